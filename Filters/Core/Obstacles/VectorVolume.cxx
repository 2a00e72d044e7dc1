// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/VectorVolume.h"

#include <openvdb/openvdb.h>

#include <cmath>
#include <exception>

namespace waft
{

namespace
{

template <class Grid>
void CopyVoxels(const Grid& grid, const openvdb::CoordBBox& box,
                std::vector<std::array<float, 3>>& values)
{
  auto accessor = grid.getConstAccessor();
  for (int k = box.min().z(); k <= box.max().z(); ++k)
  {
    for (int j = box.min().y(); j <= box.max().y(); ++j)
    {
      for (int i = box.min().x(); i <= box.max().x(); ++i)
      {
        const auto v = accessor.getValue(openvdb::Coord(i, j, k));
        values.push_back(
          { static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()) });
      }
    }
  }
}

// The lattice of a grid's box. False when its transform does more than scale and shift.
bool LatticeOf(const openvdb::GridBase& grid, const openvdb::CoordBBox& box, FieldSeries& step)
{
  const openvdb::math::Transform& transform = grid.transform();
  if (!transform.isLinear())
  {
    return false;
  }
  const openvdb::Vec3d zero = transform.indexToWorld(openvdb::Vec3d(0.0, 0.0, 0.0));
  const openvdb::Vec3d low = transform.indexToWorld(box.min().asVec3d());
  const auto dimensions = box.dim();
  for (int axis = 0; axis < 3; ++axis)
  {
    openvdb::Vec3d unit(0.0, 0.0, 0.0);
    unit[axis] = 1.0;
    const openvdb::Vec3d along = transform.indexToWorld(unit) - zero;
    const double spacing = along[axis];
    if (!(spacing > 0.0) || std::abs(along.length() - spacing) > 1e-9 * spacing)
    {
      return false;
    }
    step.Spacing[axis] = spacing;
    step.Origin[axis] = low[axis];
    step.Dimensions[static_cast<std::size_t>(axis)] = dimensions[axis];
  }
  return true;
}

Result ReadGrid(const std::string& path, double time, FieldSeries& step)
{
  openvdb::initialize();
  openvdb::io::File file(path);
  file.open();
  const bool hasWind = file.hasGrid("Wind");
  if (!hasWind && !file.hasGrid("Velocity"))
  {
    return Result::Error("expected a vector grid `Wind` or `Velocity`, found neither");
  }
  const std::string name = hasWind ? "Wind" : "Velocity";
  const openvdb::GridBase::Ptr grid = file.readGrid(name);
  const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
  if (box.empty())
  {
    return Result::Error("grid `" + name + "`: expected active voxels, found none");
  }
  constexpr openvdb::Index64 most = 256ull * 256ull * 256ull;
  if (box.volume() > most)
  {
    return Result::Error("grid `" + name + "`: expected at most 256^3 voxels, found " +
                         std::to_string(box.volume()));
  }
  FieldSeries read;
  read.Meaning = hasWind ? FieldMeaning::Acceleration : FieldMeaning::Velocity;
  read.Times = { time };
  read.Values.resize(1);
  if (!LatticeOf(*grid, box, read))
  {
    return Result::Error("grid `" + name + "`: expected a transform that scales and shifts only");
  }
  if (const auto single = openvdb::gridPtrCast<openvdb::Vec3SGrid>(grid))
  {
    CopyVoxels(*single, box, read.Values[0]);
  }
  else if (const auto twice = openvdb::gridPtrCast<openvdb::Vec3DGrid>(grid))
  {
    CopyVoxels(*twice, box, read.Values[0]);
  }
  else
  {
    return Result::Error("grid `" + name + "`: expected vectors, found " + grid->valueType());
  }
  step = std::move(read);
  return step.Validate(name);
}

} // namespace

Result ReadVectorVolume(const std::string& path, double time, FieldSeries& step)
{
  try
  {
    return ReadGrid(path, time, step);
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("expected an OpenVDB file that can be read, found: ") +
                         error.what());
  }
}

} // namespace waft
