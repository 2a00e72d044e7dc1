// SPDX-License-Identifier: BSD-3-Clause
// Thinned animations, read back and held to the whole ones by the plain way of glTF's own text: at
// each frame the two keys beside it are looked for from the first on.
#include "Base/Primitives.h"
#include "Base/Random.h"
#include "Export/GltfAnimation.h"
#include "Export/LoadedGlb.h"

#include <gtest/gtest.h>

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace key_thinning // the tests of this folder are compiled as one
{

using namespace waft;

constexpr int Frames = 300;
constexpr double Rate = 24000.0 / 1001.0;
constexpr double Extent = 0.06; // m, of the body
constexpr double PlaceTolerance = KeyPlaceTolerance * Extent;
constexpr double TurnTolerance = KeyTurnTolerance; // degrees
constexpr int LongestSpan = 64;
constexpr double Rounding = 1e-9; // m, and degrees

const double Pi = std::acos(-1.0);
SilentMonitor monitor;

std::vector<AnimatedShape> Shapes()
{
  std::vector<AnimatedShape> shapes(1);
  shapes[0].Body.Name = "petal";
  shapes[0].Body.Mesh = MakeBox({ Vec3(-0.02, -0.03, -0.001), Vec3(0.02, 0.03, 0.001) });
  return shapes;
}

/// A body at a place and turn by frame.
template <class Place, class Turn>
AnimatedObject Moved(int id, const Place& place, const Turn& turn)
{
  AnimatedObject object;
  object.ObjectId = id;
  for (int k = 0; k < Frames; ++k)
  {
    object.Positions.push_back(place(static_cast<double>(k)));
    object.Orientations.push_back(turn(static_cast<double>(k)));
  }
  return object;
}

Quat About(const Vec3& axis, double degrees)
{
  return Quat(Eigen::AngleAxisd(degrees * Pi / 180.0, axis));
}

AnimatedObject Still(int id)
{
  return Moved(
    id, [](double) { return Vec3(0.3, -0.7, 0.01); },
    [](double) { return About(Vec3(1.0, 2.0, 3.0).normalized(), 77.0); });
}

AnimatedObject Gliding(int id, double degrees)
{
  return Moved(
    id, [](double k) { return Vec3(0.01 * k, 1.0, 3.0 - 0.005 * k); },
    [&](double k) { return About(Vec3::UnitX(), degrees * k); });
}

/// Sways, turns, and from `rest` on lies.
AnimatedObject Falling(int id, int rest, Random& random)
{
  const Vec3 from = random.Direction(), sway = 0.1 * random.Direction();
  const Vec3 axis = random.Direction(), other = random.Direction();
  const double speed = 0.05 + 0.2 * random.Uniform(), turning = 6.0 * random.Uniform();
  return Moved(
    id,
    [&](double k)
    {
      const double down = std::min(k, static_cast<double>(rest));
      return Vec3(from + sway * std::sin(speed * down) + Vec3(0.0, 0.0, -0.01 * down));
    },
    [&](double k)
    {
      const double down = std::min(k, static_cast<double>(rest));
      return About(axis, turning * down) * About(other, 30.0 * std::sin(speed * down));
    });
}

AnimatedObject Shaken(int id, Random& random)
{
  return Moved(
    id, [&](double) { return Vec3(random.Direction()); },
    [&](double) { return About(random.Direction(), 90.0 * random.Uniform()); });
}

std::vector<AnimatedObject> Objects()
{
  Random random(11);
  std::vector<AnimatedObject> objects = { Still(0), Gliding(1, 0.0), Gliding(2, 9.0),
                                          Shaken(3, random), Shaken(4, random) };
  for (int i = 5; i < 40; ++i)
  {
    objects.push_back(Falling(i, 60 + 7 * i, random));
    for (int m = 0; m < i % 4; ++m)
    {
      objects.back().Marks.push_back(static_cast<int>(Frames * random.Uniform()));
    }
    objects.back().Marks.insert(objects.back().Marks.end(), { -1, Frames - 1, Frames + 3 });
  }
  for (int i = 40; i < 43; ++i) // shaken until they lie
  {
    objects.push_back(Shaken(i, random));
    AnimatedObject& last = objects.back();
    const int rest = i < 42 ? 200 : 295;
    std::fill(last.Positions.begin() + rest, last.Positions.end(), last.Positions[rest]);
    std::fill(last.Orientations.begin() + rest, last.Orientations.end(), last.Orientations[rest]);
  }
  for (int k = 1; k < Frames; k += 2) // the same turns with the other sign
  {
    objects[39].Orientations[k].coeffs() *= -1.0;
  }
  return objects;
}

struct Read
{
  std::vector<double> Values; // 1, 3 or 4 a key
  int Accessor = -1;
};

/// What a file says of an object.
struct Motion
{
  Read Times, Places, Turns;
  int Count() const { return static_cast<int>(this->Times.Values.size()); }
  Vec3 Place(int key) const { return Vec3(&this->Places.Values[3 * key]); }
  Quat Turn(int key) const { return Quat(&this->Turns.Values[4 * key]); }
  /// The key at this time, or -1.
  int KeyAt(double time) const
  {
    const auto& times = this->Times.Values;
    const auto found = std::find(times.begin(), times.end(), time);
    return found != times.end() ? static_cast<int>(found - times.begin()) : -1;
  }
};

Read ReadAccessor(const tinygltf::Model& model, int number, int width)
{
  const tinygltf::Accessor& accessor = model.accessors[number];
  const tinygltf::BufferView& view = model.bufferViews[accessor.bufferView];
  const std::size_t size = accessor.count * width * sizeof(float);
  EXPECT_LE(accessor.byteOffset + size, view.byteLength);
  EXPECT_LE(view.byteOffset + view.byteLength, model.buffers[0].data.size());
  EXPECT_EQ((view.byteOffset + accessor.byteOffset) % sizeof(float), 0u);
  const auto* first = reinterpret_cast<const float*>(model.buffers[0].data.data() +
                                                     view.byteOffset + accessor.byteOffset);
  return { std::vector<double>(first, first + accessor.count * width), number };
}

void ReadBack(const std::string& bytes, tinygltf::Model& model, std::vector<Motion>& motions)
{
  ASSERT_NO_FATAL_FAILURE(LoadGlb(bytes, model));
  motions.assign(model.nodes.size(), Motion());
  for (const tinygltf::AnimationChannel& channel : model.animations[0].channels)
  {
    const tinygltf::AnimationSampler& sampler = model.animations[0].samplers[channel.sampler];
    EXPECT_EQ(sampler.interpolation, "LINEAR");
    Motion& motion = motions[channel.target_node];
    motion.Times = ReadAccessor(model, sampler.input, 1);
    const bool isTurn = channel.target_path == "rotation";
    (isTurn ? motion.Turns : motion.Places) = ReadAccessor(model, sampler.output, isTurn ? 4 : 3);
    const tinygltf::Accessor& times = model.accessors[sampler.input];
    EXPECT_EQ(times.minValues, std::vector<double>{ motion.Times.Values.front() });
    EXPECT_EQ(times.maxValues, std::vector<double>{ motion.Times.Values.back() });
  }
}

void Write(std::size_t mostWholeKeys, tinygltf::Model& model, std::vector<Motion>& motions)
{
  std::string bytes;
  ASSERT_TRUE(GltfAnimation(Shapes(), Objects(), Rate, bytes, monitor, mostWholeKeys));
  ReadBack(bytes, model, motions);
}

double Degrees(const Quat& a, const Quat& b)
{
  return a.normalized().angularDistance(b.normalized()) * 180.0 / Pi;
}

/// How many times the tolerance the poses of `whole` between two of its keys are off, at most, from
/// what these give back.
double Off(const Motion& whole, int from, int to)
{
  double most = 0.0;
  const Quat begin = whole.Turn(from).normalized(), end = whole.Turn(to).normalized();
  for (int k = from + 1; k < to; ++k)
  {
    const double part = (whole.Times.Values[k] - whole.Times.Values[from]) /
                        (whole.Times.Values[to] - whole.Times.Values[from]);
    const Vec3 place = (1.0 - part) * whole.Place(from) + part * whole.Place(to);
    const Quat slerp = begin.slerp(part, end); // the short way
    Quat mean;
    mean.coeffs() = (1.0 - part) * begin.coeffs() + part * end.coeffs();
    most = std::max({ most, (place - whole.Place(k)).norm() / (PlaceTolerance + Rounding),
                      Degrees(slerp, whole.Turn(k)) / (TurnTolerance + Rounding),
                      Degrees(mean, whole.Turn(k)) / (TurnTolerance + Rounding) });
  }
  return most;
}

class KeyThinningTest : public testing::Test
{
protected:
  void SetUp() override
  {
    ASSERT_NO_FATAL_FAILURE(Write(AnyNumberOfKeys, this->WholeModel, this->Whole));
    ASSERT_NO_FATAL_FAILURE(Write(0, this->ThinnedModel, this->Thinned));
    ASSERT_EQ(this->Whole.size(), this->Thinned.size());
  }

  /// The frame of a key.
  int FrameOf(std::size_t i, int key) const
  {
    return this->Whole[i].KeyAt(this->Thinned[i].Times.Values[key]);
  }

  /// Whether a key is left out at which the body does not lie still.
  bool IsChosenGreedily(std::size_t i) const
  {
    const Motion& whole = this->Whole[i];
    for (int key = 1; key < this->Thinned[i].Count(); ++key)
    {
      const int from = this->FrameOf(i, key - 1), to = this->FrameOf(i, key);
      for (int k = from + 1; k < to; ++k)
      {
        if (whole.Place(k) != whole.Place(from) ||
            whole.Turn(k).coeffs() != whole.Turn(from).coeffs())
        {
          return true;
        }
      }
    }
    return false;
  }

  tinygltf::Model WholeModel, ThinnedModel;
  std::vector<Motion> Whole, Thinned;
};

TEST_F(KeyThinningTest, KeysAreThoseOfTheWholeAnimationToTheBit)
{
  for (std::size_t i = 0; i < this->Thinned.size(); ++i)
  {
    const Motion& thinned = this->Thinned[i];
    ASSERT_EQ(thinned.Places.Values.size(), 3u * thinned.Count());
    ASSERT_EQ(thinned.Turns.Values.size(), 4u * thinned.Count());
    int last = -1;
    for (int key = 0; key < thinned.Count(); ++key)
    {
      const int frame = this->FrameOf(i, key);
      ASSERT_GT(frame, last) << "object " << i;
      last = frame;
      EXPECT_EQ(thinned.Place(key), this->Whole[i].Place(frame));
      EXPECT_EQ(thinned.Turn(key).coeffs(), this->Whole[i].Turn(frame).coeffs());
    }
  }
}

TEST_F(KeyThinningTest, MarksAndEndsAreKept)
{
  const std::vector<AnimatedObject> objects = Objects();
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    std::vector<int> kept = objects[i].Marks;
    kept.insert(kept.end(), { 0, Frames - 1 });
    for (const int frame : kept)
    {
      if (frame >= 0 && frame < Frames)
      {
        EXPECT_GE(this->Thinned[i].KeyAt(this->Whole[i].Times.Values[frame]), 0)
          << "object " << i << ", frame " << frame;
      }
    }
  }
}

