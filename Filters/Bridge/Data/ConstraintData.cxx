// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/ConstraintData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/Leavings.h"
#include "Bridge/Data/SceneData.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>

namespace waft
{
namespace
{

/// Reads a line of a report's table by the names of its columns.
struct CellReader
{
  vtkTable* Table;
  const std::string& Owner;
  vtkIdType Line;

  template <class Value>
  Result Read(const char* name, Value& value) const
  {
    if (this->Table->GetColumnByName(name) == nullptr)
    {
      return Result::Error(this->Owner + ": no column `" + name + "`");
    }
    const vtkVariant cell = this->Table->GetValueByName(this->Line, name);
    const std::string expected = Take(cell, value);
    return expected.empty()
             ? Result::Ok()
             : Result::Error(this->Owner + ": line " + std::to_string(this->Line + 1) +
                             ": column `" + name + "`: expected " + expected + ", found `" +
                             std::string(cell.ToString()) + "`");
  }

private:
  // Each gives what was expected where it is something else.
  static std::string Take(const vtkVariant& cell, int& value)
  {
    bool isNumber = false;
    value = cell.ToInt(&isNumber);
    return isNumber ? "" : "a whole number";
  }
  static std::string Take(const vtkVariant& cell, double& value)
  {
    bool isNumber = !cell.ToString().empty();
    value = isNumber ? cell.ToDouble(&isNumber) : std::numeric_limits<double>::quiet_NaN();
    return isNumber || cell.ToString().empty() ? "" : "a number";
  }
  static std::string Take(const vtkVariant& cell, std::string& value)
  {
    value = cell.ToString();
    return "";
  }
  static std::string Take(const vtkVariant& cell, ConstraintKind& value)
  {
    const ConstraintTraits* traits = FindConstraintKind(cell.ToString());
    value = traits != nullptr ? traits->Kind : value;
    return traits != nullptr ? "" : "a kind of constraint";
  }
  static std::string Take(const vtkVariant& cell, ConstraintStatus& value)
  {
    const auto* found = std::find_if(std::begin(ConstraintStatuses), std::end(ConstraintStatuses),
                                     [name = std::string(cell.ToString())](ConstraintStatus one)
                                     { return name == ToString(one); });
    const bool isKnown = found != std::end(ConstraintStatuses);
    value = isKnown ? *found : value;
    return isKnown ? "" : "a status";
  }

