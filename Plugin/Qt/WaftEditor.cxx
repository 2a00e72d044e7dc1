// SPDX-License-Identifier: BSD-3-Clause
#include "WaftEditor.h"

#include "WaftActive.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkEventQtSlotConnect.h>
#include <vtkPVRenderView.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkUnsignedCharArray.h>

#include <QCursor>
#include <QToolTip>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace
{

constexpr float Before = 20.0f; // others that listen to the pointer
constexpr double Reach = 12.0;  // pixels, of the pointer
constexpr float Size = 14.0f;   // pixels
using Rgb = std::array<unsigned char, 3>;
constexpr Rgb Hot{ 255, 255, 255 };

Rgb ColorOf(const QString& kind)
{
  static const std::map<QString, Rgb> colors = {
    { "start", { 70, 150, 235 } },     { "region", { 70, 150, 235 } },
    { "mark", { 235, 150, 40 } },      { "rest", { 160, 110, 60 } },
    { "target", { 235, 200, 60 } },    { "targets", { 235, 200, 60 } },
    { "obstacle", { 175, 120, 205 } }, { "vortex", { 60, 190, 150 } },
    { "wind", { 120, 215, 235 } },
  };
  const auto found = colors.find(kind.section(' ', -1)); // a corner is of its region
  return found != colors.end() ? found->second : Hot;
}

} // namespace

WaftEditor::WaftEditor(QObject* parent) : QObject(parent)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(this->Points);
  mapper->SetColorModeToDirectScalars();
  this->Actor->SetMapper(mapper);
  this->Actor->GetProperty()->SetPointSize(Size);
  this->Actor->GetProperty()->RenderPointsAsSpheresOn();
  this->Actor->PickableOff();
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::dataUpdated, this,
                [this](pqPipelineSource* source)
                {
                  if (source == this->Edits && !this->IsDragging)
                  {
                    this->Refresh();
                  }
                });
  this->connect(new WaftActive(this), &WaftActive::changed, this, &WaftEditor::Refresh);
  pqApplicationCore* core = pqApplicationCore::instance();
  this->connect(core, &pqApplicationCore::undoStackChanged, this, &WaftEditor::FollowSteps);
  this->FollowSteps(core->getUndoStack());
  this->connect(model, &pqServerManagerModel::preViewRemoved, this,
                [this](pqView* view)
                {
                  if (view == this->View)
                  {
                    this->Leave();
                  }
                });
}

WaftEditor::~WaftEditor() = default;

void WaftEditor::SetOn(bool isOn)
{
  this->IsOn = isOn;
  this->Refresh();
}

void WaftEditor::Refresh()
{
  auto* view = qobject_cast<pqRenderView*>(waft::ActiveOf<pqView*>("ActiveView"));
  auto* source = waft::ActiveOf<pqPipelineSource*>("ActiveSources");
  if (source != nullptr && !waft::HasHandles(source->getProxy()))
  {
    source = nullptr;
  }
  if (source != this->Edits)
  {
    this->Touched = this->Hovered = -1;
    this->Edits = source;
  }
  if (!this->IsOn || view == nullptr || source == nullptr)
  {
    this->Leave();
    this->Handles = {};
  }
  else
  {
    if (view != this->View)
    {
      this->Leave();
      this->Enter(view);
    }
    const std::size_t before = this->Handles.All.size();
    this->Handles = waft::HandlesOf(source->getProxy());
    if (this->Handles.All.size() != before)
    {
      this->Touched = this->Hovered = -1; // those after it have other numbers
    }
    this->IsDragging = this->IsDragging && this->Touched >= 0;
    this->Fill();
  }
  Q_EMIT this->changed();
}

void WaftEditor::FollowSteps(pqUndoStack* steps)
{
  if (steps == nullptr)
  {
    return;
  }
  for (auto taken : { &pqUndoStack::undone, &pqUndoStack::redone })
  {
    this->connect(steps, taken, this,
                  [this]
                  {
                    this->Refresh();
                    if (this->IsOn && this->Edits != nullptr)
                    {
                      this->Edits->renderAllViews();
                    }
                  });
  }
}

