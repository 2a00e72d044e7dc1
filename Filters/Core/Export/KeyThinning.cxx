// SPDX-License-Identifier: BSD-3-Clause
#include "Export/KeyThinning.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace waft
{
namespace
{

constexpr std::size_t LongestSpan = 64; // the cost of a key does not grow with the animation

using Vec4 = Eigen::Vector4d;

class Thinner
{
public:
  Thinner(const BodyKeys& keys, double placeTolerance, double turnTolerance) :
    Keys(keys), MostSquared(placeTolerance * placeTolerance),
    LeastCosine(std::cos(0.5 * turnTolerance)) // a quaternion has half the angle
  {
  }

  /// The last key up to `end` until which the body is as it is at `from`.
  std::size_t StillUntil(std::size_t from, std::size_t end) const
  {
    std::size_t to = from;
    while (to < end && this->IsSame(from, to + 1))
    {
      ++to;
    }
    return to;
  }

  /// Whether two keys give back all between them.
  bool Spans(std::size_t from, std::size_t to) const
  {
    const Vec4 begin = this->Turn(from), end = this->Turn(to);
    const double cosine = begin.dot(end);
    if (cosine < 0.0) // readers would differ in the way round
    {
      return false;
    }
    const double angle = std::acos(std::min(1.0, cosine)), sine = std::sin(angle);
    const double first = this->Keys.Times[from], length = this->Keys.Times[to] - first;
    const Vec3 start = this->Place(from), way = this->Place(to) - start;
    for (std::size_t k = from + 1; k < to; ++k)
    {
      const double part = (this->Keys.Times[k] - first) / length;
      if ((start + part * way - this->Place(k)).squaredNorm() > this->MostSquared)
      {
        return false;
      }
      const Vec4 wanted = this->Turn(k);
      const Vec4 mean = (1.0 - part) * begin + part * end;
      const Vec4 slerp =
        sine < 1e-9
          ? mean
          : Vec4((std::sin((1.0 - part) * angle) * begin + std::sin(part * angle) * end) / sine);
      if (!this->AreNear(mean, wanted) || !this->AreNear(slerp, wanted))
      {
        return false;
      }
    }
    return true;
  }

private:
  bool IsSame(std::size_t a, std::size_t b) const
  {
    const auto same = [&](const std::vector<float>& values, std::size_t width)
    {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(a * width);
      return std::equal(first, first + static_cast<std::ptrdiff_t>(width),
                        values.begin() + static_cast<std::ptrdiff_t>(b * width));
    };
    return same(this->Keys.Places, BodyKeys::PlaceWidth) &&
           same(this->Keys.Turns, BodyKeys::TurnWidth);
  }
  Vec3 Place(std::size_t k) const
  {
    return Eigen::Map<const Eigen::Vector3f>(&this->Keys.Places[BodyKeys::PlaceWidth * k])
      .cast<double>();
  }
  Vec4 Turn(std::size_t k) const
  {
    return Eigen::Map<const Eigen::Vector4f>(&this->Keys.Turns[BodyKeys::TurnWidth * k])
      .cast<double>()
      .normalized();
  }
  bool AreNear(const Vec4& turn, const Vec4& unit) const
  {
    return std::abs(turn.dot(unit)) >= this->LeastCosine * turn.norm();
  }

  const BodyKeys& Keys;
  double MostSquared, LeastCosine;
};

/// The numbers of the keys that are kept: with `isGreedy` up to the tolerances, else but for those
/// at which the body lies still.
std::vector<std::size_t> Kept(const Thinner& thinner, std::size_t count,
                              const std::vector<int>& marks, bool isGreedy)
{
  std::vector<std::size_t> stops{ count - 1 }; // where a span ends in any case
  for (const int mark : marks)
  {
    if (mark > 0 && static_cast<std::size_t>(mark) < count)
    {
      stops.push_back(static_cast<std::size_t>(mark));
    }
  }
  std::sort(stops.begin(), stops.end());
  std::vector<std::size_t> kept{ 0 };
  auto stop = stops.begin();
  while (kept.back() < count - 1)
  {
    const std::size_t from = kept.back();
    stop = std::upper_bound(stop, stops.end(), from);
    std::size_t to = std::max(from + 1, thinner.StillUntil(from, *stop));
    const std::size_t most = isGreedy ? std::min(*stop, from + LongestSpan) : to;
    while (to < most && thinner.Spans(from, to + 1))
    {
      ++to;
    }
    kept.push_back(to);
  }
  return kept;
}

/// Both ends of each gap between keys, which say all of few numbers.
std::vector<std::size_t> GapsOf(const std::vector<std::size_t>& kept)
{
  std::vector<std::size_t> gaps;
  for (std::size_t i = 1; i < kept.size(); ++i)
  {
    if (kept[i] > kept[i - 1] + 1)
    {
      gaps.insert(gaps.end(), { kept[i - 1], kept[i] });
    }
  }
  return gaps;
}

void Keep(const std::vector<std::size_t>& kept, std::size_t width, std::vector<float>& values)
{
  std::vector<float> some;
  some.reserve(kept.size() * width);
  for (const std::size_t k : kept)
  {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(k * width);
    some.insert(some.end(), first, first + static_cast<std::ptrdiff_t>(width));
  }
  values.swap(some);
}

} // namespace

void KeyThinning::Add(const BodyKeys& keys, const std::vector<int>& marks)
{
  const Thinner thinner(keys, 0.0, 0.0);
  ++this->Shared[GapsOf(Kept(thinner, keys.Count(), marks, false))].Bodies;
}

std::size_t KeyThinning::Thin(const std::vector<int>& marks, double placeTolerance,
                              double turnTolerance, BodyKeys& keys)
{
  constexpr std::size_t width = BodyKeys::PlaceWidth + BodyKeys::TurnWidth;
  const std::size_t count = keys.Count();
  std::vector<std::size_t> kept(count); // all: their times are there once
  std::iota(kept.begin(), kept.end(), 0);
  std::size_t numbers = count * width;
  std::vector<std::size_t> gaps;
  const Thinner thinner(keys, placeTolerance, turnTolerance);
  std::vector<std::size_t> moving = Kept(thinner, count, marks, false);
  std::vector<std::size_t> ownGaps = GapsOf(moving);
  const std::size_t bodies = std::max<std::size_t>(1, this->Shared[ownGaps].Bodies);
  if (moving.size() * width + moving.size() / bodies < numbers)
  {
    numbers = moving.size() * width + moving.size() / bodies;
    kept.swap(moving);
    gaps.swap(ownGaps);
  }
  std::vector<std::size_t> few = Kept(thinner, count, marks, true);
  std::size_t number = this->Numbers;
  if (few.size() * (width + 1) < numbers)
  {
    kept.swap(few);
  }
  else
  {
    List& list = this->Shared[gaps];
    list.Number = std::min(list.Number, number);
    number = list.Number;
  }
  this->Numbers = std::max(this->Numbers, number + 1);
  Keep(kept, 1, keys.Times);
  Keep(kept, BodyKeys::PlaceWidth, keys.Places);
  Keep(kept, BodyKeys::TurnWidth, keys.Turns);
  return number;
}

} // namespace waft