  static constexpr ConstraintStatus ConstraintStatuses[] = { ConstraintStatus::Met,
                                                             ConstraintStatus::Infeasible,
                                                             ConstraintStatus::Conflict,
                                                             ConstraintStatus::Unreachable };
};

/// Rests that last to the last frame and are met, by ObjectId.
std::map<int, const Constraint*> LastRests(const std::vector<Constraint>& constraints, int last)
{
  std::map<int, const Constraint*> rests;
  for (const Constraint& row : constraints)
  {
    if (IsRest(row.Kind) && row.Status == ConstraintStatus::Met && LastFrame(row) >= last)
    {
      rests[row.ObjectId] = &row;
    }
  }
  return rests;
}

void AddArrivalsOf(const std::vector<Constraint>& constraints, vtkFieldData* ofObjects)
{
  vtkDataArray* ids = vtkDataArray::SafeDownCast(ofObjects->GetAbstractArray(names::ObjectId));
  std::map<int, const Constraint*> firsts;
  for (const Constraint& row : constraints)
  {
    if (IsPositional(row.Kind) && row.Status == ConstraintStatus::Met)
    {
      const Constraint*& first = firsts.try_emplace(row.ObjectId, &row).first->second;
      first = row.Frame < first->Frame ? &row : first;
    }
  }
  std::vector<int> arrivals;
  for (vtkIdType i = 0; ids != nullptr && i < ids->GetNumberOfTuples(); ++i)
  {
    const auto found = firsts.find(static_cast<int>(ids->GetTuple1(i)));
    arrivals.push_back(found != firsts.end() ? ArrivalOf(*found->second) : -1);
  }
  AddInts(ofObjects, names::Arrival, arrivals);
}

} // namespace

void ConstraintsToPolyData(const std::vector<Constraint>& constraints, const SceneInfo& info,
                           vtkPolyData* data)
{
  vtkNew<vtkDoubleArray> values;
  values->SetName(names::Value);
  values->SetNumberOfComponents(4);
  for (const Constraint& row : constraints)
  {
    if (IsAttitude(row.Kind))
    {
      const Quat& q = row.Orientation;
      values->InsertNextTuple4(q.w(), q.x(), q.y(), q.z());
    }
    else
    {
      values->InsertNextTuple4(row.Value.x(), row.Value.y(), row.Value.z(), 0.0);
    }
  }
  data->Initialize();
  SetVertices(data, Column(constraints, [](const Constraint& row)
                           { return IsPositional(row.Kind) ? row.Value : Vec3(Vec3::Zero()); }));
  vtkPointData* arrays = data->GetPointData();
  AddColumn(arrays, names::ObjectId, constraints, &Constraint::ObjectId);
  AddColumn(arrays, names::Frame, constraints, &Constraint::Frame);
  AddColumn(arrays, names::Kind, constraints,
            [](const Constraint& row) { return static_cast<unsigned char>(row.Kind); });
  arrays->AddArray(values);
  AddColumn(arrays, names::Radius, constraints, &Constraint::Radius);
  AddColumn(arrays, names::Until, constraints, &Constraint::Until);
  AddColumn(arrays, names::Hold, constraints, &Constraint::Hold);
  AddColumn(arrays, names::Drift, constraints, &Constraint::Drifts);
  AddColumn(arrays, names::HoldRadius, constraints, &Constraint::HoldRadius);
  AddLeavings(constraints, arrays);
  AddColumn(arrays, names::On, constraints, &Constraint::On);
  AddColumn(arrays, names::FrameFrom, constraints, &Constraint::FrameFrom);
  AddColumn(arrays, names::Arrival, constraints, ArrivalOf);
  AddColumn(arrays, names::Release, constraints, &Constraint::Release);
  AddColumn(arrays, names::Leave, constraints, &Constraint::Leave);
  AddColumn(arrays, names::TouchDown, constraints, &Constraint::TouchDown);
  AddColumn(arrays, names::Settled, constraints, &Constraint::Settled);
  AddColumn(arrays, names::LiftOff, constraints, &Constraint::LiftOff);
  AddColumn(arrays, names::Row, constraints, &Constraint::Row);
  AddColumn(arrays, names::Target, constraints, &Constraint::Target);
  AddColumn(arrays, names::Group, constraints, &Constraint::Group);
  AddColumn(arrays, names::ClassId, constraints, &Constraint::ClassId);
  AddColumn(arrays, names::FaceUp, constraints,
            [](const Constraint& row) { return static_cast<unsigned char>(row.Side); });
  AddColumn(arrays, names::Facing, constraints, &Constraint::Facing);
  AddColumn(arrays, names::FacingTolerance, constraints, &Constraint::FacingTolerance);
  AddColumn(arrays, names::Choice, constraints,
            [](const Constraint& row) { return static_cast<unsigned char>(row.Choice); });
  AddColumn(arrays, names::Status, constraints,
            [](const Constraint& row) { return static_cast<int>(row.Status); });
  SceneInfoToFieldData(info, data);
}

Result ConstraintsFromPolyData(vtkPolyData* data, const Timeline& time,
                               std::vector<Constraint>& constraints)
{
  const ArraySource source{ data->GetPointData(), "Constraints", data->GetNumberOfPoints() };
  const int last = time.NumberOfFrames - 1;
  const int met = 0;
  Constraint fallback;
  fallback.Until = last;
  fallback.Row = -1;
  std::vector<Constraint> read(static_cast<std::size_t>(source.Tuples), fallback);
  std::vector<int> kinds, statuses, sides, choices, arrivals;
  const int any = static_cast<int>(FaceUp::Any);
  std::vector<Quat> values;
  std::vector<Vec3> positions; // shown alone: `Value` is what counts
  WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), "Constraints", positions));
  const auto readOptional = [&](const char* name, auto member)
  { return ReadOptionalColumn(source, name, read, member); };
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::ObjectId, read, &Constraint::ObjectId));
  WAFT_RETURN_IF_FAILED(ReadColumn(source, names::Frame, read, &Constraint::Frame));
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::Kind, kinds));
  WAFT_RETURN_IF_FAILED(ReadQuaternions(source, names::Value, values));
  WAFT_RETURN_IF_FAILED(readOptional(names::Radius, &Constraint::Radius));
  WAFT_RETURN_IF_FAILED(readOptional(names::Until, &Constraint::Until));
  WAFT_RETURN_IF_FAILED(readOptional(names::Hold, &Constraint::Hold));
  WAFT_RETURN_IF_FAILED(readOptional(names::Drift, &Constraint::Drifts));
  WAFT_RETURN_IF_FAILED(readOptional(names::HoldRadius, &Constraint::HoldRadius));
  WAFT_RETURN_IF_FAILED(ReadLeavings(source, read));
  WAFT_RETURN_IF_FAILED(readOptional(names::On, &Constraint::On));
  WAFT_RETURN_IF_FAILED(readOptional(names::FrameFrom, &Constraint::FrameFrom));
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::Arrival, arrivals, &met));
  WAFT_RETURN_IF_FAILED(readOptional(names::Release, &Constraint::Release));
  WAFT_RETURN_IF_FAILED(readOptional(names::Leave, &Constraint::Leave));
  WAFT_RETURN_IF_FAILED(readOptional(names::TouchDown, &Constraint::TouchDown));
  WAFT_RETURN_IF_FAILED(readOptional(names::Settled, &Constraint::Settled));
  WAFT_RETURN_IF_FAILED(readOptional(names::LiftOff, &Constraint::LiftOff));
  WAFT_RETURN_IF_FAILED(readOptional(names::Row, &Constraint::Row));
  WAFT_RETURN_IF_FAILED(readOptional(names::Target, &Constraint::Target));
  WAFT_RETURN_IF_FAILED(readOptional(names::Group, &Constraint::Group));
  WAFT_RETURN_IF_FAILED(readOptional(names::ClassId, &Constraint::ClassId));
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::FaceUp, sides, &any));
  WAFT_RETURN_IF_FAILED(readOptional(names::Facing, &Constraint::Facing));
  WAFT_RETURN_IF_FAILED(readOptional(names::FacingTolerance, &Constraint::FacingTolerance));
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::Choice, choices, &met));
  WAFT_RETURN_IF_FAILED(ReadInts(source, names::Status, statuses, &met));
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    Constraint& row = read[i];
    const std::string vertex = "Constraints: vertex " + std::to_string(i);
    if (kinds[i] < 0 || kinds[i] >= NumberOfConstraintKinds)
    {
      return Result::Error(vertex + ": array `Kind`: expected 0 to " +
                           std::to_string(NumberOfConstraintKinds - 1) + ", found " +
                           std::to_string(kinds[i]));
    }
    if (row.Frame < 0 || row.Frame > last)
    {
      return Result::Error(vertex + ": array `Frame`: expected 0 to " + std::to_string(last) +
                           ", found " + std::to_string(row.Frame));
    }
    if (row.FrameFrom < -1 || row.FrameFrom > row.Frame)
    {
      return Result::Error(vertex + ": array `FrameFrom`: expected -1 or a frame up to `Frame`, " +
                           std::to_string(row.Frame) + ", found " + std::to_string(row.FrameFrom));
    }
    row.IsOpenWindow = row.FrameFrom >= 0 && arrivals[i] < 0;
    if (row.Radius < 0.0)
    {
      return Result::Error(vertex + ": array `Radius`: expected 0 or more, found " +
                           std::to_string(row.Radius));
    }
    if (sides[i] < 0 || sides[i] > static_cast<int>(FaceUp::Down))
    {
      return Result::Error(vertex + ": array `FaceUp`: expected 0 to 2, found " +
                           std::to_string(sides[i]));
    }
    row.Kind = static_cast<ConstraintKind>(kinds[i]);
    row.Side = static_cast<FaceUp>(sides[i]);
    if (choices[i] < 0 || choices[i] > static_cast<int>(ObjectChoice::AmongListed))
    {
      return Result::Error(vertex + ": array `Choice`: expected 0 to 2, found " +
                           std::to_string(choices[i]));
    }
    row.Choice = static_cast<ObjectChoice>(choices[i]);
    if (!row.Facing.isZero())
    {
      row.Facing.normalize();
    }
    // Value has four components; a quaternion is read as (w, x, y, z).
    const Quat& v = values[i];
    if (IsAttitude(row.Kind))
    {
      if (v.norm() == 0.0)
      {
        return Result::Error(vertex + ": array `Value`: expected a quaternion, found zeros");
      }
      row.Orientation = v.normalized();
    }
    else
    {
      row.Value = Vec3(v.w(), v.x(), v.y());
    }
    row.Until = IsLasting(row) ? std::clamp(row.Until, row.Frame, last) : row.Frame;
    row.Row = row.Row < 0 ? static_cast<int>(i) : row.Row;
    row.Status = static_cast<ConstraintStatus>(std::clamp(statuses[i], 0, 3));
  }
  constraints = std::move(read);
  return Result::Ok();
}

