// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SpanSearch.h"

#include "SwirlDatabase.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

const SegmentLibrary& Library()
{
  static const SegmentLibrary library = []
  {
    SegmentLibrary built;
    const Result result = built.Build(test::SwirlDatabase(), SegmentLibraryOptions(), SerialFor());
    EXPECT_TRUE(bool(result)) << result.Message();
    return built;
  }();
  return library;
}

SpanTask OpenTask()
{
  SpanTask task;
  task.Start.Position = Vec3(-1.2, -0.5, 2.5);
  task.Goal.Position = Vec3(1.0, 0.6, 1.4);
  task.Frames = 180;
  return task;
}

} // namespace

TEST(SegmentLibrary, PlacesSuccessorsSoThatWindowsMeetInTheRightDirection)
{
  const SegmentLibrary& library = Library();
  ASSERT_GE(library.Database().Segments.size(), 200u);
  const int window = library.Window();
  int checked = 0;
  for (int top = 0; top < library.NumberOfTops(); ++top)
  {
    const std::vector<Vec3>& first = library.Samples(library.SegmentOfTop(top));
    for (const Neighbour& next : library.Successors(top))
    {
      if (next.Cost > 0.06)
      {
        continue;
      }
      const std::vector<Vec3>& second = library.Samples(library.SegmentOfTop(next.Top));
      double sum = 0.0;
      for (int j = 0; j < window; ++j)
      {
        sum += (first[first.size() - window + j] - next.Transform * second[j]).squaredNorm();
      }
      const double chord = (first.back() - first[first.size() - window]).norm();
      EXPECT_LT(std::sqrt(sum / window), 0.2 * chord);
      EXPECT_LT((next.FreeEnd - next.Transform * second.back()).norm(), 1e-12);
      ++checked;
    }
    for (const Neighbour& previous : library.Predecessors(top))
    {
      // The same pair seen from the one that comes after.
      const Neighbour* same = library.Connection(previous.Top, top);
      ASSERT_NE(same, nullptr);
      const Placement both = same->Transform * previous.Transform;
      EXPECT_LT((both.Rotation - Mat3::Identity()).norm() + both.Translation.norm(), 1e-9);
    }
  }
  EXPECT_GT(checked, 200);
}

TEST(SegmentLibrary, KeepsTheTiltWithinItsLimit)
{
  Random random(3);
  for (int trial = 0; trial < 100; ++trial)
  {
    Mat3 rotation =
      Eigen::AngleAxisd(random.Uniform(0.0, 3.0), random.Direction()).toRotationMatrix();
    Library().LimitTilt(rotation);
    EXPECT_LE(std::acos(std::min(1.0, rotation(2, 2))), DefaultMaxTilt + 1e-9);
    EXPECT_LT((rotation * rotation.transpose() - Mat3::Identity()).norm(), 1e-12);
  }
}

TEST(SpanSearch, SeedNodeAndSegmentEqualBruteForce)
{
  const SegmentLibrary& library = Library();
  const ObstacleSet obstacles;
  ClearanceField field;
  field.Obstacles = &obstacles;
  const SpanTask task = OpenTask();
  SpanSearch search(library, field, task, SpanSearchOptions(), Random(5));
  for (int i = 0; i < 200; ++i)
  {
    search.Step();
  }
  Random random(9);
  int different = 0;
  const Branch* last = nullptr;
  for (int state = 0; state < 60; ++state)
  {
    const int tree = state % 2;
    const Vec3 seed = random.InBox(Box());
    const double elapsed = random.Uniform(0.0, task.Frames);
    int wanted = -1;
    double least = 1e300;
    for (std::size_t i = 0; i < search.Tree(tree).size(); ++i)
    {
      const Branch& branch = search.Tree(tree)[i];
      const std::vector<Vec3>& samples = library.Samples(branch.Body.Segment);
      const Vec3 end =
        branch.Body.Transform * samples[tree == 0 ? branch.Body.Last : branch.Body.First];
      const double late = library.TypicalStep() * (branch.Elapsed - elapsed);
      const double distance = (end - seed).squaredNorm() + late * late;
      if (branch.Elapsed < task.Frames && branch.Failures < 12 && distance < least)
      {
        least = distance;
        wanted = static_cast<int>(i);
      }
    }
    const int node = search.SeedNode(tree, seed, elapsed);
    ASSERT_EQ(node, wanted);
    const Branch& parent = search.Tree(tree)[node];
    different += &parent == last ? 0 : 1;
    last = &parent;
    const Neighbour* chosen = search.BestSegment(tree, parent, seed);
    ASSERT_NE(chosen, nullptr);
    double nearest = 1e300;
    int top = -1;
    for (int candidate = 0; candidate < library.NumberOfTops(); ++candidate)
    {
      const Neighbour* entry = tree == 0 ? library.Connection(parent.Body.Top, candidate)
                                         : library.Connection(candidate, parent.Body.Top);
      if (entry == nullptr || !entry->IsSmooth)
      {
        continue;
      }
      const std::vector<Vec3>& samples = library.Samples(library.SegmentOfTop(candidate));
      const Placement placed =
        parent.Body.Transform * (tree == 0 ? entry->Transform : entry->Transform.Inverse());
      const double distance =
        (placed * (tree == 0 ? samples.back() : samples.front()) - seed).norm();
      if (distance < nearest)
      {
        nearest = distance;
        top = candidate;
      }
    }
    EXPECT_EQ(chosen->Top, top);
  }
  EXPECT_GT(different, 20);
}

