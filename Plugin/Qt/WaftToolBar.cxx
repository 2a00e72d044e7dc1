// SPDX-License-Identifier: BSD-3-Clause
#include "WaftToolBar.h"

#include "WaftActive.h"
#include "WaftBrowser.h"
#include "WaftCamera.h"
#include "WaftCheck.h"
#include "WaftFilmLook.h"
#include "WaftFly.h"
#include "WaftFollow.h"
#include "WaftHold.h"
#include "WaftMarks.h"
#include "WaftMenu.h"
#include "WaftNames.h"
#include "WaftPace.h"
#include "WaftPanel.h"
#include "WaftRemarks.h"
#include "WaftStages.h"
#include "WaftVerdict.h"

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
#include <QSignalBlocker>
#include <QSpinBox>
#include <QStyle>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace
{

constexpr int BetweenLooks = 100;       // ms
constexpr int WhileItWaits = 10;        // ms
constexpr qint64 BetweenPictures = 500; // ms
constexpr qint64 WorkPerPicture = 9;    // of the time that a picture takes, at least
constexpr int BarSteps = 1000;
constexpr int BarWidth = 470; // pixels
constexpr int BarMargin = 12;
constexpr double Minute = 60.0;

/// What is left of a work, as a person says it.
QString TimeLeft(double seconds)
{
  const int minutes = static_cast<int>(std::ceil(seconds / Minute));
  return seconds < Minute ? QString(", %1 s left").arg(std::max(1, static_cast<int>(seconds)))
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
  Fly(new WaftFly(this)), Follow(new WaftFollow(this)), Hold(new WaftHold(this)),
  Remarks(new WaftRemarks(this))
{
  this->setObjectName("WaftToolBar");
  auto* fly = this->AddButton("Fly", {}, {});
  fly->setDefaultAction(this->Fly->Action());
  fly->setMenu(this->Fly->Menu());
  fly->setPopupMode(QToolButton::MenuButtonPopup);
  fly->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  this->connect(this->Fly, &WaftFly::made, this, &WaftToolBar::onSourceMade);
  this->connect(this->Fly, &WaftFly::begun, this->Check, &WaftCheck::LookAtPlan);
  this->connect(this->Fly, &WaftFly::refused, this, &WaftToolBar::onRefused);
  this->connect(this->Fly, &WaftFly::newAirWanted, this, &WaftToolBar::onNewAir);
  this->connect(this->Hold, &WaftHold::wanted, this,
                [this]
                {
                  if (this->Now == State::Stopped)
                  {
                    this->onGoOn();
                  }
                });
  this->connect(new WaftActive(this), &WaftActive::changed, this, &WaftToolBar::onDataUpdated);
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
  this->Marks = this->AddButton("Marks", "Marks",
                                "The marks of the active flight as a table, those first that are "
                                "not met; what is selected in it is selected in the view");
  this->connect(this->Marks, &QToolButton::clicked, this,
                []
                {
                  if (vtkSMProxy* flight = waft::FlightOf(waft::ChosenIn("ActiveSources")))
                  {
                    waft::TabulateMarks(flight);
                  }
                });
  this->AddCameras();
  this->connect(this->Remarked, &QToolButton::clicked, this, &WaftToolBar::onRemarks);
  this->connect(this->Check, &WaftCheck::found, this, &WaftToolBar::onFound);
  this->connect(this->Stop, &QToolButton::clicked, this, &WaftToolBar::onStop);
  this->connect(this->GoOn, &QToolButton::clicked, this, &WaftToolBar::onGoOn);

  this->AddButton("FilmLook", {}, {})->setDefaultAction(new WaftFilmLook(this));

  this->Timer.setSingleShot(true);
  this->Timer.setInterval(BetweenLooks);
  this->connect(&this->Timer, &QTimer::timeout, this, &WaftToolBar::onTimer);
  pqApplicationCore* core = pqApplicationCore::instance();
  pqObjectBuilder* builder = core->getObjectBuilder();
  this->connect(builder, &pqObjectBuilder::sourceCreated, this, &WaftToolBar::onSourceMade);
  this->connect(builder, &pqObjectBuilder::filterCreated, this, &WaftToolBar::onSourceMade);
  pqServerManagerModel* model = core->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::sourceAdded, this, &WaftToolBar::onSourceAdded);
  this->connect(model, &pqServerManagerModel::modifiedStateChanged, this, &WaftToolBar::onApplied);
  this->connect(model, &pqServerManagerModel::sourceAdded, this, // once its file has been set
                [](pqPipelineSource* source)
                { QTimer::singleShot(0, source, [source] { waft::NameByScene(source); }); });
  this->connect(model, &pqServerManagerModel::sourceRemoved, this, &WaftToolBar::onDataUpdated);
  this->connect(model, &pqServerManagerModel::preSourceRemoved, this,
                [](pqPipelineSource* source) { waft::LetGo(source->getProxy()); });
  this->connect(model, &pqServerManagerModel::dataUpdated, this, &WaftToolBar::onDataUpdated);
  this->connect(model, &pqServerManagerModel::dataUpdated, this->Check, &WaftCheck::LookAt);
  this->Show(State::Resting, {});
  // ParaView's own rows are full; this one is beside its progress. Once the window has taken it in.
  QTimer::singleShot(0, this, &WaftToolBar::MoveDown);
  new WaftPace(this);
  waft::AddToSourcesMenu();
}

void WaftToolBar::AddCameras()
{
  QToolButton* frame = this->AddButton("Frame", "Frame flight",
                                       "Turn the camera to all that flies, over the whole shot");
  this->connect(frame, &QToolButton::clicked, this->Camera, &WaftCamera::FrameFlight);
  this->Follows = this->AddButton("Follow", "Follow", "Let the camera go along with");
  this->Follows->setCheckable(true);
  this->connect(this->Follows, &QToolButton::toggled, this->Follow, &WaftFollow::SetOn);
  this->Followed = new QSpinBox(this);
  this->Followed->setObjectName("Followed");
  this->Followed->setRange(-1, -1);
  this->Followed->setPrefix("body ");
  this->Followed->setSpecialValueText("all bodies");
  this->Followed->setToolTip("Whom the camera goes along with");
  this->addWidget(this->Followed);
  this->connect(this->Followed, QOverload<int>::of(&QSpinBox::valueChanged), this->Follow,
                &WaftFollow::SetBody);
}

void WaftToolBar::MoveDown()
{
  if (auto* window = qobject_cast<QMainWindow*>(this->window()))
  {
    window->addToolBar(Qt::BottomToolBarArea, this);
    QAction* help =
      window->menuBar()->actions().isEmpty() ? nullptr : window->menuBar()->actions().last();
    window->menuBar()->insertMenu(help, this->Fly->Menu());
    waft::NameInMenus(window);
    WaftBrowser::PutInto(window);
    waft::FitPanel(window);
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

// Before the window reads and draws, for which it stands still.
void WaftToolBar::onApplied(pqServerManagerModelItem* item)
{
  auto* source = qobject_cast<pqPipelineSource*>(item);
  if (source != nullptr && source->modifiedState() == pqProxy::UNMODIFIED &&
      waft::WorksInSlices(source->getProxy()) && this->Now == State::Resting)
  {
    waft::WorkOfStages work;
    work.Message = QString("Reading %1 ...").arg(source->getSMName());
    this->Show(State::Working, work);
    this->Bar->repaint();
    this->onDataUpdated();
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
  SCOPED_UNDO_EXCLUDE(); // what is shown of the work is no step
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

void WaftToolBar::onFound(pqPipelineSource* source, const QVector<WaftFinding>& findings)
{
  this->Remarks->Find(source->getProxy(), findings);
  this->onDataUpdated();
}

void WaftToolBar::onRemarks()
{
  auto* box = new QMessageBox(QMessageBox::Information, "Waft", this->Lines.join("\n"),
                              QMessageBox::Ok, this);
  box->setAttribute(Qt::WA_DeleteOnClose);
  box->setTextFormat(Qt::PlainText);
  box->open();
}

void WaftToolBar::onNewAir()
{
  for (pqPipelineSource* source : waft::RelatedTo(waft::ChosenIn("ActiveSources")))
  {
    if (source->getProxy()->GetProperty("WantsNewAir") != nullptr)
    {
      this->FlyAnew(source);
    }
  }
}

void WaftToolBar::DrawNewAirs()
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (waft::WantsNewAir(source->getProxy()))
    {
      this->FlyAnew(source);
    }
  }
}

void WaftToolBar::FlyAnew(pqPipelineSource* source)
{
  waft::LetGo(source->getProxy());
  waft::UpdateStages({ source }, SessionTime());
  this->Timer.start();
}

void WaftToolBar::Say(const QString& line, const QString& whole, const QString& end)
{
  const QFontMetrics letters = this->Bar->fontMetrics();
  const int room = BarWidth - BarMargin - letters.horizontalAdvance(end);
  this->Bar->setFormat(letters.elidedText(line, Qt::ElideRight, room) + end);
  this->Bar->setToolTip(whole);
}

void WaftToolBar::ShowRest()
{
  vtkSMProxy* active = waft::ChosenIn("ActiveSources");
  vtkSMProxy* flight = waft::FlightOf(active);
  const bool isFlown = flight != nullptr && waft::HasFlown(flight);
  this->Marks->setEnabled(isFlown);
  this->Lines = this->Remarks->LinesOf(active);
  this->RemarkedShown->setVisible(!this->Lines.isEmpty());
  this->Remarked->setToolTip(this->Lines.join("\n"));
  const int bodies = this->Follow->NumberOfBodies();
  {
    const QSignalBlocker quiet(this->Followed); // what is followed of another flight stays
    this->Followed->setRange(-1, bodies - 1);
  }
  this->Followed->setEnabled(bodies > 0);
  this->Follows->setEnabled(bodies > 0 || this->Follows->isChecked());
  if (this->Now != State::Resting)
  {
    return;
  }
  const QStringList parts = (isFlown ? QStringList("done") : QStringList()) + this->Lines.mid(0, 1);
  const QString rest = parts.join("; ");
  this->Bar->setEnabled(!this->Lines.isEmpty());
  if (rest != this->Rest)
  {
    this->Rest = rest;
    this->Bar->setValue(isFlown ? BarSteps : 0);
    this->Say(rest, this->Lines.join("\n"));
  }
}

void WaftToolBar::Show(State state, const waft::WorkOfStages& work)
{
  const State before = std::exchange(this->Now, state);
  this->Stop->setEnabled(state == State::Working);
  this->GoOn->setEnabled(state == State::Stopped);
  if (state == State::Resting)
  {
    if (before != state)
    {
      this->Rest.clear();
      this->Camera->Settle();
      QTimer::singleShot(0, this, [this] { this->Hold->SaveAwaited(); });
    }
    if (!this->Hold->IsOn())
    {
      this->DrawNewAirs();
      this->ShowRest();
    }
    return;
  }
  if (before == State::Resting)
  {
    for (pqPipelineSource* source : waft::UnfinishedStages())
    {
      this->Remarks->Forget(source->getProxy());
    }
    this->LeastLeft = -1.0;
    this->SincePicture.start(); // Apply has drawn
  }
  this->ShowRest();
  this->Bar->setEnabled(true);
  QString end;
  // One that grows was none: it is told again from where it shrinks below what was told.
  if (state == State::Working && work.SecondsLeft >= 0.0 &&
      (this->LeastLeft < 0.0 || work.SecondsLeft <= this->LeastLeft))
  {
    this->LeastLeft = work.SecondsLeft;
    end = TimeLeft(work.SecondsLeft);
  }
  const QString awaited = this->Hold->Awaited();
  end += awaited.isEmpty() ? QString() : "; then " + awaited;
  const QString line = (state == State::Stopped ? "stopped: " : "") + work.Message;
  this->Bar->setValue(static_cast<int>(std::lround(BarSteps * std::clamp(work.Done, 0.0, 1.0))));
  this->Say(line, line + end, end);
}
