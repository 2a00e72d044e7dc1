// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes/AlphaOutline.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

constexpr int LeastPixels = 16;

// The mask with a clear border of one sample and only its largest connected part, holes filled.
class Field
{
public:
  Field(const AlphaMask& mask, double threshold) :
    Threshold(threshold), Width(mask.Width + 2), Height(mask.Height + 2),
    Values(static_cast<std::size_t>(Width) * Height, 0.0F)
  {
    for (int j = 0; j < mask.Height; ++j)
    {
      for (int i = 0; i < mask.Width; ++i)
      {
        this->Values[this->At(i + 1, j + 1)] =
          mask.Values[static_cast<std::size_t>(j) * mask.Width + i];
      }
    }
  }

  std::size_t At(int i, int j) const { return static_cast<std::size_t>(j) * this->Width + i; }
  bool IsInside(int i, int j) const { return this->Values[this->At(i, j)] > this->Threshold; }

  // Keeps the largest part; returns its number of samples.
  int KeepLargest()
  {
    std::vector<int> part(this->Values.size(), 0);
    int parts = 0;
    int best = 0;
    int most = 0;
    for (std::size_t seed = 0; seed < part.size(); ++seed)
    {
      if (part[seed] == 0 && this->Values[seed] > this->Threshold)
      {
        const int count = this->Flood(seed, true, ++parts, part);
        if (count > most)
        {
          most = count;
          best = parts;
        }
      }
    }
    for (std::size_t k = 0; k < part.size(); ++k)
    {
      if (part[k] != best && part[k] != 0)
      {
        this->Values[k] = 0.0F;
      }
    }
    return most;
  }

  void FillHoles()
  {
    std::vector<int> outside(this->Values.size(), 0);
    this->Flood(0, false, 1, outside);
    for (std::size_t k = 0; k < outside.size(); ++k)
    {
      if (outside[k] == 0 && !(this->Values[k] > this->Threshold))
      {
        this->Values[k] = 1.0F;
      }
    }
  }

  // Marching squares with the inside on the left. Two inside samples that touch at a corner only
  // belong to different things, so that the outline never crosses itself.
  Polygon Walk() const
  {
    int i = 0;
    int j = 0;
    this->FirstCell(i, j);
    const int startI = i;
    const int startJ = j;
    Polygon outline;
    int came = 3; // the side the walk came in by: 0 below, 1 right, 2 above, 3 left
    do
    {
      const int leaves = this->Exit(i, j, came);
      outline.push_back(this->Crossing(i, j, leaves));
      i += leaves == 1 ? 1 : (leaves == 3 ? -1 : 0);
      j += leaves == 2 ? 1 : (leaves == 0 ? -1 : 0);
      came = (leaves + 2) % 4;
    } while (i != startI || j != startJ);
    return outline;
  }

private:
  int Flood(std::size_t seed, bool inside, int mark, std::vector<int>& marks) const
  {
    std::vector<std::size_t> open{ seed };
    marks[seed] = mark;
    int count = 0;
    const auto visit = [&](std::size_t k)
    {
      if (marks[k] == 0 && (this->Values[k] > this->Threshold) == inside)
      {
        marks[k] = mark;
        open.push_back(k);
      }
    };
    const auto width = static_cast<std::size_t>(this->Width);
    while (!open.empty())
    {
      const std::size_t k = open.back();
      open.pop_back();
      ++count;
      const bool low = k >= width;
      const bool high = k + width < this->Values.size();
      const bool left = k % width > 0;
      const bool right = k % width + 1 < width;
      const auto step = [&](bool there, long by)
      {
        if (there)
        {
          visit(static_cast<std::size_t>(static_cast<long>(k) + by));
        }
      };
      const long w = this->Width;
      step(left, -1);
      step(right, 1);
      step(low, -w);
      step(high, w);
      if (!inside) // the outside leaks through corners: things that touch there are apart
      {
        step(low && left, -w - 1);
        step(low && right, -w + 1);
        step(high && left, w - 1);
        step(high && right, w + 1);
      }
    }
    return count;
  }

  // The cell below the lowest, then leftmost, inside sample: its walk begins at the left.
  void FirstCell(int& i, int& j) const
  {
    for (j = 0; j < this->Height; ++j)
    {
      for (i = 0; i < this->Width; ++i)
      {
        if (this->IsInside(i, j))
        {
          --i; // the cell whose upper right sample this is: outline goes down to its right side
          --j;
          return;
        }
      }
    }
  }

