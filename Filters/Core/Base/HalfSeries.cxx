// SPDX-License-Identifier: BSD-3-Clause
#include "Base/HalfSeries.h"

#include "Base/Half.h"
#include "Base/Simd.h"

#include <algorithm>

namespace waft
{
namespace
{

WAFT_SIMD_CLONES void FromHalves(const std::uint16_t* from, std::size_t count, float* to)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] = FromHalf(from[i]);
  }
}

WAFT_SIMD_CLONES void ToHalves(const float* from, std::size_t count, std::uint16_t* to)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] = ToHalf(from[i]);
  }
}

} // namespace

HalfSeries::HalfSeries(const FieldSeries& series) : SeriesLattice(series)
{
  this->Values.resize(series.Values.size());
  for (std::size_t k = 0; k < series.Values.size(); ++k)
  {
    this->Set(k, series.Values[k]);
  }
}

HalfSeries::Field HalfSeries::At(std::size_t k) const
{
  const std::vector<Half3>& halves = this->Values[k];
  Field field(halves.size());
  if (halves.empty())
  {
    return field;
  }
  FromHalves(halves.data()->data(), 3 * halves.size(), field.data()->data());
  return field;
}

void HalfSeries::Set(std::size_t k, const Field& field)
{
  std::vector<Half3>& halves = this->Values[k];
  halves.resize(field.size());
  if (field.empty())
  {
    return;
  }
  ToHalves(field.data()->data(), 3 * field.size(), halves.data()->data());
}

FieldSeries HalfSeries::Around(double time) const
{
  FieldSeries around{ static_cast<const SeriesLattice&>(*this) };
  around.Times.clear();
  const auto above = std::upper_bound(this->Times.begin(), this->Times.end(), time);
  const auto after = static_cast<std::size_t>(above - this->Times.begin());
  const std::size_t end = std::min(after + 1, this->Values.size());
  for (std::size_t k = after > 0 ? after - 1 : 0; k < end; ++k)
  {
    around.Times.push_back(this->Times[k]);
    around.Values.push_back(this->At(k));
  }
  return around;
}

} // namespace waft
