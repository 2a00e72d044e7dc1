// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ObjectOptions.h"

#include "Base/NumberText.h"
#include "Base/ShapeMeasures.h"
#include "Constraints/Arrivals.h"
#include "Scene/BlueNoise.h"

#include <algorithm>

namespace waft
{

namespace
{

Quat FromAngles(const Vec3& degrees)
{
  const Vec3 angles = degrees * (EIGEN_PI / 180.0);
  return Quat(Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()) *
              Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
              Eigen::AngleAxisd(angles.x(), Vec3::UnitX()));
}

} // namespace

void ObjectOptions::TakeBodyOf(const Shape& shape)
{
  this->Mass = ShellMass(shape);
  this->SettlingSpeed = shape.SettlingSpeed;
  this->ClearanceRadius = waft::ClearanceRadius(shape);
  this->RestHeight = waft::RestHeight(shape);
  this->ClassId = shape.ClassId;
}

Result ObjectOptions::MakeBody(MotionObject& object) const
{
  object = MotionObject();
  object.Mass = this->Mass;
  object.SettlingSpeed = this->SettlingSpeed;
  object.ClearanceRadius = this->ClearanceRadius;
  object.RestHeight = this->RestHeight;
  object.ShapeId = this->ShapeId;
  object.ClassId = this->ClassId;
  object.Velocity = this->Velocity;
  object.VelocityGiven = this->Velocity.isZero() ? 0 : 1;
  const std::array<double, 4>& q = this->Orientation;
  object.Orientation = Quat(q[0], q[1], q[2], q[3]);
  if (!(object.Orientation.norm() > 0.0))
  {
    return Result::Error("Orientation: expected a quaternion that is not zero");
  }
  object.Orientation.normalize();
  if (!this->Angles.isZero())
  {
    object.Orientation = FromAngles(this->Angles) * object.Orientation;
  }
  object.OrientationGiven = this->Angles.isZero() && q == ObjectOptions().Orientation ? 0 : 1;
  object.AngularVelocity = this->AngularVelocity;
  return Result::Ok();
}

Result ObjectOptions::MakePositions(std::vector<Vec3>& positions) const
{
  const auto count = static_cast<std::size_t>(this->NumberOfObjects);
  positions.clear();
  if (this->Layout == ObjectLayout::One)
  {
    positions.push_back(this->Position);
  }
  else if (this->Layout == ObjectLayout::Row)
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      const double fraction =
        count > 1 ? static_cast<double>(k) / static_cast<double>(count - 1) : 0.0;
      positions.emplace_back(this->Position + fraction * (this->RowEnd - this->Position));
    }
  }
  else
  {
    const Box region{ this->RegionMin, this->RegionMin + this->RegionSize };
    positions = SpreadInBox(region, count, this->Seed, 0,
                            [&](const Vec3& x)
                            { return this->Bounds.InnerDistance(x) >= this->ClearanceRadius; });
    if (positions.size() < count)
    {
      return Result::Error("RegionMin, RegionSize: expected room for " + std::to_string(count) +
                           " objects of radius " + NumberText(this->ClearanceRadius) +
                           " m inside Bounds, found " + std::to_string(positions.size()) +
                           " places");
    }
  }
  return Result::Ok();
}

Result ObjectOptions::MakeObjects(std::vector<MotionObject>& objects) const
{
  MotionObject object;
  std::vector<Vec3> positions;
  WAFT_RETURN_IF_FAILED(this->MakeBody(object));
  WAFT_RETURN_IF_FAILED(this->MakePositions(positions));
  if (this->ObjectId > limits::MostInt - static_cast<double>(positions.size()))
  {
    return Result::Error("ObjectId: expected a number that " + std::to_string(positions.size()) +
                         " objects can be numbered from, found " + std::to_string(this->ObjectId));
  }
  const FrameWindow releases{ this->Release, std::max(this->Release, this->LastRelease) };
  if (this->Release >= 0 && releases.To >= this->NumberOfFrames)
  {
    return Result::Error("Release, LastRelease: expected at most " +
                         std::to_string(this->NumberOfFrames - 1) +
                         ", the last of NumberOfFrames, found " + std::to_string(releases.To));
  }
  const std::vector<double> parts = PartsByChance(positions.size(), this->Seed, ReleaseStream);
  objects.clear();
  object.ObjectId = std::max(0, this->ObjectId);
  object.Appears = this->Appears ? 1 : 0;
  object.On = this->On;
  for (std::size_t k = 0; k < positions.size(); ++k)
  {
    object.Position = positions[k];
    object.Release = this->Release < 0 ? -1 : FrameAt(releases, TimeSpread::Even, parts[k]);
    objects.push_back(object);
    ++object.ObjectId;
  }
  return Result::Ok();
}

} // namespace waft
