// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/AirSymmetry.h"

#include <cmath>

namespace waft
{

Mat3 AirSymmetry::Matrix() const
{
  Mat3 mirror = Mat3::Identity();
  mirror(0, 0) = this->Mirrored ? -1.0 : 1.0;
  Mat3 quarter;
  quarter << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  Mat3 turn = Mat3::Identity();
  for (int k = 0; k < this->QuarterTurns; ++k)
  {
    turn = quarter * turn;
  }
  return turn * mirror;
}

std::string AirSymmetry::Text() const
{
  const std::string turned = this->QuarterTurns > 0
                               ? "turned by " + std::to_string(90 * this->QuarterTurns) + " degrees"
                               : std::string();
  const std::string mirrored = this->Mirrored ? "mirrored" : "";
  return turned + (turned.empty() || mirrored.empty() ? "" : ", ") + mirrored;
}

std::vector<AirSymmetry> AirSymmetries(const Box& volume)
{
  std::vector<AirSymmetry> all;
  const Vec3 size = volume.Size();
  const bool square = std::abs(size.x() - size.y()) <= 1e-9 * size.x();
  for (const bool mirrored : { false, true })
  {
    for (int turns = 0; turns < 4; ++turns)
    {
      if ((turns == 0 && !mirrored) || square)
      {
        all.push_back({ turns, mirrored });
      }
    }
  }
  return all;
}

HalfSeries Image(const AirSymmetry& symmetry, const HalfSeries& field)
{
  HalfSeries image{ static_cast<const SeriesLattice&>(field) };
  image.Values.resize(field.Values.size());
  const Mat3 m = symmetry.Matrix();
  const std::array<int, 3>& n = field.Dimensions;
  const Vec3 middle(0.5 * (n[0] - 1), 0.5 * (n[1] - 1), 0.5 * (n[2] - 1));
  std::vector<std::size_t> sources;
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const Vec3 from = middle + m.transpose() * (Vec3(i, j, k) - middle);
        sources.push_back(static_cast<std::size_t>(
          (std::lround(from.z()) * n[1] + std::lround(from.y())) * n[0] + std::lround(from.x())));
      }
    }
  }
  for (std::size_t f = 0; f < field.Values.size(); ++f)
  {
    const HalfSeries::Field values = field.At(f);
    HalfSeries::Field turned(values.size());
    for (std::size_t at = 0; at < sources.size(); ++at)
    {
      const std::array<float, 3>& v = values[sources[at]];
      const Vec3 u = m * Vec3(v[0], v[1], v[2]);
      turned[at] = { static_cast<float>(u.x()), static_cast<float>(u.y()),
                     static_cast<float>(u.z()) };
    }
    image.Set(f, turned);
  }
  return image;
}

SmokeForces Image(const AirSymmetry& symmetry, const Box& volume, const SmokeForces& forces)
{
  SmokeForces image = forces;
  const Mat3 m = symmetry.Matrix();
  const auto moved = [&](const Vec3& p)
  { return Vec3(volume.Center() + m * (p - volume.Center())); };
  for (Vortex& vortex : image.Vortices)
  {
    vortex.P1 = moved(vortex.P1);
    vortex.P2 = moved(vortex.P2);
    vortex.Strength *= symmetry.Mirrored ? -1.0 : 1.0; // a mirror image turns the other way
  }
  for (AnalyticWind& wind : image.Winds)
  {
    wind.Center = moved(wind.Center);
    wind.Direction = m * wind.Direction;
  }
  return image;
}

} // namespace waft
