// SPDX-License-Identifier: BSD-3-Clause
// What describes a run of the smoke solver, and what a run gives.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/ForceFields.h"
#include "Base/PointLattice.h"
#include "Base/Result.h"
#include "Base/SceneFrame.h"
#include "Base/Types.h"

#include <array>
#include <type_traits>
#include <vector>

namespace waft
{

enum class AdvectionScheme
{
  Linear,        // semi-Lagrangian, trilinear: first order
  MonotoneCubic, // semi-Lagrangian, tricubic with limited slopes (Fedkiw et al. 2001, Appendix B)
  MacCormack     // Selle et al. 2008, limited to the values around the foot point
};

/// What the two ends of an axis are.
enum class BoundaryKind
{
  Closed,  // walls that the air slides along
  Open,    // still air of zero pressure outside, or a breeze
  Periodic // the two ends are the same plane
};

/// Where and when air is simulated.
struct AirRun
{
  Box Bounds;
  double FramesPerSecond = 30.0;
  double WarmUpSeconds = 3.0;

  /// The fields, and the rules between them: the volume has an extent, a warm-up no more frames
  /// than a scene may have.
  Result ValidateRun() const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(BoundsField(), of.Bounds...);
    visit(FramesPerSecondField(), of.FramesPerSecond...);
    visit(
      OptionField{
        "WarmUpSeconds", limits::UpTo(1e6), "s",
        "The air starts at rest and is driven for this long before frame 0, in seconds." },
      of.WarmUpSeconds...);
  }
};

struct SmokeOptions : AirRun
{
  std::array<int, 3> Resolution{ 64, 64, 64 };
  AdvectionScheme Advection = AdvectionScheme::MonotoneCubic;
  std::array<BoundaryKind, 3> Boundary{ BoundaryKind::Open, BoundaryKind::Open,
                                        BoundaryKind::Open };
  bool ClosedFloor = true;

  double Confinement = 0.5; // Fedkiw et al. 2001, Eq. 11
  /// Buoyancy: acceleration along z is BuoyancyTemperature * T - BuoyancyDensity * rho (Fedkiw et
  /// al. 2001, Eq. 8) with T above the ambient [K] and rho the smoke's density [1].
  double BuoyancyTemperature = 0.033;
  double BuoyancyDensity = 0.0;
  double Dissipation = 0.0; // of warmth, too
  double WindDrag = 1.0;

  double CourantNumber = 2.0;
  int MaximumSubsteps = 16;
  double Tolerance = 1e-4;
  int MaximumIterations = 200;
  double AirDensity = 1.2;
  /// m/s: the air outside of open ends, and at first that inside, along axes that are open at both.
  Vec3 Breeze = Vec3::Zero();
  /// Vortices and winds are left out at times at which they have less of their peak.
  double NegligibleForce = 1e-5;

  Result Validate() const;