void WaftEditor::Leave()
{
  this->Events->Disconnect();
  if (this->Layer != nullptr)
  {
    this->Layer->RemoveActor(this->Actor);
    this->Layer = nullptr;
  }
  if (this->View != nullptr)
  {
    this->View->render();
  }
  this->View = nullptr;
  this->IsDragging = false;
}

void WaftEditor::Enter(pqRenderView* view)
{
  vtkSMRenderViewProxy* proxy = view->getRenderViewProxy();
  auto* shown = vtkPVRenderView::SafeDownCast(proxy->GetClientSideView());
  if (shown == nullptr)
  {
    return;
  }
  this->View = view;
  this->Layer = shown->GetNonCompositedRenderer(); // above all bodies, on the client
  this->Layer->AddActor(this->Actor);
  vtkRenderWindowInteractor* pointer = proxy->GetInteractor();
  const auto listen = [&](unsigned long event, const char* slot)
  { this->Events->Connect(pointer, event, this, slot, nullptr, Before); };
  listen(vtkCommand::LeftButtonPressEvent,
         SLOT(onPress(vtkObject*, unsigned long, void*, void*, vtkCommand*)));
  listen(vtkCommand::MouseMoveEvent,
         SLOT(onMove(vtkObject*, unsigned long, void*, void*, vtkCommand*)));
  listen(vtkCommand::LeftButtonReleaseEvent,
         SLOT(onRelease(vtkObject*, unsigned long, void*, void*, vtkCommand*)));
  view->render();
}

void WaftEditor::Fill()
{
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  vtkNew<vtkCellArray> dots;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  int index = 0;
  for (const waft::Handle& handle : this->Handles.All)
  {
    const vtkIdType point = places->InsertNextPoint(handle.Place.GetData());
    dots->InsertNextCell(1, &point);
    const bool isHot = index == this->Hovered || index == this->Touched;
    colors->InsertNextTypedTuple((isHot ? Hot : ColorOf(handle.Kind)).data());
    ++index;
  }
  vtkNew<vtkCellArray> lines;
  for (const vtkVector3d& end : this->Handles.Outlines())
  {
    const vtkIdType point = places->InsertNextPoint(end.GetData());
    colors->InsertNextTypedTuple(Hot.data());
    if (point % 2 != index % 2)
    {
      const vtkIdType line[2] = { point - 1, point };
      lines->InsertNextCell(2, line);
    }
  }
  this->Points->SetPoints(places);
  this->Points->SetVerts(dots);
  this->Points->SetLines(lines);
  this->Points->GetPointData()->SetScalars(colors);
}

void WaftEditor::Draw()
{
  this->Fill();
  if (this->View != nullptr)
  {
    this->View->getRenderViewProxy()->InteractiveRender();
  }
}

vtkRenderer* WaftEditor::Renderer() const
{
  return this->View->getRenderViewProxy()->GetRenderer();
}

