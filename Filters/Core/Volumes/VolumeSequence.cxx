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

// The grids of a file that are on the lattice and of the kind that they were of before.
void VolumeSequence::AddStep(int frame, const std::string& path, const VolumeContents& contents)
{
  Step step;
  step.Frame = frame;
  step.Path = path;
  for (const VolumeGrid& grid : contents.Grids)
  {
    // An empty grid has nothing to look up, on whatever lattice.
    const auto shift =
      grid.Active.IsEmpty() ? std::array<int, 3>{} : ShiftOnto(this->Pattern, grid);
    const auto kind =
      std::lower_bound(this->Kinds.begin(), this->Kinds.end(), grid.Name,
                       [](const Kind& one, const std::string& name) { return one.Grid < name; });
    const bool isNew = kind == this->Kinds.end() || kind->Grid != grid.Name;
    if (grid.Components == 0 || !shift || (!isNew && kind->Components != grid.Components))
    {
      this->Omitted.push_back(path + ": grid `" + grid.Name + "`");
      continue;
    }
    if (isNew)
    {
      this->Kinds.insert(kind, { grid.Name, grid.Name, grid.Components });
    }
    step.Shifts[grid.Name] = *shift;
    this->Voxels.Add(grid.Active.IsEmpty() ? VoxelBox() : grid.Active.Moved(*shift));
  }
  this->Steps.push_back(std::move(step));
}

// As other stages know the fields, where no other grid is called so.
void VolumeSequence::NameFields()
{
  for (Kind& kind : this->Kinds)
  {
    const std::string wanted = FieldNameOf(kind.Grid);
    const bool isTaken =
      std::any_of(this->Kinds.begin(), this->Kinds.end(),
                  [&](const Kind& other)
                  { return &other != &kind && (other.Grid == wanted || other.Field == wanted); });
    kind.Field = isTaken ? kind.Grid : wanted;
  }
}

Result VolumeSequence::Open(const std::string& path, double framesPerSecond)
{
  *this = VolumeSequence();
  VolumeSequence opened;
  const std::vector<std::pair<int, std::string>> files = SeriesFiles(path);
  std::vector<VolumeContents> contents;
  WAFT_RETURN_IF_FAILED(ListSeries(files, contents));
  if (files.empty())
  {
    return Result::Error(path + ": expected a .vdb file, found none");
  }
  std::string owner; // of the pattern
  for (const int components : { 3, 1 })
  {
    for (std::size_t f = 0; f < files.size() && owner.empty(); ++f)
    {
      for (const VolumeGrid& grid : contents[f].Grids)
      {
        if (grid.Components == components && !grid.Active.IsEmpty() && owner.empty())
        {
          opened.Pattern = grid;
          owner = files[f].second;
        }
      }
    }
  }
  if (owner.empty())
  {
    return Result::Error(path + ": expected a grid of numbers or vectors with active voxels");
  }
  if (!opened.Pattern.IsUpright)
  {
    return Result::Error(owner + ": grid `" + opened.Pattern.Name +
                         "`: expected a transform that scales and shifts only");
  }
  for (std::size_t f = 0; f < files.size(); ++f)
  {
    opened.AddStep(files[f].first, files[f].second, contents[f]);
  }
  opened.NameFields();
  opened.HasScene = contents.front().HasScene;
  opened.Info = contents.front().Scene;
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
  const Step& of = this->Steps[step];
  for (const Kind& kind : this->Kinds)
  {
    VolumeField field;
    field.Components = kind.Components;
    const auto shift = of.Shifts.find(kind.Grid);
    if (shift == of.Shifts.end())
    {
      field.Values.assign(read.NumberOfPoints() * static_cast<std::size_t>(kind.Components), 0.0f);
    }
    else
    {
      const auto& [i, j, k] = shift->second;
      const Result result =
        ReadVolumeGrid(of.Path, kind.Grid, this->Voxels.Moved({ -i, -j, -k }), field);
      if (!result)
      {
        return Result::Error(of.Path + ": " + result.Message());
      }
    }
    field.Name = kind.Field;
    read.Fields.push_back(std::move(field));
  }
  volume = std::move(read);
  return Result::Ok();
}

} // namespace waft
