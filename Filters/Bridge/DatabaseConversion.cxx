// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/DatabaseConversion.h"

#include "Bridge/ArrayNames.h"
#include "Bridge/Arrays.h"
#include "Bridge/SceneData.h"

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
#include <vtkStringArray.h>
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

vtkDoubleArray* FindRows(const ArrayPlace& place, const char* name, Result& result)
{
  auto* array = vtkDoubleArray::SafeDownCast(place.Data->GetArray(name));
  if (!array || array->GetNumberOfTuples() != place.Tuples)
  {
    result = Result::Error(place.Owner + ": expected an array `" + name + "` of doubles with " +
                           std::to_string(place.Tuples) + " entries");
    return nullptr;
  }
  return array;
}

void WriteSegments(const MotionDatabase& database, vtkPolyData* data)
{
  std::vector<Vec3> positions, winds;
  std::vector<unsigned char> types;
  std::vector<int> vortexIds, groups, simulations;
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
    groups.push_back(segment.Group);
    simulations.push_back(segment.Simulation);
    winds.push_back(segment.MeanWind);
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
  AddInts(data->GetCellData(), names::Group, groups);
  AddInts(data->GetCellData(), names::Simulation, simulations);
  AddVectors(data->GetCellData(), names::MeanWind, winds);
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

template <class Row, class Value>
std::vector<Value> Column(const std::vector<Row>& rows, Value Row::*member)
{
  std::vector<Value> values;
  values.reserve(rows.size());
  for (const Row& row : rows)
  {
    values.push_back(row.*member);
  }
  return values;
}

void WriteNodes(const MotionDatabase& database, vtkTable* table)
{
  const std::vector<ClusterNode>& nodes = database.Nodes;
  vtkDataSetAttributes* columns = table->GetRowData();
  AddInts(columns, names::Group, Column(nodes, &ClusterNode::Group));
  AddInts(columns, names::Parent, Column(nodes, &ClusterNode::Parent));
  AddInts(columns, names::Medoid, Column(nodes, &ClusterNode::Medoid));
  AddInts(columns, names::FirstChild, Column(nodes, &ClusterNode::FirstChild));
  AddInts(columns, names::NumberOfChildren, Column(nodes, &ClusterNode::NumberOfChildren));
  AddInts(columns, names::NumberOfSegments, Column(nodes, &ClusterNode::NumberOfSegments));
  AddDoubles(columns, names::Radius, Column(nodes, &ClusterNode::Radius));
}

void WriteConnections(const MotionDatabase& database, vtkTable* table)
{
  std::vector<int> before, after;
  std::vector<unsigned char> isConnectible;
  const std::size_t count = database.TopNodes.size();
  for (std::size_t pair = 0; pair < database.Connections.size(); ++pair)
  {
    before.push_back(database.TopNodes[pair / count]);
    after.push_back(database.TopNodes[pair % count]);
    isConnectible.push_back(database.Connections[pair].IsConnectible ? 1 : 0);
  }
  vtkDataSetAttributes* columns = table->GetRowData();
  AddInts(columns, names::Before, before);
  AddInts(columns, names::After, after);
  AddDoubles(columns, names::Cost, Column(database.Connections, &Connection::Cost));
  AddBytes(columns, names::IsConnectible, isConnectible);
  AddQuaternions(columns, names::Rotation, Column(database.Connections, &Connection::Rotation));
  AddVectors(columns, names::Translation, Column(database.Connections, &Connection::Translation));
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

double Number(vtkFieldData* fields, const char* name, double fallback)
{
  vtkDataArray* array = fields->GetArray(name);
  return array && array->GetNumberOfTuples() > 0 ? array->GetComponent(0, 0) : fallback;
}

Result ReadBasis(vtkTable* table, MotionDatabase& database)
{
  const ArrayPlace place{ table->GetRowData(), "Basis", table->GetNumberOfRows() };
  std::vector<int> groups, ranks;
  std::vector<double> errors, means;
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::Group, groups));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::Rank, ranks));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::RelativeError, errors));
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::Mean, means));
  Result result = Result::Ok();
  vtkDoubleArray* basis = FindRows(place, names::Basis, result);
  WAFT_RETURN_IF_FAILED(result);
  for (std::size_t begin = 0; begin < groups.size();)
  {
    std::size_t end = begin;
    while (end < groups.size() && groups[end] == groups[begin])
    {
      ++end;
    }
    const std::size_t rows = end - begin;
    if (groups[begin] != static_cast<int>(database.Groups.size()) || rows % 3 != 0 ||
        ranks[begin] < 0 || ranks[begin] > basis->GetNumberOfComponents())
    {
      return Result::Error("Basis: row " + std::to_string(begin) +
                           ": expected the groups in order, three rows a sample, and a rank of at "
                           "most the components of `Basis`");
    }
    SegmentGroup group;
    group.NumberOfSamples = static_cast<int>(rows / 3);
    group.RelativeError = errors[begin];
    group.Mean = Eigen::Map<const Eigen::VectorXd>(means.data() + begin, rows);
    group.Basis.resize(rows, ranks[begin]);
    for (std::size_t row = 0; row < rows; ++row)
    {
      for (int c = 0; c < ranks[begin]; ++c)
      {
        group.Basis(row, c) = basis->GetComponent(static_cast<vtkIdType>(begin + row), c);
      }
    }
    database.Groups.push_back(std::move(group));
    begin = end;
  }
  return Result::Ok();
}

