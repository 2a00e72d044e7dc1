// SPDX-License-Identifier: BSD-3-Clause
// A time series of OpenVDB files as fields on one lattice.
#pragma once

#include "Volumes/VolumeFile.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace waft
{

/// The lattice is that of the first vector grid with active voxels, in the order of the files, else
/// of the first such grid, over the active voxels of all grids of all files. Grids named velocity,
/// vel or v are called `Velocity`, wind `Wind`, density `Density`, whatever their case, unless a
/// file has one of that name.
class VolumeSequence
{
public:
  /// path: any file of the series (SeriesFiles). framesPerSecond: 0: as the files say, else 30.
  /// Fails, naming file and grid, when a file cannot be read, when there is no grid of numbers or
  /// vectors with active voxels, or when it is turned. On failure there are no steps.
  Result Open(const std::string& path, double framesPerSecond);

  std::size_t NumberOfSteps() const { return this->Steps.size(); }
  double Time(std::size_t step) const; // s, growing
  /// Grids that are left out, since they lie on another lattice or are of another kind.
  const std::vector<std::string>& LeftOut() const { return this->Omitted; }
  /// What the files say; else the lattice's voxels and the frames of the series.
  const SceneInfo& Scene() const { return this->Info; }
  /// Dimensions, Origin and Spacing of every step, without fields.
  const Volume& Lattice() const { return this->Outline; }

  /// The same fields at each step, in the order of their grids' names: the grid's background where
  /// it has no active voxels, zero where the step's file has no such grid.
  Result Read(std::size_t step, Volume& volume) const;

private:
  struct Kind // of a grid, as the first file that has it says
  {
    std::string Grid, Field; // in the files, as the field is called
    int Components = 1;
  };
  struct Step
  {
    int Frame = 0;
    std::string Path;
    std::map<std::string, std::array<int, 3>> Shifts; // of the grids that it has, onto the lattice
  };
  void AddStep(int frame, const std::string& path, const VolumeContents& contents);
  void NameFields();

  std::vector<Kind> Kinds; // in the order of the grids' names
  std::vector<Step> Steps;
  std::vector<std::string> Omitted;
  SceneInfo Info;
  bool HasScene = false;
  VolumeGrid Pattern; // whose lattice it is
  VoxelBox Voxels;
  Volume Outline;
};

} // namespace waft