void AddArrivals(const std::vector<Constraint>& constraints, const std::vector<Track>& tracks,
                 vtkPolyData* objects)
{
  AddArrivalsOf(constraints, objects->GetPointData());
  vtkDataArray* ids = objects->GetPointData()->GetArray(names::ObjectId);
  std::map<int, int> leaves;
  for (const Track& track : tracks)
  {
    leaves[track.ObjectId] = track.Leave;
  }
  std::vector<int> all;
  for (vtkIdType i = 0; ids != nullptr && i < ids->GetNumberOfTuples(); ++i)
  {
    const auto found = leaves.find(static_cast<int>(ids->GetTuple1(i)));
    all.push_back(found != leaves.end() ? found->second : -1);
  }
  AddInts(objects->GetPointData(), names::Leave, all);
}

void AddRowTimes(const std::vector<Constraint>& constraints, vtkPolyData* tracks)
{
  vtkDataArray* ids = tracks->GetCellData()->GetArray(names::ObjectId);
  const vtkIdType count = ids != nullptr ? ids->GetNumberOfTuples() : 0;
  if (count == 0)
  {
    return;
  }
  const int last = static_cast<int>(tracks->GetNumberOfPoints() / count) - 1;
  const std::map<int, const Constraint*> rests = LastRests(constraints, last);
  std::vector<int> touchDowns, settled;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const auto found = rests.find(static_cast<int>(ids->GetTuple1(i)));
    const Constraint* rest = found != rests.end() ? found->second : nullptr;
    settled.push_back(rest != nullptr ? FirstFrame(*rest) : -1);
    touchDowns.push_back(rest != nullptr && rest->TouchDown >= 0
                           ? std::min(rest->TouchDown, settled.back())
                           : settled.back());
  }
  AddInts(tracks->GetCellData(), names::TouchDown, touchDowns);
  AddInts(tracks->GetCellData(), names::Settled, settled);
  AddArrivalsOf(constraints, tracks->GetCellData());
}

