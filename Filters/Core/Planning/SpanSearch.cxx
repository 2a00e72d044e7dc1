// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SpanSearch.h"

#include "Planning/RoomMap.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

constexpr std::size_t KeptJoins = 32;
constexpr std::size_t KeptApproaches = 12;
constexpr int FailuresUntilGivenUp = 12;

Mat3 Yaw(double angle)
{
  return Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
}

/// The rotation about the vertical that turns a towards b, both seen from above.
double YawBetween(const Vec3& a, const Vec3& b)
{
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
}

Vec3 StepAt(const std::vector<Vec3>& samples, int k)
{
  const auto last = static_cast<int>(samples.size()) - 1;
  const int a = std::max(0, k - 1);
  const int b = std::min(last, k + 1);
  return (samples[b] - samples[a]) / static_cast<double>(b - a);
}

} // namespace

SpanSearch::SpanSearch(const SegmentLibrary& library, const ClearanceField& field,
                       const SpanTask& task, const SpanSearchOptions& options, Random random) :
  Library(library),
  Field(field), Task(task), Options(options), Stream(random), Window(library.Window())
{
  // No point farther from both ends than the top speed allows is worth a seed.
  const double reach = library.TopStep() * task.Frames * 0.5;
  const Vec3 centre = 0.5 * (task.Start.Position + task.Goal.Position);
  const Vec3 half = 0.5 * (task.Goal.Position - task.Start.Position).cwiseAbs() +
                    Vec3::Constant(std::max(0.3 * reach, 2.0 * field.Radius));
  this->SeedBox.Min = field.Bounds.Min.cwiseMax(centre - half);
  this->SeedBox.Max = field.Bounds.Max.cwiseMin(centre + half);
  for (const Vec3& x : task.Way)
  {
    this->SeedBox.Min = this->SeedBox.Min.cwiseMin(x);
    this->SeedBox.Max = this->SeedBox.Max.cwiseMax(x);
  }
  if (task.Frames <= library.LongestSegment())
  {
    this->AddSinglePieces();
  }
  if (task.HasContinuation && task.Continuation.Last - task.Continuation.First >= this->Window)
  {
    this->AddRoot(0, task.Continuation, 0.0);
  }
  this->AddRoots(0, 8);
  this->AddRoots(1, 8);
}

double SpanSearch::Score(double gap, double angle, int rawFrames, double mismatch) const
{
  const double frames = this->Task.Frames;
  return gap / (this->Library.TypicalStep() * frames) + 0.25 * std::abs(angle) +
         0.5 * std::abs(rawFrames - frames) / frames + 0.1 * mismatch;
}

bool SpanSearch::IsFree(const Piece& piece, double firstFrame) const
{
  const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
  std::vector<Vec3> placed(static_cast<std::size_t>(piece.Last) + 1);
  for (int k = piece.First; k <= piece.Last; ++k)
  {
    placed[k] = piece.Place * samples[k];
  }
  return this->Field.FirstHit(placed, piece.First, piece.Last, firstFrame, 1.0,
                              this->Options.Margin) < 0;
}

bool SpanSearch::CanEndHere(const Piece& piece) const
{
  // A body lands from above.
  const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
  const double low = (piece.Place * samples[piece.Last]).z() - 1e-6;
  for (int k = std::max(piece.First, piece.Last - 30); k < piece.Last; ++k)
  {
    if ((piece.Place * samples[k]).z() < low)
    {
      return false;
    }
  }
  return true;
}

bool SpanSearch::AddRoot(int tree, const Piece& piece, double mismatch)
{
  Branch branch;
  branch.Body = piece;
  branch.Elapsed = piece.Last - piece.First;
  branch.Mismatch = mismatch;
  const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
  branch.FreeEnd = piece.Place * samples[tree == 0 ? piece.Last : piece.First];
  const double first =
    tree == 0 ? this->Task.FirstFrame : this->Task.FirstFrame + this->Task.Frames - branch.Elapsed;
  if (branch.Elapsed > this->Task.Frames * (1.0 + this->Options.RetimingLimit) ||
      !this->IsFree(piece, first))
  {
    return false;
  }
  this->Insert(tree, branch);
  return true;
}

