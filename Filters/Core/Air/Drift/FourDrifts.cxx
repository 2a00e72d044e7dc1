// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/FourDrifts.h"

#include "Base/Simd.h"

#include <algorithm>

namespace waft
{
namespace
{

using Sums = FourDrifts::Sums;

WAFT_INLINE void Store(const Double4& values, Sums& sums)
{
  sums = { values[0], values[1], values[2], values[3] };
}

WAFT_SIMD_CLONES void Dot(const Double4* a, const Double4* b, std::size_t count, Sums& sums)
{
  Double4 sum{};
  for (std::size_t i = 0; i < count; ++i)
  {
    sum += a[i] * b[i];
  }
  Store(sum, sums);
}

WAFT_SIMD_CLONES void TurnTo(const Double4* solved, double part, std::size_t count, Double4* along)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    along[i] = solved[i] + part * along[i];
  }
}

WAFT_SIMD_CLONES void GoAlong(const Double4* along, const Double4* image, double length,
                              std::size_t count, Double4* step, Double4* rest, Sums& sums)
{
  Double4 sum{};
  for (std::size_t i = 0; i < count; ++i)
  {
    step[i] += length * along[i];
    const Double4 left = rest[i] - length * image[i];
    rest[i] = left;
    sum += left * left;
  }
  Store(sum, sums);
}

WAFT_SIMD_CLONES void PromiseOfEach(const Double4* step, const Double4* descent, double damping,
                                    std::size_t count, Sums& sums)
{
  Double4 sum{};
  for (std::size_t i = 0; i < count; ++i)
  {
    sum += 0.5 * step[i] * (descent[i] + damping * step[i]);
  }
  Store(sum, sums);
}

} // namespace

FourDrifts::FourDrifts(std::size_t frames, std::size_t halfBand) :
  Matrix(3 * frames, halfBand), IsFree(frames), Descent(3 * frames), Step(3 * frames),
  Rest(3 * frames), Along(3 * frames), Product(3 * frames), Image(3 * frames)
{
}

void FourDrifts::Set(std::size_t body, const DriftEquations& equations)
{
  const BandedMatrix& lower = equations.Lower();
  const std::size_t band = lower.HalfBand();
  const std::vector<double> descent = equations.Descent();
  for (std::size_t i = 0; i < lower.Size(); ++i)
  {
    const std::size_t first = i > band ? i - band : 0;
    const double* from = &lower.At(i, first);
    FourDoubles* to = &this->Matrix.At(i, first);
    for (std::size_t j = 0; j + first <= i; ++j)
    {
      to[j].Of[body] = from[j];
    }
    this->Descent[i].Of[body] = descent[i];
  }
  for (std::size_t f = 0; f < this->IsFree.size(); ++f)
  {
    this->IsFree[f][body] = !equations.IsFixed(static_cast<int>(f));
  }
}

bool FourDrifts::Factor(double damping)
{
  this->Damping = damping;
  for (std::size_t i = 0; i < this->Matrix.Size(); ++i)
  {
    FourDoubles& diagonal = this->Matrix.At(i, i);
    for (std::size_t b = 0; b < Count; ++b)
    {
      diagonal.Of[b] = this->IsFree[i / 3][b] ? diagonal.Of[b] + damping : 1.0;
    }
  }
  return this->Matrix.Factor();
}

Sums FourDrifts::Begin()
{
  std::fill(this->Step.begin(), this->Step.end(), FourDoubles{});
  std::fill(this->Along.begin(), this->Along.end(), FourDoubles{});
  std::fill(this->Product.begin(), this->Product.end(), FourDoubles{});
  this->Rest = this->Descent;
  Sums sums;
  Dot(Lanes(this->Rest.data()), Lanes(this->Rest.data()), this->Rest.size(), sums);
  return sums;
}

Sums FourDrifts::Solve()
{
  this->Image = this->Rest;
  this->Matrix.Solve(this->Image);
  Sums sums;
  Dot(Lanes(this->Rest.data()), Lanes(this->Image.data()), this->Rest.size(), sums);
  return sums;
}

void FourDrifts::Turn(double part)
{
  TurnTo(Lanes(this->Image.data()), part, this->Image.size(), Lanes(this->Along.data()));
  TurnTo(Lanes(this->Rest.data()), part, this->Rest.size(), Lanes(this->Product.data()));
}

void FourDrifts::Subtract(std::size_t body, std::size_t frame, const Vec3& normal, double along)
{
  for (std::size_t c = 0; c < 3; ++c)
  {
    this->Image[3 * frame + c].Of[body] -= along * normal[static_cast<int>(c)];
  }
}

Sums FourDrifts::Bend() const
{
  Sums sums;
  Dot(Lanes(this->Along.data()), Lanes(this->Image.data()), this->Along.size(), sums);
  return sums;
}

Sums FourDrifts::Go(double length)
{
  Sums sums;
  GoAlong(Lanes(this->Along.data()), Lanes(this->Image.data()), length, this->Along.size(),
          Lanes(this->Step.data()), Lanes(this->Rest.data()), sums);
  return sums;
}

void FourDrifts::Move(std::size_t body, std::vector<Vec3>& path) const
{
  for (std::size_t f = 0; f < path.size(); ++f)
  {
    path[f] += At(this->Step, body, f);
  }
}

Sums FourDrifts::Promises() const
{
  Sums sums;
  PromiseOfEach(Lanes(this->Step.data()), Lanes(this->Descent.data()), this->Damping,
                this->Step.size(), sums);
  return sums;
}

} // namespace waft