  /// What a user sets.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    AirRun::Visit(visit, of...);
    visit(OptionField{ "Resolution", { 4, 1024 }, "", "Voxels along each axis." },
          of.Resolution...);
    visit(OptionField{ "Advection", { 0, 2 }, "", "How the air carries itself and the smoke." },
          of.Advection...);
    visit(
      OptionField{
        "BoundaryX",
        { 0, 2 },
        "",
        "What the two ends along x are: walls, still air of zero pressure, or the same place." },
      BoundaryAlong<0>(of)...);
    visit(
      OptionField{
        "BoundaryY",
        { 0, 2 },
        "",
        "What the two ends along y are: walls, still air of zero pressure, or the same place." },
      BoundaryAlong<1>(of)...);
    visit(
      OptionField{
        "BoundaryZ",
        { 0, 2 },
        "",
        "What the two ends along z are: walls, still air of zero pressure, or the same place." },
      BoundaryAlong<2>(of)...);
    visit(FlagField("ClosedFloor", "With Boundary Z open: the floor is a wall all the same."),
          of.ClosedFloor...);
    visit(OptionField{ "Breeze", limits::Velocity, "m/s",
                       "Mean flow through open ends, in metres per second: the air outside moves "
                       "like that." },
          of.Breeze...);
    visit(OptionField{ "Confinement", limits::Factor, "1/s",
                       "Strength of vorticity confinement in 1/s; 0: none." },
          of.Confinement...);
    visit(
      OptionField{ "BuoyancyDensity", limits::Around0(1e9), "m/s^2",
                   "Downward acceleration of smoke of density 1, in metres per second squared." },
      of.BuoyancyDensity...);
    visit(
      OptionField{
        "BuoyancyTemperature", limits::Around0(1e9), "m/(s^2 K)",
        "Upward acceleration per kelvin above the ambient, in metres per second squared." },
      of.BuoyancyTemperature...);
    visit(OptionField{ "Dissipation", limits::Factor, "1/s", "Smoke fades at this rate, in 1/s." },
          of.Dissipation...);
    visit(
      OptionField{
        "WindDrag", limits::Factor, "1/s",
        "Rate at which an input wind that is a velocity draws the air towards it, in 1/s." }
        .With("Wind"),
      of.WindDrag...);
    visit(OptionField{ "CourantNumber", limits::Above(0, 1e9), "",
                       "A substep moves no air farther than this many voxels." },
          of.CourantNumber...);
    visit(OptionField{ "Tolerance", limits::Above(0, 1e9), "",
                       "Largest divergence times time step that the projection leaves." },
          of.Tolerance...);
    visit(OptionField{ "AirDensity", limits::Density, "kg/m^3",
                       "Density of the air in kilograms per cubic metre; it scales the pressure." },
          of.AirDensity...);
  }
  Vec3 Spacing() const; // m, of the voxels
  std::size_t NumberOfCells() const;
  std::size_t NumberOfNodes() const; // (nx + 1) (ny + 1) (nz + 1)

private:
  /// A stage of the pipeline has a property for each axis.
  template <int Axis, class Holder>
  static auto& BoundaryAlong(Holder& of)
  {
    if constexpr (std::is_same_v<std::remove_const_t<Holder>, SmokeOptions>)
    {
      return of.Boundary[Axis];
    }
    else if constexpr (Axis == 0)
    {
      return of.BoundaryX;
    }
    else if constexpr (Axis == 1)
    {
      return of.BoundaryY;
    }
    else
    {
      return of.BoundaryZ;
    }
  }
};

/// A ball that gives off smoke and warmth.
struct SmokeEmitter
{
  Vec3 Center = Vec3::Zero();
  double Radius = 0.3;      // m
  double Density = 1.0;     // kept in the ball while it emits
  double Temperature = 0.0; // K above the ambient, likewise
  double StartTime = -1e30; // s
  double EndTime = 1e30;    // s
};

/// Everything that acts on the air besides its boundary and solids. Times are those of the frames;
/// the warm-up lies before time 0.
struct SmokeForces
{
  std::vector<Vortex> Vortices;
  std::vector<AnalyticWind> Winds;
  FieldSeries Wind; // optional; counts as wind
  std::vector<SmokeEmitter> Emitters;

  Result Validate() const;
};

/// Cell-centred values of one frame.
struct SmokeFrame : PointLattice
{
  int Frame = 0;
  double Time = 0.0;                             // s
  std::vector<std::array<float, 3>> Velocity;    // m/s
  std::vector<std::array<float, 3>> Vorticity;   // 1/s
  std::vector<std::array<float, 3>> VortexForce; // m/s^2
  std::vector<std::array<float, 3>> WindForce;   // m/s^2
  std::vector<float> Density;
  std::vector<float> Pressure;         // Pa
  std::vector<unsigned char> Obstacle; // 1: the voxel's centre is in a solid
};

} // namespace waft