TEST_F(KeyThinningTest, EachFrameIsGivenBackWithinTheTolerances)
{
  for (std::size_t i = 0; i < this->Thinned.size(); ++i)
  {
    for (int key = 1; key < this->Thinned[i].Count(); ++key)
    {
      EXPECT_LE(Off(this->Whole[i], this->FrameOf(i, key - 1), this->FrameOf(i, key)), 1.0)
        << "object " << i << ", key " << key;
    }
  }
}

TEST_F(KeyThinningTest, NoSpanCouldBeLonger)
{
  const std::vector<AnimatedObject> objects = Objects();
  for (std::size_t i = 0; i < this->Thinned.size(); ++i)
  {
    for (int key = 1; this->IsChosenGreedily(i) && key < this->Thinned[i].Count() - 1; ++key)
    {
      const int from = this->FrameOf(i, key - 1), to = this->FrameOf(i, key);
      const std::vector<int>& marks = objects[i].Marks;
      const bool isMark = std::find(marks.begin(), marks.end(), to) != marks.end();
      const bool isOtherSign =
        this->Whole[i].Turn(from).dot(this->Whole[i].Turn(to + 1)) < 0.0; // two ways round
      EXPECT_TRUE(isMark || isOtherSign || to - from >= LongestSpan ||
                  Off(this->Whole[i], from, to + 1) > 1.0 - 1e-6)
        << "object " << i << ", frames " << from << " to " << to;
    }
  }
}

