// SPDX-License-Identifier: BSD-3-Clause
#include "WaftCamera.h"

#include "WaftFrame.h"

#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqServerManagerModel.h>

#include <vtkCamera.h>
#include <vtkSMProxy.h>
#include <vtkSMRenderViewProxy.h>

#include <QTimer>

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

WaftCamera::WaftCamera(QObject* parent) : QObject(parent)
{
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

void WaftCamera::Refresh()
{
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
