// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Field/AirSymmetry.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace waft
{
namespace
{

constexpr std::uint16_t HalfSign = 0x8000; // the bit

}

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
  return turned + (turned.empty() && mirrored.empty() ? "as drawn" : "") +
         (turned.empty() || mirrored.empty() ? "" : ", ") + mirrored;
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
      if (square || turns % 2 == 0)
      {
        all.push_back({ turns, mirrored });
      }
    }
  }
  return all;
}

void SetImage(const AirSymmetry& symmetry, const HalfSeries& field, HalfSeries& image)
{
  static_cast<SeriesLattice&>(image) = field;
  image.Values.resize(field.Values.size());
  const Mat3 m = symmetry.Matrix();
  const std::array<int, 3>& n = field.Dimensions;
  const Vec3 middle(0.5 * (n[0] - 1), 0.5 * (n[1] - 1), 0.5 * (n[2] - 1));
  std::vector<std::uint32_t> sources;
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const Vec3 from = middle + m.transpose() * (Vec3(i, j, k) - middle);
        sources.push_back(static_cast<std::uint32_t>(
          (std::lround(from.z()) * n[1] + std::lround(from.y())) * n[0] + std::lround(from.x())));
      }
    }
  }
  // Which component each one is, and its sign.
  std::array<std::size_t, 3> of{};
  std::array<std::uint16_t, 3> sign{};
  for (std::size_t c = 0; c < 3; ++c)
  {
    m.row(static_cast<int>(c)).cwiseAbs().maxCoeff(&of[c]);
    sign[c] = m(static_cast<int>(c), static_cast<int>(of[c])) < 0.0 ? HalfSign : 0;
  }
  for (std::size_t f = 0; f < field.Values.size(); ++f)
  {
    const Half3* from = field.Values[f].data();
    image.Values[f].resize(sources.size());
    Half3* to = image.Values[f].data();
    for (const std::uint32_t source : sources)
    {
      const Half3& value = from[source];
      for (std::size_t c = 0; c < 3; ++c)
      {
        (*to)[c] = static_cast<std::uint16_t>(value[of[c]] ^ sign[c]);
      }
      ++to;
    }
  }
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