void SpanSearch::AddRoots(int tree, int count)
{
  const SpanEnd& end = tree == 0 ? this->Task.Start : this->Task.Goal;
  for (int i = 0; i < count; ++i)
  {
    Piece best;
    double bestMismatch = 1e30;
    // With a velocity to match the best of several draws is tried; without, each draw is as good.
    // Where no way on has that velocity, the seam is healed afterwards.
    const bool matches =
      end.HasVelocity && (!this->Trees[tree].empty() || this->RootFailures[tree] < 40);
    const int draws = matches ? 48 : 1;
    for (int draw = 0; draw < draws; ++draw)
    {
      Piece piece;
      piece.Top = static_cast<int>(
        this->Stream.Index(static_cast<std::uint32_t>(this->Library.NumberOfTops())));
      piece.Segment = this->Library.SegmentOfTop(piece.Top);
      const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
      const auto last = static_cast<int>(samples.size()) - 1;
      const int room = last - this->Window;
      const int cut = static_cast<int>(this->Stream.Index(static_cast<std::uint32_t>(room + 1)));
      piece.First = tree == 0 ? cut : 0;
      piece.Last = tree == 0 ? last : this->Window + cut;
      const int at = tree == 0 ? piece.First : piece.Last;
      double yaw = this->Stream.Uniform(-M_PI, M_PI);
      double mismatch = 0.0;
      if (matches)
      {
        const Vec3 own = StepAt(samples, at);
        yaw = YawBetween(own, end.Velocity);
        mismatch = (Yaw(yaw) * own - end.Velocity).norm() / this->Library.TypicalStep();
      }
      if (mismatch < bestMismatch)
      {
        piece.Place.Rotation = Yaw(yaw);
        piece.Place.Translation = end.Position - piece.Place.Rotation * samples[at];
        best = piece;
        bestMismatch = mismatch;
      }
    }
    const bool lands = tree == 1 && end.IsRest;
    if ((lands && !this->CanEndHere(best)) || !this->AddRoot(tree, best, bestMismatch))
    {
      ++this->RootFailures[tree];
    }
  }
}

void SpanSearch::AddSinglePieces()
{
  const Vec3 wanted = this->Task.Goal.Position - this->Task.Start.Position;
  const double limit = this->Options.RetimingLimit * this->Task.Frames;
  for (int top = 0; top < this->Library.NumberOfTops(); ++top)
  {
    Piece piece;
    piece.Top = top;
    piece.Segment = this->Library.SegmentOfTop(top);
    const std::vector<Vec3>& samples = this->Library.Samples(piece.Segment);
    const auto count = static_cast<int>(samples.size());
    for (int first = 0; first < count; first += 2)
    {
      Join best;
      best.Score = 1e30;
      for (int last = first + 1; last < count; ++last)
      {
        const int raw = last - first;
        if (std::abs(raw - this->Task.Frames) > limit)
        {
          continue;
        }
        const Vec3 way = samples[last] - samples[first];
        const Mat3 turn = Yaw(YawBetween(way, wanted));
        double mismatch = 0.0;
        if (this->Task.Start.HasVelocity)
        {
          mismatch += (turn * StepAt(samples, first) - this->Task.Start.Velocity).norm();
        }
        if (this->Task.Goal.HasVelocity)
        {
          mismatch += (turn * StepAt(samples, last) - this->Task.Goal.Velocity).norm();
        }
        Join join;
        join.HasLastPiece = true;
        join.LastPiece = piece;
        join.LastPiece.First = first;
        join.LastPiece.Last = last;
        join.LastPiece.Place = { turn, this->Task.Start.Position - turn * samples[first] };
        join.RawFrames = raw;
        join.Distance = (turn * way - wanted).norm();
        join.Score = this->Score(join.Distance, 0.0, raw, mismatch / this->Library.TypicalStep());
        if (join.Score < best.Score)
        {
          best = join;
        }
      }
      if (best.HasLastPiece && (!this->Task.Goal.IsRest || this->CanEndHere(best.LastPiece)))
      {
        this->Offer(best);
        this->OfferApproach(best);
      }
    }
  }
}

