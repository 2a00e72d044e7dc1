// SPDX-License-Identifier: BSD-3-Clause
#include "WaftHandles.h"

#include <pqUndoStack.h>

#include <vtkClientServerStream.h>
#include <vtkPVSession.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSession.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTrace.h>
#include <vtkVersionMacros.h>
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
#include <vtkVectorOperators.h> // of vtkVector.h itself since then
#endif

#include <QJsonDocument>
#include <QJsonObject>

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

constexpr double Grain = 1e4; // of what is written: tenths of a millimetre

vtkVector3d PointOf(const QJsonValue& value)
{
  const QJsonArray list = value.toArray();
  return { list.at(0).toDouble(), list.at(1).toDouble(), list.at(2).toDouble() };
}

QJsonArray Written(const vtkVector3d& point)
{
  QJsonArray list;
  for (int axis = 0; axis < 3; ++axis)
  {
    list.append(std::round(point[axis] * Grain) / Grain);
  }
  return list;
}

QByteArray TextOf(vtkSMProxy* source, const char* property)
{
  source->UpdatePropertyInformation(source->GetProperty(property));
  const char* text = vtkSMPropertyHelper(source, property).GetAsString();
  return text != nullptr ? QByteArray(text) : QByteArray();
}

QJsonArray EditsOf(vtkSMProxy* source)
{
  return QJsonDocument::fromJson(vtkSMPropertyHelper(source, "Edits").GetAsString()).array();
}

void SetEdits(vtkSMProxy* source, const QByteArray& edits)
{
  vtkSMPropertyHelper(source, "Edits").Set(edits.constData());
  source->UpdateVTKObjects();
}

} // namespace

QString Handle::Text() const
{
  QString text = this->Kind;
  text += this->Object >= 0 ? QString(" of body %1").arg(this->Object) : QString();
  return text + (this->Frame > 0 ? QString(" at frame %1").arg(this->Frame) : QString());
}

vtkVector3d Handle::Shift() const
{
  vtkVector3d before(0.0, 0.0, 0.0);
  for (const vtkVector3d& point : this->Moves)
  {
    before = before + point * (1.0 / static_cast<double>(this->Moves.size()));
  }
  return this->Place - before;
}

vtkVector3d Clamped(const vtkVector3d& place, const vtkVector3d& least, const vtkVector3d& most)
{
  vtkVector3d within;
  for (int axis = 0; axis < 3; ++axis)
  {
    within[axis] = std::clamp(place[axis], least[axis], most[axis]);
  }
  return within;
}

vtkVector3d SceneHandles::About(int object, int frame) const
{
  const Handle *before = nullptr, *after = nullptr;
  for (const Handle& handle : this->All)
  {
    if (handle.Object != object || handle.Frame < 0)
    {
      continue;
    }
    if (handle.Frame <= frame && (before == nullptr || handle.Frame > before->Frame))
    {
      before = &handle;
    }
    if (handle.Frame >= frame && (after == nullptr || handle.Frame < after->Frame))
    {
      after = &handle;
    }
  }
  vtkVector3d middle;
  for (int axis = 0; axis < 3; ++axis)
  {
    middle[axis] = 0.5 * (this->Min[axis] + this->Max[axis]);
  }
  before = before != nullptr ? before : after;
  after = after != nullptr ? after : before;
  if (before == nullptr)
  {
    return middle;
  }
  const int span = after->Frame - before->Frame;
  const double share = span > 0 ? static_cast<double>(frame - before->Frame) / span : 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    middle[axis] = before->Place[axis] + share * (after->Place[axis] - before->Place[axis]);
  }
  return middle;
}

std::vector<vtkVector3d> SceneHandles::Outlines() const
{
  std::vector<vtkVector3d> points;
  for (std::size_t i = 1; i + 1 < this->All.size(); ++i)
  {
    const bool isBox = this->All[i].Kind.startsWith("corner");
    if (this->All[i].Kind != this->All[i + 1].Kind ||
        !(isBox || this->All[i].Kind == "end of vortex"))
    {
      continue;
    }
    const vtkVector3d shift = this->All[i - 1].Shift();
    const vtkVector3d low = this->All[i].Place + shift, high = this->All[i + 1].Place + shift;
    const auto corner = [&](int number) // a bit an axis
    {
      return vtkVector3d((number & 1) != 0 ? high[0] : low[0], (number & 2) != 0 ? high[1] : low[1],
                         (number & 4) != 0 ? high[2] : low[2]);
    };
    for (int from = 0; from < 8 && isBox; ++from)
    {
      for (const int bit : { 1, 2, 4 })
      {
        if ((from & bit) == 0)
        {
          points.insert(points.end(), { corner(from), corner(from | bit) });
        }
      }
    }
    if (!isBox)
    {
      points.insert(points.end(), { low, high });
    }
    ++i;
  }
  return points;
}

int SceneHandles::MarkOf(int object, int frame) const
{
  const auto found = std::find_if(this->All.begin(), this->All.end(),
                                  [&](const Handle& handle)
                                  {
                                    return handle.Object == object && handle.Frame == frame &&
                                           (handle.Kind == "mark" || handle.Kind == "rest");
                                  });
  return found != this->All.end() ? static_cast<int>(found - this->All.begin()) : -1;
}

bool HasHandles(vtkSMProxy* source)
{
  return source != nullptr && source->GetProperty("Handles") != nullptr &&
         source->GetProperty("Edits") != nullptr;
}