TEST(SpanSearch, GrowsBothTreesInsideTheVolumeAndFindsCheapJoins)
{
  const SegmentLibrary& library = Library();
  const ObstacleSet obstacles;
  ClearanceField field;
  field.Obstacles = &obstacles;
  const SpanTask task = OpenTask();
  SpanSearch search(library, field, task, SpanSearchOptions(), Random(6));
  for (int i = 0; i < 300; ++i)
  {
    search.Step();
  }
  for (int tree = 0; tree < 2; ++tree)
  {
    EXPECT_GT(search.Tree(tree).size(), 40u);
    for (const Branch& branch : search.Tree(tree))
    {
      for (int k = branch.Body.First; k <= branch.Body.Last; ++k)
      {
        const Vec3 x = branch.Body.Transform * library.Samples(branch.Body.Segment)[k];
        EXPECT_GT(field.Bounds.InnerDistance(x), field.Rule.Radius);
      }
    }
  }
  Join join;
  ASSERT_TRUE(search.Take(0.3, join));
  EXPECT_LE(std::abs(join.RawFrames - task.Frames), 0.15 * task.Frames);
  int index = 0;
  const std::vector<Piece> chain = search.Chain(join, index);
  int frames = 0;
  for (const Piece& piece : chain)
  {
    frames += piece.Last - piece.First;
  }
  frames -= (library.Window() - 1) * (static_cast<int>(chain.size()) - 1);
  EXPECT_EQ(frames, join.RawFrames);
  double before = join.Score;
  while (search.Take(1.0, join))
  {
    EXPECT_GE(join.Score, before);
    before = join.Score;
  }
}

TEST(SpanSearch, CheapestJoinEqualsBruteForce)
{
  const SegmentLibrary& library = Library();
  const ObstacleSet obstacles;
  ClearanceField field;
  field.Obstacles = &obstacles;
  SpanTask task = OpenTask();
  const int overlap = library.Window() - 1;
  const double limit = 0.15 * task.Frames;
  std::size_t fromTrees = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    SpanSearch search(library, field, task, SpanSearchOptions(), Random(seed));
    for (int i = 0; i < 40 + 20 * static_cast<int>(seed); ++i)
    {
      search.Step();
    }
    const auto score = [&](double gap, double angle, int raw)
    {
      return gap / (library.TypicalStep() * task.Frames) + 0.25 * std::abs(angle) +
             0.5 * std::abs(raw - task.Frames) / static_cast<double>(task.Frames);
    };
    double least = 1e300;
    std::vector<double> meetings;
    for (const Branch& forward : search.Tree(0))
    {
      for (int top = 0; top < library.NumberOfTops(); ++top)
      {
        const Neighbour* entry = library.Connection(forward.Body.Top, top);
        if (entry == nullptr || !entry->IsSmooth)
        {
          continue;
        }
        const std::vector<Vec3>& samples = library.Samples(library.SegmentOfTop(top));
        Placement placed = forward.Body.Transform * entry->Transform;
        for (const Branch& backward : search.Tree(1))
        {
          const int raw = forward.Elapsed + backward.Elapsed - overlap;
          if (backward.Body.Top != top || std::abs(raw - task.Frames) > limit)
          {
            continue;
          }
          const Mat3 turn = backward.Body.Transform.Rotation * placed.Rotation.transpose();
          const double angle = std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
          const double gap =
            (backward.Body.Transform * samples.front() - placed * samples.front()).norm();
          meetings.push_back(score(gap, angle, raw));
        }
        // Or one more piece, cut where it suits; which cut is judged before its lean is limited.
        const Placement uncut = placed;
        const Vec3 head = placed * samples.front();
        library.LimitTilt(placed.Rotation);
        placed.Translation = head - placed.Rotation * samples.front();
        int best = -1;
        double bestScore = 1e300;
        for (int last = overlap + 1; last < static_cast<int>(samples.size()); ++last)
        {
          const int raw = forward.Elapsed - overlap + last;
          const double own = score((uncut * samples[last] - task.Goal.Position).norm(), 0.0, raw);
          if (std::abs(raw - task.Frames) <= limit && own < bestScore)
          {
            bestScore = own;
            best = last;
          }
        }
        if (best >= 0)
        {
          const double own = score((placed * samples[best] - task.Goal.Position).norm(), 0.0,
                                   forward.Elapsed - overlap + best);
          least = std::min(least, own);
        }
      }
    }
    // The best of all come first, and of the meetings of the two trees none is passed over.
    std::sort(meetings.begin(), meetings.end());
    least = std::min(least, meetings.empty() ? least : meetings.front());
    Join join;
    std::size_t handedOut = 0;
    std::size_t ofTrees = 0;
    for (; search.Take(1e9, join); ++handedOut)
    {
      if (handedOut == 0)
      {
        EXPECT_NEAR(join.Score, least, 1e-9) << seed;
      }
      if (join.Backward >= 0)
      {
        ASSERT_LT(ofTrees, meetings.size()) << seed;
        EXPECT_NEAR(join.Score, meetings[ofTrees], 1e-9) << seed;
        ++ofTrees;
      }
    }
    EXPECT_GE(handedOut, 20u) << seed;
    fromTrees += ofTrees;
  }
  EXPECT_GE(fromTrees, 3u);
}
