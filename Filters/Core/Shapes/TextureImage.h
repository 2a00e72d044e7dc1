// SPDX-License-Identifier: BSD-3-Clause
// Painted skins of thin shapes, made from the same outlines as their meshes.
#pragma once

#include "Base/OptionFields.h"
#include "Base/Result.h"
#include "Base/SceneFrame.h"
#include "Shapes/Outline.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace waft
{

/// Pixels along a side.
inline constexpr limits::Range TexturePixels = { 16, 4096 };

/// How a body is painted, by default as a green leaf.
struct SkinOptions
{
  std::string SaveSkinAs;
  int TextureSize = 512;
  std::array<double, 3> BaseColor{ 0.36, 0.52, 0.14 };
  std::array<double, 3> EdgeColor{ 0.66, 0.62, 0.16 };
  std::array<double, 3> VeinColor{ 0.74, 0.78, 0.44 };
  double Blotches = 0.35;
  std::uint64_t Seed = 1;

  Result Validate() const { return ValidateFields<SkinOptions>(*this); }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(TextField("SaveSkinAs", "PNG file to save the painted skin in; no other picture is "
                                  "replaced by it."),
          of.SaveSkinAs...);
    visit(OptionField{ "TextureSize", TexturePixels, "", "Pixels of the skin along the length." },
          of.TextureSize...);
    visit(OptionField{ "BaseColor", { 0, 1 }, "", "Colour near the middle: red, green, blue." },
          of.BaseColor...);
    visit(
      OptionField{
        "EdgeColor", { 0, 1 }, "", "Colour of edges, blotches and bands: red, green, blue." },
      of.EdgeColor...);
    visit(
      OptionField{ "VeinColor", { 0, 1 }, "", "Colour of veins, stem or shaft: red, green, blue." },
      of.VeinColor...);
    visit(
      OptionField{
        "Blotches", { 0, 1 }, "", "How much of the edge's colour comes in blotches or bands." },
      of.Blotches...);
    visit(SeedField(), of.Seed...);
  }
};

/// What a feather starts with.
SkinOptions FeatherSkin();

/// Pixels across, for as many along: those of the outline's texture are square.
int TextureHeight(const Outline& outline, int width);

/// Red, green, blue, alpha bytes of TextureSize x height pixels, row 0 at the bottom (v = 0), x
/// fastest. Alpha is 0 outside the outline, between the teeth of a leaf and in the splits of a
/// feather.
Result PaintTexture(const Outline& outline, const SkinOptions& options, int height,
                    std::vector<std::uint8_t>& pixels);

} // namespace waft
