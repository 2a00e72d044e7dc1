// SPDX-License-Identifier: BSD-3-Clause
#include "Volumes/VectorVolume.h"

#include "Base/NumberText.h"
#include "Base/WindFields.h"
#include "Volumes/VolumeSeries.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace waft
{

namespace
{

constexpr double MostWindVoxels = 256.0 * 256.0 * 256.0;

using Files = std::vector<std::pair<int, std::string>>;

/// A wind's grids in the files of a series, found without their values.
struct WindSeries
{
  FieldMeaning Meaning = FieldMeaning::Velocity;
  std::vector<std::vector<VolumeGrid>> Steps; // one of vectors or three of numbers; empty: no wind
  VolumeGrid Pattern;                         // whose voxels the lattice has
  std::size_t PatternStep = 0;
};

std::vector<NamedField> FieldsOf(const VolumeContents& contents)
{
  std::vector<NamedField> fields;
  for (const VolumeGrid& grid : contents.Grids)
  {
    fields.push_back({ grid.Name, grid.Components });
  }
  return fields;
}

/// The grids of a file with the names and of the kind of others; none where one of them is missing.
Result FindGrids(const VolumeContents& contents, const std::vector<VolumeGrid>& as,
                 std::vector<VolumeGrid>& grids)
{
  std::vector<VolumeGrid> found;
  for (const VolumeGrid& one : as)
  {
    const auto grid = std::find_if(contents.Grids.begin(), contents.Grids.end(),
                                   [&](const VolumeGrid& other) { return other.Name == one.Name; });
    if (grid == contents.Grids.end())
    {
      WindFields other;
      const std::vector<NamedField> fields = FieldsOf(contents);
      return ChooseWind(fields, "", other)
               ? Result::Error("expected the grid `" + one.Name +
                               "` of the files before, found, with their components, " +
                               ListOfFields(fields))
               : Result::Ok();
    }
    const std::string location = "grid `" + one.Name + "`: ";
    if (grid->Components != one.Components)
    {
      return Result::Error(location + "expected " + std::to_string(one.Components) +
                           " components as in the files before, found a grid of " + grid->Type);
    }
    if (!grid->IsUpright)
    {
      return Result::Error(location + "expected a transform that scales and shifts only");
    }
    if (!found.empty() && !ShiftOnto(found.front(), *grid))
    {
      return Result::Error(location + "expected the voxels of `" + found.front().Name + "`");
    }
    found.push_back(*grid);
  }
  grids = std::move(found);
  return Result::Ok();
}

Result FindWind(const Files& files, const std::string& array, WindSeries& series)
{
  std::vector<VolumeContents> contents;
  WAFT_RETURN_IF_FAILED(ListSeries(files, contents));
  std::vector<VolumeGrid> first; // of the first file that has a wind
  bool isActive = false;
  for (std::size_t f = 0; f < files.size(); ++f)
  {
    WindFields chosen;
    if (first.empty() && ChooseWind(FieldsOf(contents[f]), array, chosen))
    {
      series.Meaning = chosen.Meaning;
      for (const std::size_t index : chosen.Fields)
      {
        first.push_back(contents[f].Grids[index]);
      }
    }
    series.Steps.emplace_back();
    if (first.empty())
    {
      continue;
    }
    const Result found = FindGrids(contents[f], first, series.Steps.back());
    if (!found)
    {
      return Result::Error(files[f].second + ": " + found.Message());
    }
    for (const VolumeGrid& grid : series.Steps.back())
    {
      if (!isActive && !grid.Active.IsEmpty())
      {
        isActive = true;
        series.Pattern = grid;
        series.PatternStep = f;
      }
    }
  }
  const std::string location = files.front().second + ": ";
  if (first.empty())
  {
    return Result::Error(location +
                         NoWind(array, ListOfFields(FieldsOf(contents.front()))).Message());
  }
  return isActive ? Result::Ok()
                  : Result::Error(location + "grid `" + first.front().Name +
                                  "`: expected active voxels, found none" +
                                  (files.size() > 1 ? " in any file of the series" : ""));
}

VoxelBox Grown(VoxelBox box, int voxels)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.First[axis] -= voxels;
    box.Last[axis] += voxels;
  }
  return box;
}

PointLattice LatticeOf(const VolumeGrid& grid, const VoxelBox& box)
{
  PointLattice lattice;
  lattice.Dimensions = box.Dimensions();
  lattice.Spacing = grid.Spacing;
  lattice.Origin =
    grid.Zero + Vec3(box.First[0], box.First[1], box.First[2]).cwiseProduct(grid.Spacing);
  return lattice;
}

/// The voxels of the pattern that hold the active ones of a grid.
VoxelBox ActiveOn(const VolumeGrid& pattern, const VolumeGrid& grid)
{
  if (grid.Active.IsEmpty())
  {
    return {};
  }
  if (const auto shift = ShiftOnto(pattern, grid))
  {
    return grid.Active.Moved(*shift);
  }
  const PointLattice own = LatticeOf(grid, grid.Active);
  const auto& n = own.Dimensions;
  const Vec3 low = (own.Origin - pattern.Zero).cwiseQuotient(pattern.Spacing);
  const Vec3 high =
    low +
    Vec3(n[0] - 1, n[1] - 1, n[2] - 1).cwiseProduct(own.Spacing.cwiseQuotient(pattern.Spacing));
  VoxelBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.First[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(low[axis]));
    box.Last[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(high[axis]));
  }
  return box;
}

