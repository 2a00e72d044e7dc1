// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/ObjectOptions.h"

namespace waft
{

Result ObjectOptions::MakeObject(MotionObject& object) const
{
  object = MotionObject();
  object.ObjectId = this->ObjectId;
  object.ShapeId = this->ShapeId;
  object.ClassId = this->ClassId;
  object.Mass = this->Mass;
  object.Position = this->Position;
  object.Velocity = this->Velocity;
  object.VelocityGiven = this->Velocity.isZero() ? 0 : 1;
  const std::array<double, 4>& q = this->Orientation;
  object.Orientation = Quat(q[0], q[1], q[2], q[3]);
  if (!(object.Orientation.norm() > 0.0))
  {
    return Result::Error("Orientation: expected a quaternion that is not zero");
  }
  object.Orientation.normalize();
  object.AngularVelocity = this->AngularVelocity;
  object.SettlingSpeed = this->SettlingSpeed;
  object.ClearanceRadius = this->ClearanceRadius;
  object.RestHeight = this->RestHeight;
  return Result::Ok();
}

} // namespace waft