Vec3 SpanSearch::Seed(double& frame)
{
  const double u = this->Stream.Uniform();
  frame = u * this->Task.Frames;
  const bool hasWay = !this->Task.Way.empty();
  if (this->Stream.Uniform() < (hasWay ? 0.8 : 0.5))
  {
    // About the way, as far from it as there is time for, or in a maze as there is room.
    const double time =
      0.35 * this->Library.TypicalStep() * this->Task.Frames * std::sqrt(u * (1.0 - u));
    const double spread = hasWay ? std::min(time, 4.0 * this->Field.Radius) : time;
    const Vec3 offset(this->Stream.Normal(), this->Stream.Normal(), this->Stream.Normal());
    const Vec3 x =
      spread * offset + (hasWay ? PointAlong(this->Task.Way, u)
                                : Vec3(this->Task.Start.Position +
                                       u * (this->Task.Goal.Position - this->Task.Start.Position)));
    return x.cwiseMax(this->SeedBox.Min).cwiseMin(this->SeedBox.Max);
  }
  return this->Stream.InBox(this->SeedBox);
}

int SpanSearch::SeedNode(int tree, const Vec3& seed, double elapsed) const
{
  const double step = this->Library.TypicalStep();
  int best = -1;
  double bestDistance = 1e300;
  const std::vector<Branch>& branches = this->Trees[tree];
  for (std::size_t i = 0; i < branches.size(); ++i)
  {
    const Branch& branch = branches[i];
    if (branch.Elapsed >= this->Task.Frames || branch.Failures >= FailuresUntilGivenUp)
    {
      continue;
    }
    const double late = step * (branch.Elapsed - elapsed);
    const double distance = (branch.FreeEnd - seed).squaredNorm() + late * late;
    if (distance < bestDistance)
    {
      bestDistance = distance;
      best = static_cast<int>(i);
    }
  }
  return best;
}

const Neighbour* SpanSearch::BestSegment(int tree, const Branch& parent, const Vec3& seed) const
{
  const std::vector<Neighbour>& list = tree == 0 ? this->Library.Successors(parent.Body.Top)
                                                 : this->Library.Predecessors(parent.Body.Top);
  const Vec3 local = parent.Body.Place.Inverse() * seed;
  const Neighbour* best = nullptr;
  double bestDistance = 1e300;
  for (const Neighbour& entry : list)
  {
    if (!entry.IsSmooth && !this->TakesRough)
    {
      continue;
    }
    const double distance = (entry.FreeEnd - local).squaredNorm();
    if (distance < bestDistance)
    {
      bestDistance = distance;
      best = &entry;
    }
  }
  return best;
}

void SpanSearch::Step()
{
  const int tree = this->Turn++ % 2;
  if (this->Turn % 16 < 2 && !(tree == 0 && this->Task.HasContinuation))
  {
    this->AddRoots(tree, 1);
  }
  double frame = 0.0;
  const Vec3 seed = this->Seed(frame);
  const int node = this->SeedNode(tree, seed, tree == 0 ? frame : this->Task.Frames - frame);
  if (node < 0)
  {
    this->AddRoots(tree, 1);
    return;
  }
  const Branch parent = this->Trees[tree][node];
  const Neighbour* entry = this->BestSegment(tree, parent, seed);
  if (entry == nullptr)
  {
    this->Trees[tree][node].Failures = FailuresUntilGivenUp;
    return;
  }
  Branch branch;
  branch.Parent = node;
  branch.Cost = entry->Cost;
  branch.Mismatch = parent.Mismatch;
  branch.Body.Top = entry->Top;
  branch.Body.Segment = this->Library.SegmentOfTop(entry->Top);
  const std::vector<Vec3>& samples = this->Library.Samples(branch.Body.Segment);
  branch.Body.Last = static_cast<int>(samples.size()) - 1;
  branch.Body.Place = parent.Body.Place * entry->Place;
  // The tilt adds up along a chain; beyond the limit it is turned back about the shared window.
  const Vec3 hinge = branch.Body.Place * (tree == 0 ? samples.front() : samples.back());
  this->Library.LimitTilt(branch.Body.Place.Rotation);
  branch.Body.Place.Translation =
    hinge - branch.Body.Place.Rotation * (tree == 0 ? samples.front() : samples.back());
  branch.FreeEnd = branch.Body.Place * (tree == 0 ? samples.back() : samples.front());
  branch.Elapsed = parent.Elapsed + branch.Body.Last - (this->Window - 1);
  const double firstFrame = tree == 0 ? this->Task.FirstFrame + parent.Elapsed - (this->Window - 1)
                                      : this->Task.FirstFrame + this->Task.Frames - branch.Elapsed;
  if (branch.Elapsed > this->Task.Frames * (1.0 + this->Options.RetimingLimit) ||
      !this->IsFree(branch.Body, firstFrame))
  {
    ++this->Trees[tree][node].Failures;
    return;
  }
  this->Insert(tree, branch);
}

