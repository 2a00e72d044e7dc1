// SPDX-License-Identifier: BSD-3-Clause
#include "WaftToolBar.h"

#include "WaftCamera.h"
#include "WaftCheck.h"
#include "WaftFly.h"
#include "WaftHold.h"
#include "WaftMenu.h"
#include "WaftRemarks.h"
#include "WaftStages.h"

#include <pqApplicationCore.h>
#include <pqObjectBuilder.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>
#include <pqTimeKeeper.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkSMProxy.h>

#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QProgressBar>
#include <QStyle>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

constexpr int BetweenLooks = 100;       // ms
constexpr int WhileItWaits = 10;        // ms
constexpr qint64 BetweenPictures = 500; // ms
constexpr qint64 WorkPerPicture = 9;    // of the time that a picture takes, at least
constexpr int BarSteps = 1000;
constexpr int BarWidth = 420; // pixels
constexpr int BarMargin = 12;
constexpr double Minute = 60.0;

/// What is left of a work, as a person says it.
QString TimeLeft(double seconds)
{
  const int minutes = static_cast<int>(std::ceil(seconds / Minute));
  return seconds < 0.0      ? QString()
         : seconds < Minute ? QString(", %1 s left").arg(std::max(1, static_cast<int>(seconds)))
                            : QString(", %1 min left").arg(minutes);
}

double SessionTime()
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  const QList<pqTimeKeeper*> keepers = model->findItems<pqTimeKeeper*>();
  return keepers.empty() ? 0.0 : keepers.front()->getTime();
}

} // namespace

WaftToolBar::WaftToolBar(QWidget* parent) :
  QToolBar("Waft", parent), Camera(new WaftCamera(this)), Check(new WaftCheck(this)),
  Fly(new WaftFly(this)), Hold(new WaftHold(this)), Remarks(new WaftRemarks(this))
{
  this->setObjectName("WaftToolBar");
  auto* fly = this->AddButton("Fly", {}, {});
  fly->setDefaultAction(this->Fly->Action());
  fly->setMenu(this->Fly->Menu());
  fly->setPopupMode(QToolButton::MenuButtonPopup);
  fly->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  this->connect(this->Fly, &WaftFly::made, this, &WaftToolBar::onSourceMade);
  this->connect(this->Fly, &WaftFly::refused, this, &WaftToolBar::onRefused);
  this->Stop = this->AddButton("Stop", "Stop", "Hold the work of Waft; the motion so far stays");
  this->Stop->setIcon(this->style()->standardIcon(QStyle::SP_MediaStop));
  this->GoOn = this->AddButton("GoOn", "Go on", "Go on with the work that was stopped");
  this->GoOn->setIcon(this->style()->standardIcon(QStyle::SP_MediaPlay));
  this->Bar = new QProgressBar(this);
  this->Bar->setObjectName("Progress");
  this->Bar->setRange(0, BarSteps);
  this->Bar->setFixedWidth(BarWidth);
  this->addWidget(this->Bar);
  this->Remarked = this->AddButton("Remarks", "!", {});
  this->Remarked->setIcon(this->style()->standardIcon(QStyle::SP_MessageBoxWarning));
  this->RemarkedShown = this->actions().last();
  this->RemarkedShown->setVisible(false);
  this->connect(this->Remarked, &QToolButton::clicked, this, &WaftToolBar::onRemarks);
  this->connect(this->Check, &WaftCheck::found, this, &WaftToolBar::onFound);
  this->connect(this->Stop, &QToolButton::clicked, this, &WaftToolBar::onStop);
  this->connect(this->GoOn, &QToolButton::clicked, this, &WaftToolBar::onGoOn);

  this->Timer.setSingleShot(true);
  this->Timer.setInterval(BetweenLooks);
  this->connect(&this->Timer, &QTimer::timeout, this, &WaftToolBar::onTimer);
  pqApplicationCore* core = pqApplicationCore::instance();
  pqObjectBuilder* builder = core->getObjectBuilder();
  this->connect(builder, &pqObjectBuilder::sourceCreated, this, &WaftToolBar::onSourceMade);
  this->connect(builder, &pqObjectBuilder::filterCreated, this, &WaftToolBar::onSourceMade);
  pqServerManagerModel* model = core->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::sourceAdded, this, &WaftToolBar::onSourceAdded);
  this->connect(model, &pqServerManagerModel::sourceRemoved, this, &WaftToolBar::onDataUpdated);
  this->connect(model, &pqServerManagerModel::preSourceRemoved, this,
                [](pqPipelineSource* source) { waft::LetGo(source->getProxy()); });
  this->connect(model, &pqServerManagerModel::dataUpdated, this, &WaftToolBar::onDataUpdated);
  this->connect(model, &pqServerManagerModel::dataUpdated, this->Check, &WaftCheck::LookAt);
  this->Show(State::Resting, {});
  // ParaView's own rows are full; this one is beside its progress. Once the window has taken it in.
  QTimer::singleShot(0, this, &WaftToolBar::MoveDown);
  waft::AddToSourcesMenu();
}