int WaftEditor::Nearest() const
{
  int pointer[2];
  this->View->getRenderViewProxy()->GetInteractor()->GetEventPosition(pointer);
  int nearest = -1;
  double least = Reach;
  for (std::size_t i = 0; i < this->Handles.All.size(); ++i)
  {
    const vtkVector3d& place = this->Handles.All[i].Place;
    vtkRenderer* renderer = this->Renderer();
    renderer->SetWorldPoint(place[0], place[1], place[2], 1.0);
    renderer->WorldToDisplay();
    const double* at = renderer->GetDisplayPoint();
    const double away = std::hypot(at[0] - pointer[0], at[1] - pointer[1]);
    if (away < least)
    {
      least = away;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

vtkVector3d WaftEditor::UnderPointer(const vtkVector3d& depth) const
{
  int pointer[2];
  this->View->getRenderViewProxy()->GetInteractor()->GetEventPosition(pointer);
  vtkRenderer* renderer = this->Renderer();
  renderer->SetWorldPoint(depth[0], depth[1], depth[2], 1.0);
  renderer->WorldToDisplay();
  renderer->SetDisplayPoint(pointer[0], pointer[1], renderer->GetDisplayPoint()[2]);
  renderer->DisplayToWorld();
  const double* world = renderer->GetWorldPoint();
  return { world[0] / world[3], world[1] / world[3], world[2] / world[3] };
}

int WaftEditor::FrameShown() const
{
  const double time = vtkSMPropertyHelper(this->View->getProxy(), "ViewTime").GetAsDouble();
  const int frame = static_cast<int>(std::lround(time * this->Handles.FramesPerSecond));
  return std::clamp(frame, 0, std::max(this->Handles.Frames - 1, 0));
}

void WaftEditor::Apply(const QString& step, const QJsonArray& operations)
{
  pqPipelineSource* source = this->Edits;
  if (source == nullptr || operations.isEmpty())
  {
    return;
  }
  waft::AddEdits(source->getProxy(), step, operations);
  source->setModifiedState(pqProxy::UNMODIFIED);
  this->Refresh();
  source->renderAllViews();
}

QJsonArray WaftEditor::WithoutTouched() const
{
  return this->Touched >= 0
           ? waft::WithoutMark(this->Handles.All[static_cast<std::size_t>(this->Touched)])
           : QJsonArray();
}

void WaftEditor::RemoveMark()
{
  const QJsonArray removal = this->WithoutTouched();
  if (!removal.isEmpty())
  {
    this->Apply("Remove " + this->Handles.All[static_cast<std::size_t>(this->Touched)].Text(),
                removal);
  }
}

void WaftEditor::onPress(vtkObject*, unsigned long, void*, void*, vtkCommand* command)
{
  const int nearest = this->Nearest();
  if (nearest >= 0)
  {
    const waft::Handle& handle = this->Handles.All[static_cast<std::size_t>(nearest)];
    this->Touched = nearest;
    this->From = handle.Place;
    this->Start = this->UnderPointer(handle.Place);
    this->IsDragging = true;
    command->AbortFlagOn();
    this->Draw();
    Q_EMIT this->touched(handle.Object);
  }
  else if (this->IsPlacing && this->Handles.LastObject >= 0)
  {
    command->AbortFlagOn();
    const int frame = this->FrameShown();
    const vtkVector3d place =
      waft::Clamped(this->UnderPointer(this->Handles.About(this->Body, frame)), this->Handles.Min,
                    this->Handles.Max);
    this->Apply(QString("New mark of body %1 at frame %2").arg(this->Body).arg(frame),
                waft::NewMark(this->Handles, this->Body, frame, place));
    this->Touched = this->Handles.MarkOf(this->Body, frame);
    this->Draw();
    Q_EMIT this->changed();
    Q_EMIT this->placed();
  }
}

void WaftEditor::onMove(vtkObject*, unsigned long, void*, void*, vtkCommand* command)
{
  if (!this->IsDragging)
  {
    const int nearest = this->Nearest();
    if (nearest != this->Hovered)
    {
      this->Hovered = nearest;
      this->Draw();
      QToolTip::showText(QCursor::pos(),
                         nearest >= 0 ? this->Handles.All[static_cast<std::size_t>(nearest)].Text()
                                      : QString());
    }
    return;
  }
  command->AbortFlagOn();
  waft::Handle& handle = this->Handles.All[static_cast<std::size_t>(this->Touched)];
  const vtkVector3d now = this->UnderPointer(this->From);
  const bool isUpright = this->View->getRenderViewProxy()->GetInteractor()->GetShiftKey() != 0;
  vtkVector3d place = this->From;
  for (int axis = isUpright ? 2 : 0; axis < 3; ++axis)
  {
    place[axis] += now[axis] - this->Start[axis];
  }
  handle.Place = waft::Clamped(place, handle.Least, handle.Most);
  this->Draw();
}

void WaftEditor::onRelease(vtkObject*, unsigned long, void*, void*, vtkCommand* command)
{
  if (!this->IsDragging)
  {
    return;
  }
  command->AbortFlagOn();
  this->IsDragging = false;
  waft::Handle handle = this->Handles.All[static_cast<std::size_t>(this->Touched)];
  const vtkVector3d place = handle.Place;
  handle.Place = this->From;
  if (place != this->From)
  {
    this->Apply("Move " + handle.Text(), waft::MoveTo(handle, place));
  }
}
