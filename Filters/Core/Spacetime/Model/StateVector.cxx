// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/StateVector.h"

#include "Particles/SphKernels.h"

namespace waft
{

// blockSum(first, size) of each block, added up in the order of the blocks.
double VectorSpace::Sum(const std::function<double(std::size_t, std::size_t)>& blockSum) const
{
  std::vector<double> sums(this->Partition.Frames(), 0.0);
  const FrameRange& own = this->Partition.Own();
  this->Parallel(own.Size(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t j = own.Begin + begin; j < own.Begin + end; ++j)
                   {
                     sums[j] = blockSum(this->Partition.Slot(j) * this->BlockSize, this->BlockSize);
                   }
                 });
  this->Partition.Gather(sums);
  double total = 0.0;
  for (const double s : sums)
  {
    total += s;
  }
  return total;
}

// range(first, last) of the elements of the own blocks.
void VectorSpace::ForElements(const std::function<void(std::size_t, std::size_t)>& range) const
{
  const FrameRange& own = this->Partition.Own();
  const std::size_t first = this->Partition.Slot(own.Begin);
  this->Parallel(own.Size(), [&](std::size_t begin, std::size_t end)
                 { range((first + begin) * this->BlockSize, (first + end) * this->BlockSize); });
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