Result ReadSegments(vtkPolyData* data, MotionDatabase& database)
{
  const ArrayPlace cells{ data->GetCellData(), "Segments", data->GetNumberOfCells() };
  const ArrayPlace points{ data->GetPointData(), "Segments", data->GetNumberOfPoints() };
  std::vector<int> groups, simulations, types, vortexIds;
  std::vector<Vec3> winds;
  WAFT_RETURN_IF_FAILED(ReadInts(cells, names::Group, groups));
  WAFT_RETURN_IF_FAILED(ReadInts(cells, names::Simulation, simulations));
  WAFT_RETURN_IF_FAILED(ReadVectors(cells, names::MeanWind, winds));
  WAFT_RETURN_IF_FAILED(ReadInts(points, names::ForceType, types));
  WAFT_RETURN_IF_FAILED(ReadInts(points, names::VortexId, vortexIds));
  Result result = Result::Ok();
  vtkDoubleArray* coefficients = FindRows(cells, names::Coefficients, result);
  WAFT_RETURN_IF_FAILED(result);
  std::size_t first = 0;
  for (std::size_t s = 0; s < groups.size(); ++s)
  {
    const bool isKnown =
      groups[s] >= 0 && static_cast<std::size_t>(groups[s]) < database.Groups.size();
    const SegmentGroup group = isKnown ? database.Groups[groups[s]] : SegmentGroup();
    const auto samples = static_cast<std::size_t>(group.NumberOfSamples);
    if (!isKnown || first + samples > types.size() ||
        group.Basis.cols() > coefficients->GetNumberOfComponents())
    {
      return Result::Error("Segments: cell " + std::to_string(s) +
                           ": expected a group of Basis, its samples and its rank");
    }
    Segment segment;
    segment.Group = groups[s];
    segment.Simulation = simulations[s];
    segment.MeanWind = winds[s];
    segment.Coefficients.resize(group.Basis.cols());
    for (Eigen::Index c = 0; c < group.Basis.cols(); ++c)
    {
      segment.Coefficients[c] =
        coefficients->GetComponent(static_cast<vtkIdType>(s), static_cast<int>(c));
    }
    for (std::size_t i = first; i < first + samples; ++i)
    {
      segment.ForceTypes.push_back(static_cast<ForceType>(std::clamp(types[i], 0, 2)));
      segment.VortexIds.push_back(vortexIds[i]);
    }
    first += samples;
    database.Segments.push_back(std::move(segment));
  }
  SceneInfo info;
  WAFT_RETURN_IF_FAILED(SceneInfoFromFieldData(data, info));
  vtkFieldData* fields = data->GetFieldData();
  database.Volume = info.Bounds;
  database.FramesPerSecond = info.Time.FramesPerSecond;
  database.Window = static_cast<int>(Number(fields, names::Window, 0));
  database.SettlingSpeed = Number(fields, names::SettlingSpeed, 0.0);
  database.TopSpeed = Number(fields, names::TopSpeed, 0.0);
  return Result::Ok();
}

Result ReadNodes(vtkTable* table, MotionDatabase& database)
{
  const ArrayPlace place{ table->GetRowData(), "Nodes", table->GetNumberOfRows() };
  database.Nodes.resize(static_cast<std::size_t>(place.Tuples));
  const std::pair<const char*, int ClusterNode::*> columns[] = {
    { names::Group, &ClusterNode::Group },
    { names::Parent, &ClusterNode::Parent },
    { names::Medoid, &ClusterNode::Medoid },
    { names::FirstChild, &ClusterNode::FirstChild },
    { names::NumberOfChildren, &ClusterNode::NumberOfChildren },
    { names::NumberOfSegments, &ClusterNode::NumberOfSegments }
  };
  for (const auto& [name, member] : columns)
  {
    std::vector<int> values;
    WAFT_RETURN_IF_FAILED(ReadInts(place, name, values));
    for (std::size_t n = 0; n < values.size(); ++n)
    {
      database.Nodes[n].*member = values[n];
    }
  }
  std::vector<double> radii;
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::Radius, radii));
  for (std::size_t n = 0; n < radii.size(); ++n)
  {
    database.Nodes[n].Radius = radii[n];
    if (database.Nodes[n].Parent == -1)
    {
      database.TopNodes.push_back(static_cast<int>(n));
    }
  }
  return Result::Ok();
}

