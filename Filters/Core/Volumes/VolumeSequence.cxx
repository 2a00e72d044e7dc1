// SPDX-License-Identifier: BSD-3-Clause
#include "Volumes/VolumeSequence.h"

#include "Volumes/VolumeSeries.h"

#include <algorithm>
#include <cctype>

namespace waft
{

namespace
{

constexpr double DefaultRate = 30.0; // frames per second

std::string FieldNameOf(const std::string& grid)
{
  std::string lower = grid;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::pair<const char*, const char*> known[] = {
    { "velocity", "Velocity" }, { "vel", "Velocity" },    { "v", "Velocity" },
    { "wind", "Wind" },         { "density", "Density" },
  };
  for (const auto& [name, field] : known)
  {
    if (lower == name)
    {
      return field;
    }
  }
  return grid;
}

} // namespace

Result VolumeSequence::AddStep(int frame, const std::string& path, bool& hasLattice)
{
  VolumeContents contents;
  if (Result listed = ListVolume(path, contents); !listed)
  {
    return Result::Error(path + ": " + listed.Message());
  }
  if (!hasLattice)
  {
    for (const int components : { 3, 1 })
    {
      for (const VolumeGrid& grid : contents.Grids)
      {
        if (grid.Components == components && !grid.Active.IsEmpty() && !hasLattice)
        {
          this->Pattern = grid;
          hasLattice = true;
        }
      }
    }
    if (hasLattice && !this->Pattern.IsUpright)
    {
      return Result::Error(path + ": grid `" + this->Pattern.Name +
                           "`: expected a transform that scales and shifts only");
    }
  }
  if (this->Steps.empty())
  {
    this->HasScene = contents.HasScene;
    this->Info = contents.Scene;
  }
  Step step;
  step.Frame = frame;
  step.Path = path;
  for (const VolumeGrid& grid : contents.Grids)
  {
    // An empty grid has nothing to look up, on whatever lattice.
    if (grid.Components == 0 ||
        (!grid.Active.IsEmpty() && hasLattice && !HasLatticeOf(grid, this->Pattern)))
    {
      this->Omitted.push_back(path + ": grid `" + grid.Name + "`");
      continue;
    }
    const std::string wanted = FieldNameOf(grid.Name);
    const bool isTaken = std::any_of(contents.Grids.begin(), contents.Grids.end(),
                                     [&](const VolumeGrid& other)
                                     { return other.Name == wanted && other.Name != grid.Name; }) ||
                         std::any_of(step.Grids.begin(), step.Grids.end(),
                                     [&](const auto& other) { return other.second == wanted; });
    step.Grids.emplace_back(grid.Name, isTaken ? grid.Name : wanted);
    this->Voxels.Add(grid.Active);
  }
  this->Steps.push_back(std::move(step));
  return Result::Ok();
}

Result VolumeSequence::Open(const std::string& path, double framesPerSecond)
{
  *this = VolumeSequence();
  VolumeSequence opened;
  bool hasLattice = false;
  for (const auto& [frame, file] : SeriesFiles(path))
  {
    if (!opened.Steps.empty() && opened.Steps.back().Frame == frame)
    {
      return Result::Error(file + ": expected one file a frame, found two");
    }
    WAFT_RETURN_IF_FAILED(opened.AddStep(frame, file, hasLattice));
  }
  if (opened.Steps.empty())
  {
    return Result::Error(path + ": expected a .vdb file, found none");
  }
  if (!hasLattice)
  {
    return Result::Error(path + ": expected a grid of numbers or vectors with active voxels");
  }
  if (opened.Voxels.NumberOfVoxels() > MostVoxels)
  {
    return Result::Error(path + ": expected at most 512^3 voxels in the box of the active ones");
  }
  const VolumeGrid& pattern = opened.Pattern;
  const std::array<int, 3>& first = opened.Voxels.First;
  Volume& outline = opened.Outline;
  outline.Dimensions = opened.Voxels.Dimensions();
  outline.Spacing = pattern.Spacing;
  outline.Origin = pattern.Zero + Vec3(first[0], first[1], first[2]).cwiseProduct(pattern.Spacing);
  SceneInfo& scene = opened.Info;
  if (!opened.HasScene)
  {
    const std::array<int, 3>& n = outline.Dimensions;
    scene = SceneInfo();
    scene.Bounds.Min = outline.Origin - 0.5 * outline.Spacing;
    scene.Bounds.Max = scene.Bounds.Min + Vec3(n[0], n[1], n[2]).cwiseProduct(outline.Spacing);
    scene.Time = Timeline{ opened.Steps.back().Frame + 1, DefaultRate };
  }
  if (framesPerSecond > 0.0)
  {
    scene.Time.FramesPerSecond = framesPerSecond;
  }
  scene.Time.NumberOfFrames = std::max(scene.Time.NumberOfFrames, opened.Steps.back().Frame + 1);
  *this = std::move(opened);
  return Result::Ok();
}

double VolumeSequence::Time(std::size_t step) const
{
  return this->Info.Time.Time(this->Steps[step].Frame);
}

Result VolumeSequence::Read(std::size_t step, Volume& volume) const
{
  Volume read = this->Outline;
  for (const auto& [grid, name] : this->Steps[step].Grids)
  {
    VolumeField field;
    if (Result result = ReadVolumeGrid(this->Steps[step].Path, grid, this->Voxels, field); !result)
    {
      return Result::Error(this->Steps[step].Path + ": " + result.Message());
    }
    field.Name = name;
    read.Fields.push_back(std::move(field));
  }
  volume = std::move(read);
  return Result::Ok();
}

} // namespace waft