SceneHandles HandlesOf(vtkSMProxy* source)
{
  vtkSMSourceProxy::SafeDownCast(source)->UpdatePipelineInformation();
  const QJsonObject scene = QJsonDocument::fromJson(TextOf(source, "Handles")).object();
  SceneHandles handles;
  handles.Min = PointOf(scene["min"]);
  handles.Max = PointOf(scene["max"]);
  handles.FramesPerSecond = scene["framesPerSecond"].toDouble(handles.FramesPerSecond);
  handles.Frames = scene["frames"].toInt();
  handles.LastObject = scene["lastObject"].toInt(-1);
  handles.HasConstraints = scene["hasConstraints"].toBool();
  for (const QJsonValue& value : scene["handles"].toArray())
  {
    const QJsonObject one = value.toObject();
    Handle handle;
    handle.Kind = one["kind"].toString();
    handle.Object = one["object"].toInt(-1);
    handle.Frame = one["frame"].toInt(-1);
    handle.Place = PointOf(one["place"]);
    handle.Least = one.contains("least") ? PointOf(one["least"]) : handles.Min;
    handle.Most = one.contains("most") ? PointOf(one["most"]) : handles.Max;
    const QJsonObject moves = one["moves"].toObject();
    for (auto move = moves.begin(); move != moves.end(); ++move)
    {
      handle.Moves[move.key()] = PointOf(move.value());
    }
    handles.All.push_back(std::move(handle));
  }
  return handles;
}

QJsonArray MoveTo(const Handle& handle, const vtkVector3d& place)
{
  QJsonArray operations;
  for (auto move = handle.Moves.begin(); move != handle.Moves.end(); ++move)
  {
    vtkVector3d moved = move.value();
    for (int axis = 0; axis < 3; ++axis)
    {
      moved[axis] += place[axis] - handle.Place[axis];
    }
    operations.append(
      QJsonObject{ { "op", "replace" }, { "path", move.key() }, { "value", Written(moved) } });
  }
  return operations;
}

QJsonArray NewMark(const SceneHandles& scene, int object, int frame, const vtkVector3d& place)
{
  if (const int mark = scene.MarkOf(object, frame); mark >= 0)
  {
    return MoveTo(scene.All[static_cast<std::size_t>(mark)], place);
  }
  const QJsonObject row{
    { "kind", "position" }, { "object", object }, { "frame", frame }, { "value", Written(place) }
  };
  if (scene.HasConstraints)
  {
    return { QJsonObject{ { "op", "add" }, { "path", "/constraints/-" }, { "value", row } } };
  }
  return { QJsonObject{
    { "op", "add" }, { "path", "/constraints" }, { "value", QJsonArray{ row } } } };
}

QJsonArray WithoutMark(const Handle& handle)
{
  const QString pointer = handle.Moves.firstKey();
  if ((handle.Kind != "mark" && handle.Kind != "rest") || !pointer.endsWith("/value"))
  {
    return {};
  }
  const QString row = pointer.left(pointer.lastIndexOf('/'));
  return { QJsonObject{ { "op", "remove" }, { "path", row } } };
}

void AddEdits(vtkSMProxy* source, const QString& step, const QJsonArray& operations)
{
  QJsonArray edits = EditsOf(source);
  for (const QJsonValue& operation : operations)
  {
    edits.append(operation);
  }
  SCOPED_UNDO_SET(step);
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", source);
  SetEdits(source, QJsonDocument(edits).toJson(QJsonDocument::Compact));
}

bool HasEdits(vtkSMProxy* source)
{
  return !EditsOf(source).isEmpty();
}

bool SaveEdits(vtkSMProxy* source)
{
  source->InvokeCommand("SaveScene");
  if (!TextOf(source, "EditsInUse").isEmpty())
  {
    return false;
  }
  SCOPED_UNDO_EXCLUDE();
  SetEdits(source, {});
  return true;
}

// Not a property: what was saved once is not saved again by a state.
bool SaveEditsAs(vtkSMProxy* source, const QString& file)
{
  const QByteArray name = file.toUtf8();
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(source) << "SaveSceneAs" << name.constData()
         << vtkClientServerStream::End;
  vtkSMSession* session = source->GetSession();
  session->ExecuteStream(vtkPVSession::DATA_SERVER, stream);
  int isSaved = 0;
  if (!session->GetLastResult(vtkPVSession::DATA_SERVER).GetArgument(0, 0, &isSaved) ||
      isSaved == 0)
  {
    return false;
  }
  SCOPED_UNDO_EXCLUDE();
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", source);
  vtkSMPropertyHelper(source, "FileName").Set(name.constData());
  SetEdits(source, {});
  return true;
}

QString SaveFlight(vtkSMProxy* source, const QString& folder)
{
  const QByteArray request =
    QJsonDocument(QJsonObject{ { "Output", folder } }).toJson(QJsonDocument::Compact);
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(source) << "SaveFlight"
         << request.constData() << 0 << vtkClientServerStream::End;
  vtkSMSession* session = source->GetSession();
  session->ExecuteStream(vtkPVSession::DATA_SERVER, stream);
  const char* wrong = nullptr;
  return session->GetLastResult(vtkPVSession::DATA_SERVER).GetArgument(0, 0, &wrong) &&
             wrong != nullptr
           ? QString::fromUtf8(wrong)
           : QString("the server did not answer");
}

} // namespace waft