void SpanSearch::Insert(int tree, const Branch& branch)
{
  this->Trees[tree].push_back(branch);
  const auto index = static_cast<int>(this->Trees[tree].size()) - 1;
  this->MeetOther(tree, index);
  if (tree == 0)
  {
    this->CloseOnGoal(index);
  }
}

void SpanSearch::MeetOther(int tree, int index)
{
  const double limit = this->Options.RetimingLimit * this->Task.Frames;
  const Branch& own = this->Trees[tree][index];
  const std::vector<Branch>& others = this->Trees[1 - tree];
  const double worst = this->Joins.size() < KeptJoins ? 1.5 : this->Joins.back().Score;
  const double reach = worst * this->Library.TypicalStep() * this->Task.Frames;
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    const Branch& other = others[i];
    const int raw = own.Elapsed + other.Elapsed - (this->Window - 1);
    if (std::abs(raw - this->Task.Frames) > limit ||
        (own.FreeEnd - other.FreeEnd).squaredNorm() > (reach + 0.5) * (reach + 0.5))
    {
      continue;
    }
    const Branch& forward = tree == 0 ? own : other;
    const Branch& backward = tree == 0 ? other : own;
    const Neighbour* entry = this->Library.Connection(forward.Body.Top, backward.Body.Top);
    if (entry == nullptr || (!entry->IsSmooth && !this->TakesRough))
    {
      continue;
    }
    const Placement predicted = forward.Body.Place * entry->Place;
    const Vec3 head = this->Library.Samples(backward.Body.Segment).front();
    const Mat3 turn = backward.Body.Place.Rotation * predicted.Rotation.transpose();
    Join join;
    join.Forward = tree == 0 ? index : static_cast<int>(i);
    join.Backward = tree == 0 ? static_cast<int>(i) : index;
    join.RawFrames = raw;
    join.Distance = (backward.Body.Place * head - predicted * head).norm();
    join.Angle = std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
    join.Score = this->Score(join.Distance, join.Angle, raw, own.Mismatch + other.Mismatch);
    if (join.Score < worst)
    {
      this->Offer(join);
    }
  }
}

