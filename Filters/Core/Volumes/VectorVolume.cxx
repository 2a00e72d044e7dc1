// SPDX-License-Identifier: BSD-3-Clause
#include "Volumes/VectorVolume.h"

#include "Volumes/VolumeFile.h"

#include <algorithm>

namespace waft
{

namespace
{

constexpr double MostWindVoxels = 256.0 * 256.0 * 256.0;

} // namespace

Result ReadVectorVolume(const std::string& path, double time, FieldSeries& step)
{
  VolumeContents contents;
  WAFT_RETURN_IF_FAILED(ListVolume(path, contents));
  const auto named = [&](const char* name)
  {
    return std::find_if(contents.Grids.begin(), contents.Grids.end(),
                        [name](const VolumeGrid& grid) { return grid.Name == name; });
  };
  const auto wind = named("Wind");
  const auto grid = wind != contents.Grids.end() ? wind : named("Velocity");
  if (grid == contents.Grids.end())
  {
    return Result::Error("expected a vector grid `Wind` or `Velocity`, found neither");
  }
  const std::string location = "grid `" + grid->Name + "`: ";
  if (grid->Components != 3)
  {
    return Result::Error(location + "expected vectors, found " + grid->Type);
  }
  if (grid->Active.IsEmpty())
  {
    return Result::Error(location + "expected active voxels, found none");
  }
  if (grid->Active.NumberOfVoxels() > MostWindVoxels)
  {
    return Result::Error(location + "expected at most 256^3 voxels, found " +
                         std::to_string(static_cast<long>(grid->Active.NumberOfVoxels())));
  }
  if (!grid->IsUpright)
  {
    return Result::Error(location + "expected a transform that scales and shifts only");
  }
  VolumeField field;
  WAFT_RETURN_IF_FAILED(ReadVolumeGrid(path, grid->Name, grid->Active, field));
  FieldSeries read;
  read.Meaning = grid->Name == "Wind" ? FieldMeaning::Acceleration : FieldMeaning::Velocity;
  read.Dimensions = grid->Active.Dimensions();
  read.Spacing = grid->Spacing;
  const std::array<int, 3>& first = grid->Active.First;
  read.Origin = grid->Zero + Vec3(first[0], first[1], first[2]).cwiseProduct(grid->Spacing);
  read.Times = { time };
  read.Values.resize(1);
  for (std::size_t i = 0; i < field.Values.size(); i += 3)
  {
    read.Values[0].push_back({ field.Values[i], field.Values[i + 1], field.Values[i + 2] });
  }
  WAFT_RETURN_IF_FAILED(read.Validate(grid->Name));
  step = std::move(read);
  return Result::Ok();
}

} // namespace waft
