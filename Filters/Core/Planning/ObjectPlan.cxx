// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/ObjectPlan.h"

#include "Planning/Repair.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace waft
{

namespace
{

/// Fastest fall in the last second before a rest over the SettlingSpeed: what the air may add near
/// the ground.
constexpr double LandingDescent = 1.1;

class ObjectPlanner
{
public:
  ObjectPlanner(const SegmentLibrary& library, const MotionObject& object,
                const Itinerary& itinerary, const ObstacleSet& obstacles, const SceneInfo& scene,
                const ObjectPlanOptions& options);
  ObjectPlan Run();

private:
  void PlanFlight(std::size_t from, int lastFrame);
  void Draw(const Mark& from, Mark& to);
  void LieStill(const Mark& mark);
  void Miss(Mark& mark, const Vec3& place);
  void Fix(int frame, const Vec3& position);
  SpanEnd EndAt(std::size_t mark, bool isGoal) const;
  bool IsDrawn(std::size_t mark) const;
  void KeepSpan(const SpanRequest& request, SpanResult& span);
  void HealSeams();
  void Unite();

  const SegmentLibrary& Library;
  const MotionObject& Object;
  Itinerary Way; // marks that are missed become places where the object just was
  const SceneInfo& Scene;
  const ObjectPlanOptions& Options;
  ClearanceField Field;
  ObjectPlan Plan;
  WarpProblem Warp;
  bool HasContinuation = false;
  Piece Continuation;
  bool Halted = false;     // the flight before came to a stop
  bool LastReached = true; // the mark before
  std::vector<int> Seams;  // frames at which two flights meet
  StyleHistory History;
  int Shortest = 0; // spans of fewer frames are drawn, not searched
};

ObjectPlanner::ObjectPlanner(const SegmentLibrary& library, const MotionObject& object,
                             const Itinerary& itinerary, const ObstacleSet& obstacles,
                             const SceneInfo& scene, const ObjectPlanOptions& options) :
  Library(library),
  Object(object), Way(itinerary), Scene(scene), Options(options)
{
  const auto count = static_cast<std::size_t>(scene.Time.NumberOfFrames);
  this->Field.Obstacles = &obstacles;
  this->Field.Bounds = scene.Bounds;
  this->Field.Radius = object.ClearanceRadius;
  this->Field.Contacts = itinerary.Contacts;
  for (const Mark& mark : itinerary.Marks)
  {
    const double distance = this->Field.Distance(mark.Position, mark.Frame);
    if (distance < this->Field.Radius + options.Span.CheckMargin)
    {
      this->Field.TightMarks.push_back(
        { mark.Position, distance - options.Span.CheckMargin - 1e-9 });
    }
  }
  this->Plan.Positions.assign(count, object.Position);
  this->Plan.Samples.assign(count, UseSample());
  this->Warp.SecondDifferences.assign(count, Vec3::Zero());
  this->Warp.IsFixed.assign(count, 0);
  this->Warp.Fixed.assign(count, Vec3::Zero());
  this->Shortest = library.Window() + 2;
}

void ObjectPlanner::Fix(int frame, const Vec3& position)
{
  this->Plan.Positions[frame] = position;
  this->Warp.IsFixed[frame] = 1;
  this->Warp.Fixed[frame] = position;
}

/// True when the flight from this mark to the next is too short for a segment.
bool ObjectPlanner::IsDrawn(std::size_t mark) const
{
  const std::vector<Mark>& marks = this->Way.Marks;
  return mark + 1 < marks.size() && marks[mark + 1].Frame - marks[mark].Until < this->Shortest;
}

SpanEnd ObjectPlanner::EndAt(std::size_t index, bool isGoal) const
{
  const std::vector<Mark>& marks = this->Way.Marks;
  const Mark& mark = marks[index];
  SpanEnd end;
  end.Position = isGoal ? mark.Position : this->Plan.Positions[mark.Until];
  end.IsRest = mark.IsRest;
  end.Descent = LandingDescent * this->Object.SettlingSpeed * this->Scene.Time.Step();
  end.HasVelocity = mark.HasVelocity && !mark.Halts;
  end.Velocity = mark.Velocity;
  if (mark.IsRest || mark.Halts || end.HasVelocity || (!isGoal && this->Halted))
  {
    return end;
  }
  // Next to a given stretch its own speed is taken over, else that of the flight before.
  if (isGoal && this->IsDrawn(index))
  {
    end.HasVelocity = true;
    end.Velocity = (marks[index + 1].Position - mark.Position) /
                   static_cast<double>(marks[index + 1].Frame - mark.Frame);
  }
  else if (!isGoal && mark.Frame > 1)
  {
    const int frame = mark.Frame;
    end.HasVelocity = true;
    end.Velocity = 1.5 * this->Plan.Positions[frame] - 2.0 * this->Plan.Positions[frame - 1] +
                   0.5 * this->Plan.Positions[frame - 2];
  }
  return end;
}

void ObjectPlanner::Draw(const Mark& from, Mark& to)
{
  const Vec3 start = this->Plan.Positions[from.Until];
  const int frames = to.Frame - from.Until;
  MarkOutcome outcome;
  outcome.Constraint = to.Constraint;
  // Frame by frame from one place that was met to the next it is the artist's own path, as fast as
  // it may be.
  const bool isGiven = frames == 1 && from.Constraint >= 0 && this->LastReached;
  const double most = 1.4 * this->Library.TopStep() * frames;
  const Vec3 way = to.Position - start;
  if (!isGiven && way.norm() - to.Radius > most)
  {
    Vec3 place = start + way.normalized() * (0.7 * most);
    while (
      (place - start).norm() > 1e-3 &&
      this->Field.FirstHit({ start, 0.5 * (start + place), place }, 1, 2, to.Frame, 0.0, 0.0) >= 0)
    {
      place = 0.5 * (start + place);
    }
    outcome.IsReached = false;
    outcome.Message = "far faster than the database's top speed";
    this->Miss(to, place);
  }
  for (int frame = from.Until + 1; frame <= to.Frame; ++frame)
  {
    const double u = static_cast<double>(frame - from.Until) / static_cast<double>(frames);
    this->Plan.Positions[frame] = start + u * (to.Position - start);
  }
  this->Fix(to.Frame, to.Position);
  this->Seams.push_back(from.Until);
  this->Seams.push_back(to.Frame);
  this->HasContinuation = false;
  this->Halted = false;
  this->LastReached = outcome.IsReached;
  this->Plan.Outcomes.push_back(outcome);
}

/// The object goes on from where it came to.
void ObjectPlanner::Miss(Mark& mark, const Vec3& place)
{
  auto& contacts = this->Field.Contacts;
  contacts.erase(std::remove_if(contacts.begin(), contacts.end(),
                                [&](const ContactStretch& contact)
                                { return contact.Constraint == mark.Constraint; }),
                 contacts.end());
  mark.Until = mark.Frame;
  mark.Position = place;
  mark.IsRest = mark.Halts = mark.HasVelocity = false;
}

void ObjectPlanner::LieStill(const Mark& mark)
{
  const Vec3 position = this->Plan.Positions[mark.Frame];
  for (int frame = mark.Frame; frame <= mark.Until; ++frame)
  {
    this->Fix(frame, position);
  }
}

void ObjectPlanner::PlanFlight(std::size_t from, int lastFrame)
{
  const std::vector<Mark>& marks = this->Way.Marks;
  const Mark& start = marks[from];
  const bool hasGoal = from + 1 < marks.size();
  const auto second = static_cast<int>(std::lround(this->Scene.Time.FramesPerSecond));
  SpanRequest request;
  request.FirstFrame = start.Until;
  request.Clock.Frames = lastFrame - start.Until;
  request.Start = this->EndAt(from, false);
  request.HasGoal = hasGoal;
  const bool launches = start.IsRest || start.Halts || this->Halted;
  const bool brakes = hasGoal && (marks[from + 1].IsRest || marks[from + 1].Halts);
  const int most = request.Clock.Frames / (launches && brakes ? 2 : 1);
  request.Clock.LaunchFrames = launches ? std::min(second, most) : 0;
  request.Clock.BrakeFrames = brakes ? std::min(second, most) : 0;
  if (hasGoal)
  {
    request.Goal = this->EndAt(from + 1, true);
    request.GoalRadius = marks[from + 1].Radius;
    request.GoalConstraint = marks[from + 1].Constraint;
    request.GoesOn = !brakes && lastFrame + 1 < this->Scene.Time.NumberOfFrames;
  }
  else
  {
    request.Goal.Position = request.Start.Position;
  }
  request.HasContinuation = this->HasContinuation && !launches;
  request.Continuation = this->Continuation;
  if (request.FirstFrame >= 2)
  {
    request.Before = { this->Plan.Positions[request.FirstFrame - 2],
                       this->Plan.Positions[request.FirstFrame - 1] };
  }
  else if (launches)
  {
    request.Before = { request.Start.Position, request.Start.Position };
  }
  request.History = this->History;
  if (hasGoal && !this->Way.Way.IsEmpty())
  {
    request.Guide = this->Way.Way.Take(request.Start.Position, request.Goal.Position);
    request.GuideWeight = this->Options.Span.GuideWeight;
  }
  const std::uint64_t stream =
    static_cast<std::uint64_t>(this->Object.ObjectId) * 8192u + static_cast<std::uint64_t>(from);
  const auto begin = std::chrono::steady_clock::now();
  SpanResult span = PlanSpan(this->Library, this->Field, request, this->Options.Span,
                             Random(this->Options.Seed, stream));
  if (hasGoal)
  {
    MarkOutcome outcome;
    outcome.Constraint = marks[from + 1].Constraint;
    outcome.IsReached = span.ReachesGoal;
    outcome.RetimingFactor = span.RetimingFactor;
    outcome.Cost = span.Cost;
    outcome.NumberOfBranches = static_cast<int>(span.Trees[0].size() + span.Trees[1].size());
    outcome.Message = span.Message;
    outcome.Seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    this->Plan.Outcomes.push_back(outcome);
    this->LastReached = span.ReachesGoal;
    if (!span.ReachesGoal)
    {
      this->Miss(this->Way.Marks[from + 1], span.Positions.back());
    }
  }
  this->KeepSpan(request, span);
}

void ObjectPlanner::KeepSpan(const SpanRequest& request, SpanResult& span)
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
  StyleGauge::Append(span.Positions, this->Scene.Time.Step(),
                     std::max(1, request.Clock.LaunchFrames), frames - request.Clock.BrakeFrames,
                     this->History);
  for (int k = 1; k < frames; ++k)
  {
    this->Warp.SecondDifferences[first + k] = span.Bends[k];
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
    use.Place = span.Pieces[i].Place;
    use.RetimingFactor = span.RetimingFactor;
    use.FirstTime = this->Scene.Time.Time(first + span.PieceFrames[i]);
    if (low >= 0)
    {
      const int middle = (low + high) / 2;
      use.Place.Translation +=
        span.Positions[middle] -
        use.Place * this->Library.Samples(use.Segment)[span.Sources[middle].Sample];
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

/// Where two flights meet what the bend jumps by is handed over within a third of a second to
/// either side: the acceleration is continuous, the velocity beyond is as before. What is given
/// frame by frame stays; the flight next to it takes all of the jump.
void ObjectPlanner::HealSeams()
{
  const auto count = static_cast<int>(this->Warp.IsFixed.size());
  std::vector<Vec3>& bends = this->Warp.SecondDifferences;
  const auto isGiven = [&](int k)
  {
    return this->Warp.IsFixed[k - 1] != 0 && this->Warp.IsFixed[k] != 0 &&
           this->Warp.IsFixed[k + 1] != 0;
  };
  const auto bendAt = [&](int k) -> Vec3
  {
    return isGiven(k)
             ? Vec3(this->Warp.Fixed[k - 1] - 2.0 * this->Warp.Fixed[k] + this->Warp.Fixed[k + 1])
             : bends[k];
  };
  const auto third = static_cast<int>(std::lround(this->Scene.Time.FramesPerSecond / 3.0));
  for (std::size_t i = 0; i < this->Seams.size(); ++i)
  {
    const int seam = this->Seams[i];
    if (seam < 2 || seam + 2 >= count)
    {
      continue;
    }
    int reach = std::min({ third, seam - 1, count - 2 - seam });
    reach =
      i > 0 && this->Seams[i - 1] < seam ? std::min(reach, (seam - this->Seams[i - 1]) / 2) : reach;
    reach = i + 1 < this->Seams.size() && this->Seams[i + 1] > seam
              ? std::min(reach, (this->Seams[i + 1] - seam) / 2)
              : reach;
    const Vec3 jump = bendAt(seam + 1) - bendAt(seam - 1);
    const double left = isGiven(seam + 1) ? 1.0 : isGiven(seam - 1) ? 0.0 : 0.5;
    bends[seam] = bendAt(seam - 1) + left * jump;
    for (int k = 1; k < reach; ++k)
    {
      const double u = static_cast<double>(k) / reach;
      const double share = (1.0 - u) * (1.0 - u) * (1.0 + 2.0 * u);
      bends[seam - k] += left * share * jump;
      bends[seam + k] -= (1.0 - left) * share * jump;
    }
  }
}

void ObjectPlanner::Unite()
{
  const std::vector<Vec3> separate = this->Plan.Positions;
  this->HealSeams();
  for (const MotionRow& row : this->Way.Rows)
  {
    if (!(row.Radius > 0.0))
    {
      this->Warp.Rows.push_back(row.Row);
    }
  }
  std::vector<Vec3> united = SolveWarp(this->Warp);
  // Rows with a tolerance are imposed where the motion does not meet them by itself.
  bool imposed = false;
  for (const MotionRow& row : this->Way.Rows)
  {
    Vec3 value = Vec3::Zero();
    for (std::size_t i = 0; i < row.Row.Frames.size(); ++i)
    {
      value += row.Row.Weights[i] * united[row.Row.Frames[i]];
    }
    const Vec3 offset = value - row.Row.Value;
    if (row.Radius > 0.0 && offset.norm() > 0.9 * row.Radius)
    {
      LinearRow limited = row.Row;
      limited.Value += offset.normalized() * (0.8 * row.Radius);
      this->Warp.Rows.push_back(limited);
      imposed = true;
    }
  }
  if (imposed)
  {
    united = SolveWarp(this->Warp);
  }
  this->Plan.Positions = RepairPath(
    this->Field, this->Warp, this->Options.Tolerance, 1.45 * this->Library.TopStep(), united,
    this->Warp.Rows.empty() ? separate : united, this->Plan.WorstSlack, this->Plan.WorstFrame);
}

ObjectPlan ObjectPlanner::Run()
{
  const std::vector<Mark>& marks = this->Way.Marks;
  const int last = this->Scene.Time.NumberOfFrames - 1;
  this->Fix(0, marks.front().Position);
  for (std::size_t i = 0; i < marks.size(); ++i)
  {
    if (marks[i].IsRest)
    {
      this->LieStill(marks[i]);
    }
    if (i + 1 == marks.size())
    {
      if (marks[i].Until < last)
      {
        this->PlanFlight(i, last);
      }
    }
    else if (this->IsDrawn(i))
    {
      this->Draw(marks[i], this->Way.Marks[i + 1]);
    }
    else
    {
      this->PlanFlight(i, marks[i + 1].Frame);
    }
  }
  this->Unite();
  return std::move(this->Plan);
}

} // namespace

ObjectPlan PlanObject(const SegmentLibrary& library, const MotionObject& object,
                      const Itinerary& itinerary, const ObstacleSet& obstacles,
                      const SceneInfo& scene, const ObjectPlanOptions& options)
{
  const auto begin = std::chrono::steady_clock::now();
  ObjectPlan plan = ObjectPlanner(library, object, itinerary, obstacles, scene, options).Run();
  plan.Seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return plan;
}

} // namespace waft