void SpanSearch::CloseOnGoal(int index)
{
  const Branch& parent = this->Trees[0][index];
  const double limit = this->Options.RetimingLimit * this->Task.Frames;
  const double typical = this->Library.TypicalStep() * this->Task.Frames;
  const Vec3 goal = parent.Body.Place.Inverse() * this->Task.Goal.Position;
  const int overlap = this->Window - 1;
  // A root that passes the goal by itself would be a single piece; here one more is attached.
  for (const Neighbour& entry : this->Library.Successors(parent.Body.Top))
  {
    if (!entry.IsSmooth && !this->TakesRough)
    {
      continue;
    }
    const std::vector<Vec3>& samples = this->Library.Samples(this->Library.SegmentOfTop(entry.Top));
    const auto end = static_cast<int>(samples.size()) - 1;
    const int low = std::max(this->Window, static_cast<int>(std::ceil(this->Task.Frames - limit)) -
                                             parent.Elapsed + overlap);
    const int high = std::min(end, static_cast<int>(std::floor(this->Task.Frames + limit)) -
                                     parent.Elapsed + overlap);
    Join best;
    best.Score = 1e30;
    for (int last = low; last <= high; ++last)
    {
      const double gap = (entry.Place * samples[last] - goal).norm();
      if (gap > 1.5 * typical)
      {
        continue;
      }
      const int raw = parent.Elapsed - overlap + last;
      const double score = this->Score(gap, 0.0, raw, parent.Mismatch);
      if (score < best.Score)
      {
        best.Score = score;
        best.RawFrames = raw;
        best.Distance = gap;
        best.LastPiece.Last = last;
      }
    }
    const bool offered = this->Joins.size() < KeptJoins || best.Score < this->Joins.back().Score;
    const bool nearer =
      this->Nearest.size() < KeptApproaches || best.Distance < this->Nearest.back().Distance;
    if (best.Score > 1e29 || (!offered && !nearer))
    {
      continue;
    }
    best.Forward = index;
    best.HasLastPiece = true;
    best.LastPiece.Top = entry.Top;
    best.LastPiece.Segment = this->Library.SegmentOfTop(entry.Top);
    best.LastPiece.Place = parent.Body.Place * entry.Place;
    const Vec3 hinge = best.LastPiece.Place * samples.front();
    this->Library.LimitTilt(best.LastPiece.Place.Rotation);
    best.LastPiece.Place.Translation = hinge - best.LastPiece.Place.Rotation * samples.front();
    best.Distance =
      (best.LastPiece.Place * samples[best.LastPiece.Last] - this->Task.Goal.Position).norm();
    best.Score = this->Score(best.Distance, 0.0, best.RawFrames, parent.Mismatch);
    if (this->Task.Goal.HasVelocity)
    {
      const Vec3 own = best.LastPiece.Place.Rotation * StepAt(samples, best.LastPiece.Last);
      best.Score += 0.1 * (own - this->Task.Goal.Velocity).norm() / this->Library.TypicalStep();
    }
    if (this->Task.Goal.IsRest && !this->CanEndHere(best.LastPiece))
    {
      continue;
    }
    this->Offer(best);
    if (nearer && this->IsFree(best.LastPiece, this->Task.FirstFrame + parent.Elapsed - overlap))
    {
      this->OfferApproach(best);
    }
  }
}

void SpanSearch::Offer(const Join& join)
{
  const auto place =
    std::upper_bound(this->Joins.begin(), this->Joins.end(), join,
                     [](const Join& a, const Join& b) { return a.Score < b.Score; });
  this->Joins.insert(place, join);
  if (this->Joins.size() > KeptJoins)
  {
    this->Joins.pop_back();
  }
}

void SpanSearch::OfferApproach(const Join& join)
{
  const auto place =
    std::upper_bound(this->Nearest.begin(), this->Nearest.end(), join,
                     [](const Join& a, const Join& b) { return a.Distance < b.Distance; });
  this->Nearest.insert(place, join);
  if (this->Nearest.size() > KeptApproaches)
  {
    this->Nearest.pop_back();
  }
}

bool SpanSearch::Take(double threshold, Join& join)
{
  if (this->Joins.empty() || this->Joins.front().Score > threshold)
  {
    return false;
  }
  join = this->Joins.front();
  this->Joins.erase(this->Joins.begin());
  return true;
}

std::vector<Piece> SpanSearch::Chain(const Join& join, int& joinPlace) const
{
  std::vector<Piece> chain;
  for (int i = join.Forward; i >= 0; i = this->Trees[0][i].Parent)
  {
    chain.push_back(this->Trees[0][i].Body);
  }
  std::reverse(chain.begin(), chain.end());
  joinPlace = static_cast<int>(chain.size());
  if (join.HasLastPiece)
  {
    chain.push_back(join.LastPiece);
  }
  for (int i = join.Backward; i >= 0; i = this->Trees[1][i].Parent)
  {
    chain.push_back(this->Trees[1][i].Body);
  }
  return chain;
}

} // namespace waft