  // The side by which an outline with the inside on its left leaves a cell.
  int Exit(int i, int j, int came) const
  {
    // Corners: 0 lower left, 1 lower right, 2 upper right, 3 upper left.
    const bool in[4] = { this->IsInside(i, j), this->IsInside(i + 1, j),
                         this->IsInside(i + 1, j + 1), this->IsInside(i, j + 1) };
    // Side k runs from corner k to corner k + 1; walking out through it keeps corner k + 1 left.
    for (int turn = 3; turn >= 1; --turn) // nearest to the corner on the left first
    {
      const int side = (came + turn) % 4;
      if (!in[side] && in[(side + 1) % 4])
      {
        return side;
      }
    }
    return came;
  }

  std::array<double, 2> Crossing(int i, int j, int side) const
  {
    const int x0 = i + (side == 1 || side == 2 ? 1 : 0);
    const int y0 = j + (side >= 2 ? 1 : 0);
    const int x1 = i + (side == 0 || side == 1 ? 1 : 0);
    const int y1 = j + (side == 1 || side == 2 ? 1 : 0);
    const double a = this->Values[this->At(x0, y0)] - this->Threshold;
    const double b = this->Values[this->At(x1, y1)] - this->Threshold;
    const double t = std::clamp(a / (a - b), 0.02, 0.98);
    // Sample (1, 1) is the centre of pixel (0, 0).
    return { x0 + t * (x1 - x0) - 0.5, y0 + t * (y1 - y0) - 0.5 };
  }

  double Threshold;
  int Width;
  int Height;
  std::vector<float> Values;
};

double DistanceToSegment(const std::array<double, 2>& p, const std::array<double, 2>& a,
                         const std::array<double, 2>& b)
{
  const double ux = b[0] - a[0];
  const double uy = b[1] - a[1];
  const double length2 = ux * ux + uy * uy;
  const double t =
    length2 > 0.0 ? std::clamp(((p[0] - a[0]) * ux + (p[1] - a[1]) * uy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - a[0] - t * ux, p[1] - a[1] - t * uy);
}

} // namespace

double SignedArea(const Polygon& polygon)
{
  double area = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const auto& a = polygon[k];
    const auto& b = polygon[(k + 1) % polygon.size()];
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  return area;
}

Result TraceOutline(const AlphaMask& mask, double threshold, Polygon& outline)
{
  if (mask.Width < 1 || mask.Height < 1 ||
      mask.Values.size() != static_cast<std::size_t>(mask.Width) * mask.Height)
  {
    return Result::Error("expected a picture with pixels, found none");
  }
  Field field(mask, threshold);
  const int found = field.KeepLargest();
  if (found < LeastPixels)
  {
    return Result::Error("expected a thing of at least " + std::to_string(LeastPixels) +
                         " pixels that are more opaque than " + std::to_string(threshold) +
                         ", found " + std::to_string(found));
  }
  field.FillHoles();
  outline = field.Walk();
  return Result::Ok();
}

Polygon SimplifyOutline(const Polygon& outline, double tolerance)
{
  if (outline.size() < 4)
  {
    return outline;
  }
  // From the two corners that are farthest apart from the first one and from each other on.
  const auto farthest = [&](std::size_t from)
  {
    std::size_t best = from;
    double most = -1.0;
    for (std::size_t k = 0; k < outline.size(); ++k)
    {
      const double d =
        std::hypot(outline[k][0] - outline[from][0], outline[k][1] - outline[from][1]);
      if (d > most)
      {
        most = d;
        best = k;
      }
    }
    return best;
  };
  const std::size_t first = farthest(0);
  const std::size_t second = farthest(first);
  std::vector<unsigned char> kept(outline.size(), 0);
  kept[first] = kept[second] = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{ { first, second }, { second, first } };
  const std::size_t count = outline.size();
  std::size_t widest = first;
  double width = -1.0;
  while (!open.empty())
  {
    const auto [a, b] = open.back();
    open.pop_back();
    double most = -1.0;
    std::size_t worst = a;
    for (std::size_t k = (a + 1) % count; k != b; k = (k + 1) % count)
    {
      const double d = DistanceToSegment(outline[k], outline[a], outline[b]);
      if (d > most)
      {
        most = d;
        worst = k;
      }
    }
    if (most > width && kept[worst] == 0)
    {
      width = most;
      widest = worst;
    }
    if (most > tolerance)
    {
      kept[worst] = 1;
      open.push_back({ a, worst });
      open.push_back({ worst, b });
    }
  }
  if (std::count(kept.begin(), kept.end(), 1) < 3)
  {
    kept[widest] = 1;
  }
  Polygon simple;
  for (std::size_t k = 0; k < count; ++k)
  {
    if (kept[k] != 0)
    {
      simple.push_back(outline[k]);
    }
  }
  return simple;
}

} // namespace waft
