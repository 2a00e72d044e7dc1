// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneWind.h"

#include "Base/Limits.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

FieldSeries LatticeOver(const Box& volume, const std::vector<AnalyticWind>& winds,
                        const std::vector<WindFront>& fronts)
{
  double spacing = volume.Width() / 16.0;
  for (const AnalyticWind& wind : winds)
  {
    spacing = std::min(spacing, 0.5 * wind.Radius);
  }
  for (const WindFront& front : fronts)
  {
    spacing = std::min(spacing, 0.25 * front.Width); // over which it comes
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

Result SceneWind::Build(const Scene& scene, const SceneAssets& assets)
{
  SceneWind built;
  built.Analytic = scene.Winds;
  built.Fronts = scene.Fronts;
  for (const WindFile& file : scene.WindFiles)
  {
    FieldSeries wind;
    const Result result = assets.LoadWind(file, scene.Info, wind);
    if (!result)
    {
      return Result::Error(file.Location + ": " + result.Message());
    }
    const bool isAlone = scene.WindFiles.size() == 1 && scene.Winds.empty() && scene.Fronts.empty();
    if (wind.Meaning == FieldMeaning::Velocity && !isAlone)
    {
      return Result::Error(file.Location + ": expected the only wind of the scene (its `Velocity` "
                                           "draws by drag and does not add up with others)");
    }
    built.Remark(file, wind, scene.Info);
    built.Files.push_back(std::move(wind));
  }
  built.Lattice = LatticeOver(scene.Info.Bounds, built.Analytic, built.Fronts);
  for (const FieldSeries& wind : built.Files)
  {
    const bool isFirst = &wind == &built.Files.front();
    if (isFirst || wind.Spacing.minCoeff() < built.Lattice.Spacing.minCoeff())
    {
      static_cast<PointLattice&>(built.Lattice) = wind;
      built.Lattice.Meaning = wind.Meaning;
    }
  }
  *this = std::move(built);
  return Result::Ok();
}

// What of a file is odd: it is read well, and yet hardly what was meant.
void SceneWind::Remark(const WindFile& file, const FieldSeries& wind, const SceneInfo& info)
{
  const double last = info.Time.Time(info.Time.NumberOfFrames - 1);
  const auto frameOf = [&](double time)
  { return NumberText(std::round(time * info.Time.FramesPerSecond), 10); };
  if (wind.Times.size() > 1 && wind.Times.front() > last)
  {
    this->Odd.push_back(file.Location + ": the series begins at frame " +
                        frameOf(wind.Times.front()) + ", the scene ends at frame " + frameOf(last) +
                        ": its first field holds throughout; `firstFrame` says where it begins");
  }
  const Vec3 size = Vec3(wind.Dimensions[0] - 1, wind.Dimensions[1] - 1, wind.Dimensions[2] - 1)
                      .cwiseProduct(wind.Spacing);
  const Vec3 end = wind.Origin + size;
  if ((wind.Origin.array() > info.Bounds.Max.array()).any() ||
      (end.array() < info.Bounds.Min.array()).any())
  {
    this->Odd.push_back(file.Location + ": the wind's field is outside the volume: from " +
                        PointText(wind.Origin) + " to " + PointText(end));
  }
}

void SceneWind::WholeExtent(int extent[6]) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis] = 0;
    extent[2 * axis + 1] = this->IsEmpty() ? -1 : this->Lattice.Dimensions[axis] - 1;
  }
}

FieldSeries SceneWind::At(double time) const
{
  if (this->IsEmpty())
  {
    return {};
  }
  FieldSeries now = this->Lattice;
  now.Times = { time };
  now.Values.resize(1);
  for (std::size_t i = 0; i < now.NumberOfPoints(); ++i)
  {
    const Vec3 x = now.PointAt(i);
    Vec3 value = Vec3::Zero();
    for (const AnalyticWind& wind : this->Analytic)
    {
      value += wind.Acceleration(x, time);
    }
    for (const WindFront& front : this->Fronts)
    {
      value += front.Acceleration(x, time);
    }
    for (const FieldSeries& wind : this->Files)
    {
      value += wind.Sample(x, time);
    }
    now.Values[0].push_back({ float(value.x()), float(value.y()), float(value.z()) });
  }
  return now;
}

FieldSeries SceneWind::OfFrames(const Timeline& line) const
{
  if (this->IsEmpty())
  {
    return {};
  }
  FieldSeries all = this->Lattice;
  for (int frame = 0; frame < line.NumberOfFrames; ++frame)
  {
    FieldSeries now = this->At(line.Time(frame));
    all.Times.push_back(now.Times.front());
    all.Values.push_back(std::move(now.Values.front()));
  }
  return all;
}

bool SceneWind::Makes(const FieldSeries& field) const
{
  constexpr double tolerance = 1e-6; // of values, which are floats, and of a spacing
  const Vec3 shift = field.Origin - this->Lattice.Origin;
  const Vec3 stretch = field.Spacing - this->Lattice.Spacing;
  const double least = tolerance * this->Lattice.Spacing.minCoeff();
  if (this->IsEmpty() || field.IsEmpty() || field.Meaning != this->Lattice.Meaning ||
      field.Dimensions != this->Lattice.Dimensions || shift.norm() > least ||
      stretch.norm() > least)
  {
    return false;
  }
  const auto isSame = [&](const std::array<float, 3>& a, const std::array<float, 3>& b)
  {
    const Vec3 u(a[0], a[1], a[2]);
    const Vec3 v(b[0], b[1], b[2]);
    return (u - v).norm() <= tolerance * std::max(1.0, u.norm());
  };
  for (std::size_t step = 0; step < field.Times.size(); ++step)
  {
    const FieldSeries now = this->At(field.Times[step]);
    if (!std::equal(now.Values[0].begin(), now.Values[0].end(), field.Values[step].begin(),
                    field.Values[step].end(), isSame))
    {
      return false;
    }
  }
  return true;
}

} // namespace waft
