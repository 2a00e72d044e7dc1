// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "WaftHandles.h"

#include <QObject>
#include <QPointer>

#include <pqPipelineSource.h>
#include <pqRenderView.h>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

class pqUndoStack;
class vtkActor;
class vtkCommand;
class vtkEventQtSlotConnect;
class vtkPolyData;
class vtkRenderer;

/// The places of a scene as handles in a view: those of the active source, in the active view. One
/// is dragged across the picture at the depth where it is, or up and down with Shift, and stays in
/// the volume; when it is let go the scene is edited, and whom it touches flies anew. A click sets
/// a mark for a body at the frame that the view shows, as far away as the body is about then.
class WaftEditor : public QObject
{
  Q_OBJECT

public:
  explicit WaftEditor(QObject* parent);
  ~WaftEditor() override;

  void SetOn(bool isOn);
  /// The next click in the view, beside a handle, is a new mark.
  void SetPlacing(bool isPlacing) { this->IsPlacing = isPlacing; }
  void SetBody(int body) { this->Body = body; }
  pqPipelineSource* Source() const { return this->Edits; }
  const waft::SceneHandles& Scene() const { return this->Handles; }
  /// Takes the mark away that was touched or made last.
  void RemoveMark();
  bool CanRemoveMark() const { return !this->WithoutTouched().isEmpty(); }

Q_SIGNALS:
  /// What is shown, or what was touched, is another one.
  void changed();
  void touched(int body);
  void placed();

public Q_SLOTS:
  void Refresh();

private Q_SLOTS:
  void onPress(vtkObject*, unsigned long, void*, void*, vtkCommand* command);
  void onMove(vtkObject*, unsigned long, void*, void*, vtkCommand* command);
  void onRelease(vtkObject*, unsigned long, void*, void*, vtkCommand* command);

private:
  void FollowSteps(pqUndoStack* steps);
  void Leave();
  void Enter(pqRenderView* view);
  void Fill();
  void Draw();
  int Nearest() const;
  QJsonArray WithoutTouched() const;
  vtkRenderer* Renderer() const;
  /// Where the pointer is, as far away as a place.
  vtkVector3d UnderPointer(const vtkVector3d& depth) const;
  void Apply(const QString& step, const QJsonArray& operations);
  int FrameShown() const;

  QPointer<pqPipelineSource> Edits;
  QPointer<pqRenderView> View;
  waft::SceneHandles Handles;
  vtkNew<vtkEventQtSlotConnect> Events; // of the pointer in the view
  vtkNew<vtkPolyData> Points;
  vtkNew<vtkActor> Actor;
  vtkSmartPointer<vtkRenderer> Layer; // that the actor is in
  bool IsOn = false;
  bool IsPlacing = false;
  int Body = 0;
  int Touched = -1;
  int Hovered = -1;
  bool IsDragging = false;
  vtkVector3d From, Start; // of the handle, and where the pointer took it
};