/// Puts a grid's numbers in a box of its own voxels into components from `part` on.
Result ReadParts(const std::string& path, const VolumeGrid& grid, const VoxelBox& box,
                 std::size_t part, FieldSeries::Field& values)
{
  VolumeField field;
  WAFT_RETURN_IF_FAILED(ReadVolumeGrid(path, grid.Name, box, field));
  const auto components = static_cast<std::size_t>(field.Components);
  for (std::size_t i = 0; i < field.Values.size(); ++i)
  {
    values[i / components][part + i % components] = field.Values[i];
  }
  return Result::Ok();
}

/// The same in a box of the pattern's voxels; where these are others, between its own.
Result ReadOn(const std::string& path, const VolumeGrid& grid, const VolumeGrid& pattern,
              const VoxelBox& box, std::size_t part, FieldSeries::Field& values)
{
  if (const auto shift = ShiftOnto(pattern, grid))
  {
    const auto& [i, j, k] = *shift;
    return ReadParts(path, grid, box.Moved({ -i, -j, -k }), part, values);
  }
  const VoxelBox own = Grown(grid.Active, 1); // with the background about it
  FieldSeries series;
  static_cast<PointLattice&>(series) = LatticeOf(grid, own);
  series.Times = { 0.0 };
  series.Values.assign(1, FieldSeries::Field(series.NumberOfPoints()));
  WAFT_RETURN_IF_FAILED(ReadParts(path, grid, own, 0, series.Values[0]));
  const PointLattice lattice = LatticeOf(pattern, box);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const Vec3 v = series.Sample(lattice.PointAt(i), 0.0);
    for (std::size_t c = 0; c < static_cast<std::size_t>(grid.Components); ++c)
    {
      values[i][part + c] = static_cast<float>(v[static_cast<Eigen::Index>(c)]);
    }
  }
  return Result::Ok();
}

Result ReadStep(const std::string& path, const std::vector<VolumeGrid>& grids,
                const VolumeGrid& pattern, const VoxelBox& box, FieldSeries::Field& values)
{
  values.assign(static_cast<std::size_t>(box.NumberOfVoxels()), {});
  for (std::size_t part = 0; part < grids.size(); ++part)
  {
    WAFT_RETURN_IF_FAILED(ReadOn(path, grids[part], pattern, box, part, values));
  }
  return Result::Ok();
}

/// The box with what the volume has beyond: all of it, or a voxel.
VoxelBox WithBackground(const VoxelBox& box, const VolumeGrid& pattern, const Box& volume,
                        bool isAllOfIt)
{
  VoxelBox wider = box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto c = static_cast<Eigen::Index>(axis);
    const double low = (volume.Min[c] - pattern.Zero[c]) / pattern.Spacing[c];
    const double high = (volume.Max[c] - pattern.Zero[c]) / pattern.Spacing[c];
    constexpr double whole = 1e-6; // what rounding may take
    const auto beyond = [&](double voxels)
    {
      const double most = isAllOfIt ? std::min(std::ceil(voxels - whole), MostWindVoxels) : 1.0;
      return voxels > 1.0 + whole ? static_cast<int>(most) : 0;
    };
    wider.First[axis] -= beyond(box.First[axis] - low);
    wider.Last[axis] += beyond(high - box.Last[axis]);
  }
  return wider;
}

} // namespace

Result ReadVectorVolumes(const Files& files, const std::string& array, const Timeline& line,
                         const Box& volume, FieldSeries& wind)
{
  WindSeries series;
  WAFT_RETURN_IF_FAILED(FindWind(files, array, series));
  VoxelBox active;
  for (const std::vector<VolumeGrid>& grids : series.Steps)
  {
    for (const VolumeGrid& grid : grids)
    {
      active.Add(ActiveOn(series.Pattern, grid));
    }
  }
  const std::string location = files[series.PatternStep].second + ": ";
  if (active.NumberOfVoxels() > MostWindVoxels)
  {
    return Result::Error(location + "grid `" + series.Pattern.Name +
                         "`: expected at most 256^3 voxels in the box of the active ones, found " +
                         NumberText(active.NumberOfVoxels(), 10));
  }
  const VoxelBox beyond = VoxelBox{ active.Last, active.Last }.Moved({ 2, 2, 2 });
  FieldSeries::Field background;
  Result result = ReadStep(files[series.PatternStep].second, series.Steps[series.PatternStep],
                           series.Pattern, beyond, background);
  const bool isCalm = result && background.front() == std::array<float, 3>{};
  VoxelBox box = WithBackground(active, series.Pattern, volume, !isCalm);
  if (box.NumberOfVoxels() > MostWindVoxels)
  {
    box = WithBackground(active, series.Pattern, volume, false);
  }
  FieldSeries read;
  read.Meaning = series.Meaning;
  static_cast<PointLattice&>(read) = LatticeOf(series.Pattern, box);
  for (std::size_t f = 0; result && f < files.size(); ++f)
  {
    read.Times.push_back(line.Time(files[f].first));
    result =
      ReadStep(files[f].second, series.Steps[f], series.Pattern, box, read.Values.emplace_back());
    result = result ? result : Result::Error(files[f].second + ": " + result.Message());
  }
  WAFT_RETURN_IF_FAILED(result);
  wind = std::move(read);
  return Result::Ok();
}

} // namespace waft