void WaftToolBar::MoveDown()
{
  if (auto* window = qobject_cast<QMainWindow*>(this->window()))
  {
    window->addToolBar(Qt::BottomToolBarArea, this);
    QAction* help =
      window->menuBar()->actions().isEmpty() ? nullptr : window->menuBar()->actions().last();
    window->menuBar()->insertMenu(help, this->Fly->Menu());
  }
}

WaftToolBar::~WaftToolBar() = default;

QToolButton* WaftToolBar::AddButton(const char* name, const QString& text, const QString& tip)
{
  auto* button = new QToolButton(this);
  button->setObjectName(name);
  button->setText(text);
  button->setToolTip(tip);
  this->addWidget(button);
  return button;
}

// Not those that a script makes, which expects the whole result.
void WaftToolBar::onSourceMade(pqPipelineSource* source)
{
  this->Camera->Follow(source);
  if (this->Now == State::Resting &&
      std::string(source->getProxy()->GetXMLName()) == "MotionSceneReader")
  {
    const QString way = "To fly a scene: File > Open, or Sources > Waft > Waft Animation";
    this->Say(way, way);
  }
  this->Remarks->ListenTo(source->getProxy());
  waft::WorkInSlices(source->getProxy());
}

void WaftToolBar::onSourceAdded(pqPipelineSource* source)
{
  pqApplicationCore* core = pqApplicationCore::instance();
  const pqUndoStack* steps = core->getUndoStack();
  if (core->isLoadingState() || (steps != nullptr && (steps->getInUndo() || steps->getInRedo())))
  {
    this->Remarks->ListenTo(source->getProxy());
    waft::WorkInSlices(source->getProxy());
  }
}

void WaftToolBar::onDataUpdated()
{
  if (!this->IsInside && !this->Timer.isActive())
  {
    this->Timer.start();
  }
}

void WaftToolBar::onTimer()
{
  if (this->IsInside)
  {
    return;
  }
  if (this->Hold->IsWithin())
  {
    this->Timer.start();
    return;
  }
  this->IsInside = true;
  this->Look();
  this->IsInside = false;
  if (this->Now == State::Working)
  {
    this->Timer.start(this->Asked != Wish::Nothing ? WhileItWaits : BetweenLooks);
  }
}

// The stages know whether they go on: one that was changed while others were stopped begins anew.
// Before a picture the work is asked to wait, and not waited for: a tick may be long in coming
// where the machine is busy.
void WaftToolBar::Look()
{
  const waft::Stages unfinished = waft::UnfinishedStages();
  this->Begun = this->Now == State::Resting ? 0 : std::max(this->Begun, unfinished.size());
  const waft::WorkOfStages work = waft::WorkOf(unfinished, this->Begun);
  const bool isIdle = !work.IsBeside && !work.HasArrived;
  if (isIdle && !(work.IsHeld && this->Asked == Wish::Picture))
  {
    this->Asked = Wish::Nothing;
    this->Show(work.IsHeld ? State::Stopped : State::Resting, work);
    return;
  }
  this->Show(State::Working, work);
  if (this->Hold->IsOn() && this->Asked != Wish::Stop)
  {
    return;
  }
  if (isIdle || work.HasArrived)
  {
    this->TakePicture();
  }
  else if (this->Asked == Wish::Nothing && this->IsPictureDue())
  {
    this->Asked = Wish::Picture;
  }
  if (this->Asked != Wish::Nothing) // a change may have begun other work since
  {
    waft::HoldWork(unfinished);
  }
}

