// SPDX-License-Identifier: BSD-3-Clause
// What of a scene can be moved by the hand, as the client has it.
#pragma once

#include <vtkVector.h>

#include <QJsonArray>
#include <QMap>
#include <QString>

#include <vector>

class vtkSMProxy;

namespace waft
{

/// A place of a scene, and the points of its file that go along (by JSON pointers).
struct Handle
{
  QString Kind; // as waft::DescribeHandles has it
  int Object = -1;
  int Frame = -1;
  vtkVector3d Place;
  QMap<QString, vtkVector3d> Moves;
  vtkVector3d Least, Most; // where it may be

  /// "mark of body 3 at frame 95"
  QString Text() const;
  /// How far it is dragged from where its points are.
  vtkVector3d Shift() const;
};

/// A place in a box, or the nearest of it.
vtkVector3d Clamped(const vtkVector3d& place, const vtkVector3d& least, const vtkVector3d& most);

/// Those of a Waft Animation.
struct SceneHandles
{
  std::vector<Handle> All;
  vtkVector3d Min, Max; // the volume
  double FramesPerSecond = 30.0;
  int Frames = 0;
  int LastObject = -1;
  bool HasConstraints = false;

  /// Where a body is about at a frame, by its start and marks; the middle of the volume where
  /// nothing says so.
  vtkVector3d About(int object, int frame) const;
  /// What regions, boxes and vortices are as they are dragged: points, of which every second ends
  /// a line.
  std::vector<vtkVector3d> Outlines() const;
  /// The index of a body's mark at a frame; -1: it has none.
  int MarkOf(int object, int frame) const;
};

/// Whether it is a source that a scene can be edited in.
bool HasHandles(vtkSMProxy* source);
/// Of the scene with the edits so far.
SceneHandles HandlesOf(vtkSMProxy* source);

/// Operations of a JSON Patch: a handle is moved to a place, a body gets a mark, a row goes.
QJsonArray MoveTo(const Handle& handle, const vtkVector3d& place);
QJsonArray NewMark(const SceneHandles& scene, int object, int frame, const vtkVector3d& place);
QJsonArray WithoutMark(const Handle& handle);

/// Adds operations to the edits of a source, as one step that can be undone; the source is to be
/// updated then.
void AddEdits(vtkSMProxy* source, const QString& step, const QJsonArray& operations);
bool HasEdits(vtkSMProxy* source);
/// Writes them to the scene file. False where the source could not, which it has said.
bool SaveEdits(vtkSMProxy* source);
/// Writes the scene with them to another file, which is the source's from then on.
bool SaveEditsAs(vtkSMProxy* source, const QString& file);
/// Writes a folder of the flight of a Waft Animation; gives what went wrong, or an empty text.
QString SaveFlight(vtkSMProxy* source, const QString& folder);

} // namespace waft
