// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "Trajectory/Alignment.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

constexpr double Pi = 3.14159265358979323846;

std::vector<Vec3> Bent(Random& random, int samples = 6)
{
  std::vector<Vec3> points;
  Vec3 x = Vec3::Zero();
  Vec3 v = random.Direction() * 0.05;
  const Vec3 turn = (v.cross(random.Direction()).normalized() + 0.5 * v.normalized()) *
                    random.Uniform(0.1, 0.6); // a helix that is never straight
  for (int i = 0; i < samples; ++i)
  {
    points.push_back(x);
    x += v;
    v += turn.cross(v);
  }
  return points;
}

Quat Turn(Random& random, double maxTilt)
{
  const double azimuth = random.Uniform(0.0, 2.0 * Pi);
  const Vec3 axis(std::cos(azimuth), std::sin(azimuth), 0.0);
  return Quat(Eigen::AngleAxisd(random.Uniform(0.0, maxTilt), axis)) *
         Quat(Eigen::AngleAxisd(random.Uniform(-Pi, Pi), Vec3::UnitZ()));
}

std::vector<Vec3> Moved(const std::vector<Vec3>& points, const Quat& rotation, const Vec3& shift)
{
  std::vector<Vec3> moved;
  for (const Vec3& point : points)
  {
    moved.push_back(rotation * point + shift);
  }
  return moved;
}

double Squares(const std::vector<Vec3>& tail, const std::vector<Vec3>& head, const Quat& rotation)
{
  Vec3 meanTail = Vec3::Zero();
  Vec3 meanHead = Vec3::Zero();
  for (std::size_t i = 0; i < tail.size(); ++i)
  {
    meanTail += tail[i] / static_cast<double>(tail.size());
    meanHead += head[i] / static_cast<double>(tail.size());
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < tail.size(); ++i)
  {
    sum += (tail[i] - meanTail - rotation * (head[i] - meanHead)).squaredNorm();
  }
  return sum;
}

constexpr RotationFreedom AllFreedoms[] = { RotationFreedom::Yaw, RotationFreedom::YawAndTilt,
                                            RotationFreedom::Any };

double LargestTilt(RotationFreedom freedom)
{
  return freedom == RotationFreedom::Yaw          ? 0.0
         : freedom == RotationFreedom::YawAndTilt ? DefaultMaxTilt
                                                  : Pi;
}

double ResidualOf(const Connection& c, const std::vector<Vec3>& tail, const std::vector<Vec3>& head)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < tail.size(); ++i)
  {
    sum += (tail[i] - c.Rotation * head[i] - c.Translation).squaredNorm();
  }
  return sum;
}

} // namespace

TEST(Alignment, RecoversAnAllowedMotionExactly)
{
  Random random(5);
  for (const RotationFreedom freedom : AllFreedoms)
  {
    const double tilt = LargestTilt(freedom);
    for (int trial = 0; trial < 200; ++trial)
    {
      const std::vector<Vec3> head = Bent(random);
      const Quat rotation = Turn(random, tilt);
      const Vec3 shift = random.Direction() * 2.0;
      const Connection c = AlignWindows(Moved(head, rotation, shift), head, freedom);
      EXPECT_LT(c.Cost, 1e-6) << ToString(freedom);
      EXPECT_LT((c.Translation - shift).norm(), 1e-5);
      EXPECT_LT(c.Rotation.angularDistance(rotation), 1e-4);
      EXPECT_TRUE(c.IsConnectible);
    }
  }
}

TEST(Alignment, NoAllowedRotationIsBetter)
{
  Random random(11);
  for (const RotationFreedom freedom : AllFreedoms)
  {
    const double tilt = LargestTilt(freedom);
    for (int trial = 0; trial < 60; ++trial)
    {
      const std::vector<Vec3> tail = Bent(random);
      const std::vector<Vec3> head = Bent(random);
      const Connection c = AlignWindows(tail, head, freedom);
      const double best = ResidualOf(c, tail, head);
      EXPECT_LE(TiltOf(c.Rotation), tilt + 1e-9);
      double reference = Squares(tail, head, c.Rotation);
      EXPECT_NEAR(best, reference, 1e-12);
      for (int i = 0; i < 3000; ++i)
      {
        reference = std::min(reference, Squares(tail, head, Turn(random, tilt)));
      }
      // Near the optimum itself, too.
      for (int i = 0; i < 300; ++i)
      {
        const Quat q = c.Rotation * Quat(Eigen::AngleAxisd(1e-3, random.Direction()));
        if (TiltOf(q) <= tilt && freedom != RotationFreedom::Yaw)
        {
          reference = std::min(reference, Squares(tail, head, q));
        }
      }
      double extent = 0.0;
      for (const Vec3& x : tail)
      {
        extent += (x - tail[0]).squaredNorm();
      }
      EXPECT_LE(best, reference + 1e-6 * extent) << ToString(freedom) << " trial " << trial;
    }
  }
}

TEST(Alignment, StraightWindowsTakeTheSmallestRotation)
{
  Random random(3);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Vec3 a = random.Direction();
    const Vec3 b = random.Direction();
    std::vector<Vec3> tail;
    std::vector<Vec3> head;
    for (int i = 0; i < 6; ++i)
    {
      // A bend of 0.1 % is noise: it must not turn the window about its line.
      tail.push_back(0.05 * i * a + 5e-5 * random.Direction());
      head.push_back(0.04 * i * b + 5e-5 * random.Direction());
    }
    const Connection c = AlignWindows(tail, head, RotationFreedom::Any);
    const double angle = 2.0 * std::acos(std::min(1.0, c.Rotation.w()));
    EXPECT_NEAR(angle, std::acos(std::clamp(a.dot(b), -1.0, 1.0)), 0.01);
  }
  const std::vector<Vec3> vertical{ Vec3(0, 0, 0), Vec3(1e-4, 0, 0.1), Vec3(0, 1e-4, 0.2) };
  const std::vector<Vec3> other{ Vec3(0, 0, 0), Vec3(0, 1e-4, 0.1), Vec3(-1e-4, 0, 0.2) };
  EXPECT_EQ(AlignWindows(vertical, other, RotationFreedom::Yaw).Rotation.w(), 1.0);
}

TEST(Alignment, CostIsDirectionlessInPlaceAndGrowsWithMisfit)
{
  const std::vector<Vec3> line{ Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0.2, 0, 0) };
  const std::vector<Vec3> half{ Vec3(0, 0, 0), Vec3(0.05, 0, 0), Vec3(0.1, 0, 0) };
  // Centred: +-0.1 against +-0.05, so rms = sqrt(2/3) 0.05 over the mean chord 0.15.
  EXPECT_NEAR(AlignWindows(line, half, RotationFreedom::YawAndTilt).Cost,
              std::sqrt(2.0 / 3.0) * 0.05 / 0.15, 1e-9);
  EXPECT_FALSE(AlignWindows(line, { Vec3::Zero() }, RotationFreedom::Any).IsConnectible);
}

TEST(Alignment, WindowsAtRestAreNotTurned)
{
  const std::vector<Vec3> still(6, Vec3(1, 2, 3));
  Random random(8);
  for (const RotationFreedom freedom : AllFreedoms)
  {
    const Connection c = AlignWindows(still, std::vector<Vec3>(6, Vec3::Zero()), freedom);
    EXPECT_EQ(c.Rotation.w(), 1.0) << ToString(freedom);
    EXPECT_EQ(c.Translation, Vec3(1, 2, 3));
    EXPECT_TRUE(std::isfinite(AlignWindows(still, Bent(random), freedom).Cost));
  }
}
