// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/SceneWind.h"

#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Files/WindFiles.h"

#include <vtkImageData.h>

#include <cmath>

namespace waft
{
namespace
{

FieldSeries LatticeOver(const Box& volume, const std::vector<AnalyticWind>& winds)
{
  double spacing = volume.Width() / 16.0;
  for (const AnalyticWind& wind : winds)
  {
    spacing = std::min(spacing, 0.5 * wind.Radius);
  }
  FieldSeries lattice;
  lattice.Origin = volume.Min;
  for (int axis = 0; axis < 3; ++axis)
  {
    constexpr double most = 64.0;
    const double cells = std::clamp(std::ceil(volume.Size()[axis] / spacing - 1e-9), 1.0, most);
    lattice.Dimensions[static_cast<std::size_t>(axis)] = static_cast<int>(cells) + 1;
    lattice.Spacing[axis] = volume.Size()[axis] / cells;
  }
  return lattice;
}

} // namespace

Result SceneWind::Build(const Scene& scene)
{
  SceneWind built;
  built.Analytic = scene.Winds;
  for (const WindFile& file : scene.WindFiles)
  {
    FieldSeries wind;
    const Result result = ReadWindFile(file.Path, scene.Info.Time, wind);
    if (!result)
    {
      return Result::Error(file.Place + ": " + result.Message());
    }
    const bool isAlone = scene.WindFiles.size() == 1 && scene.Winds.empty();
    if (wind.Meaning == FieldMeaning::Velocity && !isAlone)
    {
      return Result::Error(file.Place + ": expected the only wind of the scene (its `Velocity` "
                                        "draws by drag and does not add up with others)");
    }
    built.Files.push_back(std::move(wind));
  }
  built.Lattice = LatticeOver(scene.Info.Bounds, built.Analytic);
  for (const FieldSeries& wind : built.Files)
  {
    const bool isFirst = &wind == &built.Files.front();
    if (isFirst || wind.Spacing.minCoeff() < built.Lattice.Spacing.minCoeff())
    {
      built.Lattice.Dimensions = wind.Dimensions;
      built.Lattice.Origin = wind.Origin;
      built.Lattice.Spacing = wind.Spacing;
      built.Lattice.Meaning = wind.Meaning;
    }
  }
  *this = std::move(built);
  return Result::Ok();
}

void SceneWind::WholeExtent(int extent[6]) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = 0;
    extent[2 * axis + 1] = this->IsEmpty() ? -1 : this->Lattice.Dimensions[axis] - 1;
  }
}

void SceneWind::Fill(double time, const SceneInfo& info, vtkImageData* image) const
{
  image->Initialize();
  if (this->IsEmpty())
  {
    SceneInfoToFieldData(info, image);
    return;
  }
  FieldSeries now = this->Lattice;
  now.Times = { time };
  now.Values.resize(1);
  for (std::size_t i = 0; i < now.NumberOfPoints(); ++i)
  {
    const auto nx = static_cast<std::size_t>(now.Dimensions[0]);
    const auto ny = static_cast<std::size_t>(now.Dimensions[1]);
    const Vec3 place(static_cast<double>(i % nx), static_cast<double>(i / nx % ny),
                     static_cast<double>(i / nx / ny));
    const Vec3 x = now.Origin + place.cwiseProduct(now.Spacing);
    Vec3 value = Vec3::Zero();
    for (const AnalyticWind& wind : this->Analytic)
    {
      value += wind.Acceleration(x, time);
    }
    for (const FieldSeries& wind : this->Files)
    {
      value += wind.Sample(x, time);
    }
    now.Values[0].push_back({ float(value.x()), float(value.y()), float(value.z()) });
  }
  FieldSeriesToImage(now, time, info, image);
}

} // namespace waft
