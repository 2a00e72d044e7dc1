// SPDX-License-Identifier: BSD-3-Clause
// Sites among weighted pixels: where they begin, and how they are evened out in areas and along
// lines.
#pragma once

#include "Base/Random.h"
#include "Base/Types.h"

#include <cstddef>
#include <vector>

namespace waft
{

/// Middles of pixels, in units of pixels, z = 0.
struct WeightedPixels
{
  std::vector<Vec3> Points;
  std::vector<double> Weights; // above 0
};

/// One site from each of `count` runs of pixels of equal weight, so that the sites have the density
/// of the weights from the start (the relaxation moves them only a little). area: the sum of the
/// weights; there must be pixels.
std::vector<Vec3> FirstSites(const WeightedPixels& pixels, std::size_t count, double area,
                             Random& random);

/// Lloyd's relaxation: each site goes to the weighted mean of the pixels that are nearest to it. In
/// the plane a centroidal tessellation of density w has sites of density w^(1/2), so the weights
/// are squared.
void RelaxInArea(const WeightedPixels& pixels, std::vector<Vec3>& sites);

/// On lines a mean would leave the line and shrink its ends. Each site in turn moves along the
/// lines to where the repulsion of the others, (spacing / d)^4, is least: even distances, ends
/// taken. spacing [pixels].
void RelaxOnLines(const std::vector<Vec3>& lines, double spacing, std::vector<Vec3>& sites);

} // namespace waft
