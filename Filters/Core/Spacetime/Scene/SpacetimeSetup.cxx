// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Scene/SpacetimeSetup.h"

#include "Base/BodyLaw.h"
#include "Constraints/Rest.h"
#include "Particles/GasLattice.h"
#include "Particles/SphSurfaces.h"
#include "Spacetime/Fields/VortexSelection.h"
#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Scene/ConstraintSetup.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace waft
{
namespace
{

constexpr double ParticleRing = 0.3;            // radius of an object's particles [dx]
constexpr double LatticeSpacing = 0.4;          // of the obstacles' distances [dx]
constexpr double LargestContact = 0.5;          // [dx], where the gas alone is the air
constexpr double ContactSlack = 1.05;           // a penalty gives way a little before it holds
constexpr double FastestDrag = 0.45;            // [1 / frame]
constexpr double ObjectMassFraction = 0.1;      // of a gas particle's mass, at most
constexpr double AllObjectsMassFraction = 0.02; // of all gas, at most
constexpr double ControlTime = 1.0 / 15.0;      // s: what changes faster is a jerk

// Objects in the order of the tracks.
Result MatchObjects(const SpacetimeInput& input, SpacetimeSetup& setup)
{
  std::map<int, const MotionObject*> byId;
  for (const MotionObject& object : input.Objects)
  {
    byId[object.ObjectId] = &object;
  }
  std::map<int, bool> used;
  for (const Track& track : input.Tracks)
  {
    if (byId.find(track.ObjectId) == byId.end() || used[track.ObjectId])
    {
      return Result::Error("Tracks: object " + std::to_string(track.ObjectId) +
                           " is not in Objects, or has two tracks");
    }
    used[track.ObjectId] = true;
    setup.Objects.push_back(*byId[track.ObjectId]);
  }
  for (const Constraint& row : input.Constraints)
  {
    if (row.ObjectId >= 0 && !used[row.ObjectId])
    {
      return Result::Error("Constraints, row " + std::to_string(row.Row) + ": object " +
                           std::to_string(row.ObjectId) + " has no track");
    }
  }
  return Result::Ok();
}

// A slab below the whole volume is not an obstacle in the gas but its floor.
bool IsGround(const ObstacleMesh& obstacle, const Box& volume, double& top)
{
  if (obstacle.IsMoving() || obstacle.Mesh.Points.empty())
  {
    return false;
  }
  const auto [low, high] = BoxAbout(obstacle.Mesh.Points);
  const double slack = 1e-9 * volume.Width();
  for (const Vec3& p : obstacle.Mesh.Points)
  {
    if (std::min(p.z() - low.z(), high.z() - p.z()) > slack)
    {
      return false;
    }
  }
  top = high.z();
  return low.x() <= volume.Min.x() + slack && low.y() <= volume.Min.y() + slack &&
         high.x() >= volume.Max.x() - slack && high.y() >= volume.Max.y() - slack &&
         low.z() <= volume.Min.z() + slack && top < volume.Max.z();
}

// The lattice's sites that obstacles leave free; sets the model's Rest.
std::vector<Vec3> FillWithGas(const GasLattice& lattice, SpacetimeModel& model)
{
  SphVolume volume(model.Size);
  // Where obstacles move no gas is at rest beside them; the walls' weakening is right all the same.
  volume.Obstacles = model.Obstacles.IsMoving() ? nullptr : &model.Obstacles;
  std::vector<Vec3> gas;
  std::vector<char> isThere;
  std::vector<double> surfaces;
  for (const Vec3& point : lattice.Points())
  {
    const bool isFree =
      model.Obstacles.IsEmpty() || model.Obstacles.Distance(point, 0) > SpringReach;
    if (isFree)
    {
      gas.push_back(point);
    }
    isThere.push_back(isFree || model.Obstacles.IsMoving() ? 1 : 0);
    surfaces.push_back(SurfaceDensity(model.Fluid, volume, point).Value);
  }
  model.Rest.Build(lattice, model.Fluid, isThere, surfaces);
  return gas;
}

Result SetUpVolume(const SpacetimeInput& input, const SpacetimeOptions& options,
                   SpacetimeSetup& setup, std::vector<int>& grounds)
{
  Box box = input.Scene.Bounds;
  if (!((box.Size().array() > 0.0).all() && box.Size().allFinite()))
  {
    return Result::Error("Bounds: a volume with a positive size expected");
  }
  std::vector<ObstacleMesh> inside;
  for (const ObstacleMesh& obstacle : input.Obstacles)
  {
    double top = 0.0;
    if (IsGround(obstacle, box, top))
    {
      box.Min.z() = std::max(box.Min.z(), top);
      grounds.push_back(obstacle.ObstacleId);
    }
    else
    {
      inside.push_back(obstacle);
    }
  }
  if (Result result = setup.Obstacles.Build(input.Obstacles); !result)
  {
    return result;
  }
  const GasLattice lattice = GasLattice::Make(box, options.NumberOfGasParticles);
  WAFT_RETURN_IF_FAILED(lattice.CheckLayers());
  setup.Origin = box.Min;
  setup.Spacing = lattice.Spacing;
  setup.FrameStep = input.Scene.Time.Step();
  SpacetimeModel& model = setup.Model;
  model.Size = lattice.SizeInSpacings();
  model.NumberOfFrames = input.Scene.Time.NumberOfFrames;
  // The nodes depend on the volume alone, so that the lattice is known before anything is computed.
  model.WindNodes = WindLatticeOf(input.Scene.Bounds.Size(), options.WindCells);
  model.FieldRidge = options.FieldRidge;
  const double support = 2.0 * options.SmoothingLength;
  if (Result result =
        model.Obstacles.Build(inside, box, LatticeSpacing * setup.Spacing, setup.Spacing,
                              (support + 1.0) * setup.Spacing, model.NumberOfFrames);
      !result)
  {
    return result;
  }

  model.Fluid.SmoothingLength = options.SmoothingLength;
  model.Fluid.SoundSpeed = options.CourantNumber * options.SmoothingLength;
  model.Fluid.Viscosity = options.Viscosity;
  model.Fluid.Gamma = options.PressureExponent;
  // Objects feel the air by drag with their own settling speed, not by the gas' viscosity.
  model.Fluid.ObjectViscosity = 0.0;
  model.Fluid.GasMass = lattice.ParticleMass(model.Fluid);

  const std::vector<Vec3> gas = FillWithGas(lattice, model);
  model.NumberOfGas = gas.size();
  model.NumberOfObjects = input.Tracks.size();
  if (gas.size() < 27)
  {
    return Result::Error("Obstacles: they leave no room for the gas");
  }
  const int per =
    std::clamp(options.NumberOfObjectParticles / static_cast<int>(model.NumberOfObjects), 1, 5);
  for (int k = 0; k < per; ++k)
  {
    const double angle = 2.0 * M_PI * k / per;
    const double radius = per > 1 ? ParticleRing : 0.0;
    model.Offsets.push_back({ static_cast<float>(radius * std::cos(angle)),
                              static_cast<float>(radius * std::sin(angle)), 0.0f });
  }
  const double particles =
    static_cast<double>(static_cast<std::size_t>(per) * model.NumberOfObjects);
  model.Fluid.ObjectMass =
    model.Fluid.GasMass *
    std::min(ObjectMassFraction,
             AllObjectsMassFraction * static_cast<double>(gas.size()) / particles);

  setup.Start.assign(model.NumberOfFrames * model.FrameSize(), 0.0f);
  for (int frame = 0; frame < model.NumberOfFrames; ++frame)
  {
    float* state = setup.Start.data() + frame * model.FrameSize();
    for (int c = 0; c < 3; ++c)
    {
      for (std::size_t i = 0; i < gas.size(); ++i)
      {
        state[c * model.Stride() + i] = static_cast<float>(gas[i][c]);
      }
    }
  }
  return model.Fluid.Validate();
}

void SetUpObjects(const SpacetimeInput& input, const SpacetimeOptions& options,
                  SpacetimeSetup& setup)
{
  SpacetimeModel& model = setup.Model;
  const std::size_t no = model.NumberOfObjects;
  const double gravity = options.EffectiveGravity;
  double radii = 0.0;
  for (const MotionObject& object : setup.Objects)
  {
    // In still air drag and effective gravity balance at the settling speed. Both are weakened
    // alike for what would come to that speed in less than two frames: the step could not follow.
    const BodyLaw law = LawOf(object);
    const double rate = law.ResponseRate(setup.FrameStep * gravity);
    const double weakening = std::min(1.0, FastestDrag / rate);
    model.DragRates.push_back(static_cast<float>(weakening * rate));
    model.Gravities.push_back(static_cast<float>(weakening * gravity / setup.AccelerationUnit()));
    model.Clearances.emplace_back(static_cast<float>(object.ClearanceRadius / setup.Spacing),
                                  static_cast<float>(object.RestHeight / setup.Spacing));
    model.BrakeHeights.push_back(
      static_cast<float>(0.5 * CushionTime * law.SettlingSpeed() / setup.Spacing));
    radii += object.ClearanceRadius / setup.Spacing / static_cast<double>(no);
  }
  const double widest = ContactSlack * 2.0 * radii;
  model.Weights.ContactDistance = options.ContactDistance >= 0.0
                                    ? options.ContactDistance / setup.Spacing
                                  : input.Air.IsEmpty() ? std::min(LargestContact, widest)
                                                        : widest;
  model.Flags.assign(static_cast<std::size_t>(model.NumberOfFrames) * no, 0);
  setup.Table.FixedPositions.assign(model.Flags.size(), Vec3::Zero());
  setup.Table.Planned.resize(model.Flags.size());
  model.Reach.assign(model.Flags.size(), 0.0f);
  model.CoherenceFractions.assign(model.Flags.size(), 1.0f);
  setup.ExactPositions.assign(model.Flags.size(), Vec3::Zero());
  for (std::size_t o = 0; o < no; ++o)
  {
    const std::vector<Vec3>& x = input.Tracks[o].Positions;
    for (int frame = 0; frame < model.NumberOfFrames; ++frame)
    {
      setup.Table.Planned[static_cast<std::size_t>(frame) * no + o] = setup.FromWorld(x[frame]);
      float* state = setup.Start.data() + frame * model.FrameSize() + model.NumberOfGas + o;
      const int k = std::max(1, frame);
      for (int c = 0; c < 3; ++c)
      {
        state[c * model.Stride()] = static_cast<float>(setup.FromWorld(x[frame])[c]);
        state[(3 + c) * model.Stride()] =
          static_cast<float>((x[k][c] - x[k - 1][c]) / setup.Spacing);
      }
    }
  }
  model.Approach = setup.Table.Planned;
}

// In a sampled air objects go with it: no drag is too fast, nothing else moves or slows them, and
// they begin and land as they came here.
void SetUpAir(const SpacetimeInput& input, const SpacetimeOptions& options, SpacetimeSetup& setup)
{
  if (input.Air.IsEmpty())
  {
    return;
  }
  SpacetimeModel& model = setup.Model;
  const std::size_t no = model.NumberOfObjects;
  const auto air = [&](const Vec3& x, int frame)
  { return input.Air.Sample(x, frame * setup.FrameStep); };
  std::vector<BodyLaw> laws;
  std::vector<GroundEffect> ground;
  for (std::size_t o = 0; o < no; ++o)
  {
    const MotionObject& object = setup.Objects[o];
    laws.push_back(LawOf(object).In(setup.Spacing, setup.FrameStep));
    ground.emplace_back(setup.Obstacles, setup.Landings[o], object,
                        input.Scene.Time.FramesPerSecond, air);
  }
  model.Air = GivenAir(input.Air, setup.Origin, setup.Spacing, setup.FrameStep, model.NumberOfGas,
                       std::move(laws), std::move(ground));
  std::vector<std::vector<Vec3>> slips;
  for (const Track& track : input.Tracks)
  {
    slips.push_back(track.Slips);
  }
  model.Air.SetSlips(slips);
  model.AirDrag = static_cast<float>(options.AirDrag * setup.FrameStep);
  // Half the second difference of a control that changes within this time costs as much as it.
  model.Weights.Control = 4.0 * std::pow(ControlTime / setup.FrameStep, 4);
  model.DragRates.assign(no, 1.0f);
  model.Gravities.assign(no, 0.0f);
  model.BrakeHeights.assign(no, 0.0f);
  model.Reach.assign(model.Flags.size(), 0.0f);
  model.CoherenceFractions.assign(model.Flags.size(), 0.0f);
}

void SetUpBackground(const SpacetimeInput& input, const SpacetimeOptions& options,
                     SpacetimeSetup& setup)
{
  const FieldSeries& given = input.Wind;
  if (given.IsEmpty() || !input.Air.IsEmpty()) // a sampled air contains it
  {
    return;
  }
  constexpr int LongestKnot = 5; // frames
  SpacetimeModel& model = setup.Model;
  SplineWind& wind = model.Background;
  const bool velocity = given.Meaning == FieldMeaning::Velocity;
  wind.Drag = velocity ? options.WindDrag * setup.FrameStep : 0.0;
  wind.Origin = Vec3::Constant(-1.0);
  for (int a = 0; a < 3; ++a)
  {
    wind.Dimensions[a] = static_cast<int>(std::ceil(model.Size[a])) + 3;
  }
  const double unit = velocity ? setup.Spacing / setup.FrameStep : setup.AccelerationUnit();
  const bool steady = given.Times.size() == 1;
  wind.FramesPerKnot = LongestKnot;
  const int knots = steady ? 1 : (model.NumberOfFrames - 1) / LongestKnot + 2;
  for (int knot = 0; knot < knots; ++knot)
  {
    std::vector<float> values;
    const double time = knot * wind.FramesPerKnot * setup.FrameStep;
    for (int k = 0; k < wind.Dimensions[2]; ++k)
    {
      for (int j = 0; j < wind.Dimensions[1]; ++j)
      {
        for (int i = 0; i < wind.Dimensions[0]; ++i)
        {
          const Vec3 value = given.Sample(setup.ToWorld(wind.Origin + Vec3(i, j, k)), time) / unit;
          for (int c = 0; c < 3; ++c)
          {
            values.push_back(static_cast<float>(value[c]));
          }
          values.push_back(0.0f);
        }
      }
    }
    wind.Knots.push_back(std::move(values));
  }
}

} // namespace

Result MakeSetup(const SpacetimeInput& input, const SpacetimeOptions& options,
                 SpacetimeSetup& setup)
{
  setup = SpacetimeSetup();
  std::vector<int> grounds;
  for (const Result& result :
       { options.Validate(), CheckTracks(input, LeastSpacetimeFrames), MatchObjects(input, setup) })
  {
    if (!result)
    {
      return result;
    }
  }
  if (Result result = SetUpVolume(input, options, setup, grounds); !result)
  {
    return result;
  }
  static_cast<TermWeights&>(setup.Model.Weights) = options;
  SetUpObjects(input, options, setup);
  SetUpConstraints(input, grounds, setup);
  SetUpAir(input, options, setup);
  SetUpBackground(input, options, setup);
  for (const Vortex& vortex : input.Vortices)
  {
    const Vortex v = ToModel(setup, vortex);
    const bool finite = v.P1.allFinite() && v.P2.allFinite() && std::isfinite(v.Strength) &&
                        std::isfinite(v.CenterTime) && v.Duration > 0.0 && v.CoreRadius > 0.0;
    if (!finite || (v.P1 - v.P2).norm() <= 0.0)
    {
      return Result::Error("Vortices, VortexId " + std::to_string(vortex.VortexId) +
                           ": finite numbers, two different poles, positive Duration and "
                           "CoreRadius expected");
    }
  }
  for (const Vortex& vortex :
       SelectVortices(input.Vortices, input.Tracks, input.Scene, options.MaximumNumberOfVortices))
  {
    setup.Model.Fields.Vortices.push_back(ToModel(setup, vortex));
  }
  return Result::Ok();
}

} // namespace waft
