// SPDX-License-Identifier: BSD-3-Clause
#include "Volumes/VolumeFile.h"

#include "Base/AtomicFile.h"
#include "Volumes/VolumeArchive.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>

namespace waft
{

namespace
{

// Names of what is noted about the scene, beside OpenVDB's own.
constexpr const char* BoundsMin = "BoundsMin";
constexpr const char* BoundsMax = "BoundsMax";
constexpr const char* NumberOfFrames = "NumberOfFrames";
constexpr const char* FramesPerSecond = "FramesPerSecond";
constexpr const char* AirDensity = "AirDensity";
constexpr const char* Seed = "Seed";

openvdb::Vec3d ToVdb(const Vec3& v)
{
  return { v.x(), v.y(), v.z() };
}

Vec3 FromVdb(const openvdb::Vec3d& v)
{
  return { v.x(), v.y(), v.z() };
}

/// What OpenVDB throws becomes a Result.
Result Guarded(const char* expected, const std::function<Result()>& body)
{
  try
  {
    openvdb::initialize();
    return body();
  }
  catch (const std::exception& error)
  {
    return Result::Error(std::string("expected ") + expected + ", found: " + error.what());
  }
}

openvdb::MetaMap NotesOf(const SceneInfo& scene)
{
  openvdb::MetaMap notes;
  notes.insertMeta("creator", openvdb::StringMetadata("Waft"));
  notes.insertMeta(BoundsMin, openvdb::Vec3DMetadata(ToVdb(scene.Bounds.Min)));
  notes.insertMeta(BoundsMax, openvdb::Vec3DMetadata(ToVdb(scene.Bounds.Max)));
  notes.insertMeta(NumberOfFrames, openvdb::Int32Metadata(scene.Time.NumberOfFrames));
  notes.insertMeta(FramesPerSecond, openvdb::DoubleMetadata(scene.Time.FramesPerSecond));
  notes.insertMeta(AirDensity, openvdb::DoubleMetadata(scene.AirDensity));
  notes.insertMeta(Seed, openvdb::Int64Metadata(static_cast<openvdb::Int64>(scene.Seed)));
  return notes;
}

void ReadNotes(const openvdb::MetaMap& notes, VolumeContents& contents)
{
  const auto min = notes.getMetadata<openvdb::Vec3DMetadata>(BoundsMin);
  const auto max = notes.getMetadata<openvdb::Vec3DMetadata>(BoundsMax);
  const auto frames = notes.getMetadata<openvdb::Int32Metadata>(NumberOfFrames);
  const auto rate = notes.getMetadata<openvdb::DoubleMetadata>(FramesPerSecond);
  const auto density = notes.getMetadata<openvdb::DoubleMetadata>(AirDensity);
  const auto seed = notes.getMetadata<openvdb::Int64Metadata>(Seed);
  if (!min || !max || !frames || !rate || !density || !seed || frames->value() < 1 ||
      !(rate->value() > 0.0))
  {
    return;
  }
  contents.HasScene = true;
  contents.Scene.Bounds = Box{ FromVdb(min->value()), FromVdb(max->value()) };
  contents.Scene.Time = Timeline{ frames->value(), rate->value() };
  contents.Scene.AirDensity = density->value();
  contents.Scene.Seed = static_cast<std::uint64_t>(seed->value());
}

VoxelBox FromVdb(const openvdb::CoordBBox& box)
{
  VoxelBox voxels;
  for (int axis = 0; axis < 3 && !box.empty(); ++axis)
  {
    voxels.First[axis] = box.min()[axis];
    voxels.Last[axis] = box.max()[axis];
  }
  return voxels;
}

// From the file's own notes where it has them: the values need not be read.
VoxelBox ActiveBox(VolumeArchive& file, const openvdb::GridBase& outline)
{
  using Corner = openvdb::TypedMetadata<openvdb::Vec3i>;
  const auto min = outline.getMetadata<Corner>(openvdb::GridBase::META_FILE_BBOX_MIN);
  const auto max = outline.getMetadata<Corner>(openvdb::GridBase::META_FILE_BBOX_MAX);
  if (min && max)
  {
    return FromVdb(openvdb::CoordBBox(openvdb::Coord(min->value()), openvdb::Coord(max->value())));
  }
  return FromVdb(file.ReadGrid(outline.getName())->evalActiveVoxelBoundingBox());
}

VolumeGrid Outline(VolumeArchive& file, const openvdb::GridBase& grid)
{
  VolumeGrid outline;
  outline.Name = grid.getName();
  outline.Type = grid.valueType();
  const bool isVector = grid.isType<openvdb::Vec3SGrid>() || grid.isType<openvdb::Vec3DGrid>();
  const bool isScalar = grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>() ||
                        grid.isType<openvdb::Int32Grid>() || grid.isType<openvdb::BoolGrid>();
  outline.Components = isVector ? 3 : isScalar ? 1 : 0;
  outline.Active = ActiveBox(file, grid);
  const openvdb::math::Transform& transform = grid.transform();
  outline.IsUpright = transform.isLinear();
  const openvdb::Vec3d zero = transform.indexToWorld(openvdb::Vec3d(0.0, 0.0, 0.0));
  outline.Zero = FromVdb(zero);
  for (int axis = 0; axis < 3 && outline.IsUpright; ++axis)
  {
    openvdb::Vec3d unit(0.0, 0.0, 0.0);
    unit[axis] = 1.0;
    const openvdb::Vec3d along = transform.indexToWorld(unit) - zero;
    outline.Spacing[axis] = along[axis];
    outline.IsUpright =
      along[axis] > 0.0 && std::abs(along.length() - along[axis]) <= 1e-9 * along[axis];
  }
  return outline;
}

template <class Body>
void ForVoxels(const VoxelBox& box, const Body& body)
{
  for (int k = box.First[2]; k <= box.Last[2]; ++k)
  {
    for (int j = box.First[1]; j <= box.Last[1]; ++j)
    {
      for (int i = box.First[0]; i <= box.Last[0]; ++i)
      {
        body(openvdb::Coord(i, j, k));
      }
    }
  }
}

// False when the grid is of another type.
template <class Grid>
bool CopyScalars(const openvdb::GridBase& base, const VoxelBox& box, std::vector<float>& values)
{
  if (!base.isType<Grid>())
  {
    return false;
  }
  auto accessor = static_cast<const Grid&>(base).getConstAccessor();
  ForVoxels(box, [&](const openvdb::Coord& at)
            { values.push_back(static_cast<float>(accessor.getValue(at))); });
  return true;
}

template <class Grid>
bool CopyVectors(const openvdb::GridBase& base, const VoxelBox& box, std::vector<float>& values)
{
  if (!base.isType<Grid>())
  {
    return false;
  }
  auto accessor = static_cast<const Grid&>(base).getConstAccessor();
  const bool isStaggered = base.getGridClass() == openvdb::GRID_STAGGERED;
  ForVoxels(box,
            [&](const openvdb::Coord& at)
            {
              const auto value = accessor.getValue(at);
              for (int axis = 0; axis < 3; ++axis)
              {
                double component = value[axis];
                if (isStaggered)
                {
                  openvdb::Coord next = at;
                  ++next[axis];
                  component = 0.5 * (component + accessor.getValue(next)[axis]);
                }
                values.push_back(static_cast<float>(component));
              }
            });
  return true;
}

openvdb::GridBase::Ptr MakeGrid(const Volume& volume, const VolumeField& field)
{
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.Last[axis] = volume.Dimensions[axis] - 1;
  }
  openvdb::GridBase::Ptr made;
  const float* value = field.Values.data();
  if (field.Components == 3)
  {
    auto grid = openvdb::Vec3SGrid::create(openvdb::Vec3s(0.0f, 0.0f, 0.0f));
    auto accessor = grid->getAccessor();
    ForVoxels(box,
              [&](const openvdb::Coord& at)
              {
                accessor.setValue(at, openvdb::Vec3s(value[0], value[1], value[2]));
                value += 3;
              });
    grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
    made = grid;
  }
  else
  {
    auto grid = openvdb::FloatGrid::create(0.0f);
    auto accessor = grid->getAccessor();
    ForVoxels(box,
              [&](const openvdb::Coord& at)
              {
                if (*value != 0.0f)
                {
                  accessor.setValue(at, *value);
                }
                ++value;
              });
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    made = grid;
  }
  made->setName(field.Name);
  made->setTransform(
    openvdb::math::Transform::Ptr(new openvdb::math::Transform(openvdb::math::MapBase::Ptr(
      new openvdb::math::ScaleTranslateMap(ToVdb(volume.Spacing), ToVdb(volume.Origin))))));
  return made;
}

} // namespace

