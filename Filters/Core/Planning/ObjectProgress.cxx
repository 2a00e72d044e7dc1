// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/ObjectProgress.h"

#include <algorithm>
#include <utility>

namespace waft
{

ObjectProgress::ObjectProgress(const MotionObject& object, const Itinerary& itinerary,
                               const ObstacleSet& obstacles, const SceneInfo& scene,
                               double margin) :
  Way(itinerary)
{
  const auto count = static_cast<std::size_t>(scene.Time.NumberOfFrames);
  this->Field.Obstacles = &obstacles;
  this->Field.Bounds = scene.Bounds;
  this->Field.Rule = object;
  this->Field.Landings = itinerary.Landings;
  for (const Mark& mark : itinerary.Marks)
  {
    const double distance = this->Field.Distance(mark.Position, mark.Frame);
    if (distance < this->Field.Rule.Radius + margin)
    {
      this->Field.TightMarks.push_back({ mark.Position, distance - margin - 1e-9 });
    }
  }
  this->Plan.Positions.assign(count, object.Position);
  this->Plan.Samples.assign(count, UseSample());
  this->Warp.SecondDifferences.assign(count, Vec3::Zero());
  this->Warp.IsFixed.assign(count, 0);
  this->Warp.Fixed.assign(count, Vec3::Zero());
}

void ObjectProgress::Fix(int frame, const Vec3& position)
{
  this->Plan.Positions[frame] = position;
  this->Warp.IsFixed[frame] = 1;
  this->Warp.Fixed[frame] = position;
}

void ObjectProgress::Miss(Mark& mark, const Vec3& position)
{
  this->Field.ForgetLanding(mark.Frame);
  mark.Until = mark.Frame;
  mark.Position = position;
  mark.IsRest = mark.Halts = mark.HasVelocity = false;
}

void ObjectProgress::LieStill(const Mark& mark)
{
  const CarriedPlace place{ this->Plan.Positions[mark.Frame], static_cast<double>(mark.Frame),
                            mark.Place.On };
  for (int frame = mark.Frame; frame <= mark.Until; ++frame)
  {
    this->Fix(frame, place.At(frame));
  }
}

void ObjectProgress::Keep(const SegmentLibrary& library, const StyleGauge* gauge,
                          const Timeline& time, const SpanRequest& request, SpanResult& span)
{
  const int first = request.FirstFrame;
  const int frames = request.Clock.Frames;
  const auto base = static_cast<int>(this->Plan.Uses.size());
  for (int k = 0; k <= frames; ++k)
  {
    if (k > 0)
    {
      this->Plan.Positions[first + k] = span.Positions[k];
    }
    if (span.Sources[k].Piece >= 0)
    {
      this->Plan.Samples[first + k] = { base + span.Sources[k].Piece, span.Sources[k].Sample };
    }
  }
  if (gauge != nullptr)
  {
    gauge->Append(span.Positions, time.Step(), std::max(1, request.Clock.LaunchFrames),
                  frames - request.Clock.BrakeFrames, this->History);
  }
  for (int k = 1; k < frames; ++k)
  {
    this->Warp.SecondDifferences[first + k] = span.SecondDifferences[k];
  }
  if (request.Clock.BrakeFrames == 0 && !span.Halts)
  {
    this->Seams.push_back(first + frames);
  }
  this->Fix(first + frames, span.Positions[frames]);
  for (std::size_t i = 0; i < span.Pieces.size(); ++i)
  {
    // A piece stands where the finished path carries the middle of what is used of it.
    int low = -1;
    int high = -1;
    for (int k = 0; k <= frames; ++k)
    {
      if (span.Sources[k].Piece == static_cast<int>(i))
      {
        low = low < 0 ? k : low;
        high = k;
      }
    }
    SegmentUse use;
    use.Segment = span.Pieces[i].Segment;
    use.Transform = span.Pieces[i].Transform;
    use.RetimingFactor = span.RetimingFactor;
    use.FirstTime = time.Time(first + span.PieceFrames[i]);
    if (low >= 0)
    {
      const int middle = (low + high) / 2;
      use.Transform.Translation +=
        span.Positions[middle] -
        use.Transform * library.Samples(use.Segment)[span.Sources[middle].Sample];
    }
    this->Plan.Uses.push_back(use);
  }
  SpanTrees trees;
  trees.FirstFrame = first;
  trees.LastFrame = first + frames;
  trees.Trees[0] = std::move(span.Trees[0]);
  trees.Trees[1] = std::move(span.Trees[1]);
  this->Plan.Spans.push_back(std::move(trees));
  this->Halted = span.Halts;
  this->HasContinuation = span.HasContinuation;
  this->Continuation = span.Continuation;
}

} // namespace waft
