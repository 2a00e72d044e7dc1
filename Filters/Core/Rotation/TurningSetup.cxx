// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/TurningSetup.h"

#include "Base/BodyLaw.h"
#include "Base/Random.h"
#include "Rotation/Pace.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{
constexpr double AirViscosity = 1.8e-5; // Pa s
constexpr double FastReynolds = 133.0;  // from which on a disc's drag has ceased to fall
constexpr double BrakedTime = 0.15;     // s, before a touch-down and after a lift-off

Vec3 Curl(const Mat3& gradient)
{
  return Vec3(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
              gradient(1, 0) - gradient(0, 1));
}

AirCoefficients Coefficients(const TurningLaw& law, const RotationOptions& options)
{
  AirCoefficients coefficients;
  coefficients.Model = options.Model;
  coefficients.Drag = law.Drag;
  coefficients.Lift = options.Lift;
  coefficients.PressureShift = options.PressureShift;
  coefficients.Autorotation *= options.Roll;
  coefficients.Spin = options.Spin;
  return coefficients;
}

/// Where its Reynolds number, by the disc of its area, is below that of fast flow.
void SetStickiness(double area, double speed, double airDensity, AirCoefficients& coefficients)
{
  if (coefficients.Model != AirModel::Plate || !(airDensity > 0.0) || !(speed > 0.0))
  {
    return;
  }
  const double diameter = 2.0 * std::sqrt(area / std::acos(-1.0));
  const double sticky = AirViscosity / (airDensity * diameter);
  if (speed < FastReynolds * sticky)
  {
    coefficients.DragSpeed = speed;
    coefficients.StickySpeed = sticky;
  }
}

/// No two leaves are cut alike.
AirCoefficients Varied(AirCoefficients coefficients, const RotationOptions& options,
                       const MotionObject& object)
{
  Random random(options.Seed, 0x70053 + static_cast<std::uint64_t>(object.ObjectId));
  const auto vary = [&](double& value)
  { value *= 1.0 + options.VariationPerObject * random.Uniform(-1.0, 1.0); };
  vary(coefficients.Drag);
  vary(coefficients.Lift);
  vary(coefficients.PressureShift);
  vary(coefficients.RotationalLift);
  vary(coefficients.Spin);
  return coefficients;
}

} // namespace

Glider GliderOf(const RotationInput& input, const RotationOptions& options,
                const PreparedShape& shape, const MotionObject& object)
{
  const TurningLaw law = TurningLawOf(input.Shapes[static_cast<std::size_t>(object.ShapeId)]);
  AirCoefficients common = Coefficients(law, options);
  SetStickiness(shape.Properties.Area, object.SettlingSpeed, input.Scene.AirDensity, common);
  Glider glider{ shape.Panels,
                 shape.Properties,
                 object.Mass,
                 input.Scene.AirDensity,
                 Varied(common, options, object),
                 options.Damping + law.Damping,
                 options.Follow };
  if (options.MaximumTurn <= 0.0)
  {
    glider.Pace = PaceOf(glider.DrawnAt(0.0), shape.Properties, object.SettlingSpeed);
    glider.Damping /= glider.Pace; // what is said a second holds a second
    glider.Follow /= glider.Pace;
    glider.Ease = EaseAt(glider.Pace);
  }
  return glider;
}

Result Prepare(const RotationInput& input, const RotationOptions& options, std::size_t shapeId,
               const MotionObject* glider, const ParallelFor& parallel, PreparedShape& shape)
{
  const Shape& given = input.Shapes[shapeId];
  if (!shape.IsPrepared)
  {
    WAFT_RETURN_IF_FAILED(ComputeShellProperties(given, shape.Properties));
    WAFT_RETURN_IF_FAILED(
      shape.Panels.Build(given, shape.Properties, options.RasterSize, parallel));
    shape.IsPrepared = true;
  }
  if (glider != nullptr && shape.Draw <= 0.0)
  {
    const auto one = [&](std::size_t k)
    {
      MotionObject object = *glider;
      object.ObjectId = static_cast<int>(k); // one as they differ
      return GliderOf(input, options, shape, object);
    };
    shape.Draw = DrawOverFall(one, LawOf(*glider).SettlingSpeed(), parallel);
  }
  return Result::Ok();
}

FlightPath MakePath(const RotationInput& input, std::size_t i, double draw, double pace)
{
  const Track& track = input.Tracks[i];
  const bool isDrawn = draw > 0.0;
  FlightPath path;
  const double step = input.Scene.Time.Step();
  path.Step = pace * step;
  path.RelativeVelocities = isDrawn
                              ? std::vector<Vec3>(track.Positions.size(), -draw * Vec3::UnitZ())
                              : CentralVelocities(track, step);
  const bool given = input.Air != nullptr && !input.Air->IsEmpty();
  const bool blown = !given && input.Wind != nullptr && !input.Wind->IsEmpty() &&
                     input.Wind->Meaning == FieldMeaning::Velocity;
  for (std::size_t k = 0; k < track.Positions.size(); ++k)
  {
    Mat3 gradient = Mat3::Zero();
    Vec3 air = Vec3::Zero();
    if (given)
    {
      air = input.Air->Velocity(i, k);
      gradient = input.Air->Gradient(i, k);
    }
    else if (blown)
    {
      const double time = input.Scene.Time.Time(static_cast<double>(k));
      air = input.Wind->Sample(track.Positions[k], time, gradient);
    }
    if (given || blown)
    {
      path.AirGradients.push_back(gradient);
    }
    if (given)
    {
      path.AirTurning.push_back(0.5 / pace * Curl(gradient));
    }
    if (!isDrawn)
    {
      path.RelativeVelocities[k] -=
        given || track.AirVelocities.empty() ? air : track.AirVelocities[k];
    }
  }
  return path;
}

void EndDraw(const AttitudePlan& plan, FlightPath& path)
{
  const double braked = std::max(1.0, BrakedTime * plan.Time.FramesPerSecond); // frames
  for (const auto& rest : plan.Rests)
  {
    for (int k = 0; k < static_cast<int>(path.RelativeVelocities.size()); ++k)
    {
      const double left = k <= rest.Frame ? rest.Frame - k : k - rest.Until;
      path.RelativeVelocities[static_cast<std::size_t>(k)] *= std::clamp(left / braked, 0.0, 1.0);
    }
  }
}

} // namespace waft
