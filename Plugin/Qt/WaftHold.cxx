// SPDX-License-Identifier: BSD-3-Clause
#include "WaftHold.h"

#include "WaftStages.h"

#include <pqAnimationManager.h>
#include <pqAnimationScene.h>
#include <pqPVApplicationCore.h>
#include <pqProgressManager.h>

#include <vtkOutputWindow.h>
#include <vtkSMAnimationScene.h>
#include <vtkSMProxy.h>

#include <QAction>
#include <QTimer>
#include <QWidget>

WaftHold::WaftHold(QWidget* bar) : QObject(bar), Bar(bar)
{
  pqPVApplicationCore* core = pqPVApplicationCore::instance();
  const pqProgressManager* progress = core->getProgressManager();
  this->connect(progress, &pqProgressManager::progressStartEvent, this,
                [this] { this->IsUpdating = true; });
  this->connect(progress, &pqProgressManager::progressEndEvent, this,
                [this] { this->IsUpdating = false; });
  const pqAnimationManager* animations = core->animationManager();
  this->connect(animations, SIGNAL(beginPlay(vtkObject*, unsigned long, void*, void*)),
                SLOT(onBegin()));
  this->connect(animations, SIGNAL(endPlay(vtkObject*, unsigned long, void*, void*)),
                SLOT(onEnd()));
  QTimer::singleShot(0, this, &WaftHold::WatchActions); // once the window is there
}

WaftHold::~WaftHold() = default;

void WaftHold::onBegin()
{
  this->IsPlaying = true;
}

// A film or extracts are written by playing, without the cache that Play itself may use.
void WaftHold::onEnd()
{
  this->IsPlaying = false;
  const pqAnimationScene* active =
    pqPVApplicationCore::instance()->animationManager()->getActiveScene();
  auto* scene = active == nullptr
                  ? nullptr
                  : vtkSMAnimationScene::SafeDownCast(active->getProxy()->GetClientSideObject());
  if (scene != nullptr && scene->GetForceDisableCaching())
  {
    this->onSaved();
  }
}

// ParaView's own slot, which saves, comes before.
void WaftHold::WatchActions()
{
  for (const char* name : { "actionFileSaveData", "actionFileSaveGeometry" })
  {
    if (auto* action = this->Bar->window()->findChild<QAction*>(name))
    {
      this->connect(action, &QAction::triggered, this, &WaftHold::onSaved);
    }
  }
}

void WaftHold::onSaved()
{
  if (!waft::UnfinishedStages().empty())
  {
    vtkOutputWindowDisplayWarningText("Waft: the work is not done: what was saved now shows the "
                                      "motion so far. Save again when the tool bar Waft says "
                                      "done.\n");
  }
}
