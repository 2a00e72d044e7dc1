// SPDX-License-Identifier: BSD-3-Clause
// All winds of a scene as one field on a lattice.
#pragma once

#include "Base/FieldSeries.h"
#include "Scene/Scene.h"

namespace waft
{

/// Analytic winds, fronts and wind files added up. The lattice is the finest of the files'; without
/// files one over the volume whose spacing is a sixteenth of its width or half the smallest radius
/// or width, at most 65 points a side.
class SceneWind
{
public:
  /// Reads the files by `assets`. Fails when one cannot be read (the message names its place in the
  /// scene) or when a file with `Velocity` comes together with another wind: drag and acceleration
  /// do not add up.
  Result Build(const Scene& scene, const SceneAssets& assets);
  /// What of the files is odd, a sentence each: a series that begins after the scene's end, a field
  /// outside the volume.
  const std::vector<std::string>& Warnings() const { return this->Odd; }
  bool IsEmpty() const
  {
    return this->Analytic.empty() && this->Fronts.empty() && this->Files.empty();
  }
  /// The extent of the lattice (0, -1, ... without wind).
  void WholeExtent(int extent[6]) const;
  /// The field at a time [s], a series of one step; empty when there is no wind.
  FieldSeries At(double time) const;
  /// The fields at all frames; empty when there is no wind.
  FieldSeries OfFrames(const Timeline& line) const;

  /// Whether it has the values of a field that was made of it once, at all the field's times.
  bool Makes(const FieldSeries& field) const;

private:
  void Remark(const WindFile& file, const FieldSeries& wind, const SceneInfo& info);

  std::vector<AnalyticWind> Analytic;
  std::vector<WindFront> Fronts;
  std::vector<FieldSeries> Files;
  std::vector<std::string> Odd;
  FieldSeries Lattice; // its dimensions, origin, spacing and meaning
};

} // namespace waft
