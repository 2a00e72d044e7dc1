// SPDX-License-Identifier: BSD-3-Clause
#include "Volumes/VectorVolume.h"

#include "Base/WindFields.h"
#include "Volumes/VolumeFile.h"

#include <array>
#include <vector>

namespace waft
{

namespace
{

constexpr double MostWindVoxels = 256.0 * 256.0 * 256.0;

} // namespace

Result ReadVectorVolume(const std::string& path, const std::string& array, double time,
                        FieldSeries& step)
{
  VolumeContents contents;
  WAFT_RETURN_IF_FAILED(ListVolume(path, contents));
  std::vector<NamedField> fields;
  for (const VolumeGrid& grid : contents.Grids)
  {
    fields.push_back({ grid.Name, grid.Components });
  }
  WindFields chosen;
  if (!ChooseWind(fields, array, chosen))
  {
    return NoWind(array, ListOfFields(fields));
  }
  const VolumeGrid* pattern = &contents.Grids[chosen.Fields.front()];
  VoxelBox active;
  for (const std::size_t index : chosen.Fields)
  {
    const VolumeGrid& grid = contents.Grids[index];
    const std::string location = "grid `" + grid.Name + "`: ";
    if (!grid.IsUpright)
    {
      return Result::Error(location + "expected a transform that scales and shifts only");
    }
    if (!HasLatticeOf(grid, *pattern))
    {
      return Result::Error(location + "expected the voxels of `" + pattern->Name + "`");
    }
    active.Add(grid.Active);
  }
  const std::string location = "grid `" + pattern->Name + "`: ";
  if (active.IsEmpty())
  {
    return Result::Error(location + "expected active voxels, found none");
  }
  if (active.NumberOfVoxels() > MostWindVoxels)
  {
    return Result::Error(location + "expected at most 256^3 voxels, found " +
                         std::to_string(static_cast<long>(active.NumberOfVoxels())));
  }
  FieldSeries read;
  read.Meaning = chosen.Meaning;
  read.Dimensions = active.Dimensions();
  read.Spacing = pattern->Spacing;
  const std::array<int, 3>& first = active.First;
  read.Origin = pattern->Zero + Vec3(first[0], first[1], first[2]).cwiseProduct(pattern->Spacing);
  read.Times = { time };
  read.Values.assign(1, FieldSeries::Field(read.NumberOfPoints()));
  for (std::size_t part = 0; part < chosen.Fields.size(); ++part)
  {
    VolumeField field;
    WAFT_RETURN_IF_FAILED(
      ReadVolumeGrid(path, contents.Grids[chosen.Fields[part]].Name, active, field));
    const auto components = static_cast<std::size_t>(field.Components);
    for (std::size_t i = 0; i < field.Values.size(); ++i)
    {
      read.Values[0][i / components][part + i % components] = field.Values[i];
    }
  }
  WAFT_RETURN_IF_FAILED(read.Validate(pattern->Name));
  step = std::move(read);
  return Result::Ok();
}

} // namespace waft
