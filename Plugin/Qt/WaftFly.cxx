// SPDX-License-Identifier: BSD-3-Clause
#include "WaftFly.h"

#include "SceneFlight.h"
#include "WaftActive.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkNew.h>
#include <vtkSMParaViewPipelineControllerWithRendering.h>
#include <vtkSMProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMViewProxy.h>

#include <QAction>
#include <QActionGroup>
#include <QIcon>
#include <QMenu>
#include <QPainter>
#include <QPainterPath>
#include <QPixmap>
#include <QWidget>

#include <string>

namespace
{

constexpr int IconSize = 64; // pixels

/// A leaf that is blown away.
QIcon Leaf()
{
  QPixmap picture(IconSize, IconSize);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  const QPointF stem(22, 44), tip(60, 6);
  QPainterPath leaf(stem);
  leaf.cubicTo(QPointF(16, 20), QPointF(38, 4), tip);
  leaf.cubicTo(QPointF(60, 30), QPointF(44, 50), stem);
  painter.fillPath(leaf, QColor(222, 130, 42));
  painter.setPen(QPen(QColor(120, 62, 20), 3, Qt::SolidLine, Qt::RoundCap));
  painter.drawLine(QPointF(14, 52), QPointF(50, 16));
  painter.setPen(QPen(QColor(90, 140, 190), 4, Qt::SolidLine, Qt::RoundCap));
  QPainterPath wind(QPointF(4, 36));
  wind.lineTo(QPointF(14, 36));
  wind.moveTo(QPointF(24, 58));
  wind.quadTo(QPointF(38, 64), QPointF(52, 52));
  painter.drawPath(wind);
  return QIcon(picture);
}

pqPipelineSource* ItemOf(vtkSMProxy* proxy)
{
  return pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(proxy);
}

/// Bodies, faint paths and marks; what stands for them so far goes.
void Show(const waft::SceneFlight& flight)
{
  auto* view = qobject_cast<pqRenderView*>(waft::ActiveOf<pqView*>("ActiveView"));
  if (view == nullptr)
  {
    return;
  }
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  for (vtkSMSourceProxy* drawn : flight.Drawn)
  {
    for (unsigned int port = 0; port < drawn->GetNumberOfOutputPorts(); ++port)
    {
      if (std::string(drawn->GetOutputPortName(port)) != "Obstacles")
      {
        controller->Hide(drawn, static_cast<int>(port), view->getViewProxy());
      }
    }
  }
  controller->Show(flight.Bodies, 0, view->getViewProxy());
  controller->Show(flight.Bodies, 1, view->getViewProxy());
  controller->Show(flight.Marks.first, static_cast<int>(flight.Marks.second), view->getViewProxy());
}

} // namespace

WaftFly::WaftFly(QWidget* bar) :
  QObject(bar), Bar(bar), Choices(new QMenu("&Waft", bar)), Fly(new QAction(Leaf(), "Fly", this))
{
  this->Choices->setObjectName("menuWaft");
  this->Fly->setObjectName("actionFly");
  this->Fly->setToolTip("Fly the scene that the session's sources make: objects, constraints, "
                        "obstacles, shapes, vortices, wind");
  this->connect(this->Fly, &QAction::triggered, this, &WaftFly::Run);
  this->Choices->addAction(this->Fly);
  QAction* air = this->Choices->addAction("New air");
  air->setObjectName("actionNewAir");
  air->setToolTip("Fly the active Waft Animation as edited in an air that is drawn for it, instead "
                  "of the one that there is");
  this->connect(air, &QAction::triggered, this, &WaftFly::newAirWanted);
  this->Choices->addSeparator();
  auto* one = new QActionGroup(this);
  int quality = 0;
  for (const char* name : { "Preview", "Air", "Full", "Paper" })
  {
    QAction* choice = this->Choices->addAction(name);
    choice->setObjectName(QString("action") + name);
    choice->setToolTip("The quality of the next Fly");
    choice->setCheckable(true);
    choice->setChecked(quality == this->Quality);
    one->addAction(choice);
    this->connect(choice, &QAction::triggered, this,
                  [this, quality]
                  {
                    this->Quality = quality;
                    this->IsChosen = true;
                  });
    ++quality;
  }
}

WaftFly::~WaftFly() = default;

// The panel's own slot, since its class needs a header that Debian does not install.
void WaftFly::ApplyPanels()
{
  if (auto* panel = this->Bar->window()->findChild<QWidget*>("propertiesPanel"))
  {
    QMetaObject::invokeMethod(panel, "apply", Qt::DirectConnection);
  }
}

void WaftFly::Run()
{
  vtkSMSessionProxyManager* session =
    vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  if (session == nullptr)
  {
    return;
  }
  this->ApplyPanels();
  SCOPED_UNDO_SET("Fly");
  const waft::SceneFlight flight = waft::FlySources(session, this->Quality, this->IsChosen);
  if (!flight.Refusal.empty())
  {
    Q_EMIT this->refused(QString::fromStdString(flight.Refusal));
    return;
  }
  this->IsChosen = false;
  for (vtkSMSourceProxy* proxy : flight.Made)
  {
    if (pqPipelineSource* stage = ItemOf(proxy))
    {
      Q_EMIT this->made(stage);
      stage->setModifiedState(pqProxy::UNMODIFIED);
    }
  }
  Q_EMIT this->begun(ItemOf(flight.Plans));
  if (!flight.Made.empty())
  {
    Show(flight);
  }
  if (pqPipelineSource* bodies = ItemOf(flight.Bodies))
  {
    waft::Activate(bodies);
    bodies->renderAllViews();
  }
}