// Where pictures take long they are not to take the most of the time.
bool WaftToolBar::IsPictureDue() const
{
  return this->SincePicture.elapsed() >=
         std::max(BetweenPictures, WorkPerPicture * this->PictureTook);
}

void WaftToolBar::TakePicture()
{
  this->Asked = this->Asked == Wish::Stop ? Wish::Stop : Wish::Nothing;
  QElapsedTimer clock;
  clock.start();
  waft::UpdateStages(waft::UnfinishedStages(), SessionTime());
  this->Draw();
  this->PictureTook = clock.elapsed();
  this->SincePicture.start();
}

void WaftToolBar::Draw()
{
  this->Camera->Refresh();
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqView* view : model->findItems<pqView*>())
  {
    view->forceRender();
  }
}

void WaftToolBar::onStop()
{
  this->Asked = Wish::Stop;
  waft::HoldWork(waft::UnfinishedStages());
  this->Timer.start();
}

void WaftToolBar::onGoOn()
{
  for (pqPipelineSource* source : waft::UnfinishedStages())
  {
    waft::WorkInSlices(source->getProxy()); // one may be a script's
  }
  this->TakePicture();
  this->Timer.start();
}

void WaftToolBar::onRefused(const QString& why)
{
  this->Say("nothing flies: " + why, "nothing flies: " + why);
}

void WaftToolBar::onFound(const QString& file, const QStringList& findings)
{
  this->Remarks->Find(file, findings);
  this->ShowRemarks();
  this->onDataUpdated();
}

void WaftToolBar::onRemarks()
{
  auto* box =
    new QMessageBox(QMessageBox::Information, "Waft", this->Remarks->All(), QMessageBox::Ok, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextFormat(Qt::PlainText);
  box->open();
}

void WaftToolBar::ShowRemarks()
{
  this->RemarkedShown->setVisible(!this->Remarks->Line().isEmpty());
  this->Remarked->setToolTip(this->Remarks->All());
}

void WaftToolBar::Say(const QString& line, const QString& whole)
{
  this->Bar->setFormat(
    this->Bar->fontMetrics().elidedText(line, Qt::ElideRight, BarWidth - BarMargin));
  this->Bar->setToolTip(whole);
}

void WaftToolBar::Show(State state, const waft::WorkOfStages& work)
{
  const State before = this->Now;
  this->Now = state;
  this->Stop->setEnabled(state == State::Working);
  this->GoOn->setEnabled(state == State::Stopped);
  this->Bar->setEnabled(state != State::Resting || !this->Remarks->Line().isEmpty());
  this->ShowRemarks();
  if (state == State::Resting)
  {
    const bool isNew = this->Remarks->TakeNews();
    if (before != state || isNew)
    {
      this->Bar->setValue(BarSteps);
      const QString remark = this->Remarks->Line();
      this->Say(remark.isEmpty() ? QString("done") : "done; " + remark, this->Remarks->All());
    }
    return;
  }
  if (before == State::Resting)
  {
    this->Remarks->Clear();
    this->SincePicture.start(); // Apply has drawn
  }
  const QString left = TimeLeft(work.SecondsLeft);
  const QString line = state == State::Stopped ? "stopped: " + work.Message : work.Message + left;
  this->Bar->setValue(static_cast<int>(std::lround(BarSteps * std::clamp(work.Done, 0.0, 1.0))));
  this->Say(line, line);
}