bool VoxelBox::IsEmpty() const
{
  return this->Last[0] < this->First[0] || this->Last[1] < this->First[1] ||
         this->Last[2] < this->First[2];
}

std::array<int, 3> VoxelBox::Dimensions() const
{
  return { this->Last[0] - this->First[0] + 1, this->Last[1] - this->First[1] + 1,
           this->Last[2] - this->First[2] + 1 };
}

double VoxelBox::NumberOfVoxels() const
{
  double count = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    count *= std::max(0.0, double(this->Last[axis]) - this->First[axis] + 1.0);
  }
  return count;
}

void VoxelBox::Add(const VoxelBox& other)
{
  if (other.IsEmpty())
  {
    return;
  }
  if (this->IsEmpty())
  {
    *this = other;
    return;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    this->First[axis] = std::min(this->First[axis], other.First[axis]);
    this->Last[axis] = std::max(this->Last[axis], other.Last[axis]);
  }
}

VoxelBox VoxelBox::Moved(const std::array<int, 3>& shift) const
{
  VoxelBox moved = *this;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    moved.First[axis] += shift[axis];
    moved.Last[axis] += shift[axis];
  }
  return moved;
}

std::optional<std::array<int, 3>> ShiftOnto(const VolumeGrid& pattern, const VolumeGrid& grid)
{
  const Vec3 apart = (grid.Zero - pattern.Zero).cwiseQuotient(pattern.Spacing);
  const Vec3 whole = apart.array().round();
  if (!pattern.IsUpright || !grid.IsUpright || whole.cwiseAbs().maxCoeff() > 1e6 ||
      (pattern.Spacing - grid.Spacing).norm() >= 1e-6 * pattern.Spacing.minCoeff() ||
      (apart - whole).norm() >= 1e-3)
  {
    return std::nullopt;
  }
  return std::array<int, 3>{ int(whole[0]), int(whole[1]), int(whole[2]) };
}

