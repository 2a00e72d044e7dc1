// SPDX-License-Identifier: BSD-3-Clause
// Shi et al. 2005, section 7: a body from a photograph, outlined, triangulated, textured by the
// picture itself and curved.
#pragma once

#include "Base/Result.h"
#include "Base/Shape.h"
#include "Shapes/AlphaOutline.h"
#include "Shapes/FlatSheet.h"

#include <string>

namespace waft
{

struct PhotographOptions : Bending
{
  double Threshold = 0.5;
  double Detail = 0.006;
  int NumberOfTriangles = 500;

  Result Validate() const { return ValidateFields<PhotographOptions>(*this); }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(
      OptionField{
        "Threshold", { 0.01, 0.99 }, "", "Alpha above which a pixel belongs to the body." },
      of.Threshold...);
    visit(
      OptionField{
        "Detail", { 0.0005, 0.1 }, "lengths", "How far the outline may be off, in lengths." },
      of.Detail...);
    visit(OptionField{ "NumberOfTriangles",
                       { 20, 20000 },
                       "",
                       "About as many triangles; a fine outline takes more." },
          of.NumberOfTriangles...);
    Bending::Visit(visit, of...);
  }
};

/// A photograph that a user names.
struct PhotographFile
{
  std::string Photograph;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(TextField("Photograph", "The picture file; its transparency tells the outline."),
          of.Photograph...);
  }
};

/// The largest thing that the mask shows, as mesh and texture coordinates of `shape`: its longest
/// direction along x, the heavier end towards -x, edges up, centred on its mass. Its other members
/// are left alone, and all of it on failure.
Result MakePhotographSheet(const AlphaMask& mask, const PhotographOptions& options, Shape& shape);

} // namespace waft
