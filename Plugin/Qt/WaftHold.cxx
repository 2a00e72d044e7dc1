// SPDX-License-Identifier: BSD-3-Clause
#include "WaftHold.h"

#include "WaftStages.h"

#include <pqAnimationManager.h>
#include <pqPVApplicationCore.h>
#include <pqProgressManager.h>

#include <QAction>
#include <QMessageBox>
#include <QPushButton>
#include <QTimer>
#include <QWidget>

namespace
{

/// What ParaView does on an action, where that is to save more than what is seen.
QObject* SavesBy(const QAction* action)
{
  for (QObject* child : action->children())
  {
    for (const char* kind :
         { "pqSaveAnimationReaction", "pqSaveAnimationGeometryReaction", "pqSaveDataReaction",
           "pqSaveExtractsReaction", "pqAnimatedExportReaction" })
    {
      if (child->inherits(kind))
      {
        return child;
      }
    }
  }
  return nullptr;
}

} // namespace

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

// ParaView's own slots come after the question, if at all.
void WaftHold::WatchActions()
{
  for (QAction* action : this->Bar->window()->findChildren<QAction*>())
  {
    if (QObject* reaction = SavesBy(action))
    {
      QObject::disconnect(action, SIGNAL(triggered(bool)), reaction, nullptr);
      this->connect(action, &QAction::triggered, this,
                    [this, action, reaction] { this->Save(action, reaction); });
    }
  }
}

void WaftHold::Let(QObject* reaction)
{
  QMetaObject::invokeMethod(reaction, "onTriggered", Qt::DirectConnection);
}

void WaftHold::Save(QAction* action, QObject* reaction)
{
  if (waft::UnfinishedStages().empty())
  {
    Let(reaction);
    return;
  }
  auto* box = new QMessageBox(QMessageBox::Question, "Waft",
                              "The flight is not done: what is saved now is the motion so far.",
                              QMessageBox::Cancel, this->Bar->window());
  box->setObjectName("WaftSave");
  box->setAttribute(Qt::WA_DeleteOnClose);
  QPushButton* wait = box->addButton("Wait, then save", QMessageBox::AcceptRole);
  wait->setObjectName("Wait");
  box->setDefaultButton(wait);
  QPushButton* now = box->addButton("Save as it is", QMessageBox::DestructiveRole);
  now->setObjectName("Now");
  this->connect(box, &QMessageBox::buttonClicked, this,
                [this, action, reaction, wait, now](QAbstractButton* clicked)
                {
                  if (clicked == now)
                  {
                    // Once the question is gone.
                    QTimer::singleShot(0, reaction, [reaction] { Let(reaction); });
                  }
                  else if (clicked == wait)
                  {
                    this->Waiting = action;
                    Q_EMIT this->wanted();
                    QTimer::singleShot(0, this, &WaftHold::SaveAwaited); // it may be done by now
                  }
                });
  box->open();
}

QString WaftHold::Awaited() const
{
  return this->Waiting ? this->Waiting->text().remove('&').remove("...") : QString();
}

void WaftHold::SaveAwaited()
{
  if (this->Waiting && waft::UnfinishedStages().empty())
  {
    QAction* action = this->Waiting;
    this->Waiting = nullptr;
    action->trigger();
  }
}
