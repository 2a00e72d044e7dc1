// SPDX-License-Identifier: BSD-3-Clause
#include "WaftFollow.h"

#include "WaftActive.h"
#include "WaftVerdict.h"

#include <pqRenderView.h>
#include <pqTimeKeeper.h>
#include <pqUndoStack.h>

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkVersionMacros.h>
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
#include <vtkVectorOperators.h> // of vtkVector.h itself since then
#endif

#include <algorithm>

namespace
{

/// The way of each body of the active flight, a point a frame; nullptr without any.
vtkPolyData* WaysOfActive()
{
  vtkSMProxy* flight = waft::FlightOf(waft::ChosenIn("ActiveSources"));
  return flight != nullptr ? waft::PosesOf(flight) : nullptr;
}

vtkVector3d PlaceAt(vtkPolyData* ways, vtkIdType body, double frame)
{
  vtkIdType count = 0;
  const vtkIdType* points = nullptr;
  ways->GetLines()->GetCellAtId(body, count, points);
  const double at = std::clamp(frame, 0.0, static_cast<double>(count - 1));
  const auto before = static_cast<vtkIdType>(at);
  const vtkIdType after = std::min(before + 1, count - 1);
  vtkVector3d from, to;
  ways->GetPoint(points[before], from.GetData());
  ways->GetPoint(points[after], to.GetData());
  return from + (to - from) * (at - static_cast<double>(before));
}

} // namespace

WaftFollow::WaftFollow(QObject* parent) : QObject(parent) {}

WaftFollow::~WaftFollow() = default;

int WaftFollow::NumberOfBodies() const
{
  vtkPolyData* ways = WaysOfActive();
  return ways != nullptr ? static_cast<int>(ways->GetNumberOfLines()) : 0;
}

void WaftFollow::SetOn(bool isOn)
{
  if (this->Keeper)
  {
    this->Keeper->disconnect(this);
  }
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  const QList<pqTimeKeeper*> keepers = model->findItems<pqTimeKeeper*>();
  this->Keeper = isOn && !keepers.empty() ? keepers.front() : nullptr;
  this->View = qobject_cast<pqRenderView*>(waft::ActiveOf<pqView*>("ActiveView"));
  if (this->Keeper)
  {
    this->connect(this->Keeper, &pqTimeKeeper::timeChanged, this, &WaftFollow::Go);
    this->LookAt();
  }
}

void WaftFollow::SetBody(int body)
{
  this->Body = body;
  if (this->Keeper)
  {
    this->LookAt();
  }
}

// From as far away, and in the direction, as the camera looks.
void WaftFollow::LookAt()
{
  this->Before = this->PlaceNow();
  if (this->Before && this->View)
  {
    vtkVector3d focus;
    vtkSMPropertyHelper(this->View->getProxy(), "CameraFocalPoint").Get(focus.GetData(), 3);
    this->Shift(*this->Before - focus);
    this->View->render();
  }
}

void WaftFollow::Go()
{
  const std::optional<vtkVector3d> now = this->PlaceNow();
  if (now && this->Before)
  {
    this->Shift(*now - *this->Before);
  }
  this->Before = now;
}

std::optional<vtkVector3d> WaftFollow::PlaceNow() const
{
  vtkPolyData* ways = WaysOfActive();
  const vtkIdType count = ways != nullptr ? ways->GetNumberOfLines() : 0;
  vtkDataArray* rate = count > 0 ? ways->GetFieldData()->GetArray("FramesPerSecond") : nullptr;
  if (rate == nullptr || this->Body >= count)
  {
    return {};
  }
  const double frame = this->Keeper->getTime() * rate->GetTuple1(0);
  if (this->Body >= 0)
  {
    return PlaceAt(ways, this->Body, frame);
  }
  vtkVector3d middle(0.0, 0.0, 0.0);
  for (vtkIdType body = 0; body < count; ++body)
  {
    middle = middle + PlaceAt(ways, body, frame) * (1.0 / static_cast<double>(count));
  }
  return middle;
}

void WaftFollow::Shift(const vtkVector3d& shift)
{
  if (!this->View)
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  vtkSMRenderViewProxy* proxy = this->View->getRenderViewProxy();
  proxy->SynchronizeCameraProperties(); // a hand may have moved it
  for (const char* name : { "CameraPosition", "CameraFocalPoint", "CenterOfRotation" })
  {
    vtkSMPropertyHelper helper(proxy, name);
    vtkVector3d place;
    helper.Get(place.GetData(), 3);
    helper.Set((place + shift).GetData(), 3);
  }
  proxy->UpdateVTKObjects();
}
