// SPDX-License-Identifier: BSD-3-Clause
#include "WaftCamera.h"

#include "WaftActive.h"
#include "WaftFrame.h"

#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkCamera.h>
#include <vtkSMProxy.h>
#include <vtkSMRenderViewProxy.h>

#include <QAction>
#include <QTimer>
#include <QWidget>

#include <algorithm>
#include <vector>

namespace
{

/// What a view shows of pipelines.
std::vector<pqDataRepresentation*> ShownIn(pqRenderView* view)
{
  std::vector<pqDataRepresentation*> shown;
  for (pqRepresentation* one : view->getRepresentations())
  {
    auto* data = qobject_cast<pqDataRepresentation*>(one);
    if (data != nullptr && data->isVisible() && data->getInput() != nullptr)
    {
      shown.push_back(data);
    }
  }
  return shown;
}

} // namespace

WaftCamera::WaftCamera(QWidget* bar) : QObject(bar), Bar(bar)
{
  QTimer::singleShot(0, this, &WaftCamera::WatchActions); // once the window is there
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::preSourceRemoved, this,
                [this](pqPipelineSource* source) { this->Sources.erase(source); });
  this->connect(model, &pqServerManagerModel::preViewRemoved, this,
                [this](pqView* view) { this->Framed.erase(qobject_cast<pqRenderView*>(view)); });
}

WaftCamera::~WaftCamera() = default;

void WaftCamera::Follow(pqPipelineSource* source)
{
  this->Sources.insert(source);
  // Apply shows one port after the other, and sets the camera by the first.
  this->connect(source, &pqPipelineSource::visibilityChanged, this,
                [this] { QTimer::singleShot(0, this, &WaftCamera::Refresh); });
}

// ParaView's own slot, which takes in the whole ground, comes before.
void WaftCamera::WatchActions()
{
  for (QAction* action : this->Bar->window()->findChildren<QAction*>())
  {
    const QString name = action->objectName();
    if (name.startsWith("actionResetCamera") || name.startsWith("actionPositive") ||
        name.startsWith("actionNegative") || name == "actionIsometricView")
    {
      this->connect(action, &QAction::triggered, this, &WaftCamera::LeaveOutFloor);
    }
  }
}

void WaftCamera::LeaveOutFloor()
{
  auto* view = qobject_cast<pqRenderView*>(waft::ActiveOf<pqView*>("ActiveView"));
  if (view == nullptr)
  {
    return;
  }
  const std::vector<pqDataRepresentation*> shown = ShownIn(view);
  if (std::any_of(shown.begin(), shown.end(), waft::IsMotion) && waft::Reset(view, shown))
  {
    view->render();
  }
}

void WaftCamera::Settle()
{
  for (auto& [view, place] : this->Framed)
  {
    place = Place{};
  }
}

void WaftCamera::FrameFlight()
{
  SCOPED_UNDO_EXCLUDE();
  auto* view = qobject_cast<pqRenderView*>(waft::ActiveOf<pqView*>("ActiveView"));
  if (view != nullptr && waft::Frame(view, ShownIn(view)))
  {
    view->render();
  }
}

void WaftCamera::Refresh()
{
  SCOPED_UNDO_EXCLUDE();
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqRenderView* view : model->findItems<pqRenderView*>())
  {
    const std::vector<pqDataRepresentation*> shown = ShownIn(view);
    if (shown.empty())
    {
      this->Framed.erase(view);
      continue;
    }
    const bool isNew =
      this->Framed.count(view) == 0 &&
      std::all_of(shown.begin(), shown.end(),
                  [this](pqDataRepresentation* one)
                  { return this->Sources.count(one->getInput()) != 0 && waft::IsMotion(one); });
    for (pqDataRepresentation* one : shown)
    {
      // Where first data came after it was shown, its look is put on now.
      one->getProxy()->UpdateVTKObjects();
    }
    const Place before = PlaceOf(view);
    if (!isNew && !this->IsMine(view))
    {
      // What others show first is theirs from then on.
      this->Framed.insert({ view, Place{} });
    }
    else if (waft::Frame(view, shown))
    {
      if (isNew)
      {
        waft::SetBackdrop(view);
      }
      this->Framed[view] = PlaceOf(view);
      if (this->Framed[view] != before)
      {
        view->render();
      }
    }
  }
}

bool WaftCamera::IsMine(pqRenderView* view)
{
  const auto found = this->Framed.find(view);
  return found != this->Framed.end() && found->second == PlaceOf(view);
}

WaftCamera::Place WaftCamera::PlaceOf(pqRenderView* view)
{
  vtkCamera* camera = view->getRenderViewProxy()->GetActiveCamera();
  Place place;
  camera->GetPosition(place.data());
  camera->GetFocalPoint(place.data() + 3);
  return place;
}
