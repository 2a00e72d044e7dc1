// SPDX-License-Identifier: BSD-3-Clause
#include "WaftVerdict.h"

#include "WaftStages.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <vtkAlgorithm.h>
#include <vtkMotionReport.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <algorithm>
#include <string>

namespace waft
{

namespace
{

// As they stand in reports, the worst first.
constexpr const char* Unmet[] = { "infeasible", "conflict", "unreachable" };

/// -1 where there is none of that name.
int PortOf(vtkSMSourceProxy* source, const char* name)
{
  for (unsigned int i = 0; source != nullptr && i < source->GetNumberOfOutputPorts(); ++i)
  {
    if (std::string(source->GetOutputPortName(i)) == name)
    {
      return static_cast<int>(i);
    }
  }
  return -1;
}

/// What a port of a source has on the client; nullptr where there is none.
template <class Data>
Data* OutputOf(vtkSMProxy* proxy, const char* name)
{
  auto* source = vtkSMSourceProxy::SafeDownCast(proxy);
  const int port = PortOf(source, name);
  auto* stage = port >= 0 ? vtkAlgorithm::SafeDownCast(source->GetClientSideObject()) : nullptr;
  return stage != nullptr ? Data::SafeDownCast(stage->GetOutputDataObject(port)) : nullptr;
}

vtkSMProxy* GiverOf(vtkSMProxy* stage, const char* input)
{
  return stage != nullptr ? vtkSMPropertyHelper(stage, input, /*quiet=*/true).GetAsProxy()
                          : nullptr;
}

struct Reports
{
  vtkTable* Moved = nullptr;
  vtkTable* Planned = nullptr;
  vtkTable* Turned = nullptr;
  vtkPolyData* Rows = nullptr;
  bool HasObstacles = true; // or may have
};

Reports OfAnimation(vtkSMProxy* source)
{
  Reports reports;
  reports.Planned = OutputOf<vtkTable>(source, "PlannedReport");
  reports.Moved = reports.Planned;
  for (const char* moved : { "AssimilatedReport", "OptimisedReport" })
  {
    auto* report = OutputOf<vtkTable>(source, moved);
    if (report != nullptr && report->GetNumberOfRows() > 0)
    {
      reports.Moved = report;
    }
  }
  reports.Turned = OutputOf<vtkTable>(source, "TurnedReport");
  return reports;
}

Reports OfStages(vtkSMProxy* rotation)
{
  Reports reports;
  reports.Turned = OutputOf<vtkTable>(rotation, "Report");
  vtkSMProxy* moves = GiverOf(rotation, "Tracks");
  reports.Moved = OutputOf<vtkTable>(moves, "Report");
  vtkSMProxy* plans = moves;
  while (GiverOf(plans, "Tracks") != nullptr)
  {
    plans = GiverOf(plans, "Tracks");
  }
  reports.Planned = OutputOf<vtkTable>(plans, "Report");
  reports.HasObstacles = GiverOf(plans, "Obstacles") != nullptr;
  return reports;
}

bool IsOfFile(vtkSMProxy* source)
{
  return std::string(source->GetXMLName()) == "WaftAnimation";
}

} // namespace

bool IsFlight(vtkSMProxy* source)
{
  return IsOfFile(source) || std::string(source->GetXMLName()) == "RotationRefineFilter";
}

vtkSMProxy* FlightOf(vtkSMProxy* source)
{
  for (pqPipelineSource* one : RelatedTo(source))
  {
    if (IsFlight(one->getProxy()))
    {
      return one->getProxy();
    }
  }
  return nullptr;
}

// To ask for data would make them.
bool HasFlown(vtkSMProxy* flight)
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  auto* source = model->findItem<pqPipelineSource*>(flight);
  return source != nullptr && source->modifiedState() != pqProxy::UNINITIALIZED;
}

vtkPolyData* PosesOf(vtkSMProxy* flight)
{
  return OutputOf<vtkPolyData>(flight, "Poses");
}

std::pair<vtkSMSourceProxy*, int> MarksOf(vtkSMProxy* flight)
{
  auto* source =
    vtkSMSourceProxy::SafeDownCast(IsOfFile(flight) ? flight : GiverOf(flight, "Constraints"));
  const int port = PortOf(source, IsOfFile(flight) ? "Marks" : "Constraints");
  return { port >= 0 ? source : nullptr, port };
}

QStringList UnmetMarksOf(vtkSMProxy* flight)
{
  Reports reports = IsOfFile(flight) ? OfAnimation(flight) : OfStages(flight);
  const auto [marks, port] = MarksOf(flight);
  reports.Rows =
    marks != nullptr ? OutputOf<vtkPolyData>(marks, marks->GetOutputPortName(port)) : nullptr;
  vtkNew<vtkTable> all;
  if (!vtkMotionReport::Join(reports.Moved, reports.Planned, reports.Turned, reports.Rows, all)
         .empty())
  {
    return {};
  }
  const auto cell = [&all](vtkIdType row, const char* column)
  { return QString::fromStdString(all->GetValueByName(row, column).ToString()); };
  QStringList lines;
  bool lacksGround = false;
  for (const char* status : Unmet)
  {
    for (vtkIdType row = 0; row < all->GetNumberOfRows(); ++row)
    {
      if (cell(row, "Status") != status)
      {
        continue;
      }
      const QString kind = cell(row, "Kind");
      const QString place = kind + " at frame " + cell(row, "Frame");
      const QString why = cell(row, "Message");
      const int body = all->GetValueByName(row, "ObjectId").ToInt();
      lines << (body >= 0 ? QString("body %1: ").arg(body) : QString()) +
                 (why.contains(place) ? why : place + ": " + why);
      lacksGround = lacksGround || (!reports.HasObstacles && kind == "rest" && status == Unmet[0]);
    }
  }
  if (!lines.isEmpty())
  {
    lines.prepend(
      QString("%1 of %2 marks are not met").arg(lines.size()).arg(all->GetNumberOfRows()) +
      (lacksGround ? ": add an Obstacle with Ground" : ""));
  }
  return lines;
}

} // namespace waft
