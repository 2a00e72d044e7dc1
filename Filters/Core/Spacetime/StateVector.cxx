// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/StateVector.h"

namespace waft
{

double VectorSpace::Dot(const StateVector& a, const StateVector& b) const
{
  std::vector<double> sums(this->Blocks, 0.0);
  this->Parallel(this->Blocks,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t k = begin; k < end; ++k)
                   {
                     const float* x = a.data() + k * this->BlockSize;
                     const float* y = b.data() + k * this->BlockSize;
                     // Eight running sums: fixed order, and short enough chains to be fast.
                     double s[8] = {};
                     std::size_t i = 0;
                     for (; i + 8 <= this->BlockSize; i += 8)
                     {
                       for (int c = 0; c < 8; ++c)
                       {
                         s[c] += static_cast<double>(x[i + c]) * y[i + c];
                       }
                     }
                     for (; i < this->BlockSize; ++i)
                     {
                       s[0] += static_cast<double>(x[i]) * y[i];
                     }
                     sums[k] = ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7]));
                   }
                 });
  double total = 0.0;
  for (const double s : sums)
  {
    total += s;
  }
  return total;
}

void VectorSpace::Add(double factor, const StateVector& x, StateVector& y) const
{
  const auto f = static_cast<float>(factor);
  this->Parallel(this->Blocks,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t i = begin * this->BlockSize; i < end * this->BlockSize; ++i)
                   {
                     y[i] += f * x[i];
                   }
                 });
}

void VectorSpace::Combine(const StateVector& a, double factor, const StateVector& b,
                          StateVector& out) const
{
  const auto f = static_cast<float>(factor);
  this->Parallel(this->Blocks,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t i = begin * this->BlockSize; i < end * this->BlockSize; ++i)
                   {
                     out[i] = a[i] + f * b[i];
                   }
                 });
}

void VectorSpace::Scale(double factor, StateVector& x) const
{
  const auto f = static_cast<float>(factor);
  this->Parallel(this->Blocks,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t i = begin * this->BlockSize; i < end * this->BlockSize; ++i)
                   {
                     x[i] *= f;
                   }
                 });
}

} // namespace waft
