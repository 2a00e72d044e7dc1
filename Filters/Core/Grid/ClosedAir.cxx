// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/ClosedAir.h"

namespace waft
{

ClosedAir::ClosedAir(const PaddedCells& c, const std::array<const float*, 3>& weights,
                     const std::array<bool, 3>& periodic) :
  Part(c.Size(), -1)
{
  std::vector<bool> seen(c.Size(), false);
  struct Node
  {
    int At[3];
  };
  const std::array<std::ptrdiff_t, 3> stride{ 1, c.StrideY, c.StrideZ };
  std::vector<Node> stack;
  std::vector<std::ptrdiff_t> members;
  const auto enter = [&](const Node& node)
  {
    const std::ptrdiff_t p = c.Index(node.At[0], node.At[1], node.At[2]);
    if (!seen[p])
    {
      seen[p] = true;
      stack.push_back(node);
      members.push_back(p);
    }
  };
  for (int k = 0; k < c.N[2]; ++k)
  {
    for (int j = 0; j < c.N[1]; ++j)
    {
      for (int i = 0; i < c.N[0]; ++i)
      {
        const std::ptrdiff_t start = c.Index(i, j, k);
        if (seen[start])
        {
          continue;
        }
        members.clear();
        bool isOpen = false;
        enter({ { i, j, k } });
        while (!stack.empty())
        {
          const Node node = stack.back();
          stack.pop_back();
          const std::ptrdiff_t p = c.Index(node.At[0], node.At[1], node.At[2]);
          for (int axis = 0; axis < 3; ++axis)
          {
            for (int side = -1; side <= 1; side += 2)
            {
              const std::ptrdiff_t face = side < 0 ? p : p + stride[axis];
              if (weights[axis][face] <= 0.0f)
              {
                continue;
              }
              Node next = node;
              next.At[axis] += side;
              const bool leaves = next.At[axis] < 0 || next.At[axis] >= c.N[axis];
              if (leaves && !periodic[axis])
              {
                isOpen = true;
                continue;
              }
              next.At[axis] = (next.At[axis] + c.N[axis]) % c.N[axis];
              enter(next);
            }
          }
        }
        if (!isOpen)
        {
          for (const std::ptrdiff_t p : members)
          {
            this->Part[p] = static_cast<std::int32_t>(this->Sizes.size());
          }
          this->Sizes.push_back(members.size());
        }
      }
    }
  }
}

void ClosedAir::MakeCompatible(std::vector<float>& b) const
{
  if (this->Sizes.empty())
  {
    return;
  }
  // Most cells that follow one another are of one part: its sum stays in a register meanwhile.
  const std::size_t count = b.size();
  std::vector<double> means(this->Sizes.size(), 0.0);
  for (std::size_t p = 0; p < count;)
  {
    const std::int32_t part = this->Part[p];
    double sum = part >= 0 ? means[part] : 0.0;
    for (; p < count && this->Part[p] == part; ++p)
    {
      sum += b[p];
    }
    if (part >= 0)
    {
      means[part] = sum;
    }
  }
  for (std::size_t c = 0; c < means.size(); ++c)
  {
    means[c] /= static_cast<double>(this->Sizes[c]);
  }
  for (std::size_t p = 0; p < count;)
  {
    const std::int32_t part = this->Part[p];
    const float mean = part >= 0 ? static_cast<float>(means[part]) : 0.0f;
    for (; p < count && this->Part[p] == part; ++p)
    {
      b[p] -= mean;
    }
  }
}

} // namespace waft
