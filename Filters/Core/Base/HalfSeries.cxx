// SPDX-License-Identifier: BSD-3-Clause
#include "Base/HalfSeries.h"

#include "Base/Half.h"

#include <algorithm>

namespace waft
{

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
  const std::uint16_t* from = halves.data()->data();
  std::transform(from, from + 3 * halves.size(), field.data()->data(), FromHalf);
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
  const float* from = field.data()->data();
  std::transform(from, from + 3 * field.size(), halves.data()->data(), ToHalf);
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
