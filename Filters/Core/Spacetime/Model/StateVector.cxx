// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/StateVector.h"

#include "Particles/SphKernels.h"

namespace waft
{

// blockSum(first, size) of each block, added up in the order of the blocks.
double VectorSpace::Sum(const std::function<double(std::size_t, std::size_t)>& blockSum) const
{
  std::vector<double> sums(this->Blocks, 0.0);
  this->Parallel(this->Blocks,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t j = begin; j < end; ++j)
                   {
                     sums[j] = blockSum(j * this->BlockSize, this->BlockSize);
                   }
                 });
  double total = 0.0;
  for (const double s : sums)
  {
    total += s;
  }
  return total;
}

// range(first, last) of the elements of some blocks.
void VectorSpace::ForElements(const std::function<void(std::size_t, std::size_t)>& range) const
{
  this->Parallel(this->Blocks, [&](std::size_t begin, std::size_t end)
                 { range(begin * this->BlockSize, end * this->BlockSize); });
}

double VectorSpace::Dot(const StateVector& a, const StateVector& b) const
{
  const VectorKernels& kernels = FastestSphKernels().Vectors;
  return this->Sum([&](std::size_t first, std::size_t size)
                   { return kernels.Dot(size, a.data() + first, b.data() + first); });
}

double VectorSpace::AddDot(double factor, const StateVector& x, StateVector& y,
                           const StateVector& z) const
{
  const VectorKernels& kernels = FastestSphKernels().Vectors;
  const auto f = static_cast<float>(factor);
  return this->Sum(
    [&](std::size_t first, std::size_t size)
    { return kernels.AddDot(size, f, x.data() + first, y.data() + first, z.data() + first); });
}

void VectorSpace::Add(double factor, const StateVector& x, StateVector& y) const
{
  const auto f = static_cast<float>(factor);
  this->ForElements(
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        y[i] += f * x[i];
      }
    });
}

void VectorSpace::Combine(const StateVector& a, double factor, const StateVector& b,
                          StateVector& out) const
{
  const auto f = static_cast<float>(factor);
  this->ForElements(
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        out[i] = a[i] + f * b[i];
      }
    });
}

void VectorSpace::Scale(double factor, StateVector& x) const
{
  const auto f = static_cast<float>(factor);
  this->ForElements(
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        x[i] *= f;
      }
    });
}

} // namespace waft
