// SPDX-License-Identifier: BSD-3-Clause
// Shi et al. 2005, section 7: a body from a photograph, outlined, triangulated, textured by the
// picture itself and curved.
#pragma once

#include "Base/Result.h"
#include "Base/Shape.h"
#include "Shapes/AlphaOutline.h"
#include "Shapes/FlatSheet.h"

namespace waft
{

struct PhotographOptions : Bending
{
  double Threshold = 0.5; // of alpha, between 0 and 1
  double Detail = 0.006;  // how far the outline may be off, in lengths, 0.0005..0.1
  int Triangles = 500;    // about as many as wanted, 20..20000; a fine outline takes more

  Result Validate() const;
};

/// The largest thing that the mask shows, as mesh and texture coordinates of `shape`: its longest
/// direction along x, the heavier end towards -x, edges up, centred on its mass. Its other members
/// are left alone, and all of it on failure.
Result MakePhotographSheet(const AlphaMask& mask, const PhotographOptions& options, Shape& shape);

} // namespace waft
