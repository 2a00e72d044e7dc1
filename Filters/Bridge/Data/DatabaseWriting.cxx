// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/DatabaseConversion.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

// The order of the blocks.
constexpr const char* BlockNames[] = { names::Segments,    names::Basis,    names::Nodes,
                                       names::Connections, names::Vortices, names::Provenance };

Eigen::Index LargestRank(const MotionDatabase& database)
{
  Eigen::Index rank = 1; // an array has at least one component
  for (const SegmentGroup& group : database.Groups)
  {
    rank = std::max(rank, group.Basis.cols());
  }
  return rank;
}

vtkNew<vtkDoubleArray> ZeroRows(const char* name, std::size_t rows, Eigen::Index components)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(components));
  array->SetNumberOfTuples(static_cast<vtkIdType>(rows));
  array->Fill(0.0);
  return array;
}

// The points of segments are only looked at; to a micrometre they take half of the room in a file.
Vec3 ForDisplay(const Vec3& x)
{
  constexpr double grain = 1.0 / (1 << 20);
  return (x / grain).array().round().matrix() * grain;
}

void WriteSegments(const MotionDatabase& database, vtkPolyData* data)
{
  std::vector<Vec3> positions;
  std::vector<unsigned char> types;
  std::vector<int> vortexIds;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> coefficients =
    ZeroRows(names::Coefficients, database.Segments.size(), LargestRank(database));
  for (std::size_t s = 0; s < database.Segments.size(); ++s)
  {
    const Segment& segment = database.Segments[s];
    const std::vector<Vec3> path = database.Reconstruct(static_cast<int>(s));
    lines->InsertNextCell(static_cast<int>(path.size()));
    for (std::size_t i = 0; i < path.size(); ++i)
    {
      lines->InsertCellPoint(static_cast<vtkIdType>(positions.size()));
      types.push_back(static_cast<unsigned char>(segment.ForceTypes[i]));
      vortexIds.push_back(segment.VortexIds[i]);
      positions.push_back(ForDisplay(path[i]));
    }
    for (Eigen::Index c = 0; c < segment.Coefficients.size(); ++c)
    {
      coefficients->SetComponent(static_cast<vtkIdType>(s), static_cast<int>(c),
                                 segment.Coefficients[c]);
    }
  }
  vtkNew<vtkPoints> points;
  SetPoints(points, positions);
  data->SetPoints(points);
  data->SetLines(lines);
  AddBytes(data->GetPointData(), names::ForceType, types);
  AddInts(data->GetPointData(), names::VortexId, vortexIds);
  AddColumn(data->GetCellData(), names::Group, database.Segments, &Segment::Group);
  AddColumn(data->GetCellData(), names::Simulation, database.Segments, &Segment::Simulation);
  AddColumn(data->GetCellData(), names::MeanWind, database.Segments, &Segment::MeanWind);
  data->GetCellData()->AddArray(coefficients);
}

void WriteBasis(const MotionDatabase& database, vtkTable* table)
{
  std::vector<int> groups, ranks;
  std::vector<double> errors, means;
  for (std::size_t g = 0; g < database.Groups.size(); ++g)
  {
    const SegmentGroup& group = database.Groups[g];
    const auto rows = static_cast<std::size_t>(group.Mean.size());
    groups.insert(groups.end(), rows, static_cast<int>(g));
    ranks.insert(ranks.end(), rows, static_cast<int>(group.Basis.cols()));
    errors.insert(errors.end(), rows, group.RelativeError);
    means.insert(means.end(), group.Mean.data(), group.Mean.data() + rows);
  }
  vtkNew<vtkDoubleArray> basis = ZeroRows(names::Basis, groups.size(), LargestRank(database));
  vtkIdType first = 0;
  for (const SegmentGroup& group : database.Groups)
  {
    for (Eigen::Index row = 0; row < group.Basis.rows(); ++row)
    {
      for (Eigen::Index c = 0; c < group.Basis.cols(); ++c)
      {
        basis->SetComponent(first + row, static_cast<int>(c), group.Basis(row, c));
      }
    }
    first += group.Basis.rows();
  }
  vtkDataSetAttributes* columns = table->GetRowData();
  AddInts(columns, names::Group, groups);
  AddInts(columns, names::Rank, ranks);
  AddDoubles(columns, names::RelativeError, errors);
  AddDoubles(columns, names::Mean, means);
  columns->AddArray(basis);
}

