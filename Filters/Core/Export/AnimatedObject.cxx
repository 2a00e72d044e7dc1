// SPDX-License-Identifier: BSD-3-Clause
#include "Export/AnimatedObject.h"

#include <cmath>
#include <limits>
#include <string>

namespace waft
{

Vec3 KeyOrigin(const Box& volume)
{
  const double farthest = volume.Min.cwiseAbs().cwiseMax(volume.Max.cwiseAbs()).maxCoeff();
  return farthest * std::numeric_limits<float>::epsilon() > 1e-6 * volume.Width() ? volume.Min
                                                                                  : Vec3::Zero();
}

BodyKeys KeysOf(const AnimatedObject& object, double framesPerSecond, const Vec3& origin)
{
  BodyKeys keys;
  for (std::size_t k = 0; k < object.Positions.size(); ++k)
  {
    const Vec3 place = ToYUp(object.Positions[k] - origin);
    const Vec3 axis = ToYUp(object.Orientations[k].vec());
    for (const double x : { place.x(), place.y(), place.z() })
    {
      keys.Places.push_back(static_cast<float>(x));
    }
    for (const double x : { axis.x(), axis.y(), axis.z(), object.Orientations[k].w() })
    {
      keys.Turns.push_back(static_cast<float>(x));
    }
    keys.Times.push_back(static_cast<float>(static_cast<double>(k) / framesPerSecond));
  }
  return keys;
}

Result CheckAnimated(const std::vector<AnimatedShape>& shapes,
                     const std::vector<AnimatedObject>& objects)
{
  for (const AnimatedShape& shape : shapes)
  {
    const std::size_t points = shape.Body.Mesh.Points.size();
    const std::string name = "shape '" + shape.Body.Name + "'";
    if (shape.Body.Mesh.Triangles.empty())
    {
      return Result::Error(name + " has no triangles");
    }
    if ((!shape.Normals.empty() && shape.Normals.size() != points) ||
        (!shape.Body.TextureCoordinates.empty() && shape.Body.TextureCoordinates.size() != points))
    {
      return Result::Error(name + ": expected a normal and a texture coordinate for each of " +
                           std::to_string(points) + " points");
    }
    for (const auto& triangle : shape.Body.Mesh.Triangles)
    {
      for (const int corner : triangle)
      {
        if (corner < 0 || corner >= static_cast<int>(points))
        {
          return Result::Error(name + ": a triangle names point " + std::to_string(corner) +
                               " of " + std::to_string(points));
        }
      }
    }
  }
  for (const AnimatedObject& object : objects)
  {
    const std::string name = "object " + std::to_string(object.ObjectId);
    if (object.Shape >= shapes.size())
    {
      return Result::Error(name + ": shape " + std::to_string(object.Shape) + " of " +
                           std::to_string(shapes.size()) + ": expected a number below");
    }
    if (object.Positions.empty() || object.Positions.size() != objects[0].Positions.size() ||
        object.Orientations.size() != object.Positions.size())
    {
      return Result::Error(name + ": its poses have another number of frames");
    }
    for (std::size_t k = 0; k < object.Positions.size(); ++k)
    {
      if (!object.Positions[k].allFinite() || !object.Orientations[k].coeffs().allFinite())
      {
        return Result::Error(name + ", frame " + std::to_string(k) + ": a number is not finite");
      }
    }
  }
  return Result::Ok();
}

} // namespace waft
