// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Itinerary.h"

#include "Constraints/Rest.h"

#include <algorithm>
#include <map>

namespace waft
{

namespace
{

using Stencil = std::map<int, double>;

/// The velocity at a frame times the frame step: the central difference, one-sided and of second
/// order at the ends.
Stencil VelocityStencil(int frame, int count)
{
  if (count < 3)
  {
    return { { 0, -1.0 }, { 1, 1.0 } };
  }
  if (frame == 0)
  {
    return { { 0, -1.5 }, { 1, 2.0 }, { 2, -0.5 } };
  }
  if (frame == count - 1)
  {
    return { { count - 1, 1.5 }, { count - 2, -2.0 }, { count - 3, 0.5 } };
  }
  return { { frame - 1, -0.5 }, { frame + 1, 0.5 } };
}

/// The same difference taken of the velocities.
Stencil AccelerationStencil(int frame, int count)
{
  Stencil result;
  for (const auto& [outer, outerWeight] : VelocityStencil(frame, count))
  {
    for (const auto& [inner, weight] : VelocityStencil(outer, count))
    {
      result[inner] += outerWeight * weight;
    }
  }
  return result;
}

MotionRow MakeRow(const Stencil& stencil, const Vec3& value, double radius)
{
  MotionRow row;
  for (const auto& [frame, weight] : stencil)
  {
    row.Row.Frames.push_back(frame);
    row.Row.Weights.push_back(weight);
  }
  row.Row.Value = value;
  row.Radius = radius;
  return row;
}

} // namespace

void Itinerary::Follow(const std::vector<Vec3>& points, double radius, const SceneInfo& scene)
{
  this->Way = GuideWay(points);
  const int last = scene.Time.NumberOfFrames - 1;
  if (this->Marks.back().Until < last && scene.Bounds.InnerDistance(this->Way.End()) > 0.0)
  {
    Mark end;
    end.Frame = end.Until = last;
    end.Position = this->Way.End();
    end.Radius = radius;
    this->Marks.push_back(end);
  }
}

Itinerary MakeItinerary(const MotionObject& object, const std::vector<Constraint>& rows,
                        const std::vector<unsigned char>& isUsed, const ObstacleSet& obstacles,
                        const SceneInfo& scene)
{
  const int count = scene.Time.NumberOfFrames;
  const double step = scene.Time.Step();
  Itinerary result;
  std::vector<Constraint> own;
  std::vector<int> index;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    if (rows[i].ObjectId == object.ObjectId && isUsed[i] != 0)
    {
      own.push_back(rows[i]);
      index.push_back(static_cast<int>(i));
    }
  }

  std::map<int, Mark> marks;
  Mark start;
  start.Position = object.Position;
  marks[0] = start;
  const std::vector<LandingWindow> windows =
    LandingWindows(object, own, obstacles, scene.Time.FramesPerSecond);
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    const Constraint& row = own[i];
    if (row.Kind != ConstraintKind::Rest)
    {
      continue;
    }
    Mark mark;
    mark.Frame = row.Frame;
    mark.Until = std::clamp(row.Until, row.Frame, count - 1);
    mark.IsRest = true;
    mark.Constraint = index[i];
    // Nothing below: the floor of the volume.
    mark.Position = row.Value;
    mark.Position.z() = scene.Bounds.Min.z() + object.RestHeight;
    ContactStretch contact;
    contact.Constraint = index[i];
    contact.FirstFrame = row.Frame - scene.Time.FramesPerSecond;
    contact.LastFrame = row.Until + scene.Time.FramesPerSecond;
    for (const LandingWindow& window : windows)
    {
      if (window.Row == row.Row && window.Target == row.Target && window.Frame == row.Frame)
      {
        mark.Position = window.Centre;
        contact.FirstFrame = window.First;
        contact.LastFrame = window.Last;
        contact.Surface = window.ObstacleId;
        contact.Normal = window.Normal;
      }
    }
    contact.Centre = mark.Position;
    if (row.Frame == 0)
    {
      mark.Position = object.Position;
    }
    result.Contacts.push_back(contact);
    marks[mark.Frame] = mark;
  }
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    const Constraint& row = own[i];
    if (row.Kind != ConstraintKind::Position || row.Frame == 0)
    {
      continue;
    }
    const auto known = marks.find(row.Frame);
    if (known != marks.end() && (known->second.IsRest || known->second.Radius <= row.Radius))
    {
      continue;
    }
    const auto before = std::prev(marks.upper_bound(row.Frame));
    if (before->second.IsRest && before->second.Until >= row.Frame)
    {
      continue;
    }
    Mark mark;
    mark.Frame = mark.Until = row.Frame;
    mark.Position = row.Value;
    mark.Radius = row.Radius;
    mark.Constraint = index[i];
    marks[row.Frame] = mark;
  }
  bool startsAsTold = false;
  for (const Constraint& row : own)
  {
    if (count < 2)
    {
      break; // one frame has no motion
    }
    if (row.Kind == ConstraintKind::Velocity)
    {
      result.Rows.push_back(
        MakeRow(VelocityStencil(row.Frame, count), row.Value * step, row.Radius * step));
      startsAsTold = startsAsTold || row.Frame == 0;
      const auto mark = marks.find(row.Frame);
      if (mark != marks.end() && !mark->second.IsRest)
      {
        mark->second.HasVelocity = true;
        mark->second.Velocity = row.Value * step;
        mark->second.Halts = row.Value.norm() < 0.02;
      }
    }
    else if (row.Kind == ConstraintKind::Acceleration)
    {
      result.Rows.push_back(MakeRow(AccelerationStencil(row.Frame, count), row.Value * step * step,
                                    row.Radius * step * step));
    }
  }
  Mark& first = marks.begin()->second;
  if (!startsAsTold && !first.IsRest && object.Velocity.norm() > 0.0 && count > 1)
  {
    first.HasVelocity = true;
    first.Velocity = object.Velocity * step;
    result.Rows.push_back(MakeRow(VelocityStencil(0, count), object.Velocity * step, 0.0));
  }
  for (auto& entry : marks)
  {
    entry.second.Frame = entry.first;
    entry.second.Until = std::max(entry.second.Until, entry.first);
    result.Marks.push_back(entry.second);
  }
  return result;
}

} // namespace waft
