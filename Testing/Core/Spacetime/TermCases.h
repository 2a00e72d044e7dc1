// SPDX-License-Identifier: BSD-3-Clause
// A small problem in which one term of E is alone, for each of them.
#pragma once

#include "Base/Random.h"
#include "ReferenceObjective.h"
#include "Spacetime/Scene/SpacetimeSetup.h"
#include "SpacetimeScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace waft
{
namespace test
{

inline FieldSeries Draught()
{
  FieldSeries wind;
  wind.Meaning = FieldMeaning::Velocity;
  wind.Dimensions = { 2, 2, 2 };
  wind.Origin = Vec3(-2.0, -2.0, 0.0);
  wind.Spacing = Vec3::Constant(4.0);
  wind.Times = { 0.0 };
  wind.Values.emplace_back();
  for (int k = 0; k < 8; ++k)
  {
    wind.Values[0].push_back({ 0.3f * (k & 1), 0.5f, k & 4 ? 0.4f : -0.2f });
  }
  return wind;
}

/// Landing objects, a pillar, a draught: everything that acts, to be taken away but for one thing.
struct Problem
{
  Problem()
  {
    SceneOptions scene;
    scene.NumberOfFrames = 9;
    scene.Land = true;
    SpacetimeInput input = MakeScene(scene);
    AddPillar(input);
    input.Wind = Draught();
    SpacetimeOptions options;
    options.NumberOfGasParticles = 125;
    options.NumberOfObjectParticles = 12;
    const Result result = MakeSetup(input, options, this->Setup);
    EXPECT_TRUE(result) << result.Message();
    this->Full = this->Setup.Model;
  }

  /// Nothing acts and nothing counts.
  SpacetimeModel& Empty()
  {
    SpacetimeModel& model = this->Setup.Model;
    model = this->Full;
    SpacetimeWeights& w = model.Weights;
    w.PositionWeight = w.VelocityWeight = w.CoherenceWeight = w.XsphFactor = 0.0;
    w.ObjectPosition = w.ObjectCoherence = 1.0;
    w.Clearance = w.Reach = w.Contact = w.ContactDistance = w.Separation = 0.0;
    model.Fluid.SoundSpeed = model.Fluid.Viscosity = 0.0;
    model.Fields.Vortices.clear();
    model.Background = SplineWind();
    model.Obstacles = ObstacleField();
    std::fill(model.DragRates.begin(), model.DragRates.end(), 0.0f);
    std::fill(model.Gravities.begin(), model.Gravities.end(), 0.0f);
    std::fill(model.Flags.begin(), model.Flags.end(), std::uint8_t(0));
    std::fill(model.Reach.begin(), model.Reach.end(), 0.0f);
    model.Kept = KeptDistances(30.0);
    model.CoherenceFractions.clear();
    return model;
  }

  /// Gas off its lattice, some of it close together, all drifting; exact in float.
  std::vector<double> Disturbed(const ReferenceObjective& reference) const
  {
    const SpacetimeModel& model = this->Setup.Model;
    const TimeLevel level = this->Level();
    StateVector state;
    for (const int frame : level.Frames)
    {
      const auto begin = this->Setup.Start.begin() + frame * model.FrameSize();
      state.insert(state.end(), begin, begin + model.FrameSize());
    }
    // Velocities hardly change in time, so that what acts makes up the steps' rows.
    std::vector<float> steady(3 * model.Stride());
    Random random(5);
    for (float& value : steady)
    {
      value = static_cast<float>(0.08 * random.Normal());
    }
    for (std::size_t j = 0; j < level.NumberOfFrames(); ++j)
    {
      float* x = state.data() + j * model.FrameSize();
      float* v = x + 3 * model.Stride();
      for (std::size_t k = 0; k < steady.size(); ++k)
      {
        x[k] += static_cast<float>(0.08 * random.Normal());
        v[k] = steady[k] + static_cast<float>(0.001 * random.Normal());
      }
      // Beside an edge of the pillar, where distances are curved.
      for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
      {
        const Vec3 edge = this->Setup.FromWorld(Vec3(0.5, 0.3, 1.5));
        const double away = 0.3 + 0.3 * static_cast<double>(o) + 0.05 * random.Normal();
        for (int c = 0; c < 3; ++c)
        {
          x[c * model.Stride() + model.NumberOfGas + o] =
            static_cast<float>(edge[c] + (c < 2 ? away : 0.0));
        }
      }
      for (std::size_t i = 1; i < model.NumberOfGas; i += 10)
      {
        for (int c = 0; c < 3; ++c)
        {
          float* row = x + c * model.Stride();
          row[i] = row[i - 1] + 0.08f + 0.01f * static_cast<float>(c);
        }
      }
    }
    return reference.From(state);
  }
  TimeLevel Level() const
  {
    return TimeLevel::Make({ 0, 1, 2, 4, 6, 7, 8 }, this->Setup.Model.Weights.TemporalWindow);
  }

  SpacetimeSetup Setup;
  SpacetimeModel Full;
};

struct Term
{
  const char* Name;
  std::function<void(SpacetimeModel&, const Problem&)> Add; // to an empty model
};

inline void AddWind(SpacetimeModel& model)
{
  model.Fields.Wind.Dimensions = { 4, 4, 5 };
  model.Fields.Wind.Origin = Vec3::Constant(-1.0);
  model.Fields.Wind.Spacing = (model.Size + Vec3::Constant(2.0)).cwiseQuotient(Vec3(3.0, 3.0, 4.0));
  model.Fields.Wind.FramesPerKnot = 4.0;
  Random random(8);
  for (int knot = 0; knot < 3; ++knot)
  {
    model.Fields.Wind.Knots.emplace_back();
    for (int k = 0; k < 4 * 80; ++k)
    {
      model.Fields.Wind.Knots.back().push_back(
        k % 4 == 3 ? 0.0f : static_cast<float>(0.02 * random.Normal()));
    }
  }
}

inline void AddFluid(SpacetimeModel& model, const Problem& problem)
{
  model.Fluid = problem.Full.Fluid;
  model.Weights.VelocityWeight = 1.0;
}

/// Of objects that settle as fast as ever, with next to no drag of their own.
inline void AddLandingDamping(SpacetimeModel& model, const Problem& problem, std::uint8_t flag)
{
  model.Weights.VelocityWeight = 1.0;
  model.Flags.assign(model.Flags.size(), flag);
  model.BrakeHeights.assign(model.BrakeHeights.size(), 3.0f);
  for (std::size_t o = 0; o < model.NumberOfObjects; ++o)
  {
    model.DragRates[o] = 1e-4f * problem.Full.DragRates[o];
    model.Gravities[o] = 1e-4f * problem.Full.Gravities[o];
  }
}

inline const std::vector<Term>& Terms()
{
  using Model = SpacetimeModel;
  static const std::vector<Term> terms = {
    { "position",
      [](Model& m, const Problem&)
      {
        m.Weights.PositionWeight = 10.0;
        m.Weights.ObjectPosition = 4.0;
        m.Weights.XsphFactor = 0.3;
      } },
    { "gas", [](Model& m, const Problem& p) { AddFluid(m, p); } },
    { "stiff gas",
      [](Model& m, const Problem& p)
      {
        AddFluid(m, p);
        m.Fluid.Gamma = 7.0;
      } },
    { "obstacle in the gas",
      [](Model& m, const Problem& p)
      {
        AddFluid(m, p);
        m.Obstacles = p.Full.Obstacles;
      } },
    { "vortex",
      [](Model& m, const Problem& p)
      {
        m.Weights.VelocityWeight = 1.0;
        m.Fields.Vortices = p.Full.Fields.Vortices;
      } },
    { "drag",
      [](Model& m, const Problem& p)
      {
        m.Weights.VelocityWeight = 1.0;
        m.DragRates = p.Full.DragRates;
        m.Gravities = p.Full.Gravities;
      } },
    { "landing damping above the floor",
      [](Model& m, const Problem& p) { AddLandingDamping(m, p, LandsOnFloor); } },
    { "landing damping above an obstacle",
      [](Model& m, const Problem& p)
      {
        m.Obstacles = p.Full.Obstacles;
        AddLandingDamping(m, p, LandsOnObstacle);
      } },
    { "estimated wind",
      [](Model& m, const Problem&)
      {
        m.Weights.VelocityWeight = 1.0;
        AddWind(m);
      } },
    { "background that accelerates",
      [](Model& m, const Problem&)
      {
        m.Weights.VelocityWeight = 1.0;
        AddWind(m);
        std::swap(m.Fields.Wind, m.Background);
      } },
    { "background that draws",
      [](Model& m, const Problem& p)
      {
        m.Weights.VelocityWeight = 1.0;
        m.Background = p.Full.Background;
      } },
    { "coherence with the air",
      [](Model& m, const Problem& p)
      {
        m.Weights.CoherenceWeight = 0.5;
        m.Weights.SpatialShare = 1.0;
        m.Weights.ObjectCoherence = 3.0;
        m.DragRates = p.Full.DragRates;
        m.Gravities = p.Full.Gravities;
        for (std::size_t place = 0; place < m.Flags.size(); ++place)
        {
          m.CoherenceFractions.push_back(0.25f * static_cast<float>(place % 5));
        }
      } },
    { "coherence in time",
      [](Model& m, const Problem&)
      {
        m.Weights.CoherenceWeight = 0.5;
        m.Weights.SpatialShare = 0.0;
      } },
    { "coherence in time, a wide window",
      [](Model& m, const Problem&)
      {
        m.Weights.CoherenceWeight = 0.5;
        m.Weights.SpatialShare = 0.0;
        m.Weights.TemporalWindow = 3;
      } },
    { "clearance from walls",
      [](Model& m, const Problem&)
      {
        m.Weights.Clearance = 10.0;
        for (ClearanceRule& rule : m.Clearances)
        {
          rule.Radius = 2.2f;
        }
      } },
    { "clearance from an obstacle",
      [](Model& m, const Problem& p)
      {
        m.Weights.Clearance = 10.0;
        m.Obstacles = p.Full.Obstacles;
        for (ClearanceRule& rule : m.Clearances)
        {
          rule.Radius = 1.2f;
        }
      } },
    { "approach",
      [](Model& m, const Problem&)
      {
        m.Weights.Reach = 3.0;
        m.Approach.assign(m.Flags.size(), 0.5 * m.Size);
        m.Reach.assign(m.Flags.size(), 0.3f);
      } },
    { "contact",
      [](Model& m, const Problem&)
      {
        m.Weights.Contact = 5.0;
        m.Weights.ContactDistance = 2.5;
      } },
    { "contact near marks",
      [](Model& m, const Problem&)
      {
        m.Weights.Contact = 5.0;
        m.Weights.ContactDistance = 2.5;
        m.Kept = KeptDistances(30.0);
        for (std::size_t o = 0; o < m.NumberOfObjects; ++o)
        {
          m.Flags[o] |= FixedPosition;
          m.Kept.AddBody(1.25, 100.0, m.NumberOfFrames,
                         { { 0, 0.5 * m.Size + 1.5 * o * Vec3::UnitX(), 0.0 } });
        }
      } },
    { "separation",
      [](Model& m, const Problem&)
      {
        m.Weights.Separation = 0.1;
        m.Weights.GasDistance = 0.32;
      } },
    { "all of them",
      [](Model& m, const Problem& p)
      {
        m = p.Full;
        m.Weights.VelocityWeight = 1.0;
        m.Weights.XsphFactor = 0.2;
        m.Weights.TemporalWindow = 2;
        m.Weights.ContactDistance = 2.5;
        AddWind(m);
      } },
  };
  return terms;
}

} // namespace test
} // namespace waft