TEST_F(KeyThinningTest, WhatLiesOrGlidesNeedsFew)
{
  EXPECT_EQ(this->Thinned[0].Count(), 2);
  EXPECT_EQ(this->Thinned[1].Count(), 6);  // spans of 64 frames
  EXPECT_LT(this->Thinned[2].Count(), 45); // and of a turn that components mix well enough
  for (std::size_t i = 5; i < 30; ++i)     // lie from frame 60 + 7 i on
  {
    const int rest = 60 + 7 * static_cast<int>(i);
    int lying = 0;
    for (int key = 0; key < this->Thinned[i].Count(); ++key)
    {
      lying += this->FrameOf(i, key) >= rest ? 1 : 0;
    }
    EXPECT_LE(lying, 2 + static_cast<int>(i % 4)) << "object " << i;
  }
}

TEST_F(KeyThinningTest, WhatCannotBeThinnedSharesTheTimesOfAllFrames)
{
  EXPECT_EQ(this->Thinned[3].Count(), Frames);
  EXPECT_EQ(this->Thinned[4].Count(), Frames);
  EXPECT_EQ(this->Thinned[3].Times.Accessor, this->Thinned[4].Times.Accessor);
  EXPECT_NE(this->Thinned[0].Times.Accessor, this->Thinned[3].Times.Accessor);
  EXPECT_EQ(this->Thinned[42].Count(), Frames); // alone with four fewer, and times of its own
  EXPECT_EQ(this->Thinned[42].Times.Accessor, this->Thinned[3].Times.Accessor);
  EXPECT_LT(this->ThinnedModel.buffers[0].data.size(), this->WholeModel.buffers[0].data.size());
}