Result ReadConnections(vtkTable* table, MotionDatabase& database)
{
  const ArrayPlace place{ table->GetRowData(), "Connections", table->GetNumberOfRows() };
  std::vector<double> costs;
  std::vector<int> isConnectible;
  std::vector<Quat> rotations;
  std::vector<Vec3> translations;
  WAFT_RETURN_IF_FAILED(ReadDoubles(place, names::Cost, costs));
  WAFT_RETURN_IF_FAILED(ReadInts(place, names::IsConnectible, isConnectible));
  WAFT_RETURN_IF_FAILED(ReadQuaternions(place, names::Rotation, rotations));
  WAFT_RETURN_IF_FAILED(ReadVectors(place, names::Translation, translations));
  for (std::size_t i = 0; i < costs.size(); ++i)
  {
    database.Connections.push_back(
      { costs[i], rotations[i], translations[i], isConnectible[i] != 0 });
  }
  return Result::Ok();
}

Result ReadProvenance(vtkTable* table, MotionDatabase& database)
{
  auto* keys = vtkStringArray::SafeDownCast(table->GetColumnByName(names::Key));
  auto* values = vtkStringArray::SafeDownCast(table->GetColumnByName(names::Value));
  if (!keys || !values)
  {
    return Result::Error("Provenance: expected the text columns `Key` and `Value`");
  }
  for (vtkIdType i = 0; i < keys->GetNumberOfValues(); ++i)
  {
    database.Provenance[keys->GetValue(i)] = values->GetValue(i);
  }
  return Result::Ok();
}

template <class DataT>
Result FindBlock(vtkMultiBlockDataSet* data, const char* name, DataT*& block)
{
  block = nullptr;
  for (unsigned int b = 0; b < data->GetNumberOfBlocks() && !block; ++b)
  {
    if (data->HasMetaData(b) && data->GetMetaData(b)->Has(vtkCompositeDataSet::NAME()) &&
        std::string(data->GetMetaData(b)->Get(vtkCompositeDataSet::NAME())) == name)
    {
      block = DataT::SafeDownCast(data->GetBlock(b));
    }
  }
  return block ? Result::Ok()
               : Result::Error(std::string("motion database: block `") + name +
                               "` is missing or of another type");
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

Result DatabaseFromMultiBlock(vtkMultiBlockDataSet* data, MotionDatabase& database)
{
  vtkPolyData* segments = nullptr;
  vtkPolyData* vortices = nullptr;
  vtkTable* basis = nullptr;
  vtkTable* nodes = nullptr;
  vtkTable* connections = nullptr;
  vtkTable* provenance = nullptr;
  WAFT_RETURN_IF_FAILED(FindBlock(data, names::Segments, segments));
  WAFT_RETURN_IF_FAILED(FindBlock(data, names::Basis, basis));
  WAFT_RETURN_IF_FAILED(FindBlock(data, names::Nodes, nodes));
  WAFT_RETURN_IF_FAILED(FindBlock(data, names::Connections, connections));
  // A file does not keep a block that has no entries: without vortices there is none.
  const bool hasVortices = bool(FindBlock(data, names::Vortices, vortices));
  const bool hasProvenance = bool(FindBlock(data, names::Provenance, provenance));
  MotionDatabase read;
  WAFT_RETURN_IF_FAILED(ReadBasis(basis, read));
  WAFT_RETURN_IF_FAILED(ReadSegments(segments, read));
  WAFT_RETURN_IF_FAILED(ReadNodes(nodes, read));
  WAFT_RETURN_IF_FAILED(ReadConnections(connections, read));
  if (hasVortices && vortices->GetNumberOfCells() > 0)
  {
    WAFT_RETURN_IF_FAILED(VorticesFromPolyData(vortices, read.Vortices));
  }
  if (hasProvenance)
  {
    WAFT_RETURN_IF_FAILED(ReadProvenance(provenance, read));
  }
  WAFT_RETURN_IF_FAILED(read.Validate());
  database = std::move(read);
  return Result::Ok();
}

void CoverageToTable(const std::vector<CoveragePoint>& coverage, vtkTable* table)
{
  std::vector<int> simulations, segments;
  std::vector<double> shares;
  for (const CoveragePoint& point : coverage)
  {
    simulations.push_back(point.Simulations);
    segments.push_back(point.NewSegments);
    shares.push_back(point.NewShare);
  }
  table->Initialize();
  AddInts(table->GetRowData(), names::Simulations, simulations);
  AddInts(table->GetRowData(), names::NewSegments, segments);
  AddDoubles(table->GetRowData(), names::NewShare, shares);
}

} // namespace waft