void AddLandings(const std::vector<Constraint>& constraints,
                 const std::vector<MotionObject>& objects, const std::vector<Track>& tracks,
                 vtkPolyData* rows)
{
  std::map<int, double> below; // the centre of a body that lies, by ObjectId
  for (const MotionObject& object : objects)
  {
    below[object.ObjectId] = object.RestHeight;
  }
  std::map<int, const Track*> trackOf;
  for (const Track& track : tracks)
  {
    trackOf[track.ObjectId] = &track;
  }
  std::vector<double> heights;
  for (const Constraint& row : constraints)
  {
    heights.push_back(std::numeric_limits<double>::quiet_NaN());
    const auto found = trackOf.find(row.ObjectId);
    if (IsRest(row.Kind) && row.Status == ConstraintStatus::Met && found != trackOf.end() &&
        !found->second->Positions.empty())
    {
      const std::vector<Vec3>& places = found->second->Positions;
      const auto frame = static_cast<std::size_t>(std::max(FirstFrame(row), 0));
      heights.back() = places[std::min(frame, places.size() - 1)].z() - below[row.ObjectId];
    }
  }
  AddDoubles(rows->GetFieldData(), names::LandingHeight, heights);
}

std::vector<int> SettledFrames(const std::vector<Constraint>& constraints,
                               const std::vector<Track>& tracks)
{
  const int last = tracks.empty() ? 0 : static_cast<int>(tracks.front().Positions.size()) - 1;
  const std::map<int, const Constraint*> rests = LastRests(constraints, last);
  std::vector<int> frames;
  for (const Track& track : tracks)
  {
    const auto found = rests.find(track.ObjectId);
    frames.push_back(found != rests.end() ? FirstFrame(*found->second) : -1);
  }
  return frames;
}

