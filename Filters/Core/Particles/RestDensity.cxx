// SPDX-License-Identifier: BSD-3-Clause
#include "Particles/RestDensity.h"

#include "Base/SmoothStep.h"
#include "Particles/SphSurfaces.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr int GapSweeps = 3; // sites this far into an obstacle have a value

struct Blend
{
  std::size_t First, Second; // sites
  double Value[2], Slope[2], Curve[2];
};

Blend BlendAt(double x, double cell, int count)
{
  const double c = std::clamp(x / cell + 0.5, 0.0, count - 1.0);
  const int first = std::min(static_cast<int>(c), std::max(0, count - 2));
  const double u = c - first;
  Blend b;
  b.First = static_cast<std::size_t>(first);
  b.Second = static_cast<std::size_t>(std::min(first + 1, count - 1));
  b.Value[1] = SmoothStep(u);
  b.Slope[1] = 30.0 * u * u * (1.0 - u) * (1.0 - u) / cell;
  b.Curve[1] = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / (cell * cell);
  b.Value[0] = 1.0 - b.Value[1];
  b.Slope[0] = -b.Slope[1];
  b.Curve[0] = -b.Curve[1];
  return b;
}

// Calls function(neighbour, offset in sites) for the sites of a box about a site, itself included.
template <typename Function>
void ForSitesAbout(const std::array<int, 3>& n, int site, const std::array<int, 3>& reach,
                   Function function)
{
  const int at[3] = { site % n[0], site / n[0] % n[1], site / (n[0] * n[1]) };
  for (int k = std::max(0, at[2] - reach[2]); k <= std::min(n[2] - 1, at[2] + reach[2]); ++k)
  {
    for (int j = std::max(0, at[1] - reach[1]); j <= std::min(n[1] - 1, at[1] + reach[1]); ++j)
    {
      for (int i = std::max(0, at[0] - reach[0]); i <= std::min(n[0] - 1, at[0] + reach[0]); ++i)
      {
        function(i + n[0] * (j + n[1] * k), Vec3(i - at[0], j - at[1], k - at[2]));
      }
    }
  }
}

} // namespace

void RestDensity::Build(const GasLattice& lattice, const SphFluid& fluid,
                        const std::vector<char>& isThere, const std::vector<double>& surfaces)
{
  const std::array<int, 3>& cells = lattice.Dimensions;
  const Vec3 size = lattice.SizeInSpacings();
  std::array<int, 3> reach;
  for (int a = 0; a < 3; ++a)
  {
    this->Cell[a] = size[a] / cells[a];
    reach[a] = static_cast<int>(std::ceil(fluid.Support() / this->Cell[a]));
  }
  std::vector<double> values(isThere.size(), 0.0);
  for (std::size_t i = 0; i < isThere.size(); ++i)
  {
    if (!isThere[i])
    {
      continue;
    }
    double density = surfaces[i];
    ForSitesAbout(cells, static_cast<int>(i), reach,
                  [&](int other, const Vec3& offset)
                  {
                    const double r = offset.cwiseProduct(this->Cell).norm();
                    density += isThere[static_cast<std::size_t>(other)]
                                 ? fluid.GasMass * fluid.Kernel(r)
                                 : 0.0;
                  });
    values[i] = 1.0 - density;
  }
  FillGaps(cells, isThere, values);
  for (int a = 0; a < 3; ++a)
  {
    this->Dimensions[a] = cells[a] + 2;
  }
  this->Mirror(values);
  this->Rounded.assign(this->Values.begin(), this->Values.end());
}

void RestDensity::Mirror(const std::vector<double>& inside)
{
  const std::array<int, 3>& n = this->Dimensions;
  this->Values.clear();
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const int site[3] = { i, j, k };
        double sign = 1.0;
        std::size_t at[3];
        for (int a = 0; a < 3; ++a)
        {
          const int own = std::clamp(site[a], 1, n[a] - 2);
          sign = own == site[a] ? sign : -sign;
          at[a] = static_cast<std::size_t>(own - 1);
        }
        this->Values.push_back(sign * inside[at[0] + (n[0] - 2) * (at[1] + (n[1] - 2) * at[2])]);
      }
    }
  }
}

void RestDensity::Build(const GasLattice& lattice, const SphFluid& fluid)
{
  const std::vector<Vec3> points = lattice.Points();
  std::vector<double> walls;
  const SphVolume volume(lattice.SizeInSpacings());
  for (const Vec3& x : points)
  {
    walls.push_back(SurfaceDensity(fluid, volume, x).Value);
  }
  this->Build(lattice, fluid, std::vector<char>(points.size(), 1), walls);
}

void RestDensity::FillGaps(const std::array<int, 3>& cells, std::vector<char> isKnown,
                           std::vector<double>& values)
{
  for (int sweep = 0; sweep < GapSweeps; ++sweep)
  {
    const std::vector<char> before = isKnown;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
      if (before[i])
      {
        continue;
      }
      double sum = 0.0;
      int count = 0;
      ForSitesAbout(cells, static_cast<int>(i), { 1, 1, 1 },
                    [&](int other, const Vec3&)
                    {
                      sum += before[static_cast<std::size_t>(other)]
                               ? values[static_cast<std::size_t>(other)]
                               : 0.0;
                      count += before[static_cast<std::size_t>(other)] ? 1 : 0;
                    });
      if (count > 0)
      {
        values[i] = sum / count;
        isKnown[i] = 1;
      }
    }
  }
}

double RestDensity::Evaluate(const Vec3& x, Vec3& gradient, Mat3& hessian) const
{
  gradient.setZero();
  hessian.setZero();
  if (this->IsEmpty())
  {
    return 0.0;
  }
  Blend b[3];
  for (int a = 0; a < 3; ++a)
  {
    b[a] = BlendAt(x[a], this->Cell[a], this->Dimensions[a]);
  }
  double value = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int c[3] = { corner & 1, corner >> 1 & 1, corner >> 2 };
    const auto site = [&](int a) { return c[a] ? b[a].Second : b[a].First; };
    const double v =
      this->Values[site(0) + this->Dimensions[0] * (site(1) + this->Dimensions[1] * site(2))];
    const auto product = [&](int p, int q) // differentiated along p and q, unless negative
    {
      double result = v;
      for (int a = 0; a < 3; ++a)
      {
        const int order = (a == p) + (a == q);
        result *=
          order == 0 ? b[a].Value[c[a]] : (order == 1 ? b[a].Slope[c[a]] : b[a].Curve[c[a]]);
      }
      return result;
    };
    value += product(-1, -1);
    for (int p = 0; p < 3; ++p)
    {
      gradient[p] += product(p, -1);
      for (int q = 0; q < 3; ++q)
      {
        hessian(p, q) += product(p, q);
      }
    }
  }
  return value;
}

SphRestField RestDensity::View() const
{
  SphRestField view;
  for (int a = 0; a < 3; ++a)
  {
    view.Dimensions[a] = this->Dimensions[a];
    view.InverseCell[a] = static_cast<float>(1.0 / this->Cell[a]);
  }
  view.Values = this->Rounded.data();
  return view;
}

} // namespace waft
