// SPDX-License-Identifier: BSD-3-Clause
#include "WaftToolBar.h"

#include "WaftCamera.h"
#include "WaftCheck.h"
#include "WaftHold.h"
#include "WaftMenu.h"
#include "WaftStages.h"

#include <pqApplicationCore.h>
#include <pqObjectBuilder.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>
#include <pqTimeKeeper.h>
#include <pqView.h>

#include <vtkSMSourceProxy.h>

#include <QMainWindow>
#include <QProgressBar>
#include <QStyle>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

constexpr int Pause = 10;         // ms for the window's own events
constexpr int WorkPerPicture = 3; // of the time that a picture takes, at least
constexpr int BarSteps = 1000;
constexpr int BarWidth = 360; // pixels

} // namespace

WaftToolBar::WaftToolBar(QWidget* parent) :
  QToolBar("Waft", parent), Camera(new WaftCamera(this)), Check(new WaftCheck(this)),
  Hold(new WaftHold(this))
{
  this->setObjectName("WaftToolBar");
  this->Stop = this->AddButton("Stop", "Stop", "Hold the work of Waft; the motion so far stays");
  this->Stop->setIcon(this->style()->standardIcon(QStyle::SP_MediaStop));
  this->GoOn = this->AddButton("GoOn", "Go on", "Go on with the work that was stopped");
  this->GoOn->setIcon(this->style()->standardIcon(QStyle::SP_MediaPlay));
  this->Bar = new QProgressBar(this);
  this->Bar->setObjectName("Progress");
  this->Bar->setRange(0, BarSteps);
  this->Bar->setFixedWidth(BarWidth);
  this->addWidget(this->Bar);
  this->connect(this->Stop, &QToolButton::clicked, this, &WaftToolBar::onStop);
  this->connect(this->GoOn, &QToolButton::clicked, this, &WaftToolBar::onGoOn);

  this->Timer.setSingleShot(true);
  this->Timer.setInterval(Pause);
  this->connect(&this->Timer, &QTimer::timeout, this, &WaftToolBar::onTimer);
  pqApplicationCore* core = pqApplicationCore::instance();
  pqObjectBuilder* builder = core->getObjectBuilder();
  this->connect(builder, &pqObjectBuilder::sourceCreated, this, &WaftToolBar::onSourceMade);
  this->connect(builder, &pqObjectBuilder::filterCreated, this, &WaftToolBar::onSourceMade);
  pqServerManagerModel* model = core->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::sourceAdded, this, &WaftToolBar::onSourceAdded);
  this->connect(model, &pqServerManagerModel::sourceRemoved, this, &WaftToolBar::onDataUpdated);
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
    this->Bar->setFormat("To fly a scene: File > Open, or Sources > Waft > Waft Animation");
  }
  waft::WorkInSlices(source->getProxy());
}

void WaftToolBar::onSourceAdded(pqPipelineSource* source)
{
  if (pqApplicationCore::instance()->isLoadingState())
  {
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
  if (this->Hold->IsOn())
  {
    this->Timer.start();
    return;
  }
  this->IsInside = true;
  std::vector<pqPipelineSource*> held = waft::HeldStages();
  if (!held.empty() && this->Now != State::Stopped)
  {
    this->WorkOn(held);
    held = waft::HeldStages();
  }
  if (held.empty())
  {
    if (this->Now != State::Resting)
    {
      this->Draw();
    }
    this->Show(State::Resting, held);
  }
  else if (this->Now != State::Stopped)
  {
    this->Show(State::Working, held);
    this->Timer.start();
  }
  this->IsInside = false;
}

void WaftToolBar::WorkOn(const std::vector<pqPipelineSource*>& held)
{
  waft::GoOn(held);
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  const QList<pqTimeKeeper*> keepers = model->findItems<pqTimeKeeper*>();
  const double time = keepers.empty() ? 0.0 : keepers.front()->getTime();
  for (pqPipelineSource* source : held)
  {
    auto* proxy = vtkSMSourceProxy::SafeDownCast(source->getProxy());
    proxy->UpdatePipeline(time);
  }
  // Where pictures take long they are not to take the most of the time.
  if (!this->SinceDrawn.isValid() ||
      this->SinceDrawn.elapsed() >= WorkPerPicture * this->DrawingTook)
  {
    this->Draw();
  }
}

void WaftToolBar::Draw()
{
  QElapsedTimer clock;
  clock.start();
  this->Camera->Refresh();
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqView* view : model->findItems<pqView*>())
  {
    view->forceRender();
  }
  this->DrawingTook = clock.elapsed();
  this->SinceDrawn.start();
}

void WaftToolBar::onStop()
{
  if (this->Now == State::Working)
  {
    this->Timer.stop();
    this->Draw();
    this->Show(State::Stopped, waft::HeldStages());
  }
}

void WaftToolBar::onGoOn()
{
  if (this->Now == State::Stopped)
  {
    this->Show(State::Working, waft::HeldStages());
    this->Timer.start();
  }
}

void WaftToolBar::Show(State state, const std::vector<pqPipelineSource*>& held)
{
  const bool ends = state == State::Resting && this->Now != State::Resting;
  this->Now = state;
  this->Stop->setEnabled(state == State::Working);
  this->GoOn->setEnabled(state == State::Stopped);
  if (held.empty())
  {
    this->Bar->setValue(ends ? BarSteps : this->Bar->value());
    this->Bar->setFormat(ends ? "done" : this->Bar->format());
    this->Bar->setEnabled(false);
    return;
  }
  // Those after the first wait for it.
  const waft::WorkOfStage work = waft::WorkOf(held.front()->getProxy());
  this->Bar->setEnabled(true);
  this->Bar->setValue(static_cast<int>(std::lround(BarSteps * std::clamp(work.Done, 0.0, 1.0))));
  this->Bar->setFormat((state == State::Stopped ? "stopped: " : "") + work.Message);
  this->Bar->setToolTip(this->Bar->format());
}