void WriteNodes(const MotionDatabase& database, vtkTable* table)
{
  const std::vector<ClusterNode>& nodes = database.Nodes;
  vtkDataSetAttributes* columns = table->GetRowData();
  AddColumn(columns, names::Group, nodes, &ClusterNode::Group);
  AddColumn(columns, names::Parent, nodes, &ClusterNode::Parent);
  AddColumn(columns, names::Medoid, nodes, &ClusterNode::Medoid);
  AddColumn(columns, names::FirstChild, nodes, &ClusterNode::FirstChild);
  AddColumn(columns, names::NumberOfChildren, nodes, &ClusterNode::NumberOfChildren);
  AddColumn(columns, names::NumberOfSegments, nodes, &ClusterNode::NumberOfSegments);
  AddColumn(columns, names::Radius, nodes, &ClusterNode::Radius);
}

void WriteConnections(const MotionDatabase& database, vtkTable* table)
{
  const std::vector<Connection>& connections = database.Connections;
  std::vector<int> before, after;
  const std::size_t count = database.TopNodes.size();
  for (std::size_t pair = 0; pair < connections.size(); ++pair)
  {
    before.push_back(database.TopNodes[pair / count]);
    after.push_back(database.TopNodes[pair % count]);
  }
  vtkDataSetAttributes* columns = table->GetRowData();
  AddInts(columns, names::Before, before);
  AddInts(columns, names::After, after);
  AddColumn(columns, names::Cost, connections, &Connection::Cost);
  AddColumn(columns, names::IsConnectible, connections,
            [](const Connection& c) { return static_cast<unsigned char>(c.IsConnectible); });
  AddColumn(columns, names::Rotation, connections, &Connection::Rotation);
  AddColumn(columns, names::Translation, connections, &Connection::Translation);
}

void WriteProvenance(const MotionDatabase& database, vtkTable* table)
{
  std::vector<std::string> keys, values;
  for (const auto& [key, value] : database.Provenance)
  {
    keys.push_back(key);
    values.push_back(value);
  }
  AddStrings(table->GetRowData(), names::Key, keys);
  AddStrings(table->GetRowData(), names::Value, values);
}

} // namespace

void DatabaseToMultiBlock(const MotionDatabase& database, vtkMultiBlockDataSet* data)
{
  SceneInfo info;
  info.Bounds = database.Volume;
  info.Time.FramesPerSecond = database.FramesPerSecond;
  const auto seed = database.Provenance.find("Seed");
  info.Seed = seed != database.Provenance.end() ? std::strtoull(seed->second.c_str(), nullptr, 10)
                                                : info.Seed;

  vtkNew<vtkPolyData> segments;
  vtkNew<vtkTable> basis, nodes, connections, provenance;
  vtkNew<vtkPolyData> vortices;
  WriteSegments(database, segments);
  WriteBasis(database, basis);
  WriteNodes(database, nodes);
  WriteConnections(database, connections);
  VorticesToPolyData(database.Vortices, info, vortices);
  WriteProvenance(database, provenance);
  vtkDataObject* blocks[] = { segments, basis, nodes, connections, vortices, provenance };

  data->Initialize();
  for (unsigned int b = 0; b < 6; ++b)
  {
    SceneInfoToFieldData(info, blocks[b]);
    data->SetBlock(b, blocks[b]);
    data->GetMetaData(b)->Set(vtkCompositeDataSet::NAME(), BlockNames[b]);
  }
  vtkFieldData* fields = segments->GetFieldData();
  AddInts(fields, names::Window, { database.Window });
  AddDoubles(fields, names::SettlingSpeed, { database.SettlingSpeed });
  AddDoubles(fields, names::TopSpeed, { database.TopSpeed });
  SceneInfoToFieldData(info, data);
}

void CoverageToTable(const std::vector<CoveragePoint>& coverage, vtkTable* table)
{
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddColumn(columns, names::Simulations, coverage, &CoveragePoint::Simulations);
  AddColumn(columns, names::NewSegments, coverage, &CoveragePoint::NewSegments);
  AddColumn(columns, names::NewShare, coverage, &CoveragePoint::NewShare);
}

} // namespace waft
