// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/DatabaseConversion.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <algorithm>

namespace waft
{
namespace
{

vtkDoubleArray* FindRows(const ArraySource& source, const char* name, Result& result)
{
  auto* array = vtkDoubleArray::SafeDownCast(source.Data->GetArray(name));
  if (!array || array->GetNumberOfTuples() != source.Tuples)
  {
    result = Result::Error(source.Owner + ": expected an array `" + name + "` of doubles with " +
                           std::to_string(source.Tuples) + " entries");
    return nullptr;
  }
  return array;
}

Result ReadBasis(vtkTable* table, MotionDatabase& database)
{
  const ArraySource source{ table->GetRowData(), "Basis", table->GetNumberOfRows(), true };
  std::vector<int> groups, ranks;
  std::vector<double> errors, means;
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::Group, groups));
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::Rank, ranks));
  WAFT_RETURN_IF_FAILED(ReadDoubles(source, names::RelativeError, errors));
  WAFT_RETURN_IF_FAILED(ReadDoubles(source, names::Mean, means));
  Result result = Result::Ok();
  vtkDoubleArray* basis = FindRows(source, names::Basis, result);
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
  WAFT_RETURN_IF_FAILED(CheckCells(data, "Segments"));
  const ArraySource cells{ data->GetCellData(), "Segments", data->GetNumberOfCells(), true };
  const ArraySource points{ data->GetPointData(), "Segments", data->GetNumberOfPoints(), true };
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
  const std::string owner = "Segments: field data";
  double window = 0.0;
  WAFT_RETURN_IF_FAILED(ReadNumber(fields, owner, names::Window, limits::UpTo(1e6), window));
  database.Window = static_cast<int>(window);
  database.SettlingSpeed = 0.0;
  WAFT_RETURN_IF_FAILED(ReadNumber(fields, owner, names::SettlingSpeed,
                                   limits::UpTo(limits::Speed.High), database.SettlingSpeed));
  database.TopSpeed = 0.0;
  return ReadNumber(fields, owner, names::TopSpeed, limits::UpTo(limits::Speed.High),
                    database.TopSpeed);
}

Result ReadNodes(vtkTable* table, MotionDatabase& database)
{
  const ArraySource source{ table->GetRowData(), "Nodes", table->GetNumberOfRows(), true };
  database.Nodes.resize(static_cast<std::size_t>(source.Tuples));
  std::vector<ClusterNode>& nodes = database.Nodes;
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::Group, nodes, &ClusterNode::Group));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::Parent, nodes, &ClusterNode::Parent));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::Medoid, nodes, &ClusterNode::Medoid));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::FirstChild, nodes, &ClusterNode::FirstChild));
  WAFT_RETURN_IF_FAILED(
    ReadColumn(source, names::NumberOfChildren, nodes, &ClusterNode::NumberOfChildren));
  WAFT_RETURN_IF_FAILED(
    ReadColumn(source, names::NumberOfSegments, nodes, &ClusterNode::NumberOfSegments));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::Radius, nodes, &ClusterNode::Radius));
  for (std::size_t n = 0; n < nodes.size(); ++n)
  {
    if (nodes[n].Parent == -1)
    {
      database.TopNodes.push_back(static_cast<int>(n));
    }
  }
  return Result::Ok();
}

Result ReadConnections(vtkTable* table, MotionDatabase& database)
{
  const ArraySource source{ table->GetRowData(), "Connections", table->GetNumberOfRows(), true };
  std::vector<Connection>& connections = database.Connections;
  connections.resize(static_cast<std::size_t>(source.Tuples));
  std::vector<int> isConnectible;
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::Cost, connections, &Connection::Cost));
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::IsConnectible, isConnectible));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::Rotation, connections, &Connection::Rotation));
  WAFT_RETURN_IF_FAILED(
    ReadColumn(source, names::Translation, connections, &Connection::Translation));
  for (std::size_t i = 0; i < connections.size(); ++i)
  {
    connections[i].IsConnectible = isConnectible[i] != 0;
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
               : Result::Error(std::string("block `") + name + "` is missing or of another type");
}

Result ReadDatabase(vtkMultiBlockDataSet* data, MotionDatabase& database)
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

} // namespace

Result DatabaseFromMultiBlock(vtkMultiBlockDataSet* data, MotionDatabase& database)
{
  const std::string owner = "motion database: ";
  const Result result = ReadDatabase(data, database);
  const bool isNamed = result || result.Message().rfind(owner, 0) == 0;
  return isNamed ? result : Result::Error(owner + result.Message());
}

} // namespace waft
