// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/FreeFlight.h"

#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

/// One level of the search: a placed piece and the successors still to be tried.
struct Level
{
  Piece Body;
  int Elapsed = 0;
  std::vector<int> Untried; // in random order
};

std::vector<int> Shuffled(std::size_t count, Random& random)
{
  std::vector<int> order(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    order[i] = static_cast<int>(i);
  }
  for (std::size_t i = count; i > 1; --i)
  {
    std::swap(order[i - 1], order[random.Index(static_cast<std::uint32_t>(i))]);
  }
  return order;
}

class FlightGrower
{
public:
  FlightGrower(const SegmentLibrary& library, const ClearanceField& field, const SpanTask& task,
               double margin, Random random) :
    Library(library),
    Field(field), Task(task), Margin(margin), Stream(random)
  {
  }

  std::vector<Piece> Grow(int maximumNumberOfBranches);

private:
  bool PlaceRoot(Level& level);
  bool Advance(const Level& from, int successor, Level& level);
  bool Fits(const Piece& piece, double firstFrame) const;

  const SegmentLibrary& Library;
  const ClearanceField& Field;
  const SpanTask& Task;
  double Margin;
  Random Stream;
  double Tolerance = PlannerNumbers::FirstMismatch; // of the velocity at the start, relative
};

bool FlightGrower::Fits(const Piece& piece, double firstFrame) const
{
  const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
  std::vector<Vec3> placed(static_cast<std::size_t>(piece.Last) + 1);
  for (int k = piece.First; k <= piece.Last; ++k)
  {
    placed[k] = piece.Transform * samples[k];
  }
  // What comes after the span's end need not fit.
  const int last =
    std::min(piece.Last, piece.First + static_cast<int>(this->Task.FirstFrame + this->Task.Frames -
                                                        firstFrame));
  return last < piece.First ||
         this->Field.FirstHit(placed, piece.First, last, firstFrame, 1.0, this->Margin) < 0;
}

bool FlightGrower::PlaceRoot(Level& level)
{
  const SpanTask& task = this->Task;
  Piece piece;
  piece.Top =
    static_cast<int>(this->Stream.Index(static_cast<std::uint32_t>(this->Library.NumberOfTops())));
  piece.Segment = this->Library.SegmentOfTop(piece.Top);
  const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
  piece.Last = static_cast<int>(samples.size()) - 1;
  piece.First = static_cast<int>(
    this->Stream.Index(static_cast<std::uint32_t>(piece.Last - this->Library.Window() + 1)));
  double yaw = this->Stream.Uniform(-M_PI, M_PI);
  if (task.Start.HasVelocity)
  {
    const Vec3 own = samples[std::min(piece.First + 1, piece.Last)] - samples[piece.First];
    const Vec3& wanted = task.Start.Velocity;
    yaw = std::atan2(own.x() * wanted.y() - own.y() * wanted.x(),
                     own.x() * wanted.x() + own.y() * wanted.y());
    const Vec3 turned = Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * own;
    // The more draws miss, the less is asked.
    this->Tolerance += PlannerNumbers::MismatchGrowth;
    if ((turned - wanted).norm() > this->Tolerance * (wanted.norm() + this->Library.TypicalStep()))
    {
      return false;
    }
  }
  piece.Transform.Rotation = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
  piece.Transform.Translation =
    task.Start.Position - piece.Transform.Rotation * samples[piece.First];
  level.Body = piece;
  level.Elapsed = piece.Last - piece.First;
  return this->Fits(piece, task.FirstFrame);
}

bool FlightGrower::Advance(const Level& from, int successor, Level& level)
{
  const Neighbour& entry = this->Library.Successors(from.Body.Top)[successor];
  if (!entry.IsSmooth)
  {
    return false;
  }
  Piece piece;
  piece.Top = entry.Top;
  piece.Segment = this->Library.SegmentOfTop(entry.Top);
  const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
  piece.Last = static_cast<int>(samples.size()) - 1;
  piece.Transform = from.Body.Transform * entry.Transform;
  const Vec3 head = piece.Transform * samples.front();
  this->Library.LimitTilt(piece.Transform.Rotation);
  piece.Transform.Translation = head - piece.Transform.Rotation * samples.front();
  const int overlap = this->Library.Window() - 1;
  level.Body = piece;
  level.Elapsed = from.Elapsed + piece.Last - overlap;
  return this->Fits(piece, this->Task.FirstFrame + from.Elapsed - overlap);
}

std::vector<Piece> FlightGrower::Grow(int maximumNumberOfBranches)
{
  std::vector<Level> path;
  std::vector<Level> best;
  int attempts = 0;
  const auto finished = [&](const std::vector<Level>& p)
  { return !p.empty() && p.back().Elapsed >= this->Task.Frames; };
  if (this->Task.HasContinuation &&
      this->Task.Continuation.Last - this->Task.Continuation.First >= this->Library.Window())
  {
    Level root;
    root.Body = this->Task.Continuation;
    root.Elapsed = root.Body.Last - root.Body.First;
    if (this->Fits(root.Body, this->Task.FirstFrame))
    {
      root.Untried = Shuffled(this->Library.Successors(root.Body.Top).size(), this->Stream);
      path.push_back(root);
    }
  }
  while (!finished(path) && attempts < maximumNumberOfBranches)
  {
    ++attempts;
    if (path.empty())
    {
      Level root;
      if (this->PlaceRoot(root))
      {
        root.Untried = Shuffled(this->Library.Successors(root.Body.Top).size(), this->Stream);
        path.push_back(root);
      }
    }
    else if (path.back().Untried.empty())
    {
      path.pop_back();
      continue;
    }
    else
    {
      const int successor = path.back().Untried.back();
      path.back().Untried.pop_back();
      Level next;
      if (this->Advance(path.back(), successor, next))
      {
        next.Untried = Shuffled(this->Library.Successors(next.Body.Top).size(), this->Stream);
        path.push_back(next);
      }
    }
    if (best.empty() || (!path.empty() && path.back().Elapsed > best.back().Elapsed))
    {
      best = path;
    }
  }
  std::vector<Piece> pieces;
  for (const Level& level : best)
  {
    pieces.push_back(level.Body);
  }
  if (!best.empty() && best.back().Elapsed > this->Task.Frames)
  {
    // Cut, but never into the overlap; then time scales by a frame or two.
    Piece& last = pieces.back();
    const int least = last.First + this->Library.Window();
    last.Last = std::max(least, last.Last - (best.back().Elapsed - this->Task.Frames));
  }
  return pieces;
}

} // namespace

std::vector<Piece> FlyFree(const SegmentLibrary& library, const ClearanceField& field,
                           const SpanTask& task, double margin, int maximumNumberOfBranches,
                           Random random)
{
  return FlightGrower(library, field, task, margin, random).Grow(maximumNumberOfBranches);
}

} // namespace waft
