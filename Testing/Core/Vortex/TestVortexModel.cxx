// SPDX-License-Identifier: BSD-3-Clause
// What a fit stands on: the model and its costs, and the samples it is given.
#include "TrueVortex.h"

#include "Vortex/VortexCosts.h"
#include "Vortex/VortexSamples.h"

#include <ceres/gradient_checker.h>
#include <ceres/sphere_manifold.h>
#include <gtest/gtest.h>

using namespace waft;
using test::Truth;

TEST(VortexCosts, GradientsPassCeresChecker)
{
  ceres::SphereManifold<3> sphere;
  const std::vector<const ceres::Manifold*> manifolds{ nullptr, &sphere, nullptr, nullptr };
  ceres::NumericDiffOptions numeric;
  numeric.ridders_relative_initial_step_size = 1e-3;
  Random random(6);
  for (int n = 0; n < 40; ++n)
  {
    VortexParameters p = ToParameters(Truth(n));
    Vec3 background = random.Direction();
    double* blocks[] = { p.Center.data(), p.Direction.data(), p.Shape.data(), background.data() };
    const SampleCost cost(random.InBox({ Vec3(-1.5, -1.5, 0.5), Vec3(1.5, 1.5, 3.5) }),
                          random.Uniform(2.0, 7.0), random.Direction(), 1.7);
    ceres::GradientChecker checker(&cost, &manifolds, numeric);
    ceres::GradientChecker::ProbeResults results;
    EXPECT_TRUE(checker.Probe(blocks, 1e-6, &results)) << results.error_log;
    VortexBelief belief;
    belief.Mean = ToParameters(Truth(n + 100));
    belief.CenterPrecision = 2.0;
    belief.DirectionPrecision = 3.0;
    belief.ShapePrecision << 1.0, 2.0, 3.0, 4.0, 5.0;
    belief.BackgroundPrecision = 0.5;
    const BeliefCost prior(belief);
    ceres::GradientChecker priorChecker(&prior, &manifolds, numeric);
    EXPECT_TRUE(priorChecker.Probe(blocks, 1e-6, &results)) << results.error_log;
  }
}

TEST(VortexModel, IsTheFieldOfBase)
{
  Random random(2);
  for (int n = 0; n < 50; ++n)
  {
    const Vortex v = Truth(n);
    const VortexParameters p = ToParameters(v);
    Vortex back;
    FromParameters(p, back);
    const Vec3 x = random.InBox({ Vec3(-2, -2, 0), Vec3(2, 2, 4) });
    const double t = random.Uniform(0.0, 10.0);
    const Vec3 field =
      EvaluateVortex(p.Center.data(), p.Direction.data(), p.Shape.data(), x, t, nullptr);
    EXPECT_LT((field - v.Acceleration(x, t)).norm(), 1e-12);
    EXPECT_LT((back.Acceleration(x, t) - v.Acceleration(x, t)).norm(), 1e-12);
  }
}

TEST(VortexSamples, AreForcesLessWindWithTheirAnnotation)
{
  Track track;
  track.ObjectId = 8;
  track.Positions = { Vec3(0, 0, 1), Vec3(0, 0.1, 1), Vec3(0, 0.2, 1) };
  track.Forces = { Vec3(1, 2, 3), Vec3::Zero(), Vec3(4, 5, 6) };
  track.WindAccelerations = { Vec3(0.5, 0, 0), Vec3::Zero(), Vec3(0, 0.5, 0) };
  track.ForceTypes = { ForceType::Vortex, ForceType::None, ForceType::Wind };
  track.VortexIds = { 3, -1, 3 };
  const Timeline time{ 3, 10.0 };
  std::vector<VortexSample> samples;
  ASSERT_TRUE(static_cast<bool>(SamplesFromTracks({ track }, time, true, samples)));
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[0].Acceleration, Vec3(0.5, 2, 3));
  EXPECT_EQ(samples[0].VortexId, 3);
  EXPECT_EQ(samples[1].Weight, 0.0);
  EXPECT_EQ(samples[2].VortexId, -1);
  EXPECT_EQ(samples[2].Time, 0.2);
  ASSERT_TRUE(static_cast<bool>(SamplesFromTracks({ track }, time, false, samples)));
  EXPECT_EQ(samples[0].Acceleration, Vec3(1, 2, 3));
  const Vortex v = Truth(1);
  EXPECT_EQ(VortexForces(track, { v, v }, time)[1], 2.0 * v.Acceleration(Vec3(0, 0.1, 1), 0.1));
  track.Forces.clear();
  const Result result = SamplesFromTracks({ track }, time, false, samples);
  EXPECT_NE(result.Message().find("object 8 has no point data `Force`"), std::string::npos);
}

TEST(VortexSamples, OfTheAirAreTheRateAtWhichItChangesAlongThePath)
{
  std::vector<Track> tracks(1);
  tracks[0].ObjectId = 4;
  const Timeline time{ 4, 10.0 };
  for (int k = 0; k < 4; ++k)
  {
    tracks[0].Positions.emplace_back(0.1 * k, 0.0, 1.0);
    tracks[0].AirVelocities.emplace_back(0.3 * k, 0.02 * k * k, 1.0);
  }
  tracks[0].WindAccelerations.assign(4, Vec3::UnitX());
  ASSERT_TRUE(static_cast<bool>(TakeAirAccelerations(time, tracks)));
  std::vector<VortexSample> samples;
  ASSERT_TRUE(static_cast<bool>(SamplesFromTracks(tracks, time, true, samples)));
  EXPECT_LT((samples[0].Acceleration - Vec3(3.0, 0.2, 0.0)).norm(), 1e-12);
  EXPECT_LT((samples[2].Acceleration - Vec3(3.0, 0.8, 0.0)).norm(), 1e-12);
  EXPECT_LT((samples[3].Acceleration - Vec3(3.0, 1.0, 0.0)).norm(), 1e-12);
  tracks[0].AirVelocities.clear();
  EXPECT_NE(
    TakeAirAccelerations(time, tracks).Message().find("object 4 has no point data `AirVelocity`"),
    std::string::npos);
}