TEST_F(KeyThinningTest, WhatComesToLieTogetherSharesTimes)
{
  EXPECT_EQ(this->Thinned[40].Count(), 202);
  EXPECT_EQ(this->Thinned[41].Count(), 202);
  EXPECT_EQ(this->Thinned[40].Times.Accessor, this->Thinned[41].Times.Accessor);
}

TEST_F(KeyThinningTest, TheFileSaysHowManyKeysOfHowManyAndHowFarOff)
{
  int kept = 0;
  for (const Motion& motion : this->Thinned)
  {
    kept += motion.Count();
  }
  const tinygltf::Value& keys = this->ThinnedModel.asset.extras.Get("keys");
  EXPECT_EQ(keys.Get("kept").Get<int>(), kept);
  EXPECT_EQ(keys.Get("of").Get<int>(), Frames * static_cast<int>(this->Whole.size()));
  EXPECT_EQ(keys.Get("frames").Get<int>(), Frames);
  EXPECT_EQ(keys.Get("placeTolerance").Get<double>(), KeyPlaceTolerance);
  EXPECT_EQ(keys.Get("turnTolerance").Get<double>(), KeyTurnTolerance);
  EXPECT_EQ(this->ThinnedModel.asset.extras.Get("framesPerSecond").Get<double>(), Rate);
  EXPECT_FALSE(this->WholeModel.asset.extras.Has("keys"));
}

TEST(KeyThinning, UpToTheGivenNumberAllKeysAreThere)
{
  std::string whole, atMost, beyond;
  const std::size_t poses = Objects().size() * Frames;
  ASSERT_TRUE(GltfAnimation(Shapes(), Objects(), Rate, whole, monitor));
  ASSERT_TRUE(GltfAnimation(Shapes(), Objects(), Rate, atMost, monitor, poses));
  ASSERT_TRUE(GltfAnimation(Shapes(), Objects(), Rate, beyond, monitor, poses - 1));
  EXPECT_TRUE(whole == atMost);
  EXPECT_LT(beyond.size(), whole.size());
}

TEST(KeyThinning, OneFrameIsOneKey)
{
  AnimatedObject object;
  object.Positions.assign(1, Vec3(1.0, 2.0, 3.0));
  object.Orientations.assign(1, Quat::Identity());
  std::string bytes;
  ASSERT_TRUE(GltfAnimation(Shapes(), { object }, Rate, bytes, monitor, 0));
  tinygltf::Model model;
  std::vector<Motion> motions;
  ASSERT_NO_FATAL_FAILURE(ReadBack(bytes, model, motions));
  EXPECT_EQ(motions[0].Count(), 1);
  EXPECT_EQ(motions[0].Place(0), Vec3(1.0, 3.0, -2.0));
}

} // namespace key_thinning