void ReportToTable(const std::vector<ReportRow>& lines, const SceneInfo& info, vtkTable* table)
{
  std::vector<ReportRow> report;
  std::copy_if(lines.begin(), lines.end(), std::back_inserter(report),
               [](const ReportRow& line) { return line.Target != OfNoRow; });
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddColumn(columns, names::Row, report, &ReportRow::Row);
  AddColumn(columns, names::Target, report, &ReportRow::Target);
  AddColumn(columns, names::ObjectId, report, &ReportRow::ObjectId);
  AddColumn(columns, names::Frame, report, &ReportRow::Frame);
  AddColumn(columns, names::Kind, report,
            [](const ReportRow& line) { return std::string(ToString(line.Kind)); });
  AddColumn(columns, names::Residual, report, &ReportRow::Residual);
  AddColumn(columns, names::Status, report,
            [](const ReportRow& line) { return std::string(ToString(line.Status)); });
  AddColumn(columns, names::Message, report, &ReportRow::Message);
  AddColumn(columns, names::TouchDown, report, &ReportRow::TouchDown);
  AddColumn(columns, names::Settled, report, &ReportRow::Settled);
  AddColumn(columns, names::Arrival, report, &ReportRow::Arrival);
  AddColumn(columns, names::Release, report, &ReportRow::Release);
  AddColumn(columns, names::Leave, report, &ReportRow::Leave);
  SceneInfoToFieldData(info, table);
}

Result ReportFromTable(vtkTable* table, const std::string& owner, std::vector<ReportRow>& report)
{
  std::vector<ReportRow> read(static_cast<std::size_t>(table->GetNumberOfRows()));
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    const CellReader cells{ table, owner, static_cast<vtkIdType>(i) };
    ReportRow& line = read[i];
    WAFT_RETURN_IF_FAILED(cells.Read(names::Row, line.Row));
    WAFT_RETURN_IF_FAILED(cells.Read(names::Target, line.Target));
    WAFT_RETURN_IF_FAILED(cells.Read(names::ObjectId, line.ObjectId));
    WAFT_RETURN_IF_FAILED(cells.Read(names::Frame, line.Frame));
    WAFT_RETURN_IF_FAILED(cells.Read(names::Kind, line.Kind));
    WAFT_RETURN_IF_FAILED(cells.Read(names::Residual, line.Residual));
    WAFT_RETURN_IF_FAILED(cells.Read(names::Status, line.Status));
    WAFT_RETURN_IF_FAILED(cells.Read(names::Message, line.Message));
    WAFT_RETURN_IF_FAILED(cells.Read(names::TouchDown, line.TouchDown));
    WAFT_RETURN_IF_FAILED(cells.Read(names::Settled, line.Settled));
    if (table->GetColumnByName(names::Leave) != nullptr) // not of older runs
    {
      WAFT_RETURN_IF_FAILED(cells.Read(names::Arrival, line.Arrival));
      WAFT_RETURN_IF_FAILED(cells.Read(names::Release, line.Release));
      WAFT_RETURN_IF_FAILED(cells.Read(names::Leave, line.Leave));
    }
  }
  report = std::move(read);
  return Result::Ok();
}

} // namespace waft