Result ListVolume(const std::string& path, VolumeContents& contents)
{
  return Guarded("an OpenVDB file that can be read",
                 [&]
                 {
                   VolumeArchive file(path);
                   VolumeContents found;
                   for (const openvdb::GridBase::Ptr& grid : file.ReadOutlines())
                   {
                     found.Grids.push_back(Outline(file, *grid));
                   }
                   std::stable_sort(found.Grids.begin(), found.Grids.end(),
                                    [](const VolumeGrid& a, const VolumeGrid& b)
                                    { return a.Name < b.Name; });
                   ReadNotes(file.Notes(), found);
                   contents = std::move(found);
                   return Result::Ok();
                 });
}

Result ReadVolumeGrid(const std::string& path, const std::string& name, const VoxelBox& box,
                      VolumeField& field)
{
  const auto read = [&]
  {
    if (box.NumberOfVoxels() > MostVoxels)
    {
      return Result::Error("grid `" + name + "`: expected at most 512^3 voxels, found " +
                           std::to_string(box.NumberOfVoxels()));
    }
    const openvdb::GridBase::Ptr grid = VolumeArchive(path).ReadGrid(name);
    VolumeField copied;
    copied.Name = name;
    if (CopyVectors<openvdb::Vec3SGrid>(*grid, box, copied.Values) ||
        CopyVectors<openvdb::Vec3DGrid>(*grid, box, copied.Values))
    {
      copied.Components = 3;
    }
    else if (!CopyScalars<openvdb::FloatGrid>(*grid, box, copied.Values) &&
             !CopyScalars<openvdb::DoubleGrid>(*grid, box, copied.Values) &&
             !CopyScalars<openvdb::Int32Grid>(*grid, box, copied.Values) &&
             !CopyScalars<openvdb::BoolGrid>(*grid, box, copied.Values))
    {
      return Result::Error("grid `" + name + "`: expected numbers or vectors, found " +
                           grid->valueType());
    }
    field = std::move(copied);
    return Result::Ok();
  };
  return Guarded("an OpenVDB file that can be read", read);
}

Result WriteVolume(const std::string& path, const Volume& volume, const SceneInfo& scene)
{
  for (const VolumeField& field : volume.Fields)
  {
    if ((field.Components != 1 && field.Components != 3) ||
        field.Values.size() != volume.NumberOfPoints() * field.Components)
    {
      return Result::Error("field `" + field.Name + "`: expected 1 or 3 values a point");
    }
  }
  PartFile part(path);
  const Result written = Guarded("a place that can be written",
                                 [&]
                                 {
                                   openvdb::GridCPtrVec grids;
                                   for (const VolumeField& field : volume.Fields)
                                   {
                                     grids.push_back(MakeGrid(volume, field));
                                   }
                                   openvdb::io::File file(part.Name());
                                   file.write(grids, NotesOf(scene));
                                   file.close();
                                   return Result::Ok();
                                 });
  return written ? part.PutInPlace()
                 : Result::Error("cannot write " + path + ": " + written.Message());
}

} // namespace waft
