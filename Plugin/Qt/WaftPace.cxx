// SPDX-License-Identifier: BSD-3-Clause
#include "WaftPace.h"

#include "WaftFrame.h"

#include <pqAnimationManager.h>
#include <pqAnimationScene.h>
#include <pqDataRepresentation.h>
#include <pqPVApplicationCore.h>
#include <pqServerManagerModel.h>

#include <vtkCompositeAnimationPlayer.h>
#include <vtkSMAnimationScene.h>
#include <vtkSMProxy.h>

#include <algorithm>

namespace
{

bool IsFlightShown()
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  const QList<pqDataRepresentation*> shown = model->findItems<pqDataRepresentation*>();
  return std::any_of(shown.begin(), shown.end(),
                     [](pqDataRepresentation* one)
                     { return one->isVisible() && waft::IsMotion(one); });
}

} // namespace

WaftPace::WaftPace(QObject* parent) : QObject(parent)
{
  const pqAnimationManager* animations = pqPVApplicationCore::instance()->animationManager();
  this->connect(animations, SIGNAL(beginPlay(vtkObject*, unsigned long, void*, void*)),
                SLOT(onBegin()));
  this->connect(animations, SIGNAL(endPlay(vtkObject*, unsigned long, void*, void*)),
                SLOT(onEnd()));
}

WaftPace::~WaftPace() = default;

// The mode of the property stays, and with it what the window shows of frames. A film is written
// by a scene that draws nothing itself.
void WaftPace::onBegin()
{
  pqAnimationScene* active = pqPVApplicationCore::instance()->animationManager()->getActiveScene();
  auto* scene = vtkSMAnimationScene::SafeDownCast(active->getProxy()->GetClientSideObject());
  if (scene->GetPlayMode() == vtkCompositeAnimationPlayer::SNAP_TO_TIMESTEPS &&
      !scene->GetOverrideStillRender() && IsFlightShown())
  {
    this->Paced = scene;
    scene->SetPlayMode(vtkCompositeAnimationPlayer::REAL_TIME);
  }
}

void WaftPace::onEnd()
{
  if (this->Paced != nullptr)
  {
    this->Paced->SetPlayMode(vtkCompositeAnimationPlayer::SNAP_TO_TIMESTEPS);
    this->Paced = nullptr;
  }
}
