// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/TargetMask.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace waft
{

namespace
{

constexpr float Solid = 0.99f; // alpha

double ColorDistance(const std::array<double, 3>& a, const std::array<float, 4>& b)
{
  double sum = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    sum += (a[c] - b[c]) * (a[c] - b[c]);
  }
  return std::sqrt(sum);
}

// The commonest colour of the border, of 16 shades a channel.
std::array<double, 3> BackgroundColor(const Picture& picture)
{
  std::map<std::array<int, 3>, std::pair<int, std::array<double, 3>>> counts;
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      if (x == 0 || y == 0 || x == picture.Width - 1 || y == picture.Height - 1)
      {
        const auto& p = picture.Pixels[static_cast<std::size_t>(y) * picture.Width + x];
        auto& entry = counts[{ int(p[0] * 15.9f), int(p[1] * 15.9f), int(p[2] * 15.9f) }];
        ++entry.first;
        entry.second = { p[0], p[1], p[2] };
      }
    }
  }
  std::pair<int, std::array<double, 3>> best{ 0, { 1.0, 1.0, 1.0 } };
  for (const auto& [shade, entry] : counts)
  {
    if (entry.first > best.first)
    {
      best = entry;
    }
  }
  return best.second;
}

} // namespace

bool TargetMask::IsEmpty() const
{
  return std::none_of(this->Weights.begin(), this->Weights.end(), [](float w) { return w > 0.f; });
}

std::string RemarkOnTransparency(const Picture& picture)
{
  constexpr double most = 0.95; // of the pixels; round pictures in a square have less
  const auto isSolid = [](const auto& p) { return p[3] >= Solid; };
  const auto count = std::count_if(picture.Pixels.begin(), picture.Pixels.end(), isSolid);
  const auto all = static_cast<long>(picture.Pixels.size());
  if (count == all || static_cast<double>(count) < most * static_cast<double>(all))
  {
    return {};
  }
  char share[16];
  std::snprintf(share, sizeof(share), "%.2g",
                100.0 * (1.0 - static_cast<double>(count) / static_cast<double>(all)));
  return std::string("only ") + share +
         " % of the picture are transparent, so that all the rest wants targets, whatever its "
         "colour: make its background transparent, or all of it opaque";
}

TargetMask MaskFromPicture(const Picture& picture,
                           const std::vector<std::array<double, 3>>& classColors)
{
  TargetMask mask;
  mask.Width = picture.Width;
  mask.Height = picture.Height;
  const bool isTransparent = std::any_of(picture.Pixels.begin(), picture.Pixels.end(),
                                         [](const auto& p) { return p[3] < Solid; });
  const std::array<double, 3> background = BackgroundColor(picture);
  const std::array<float, 4> backgroundPixel = { float(background[0]), float(background[1]),
                                                 float(background[2]), 1.f };
  constexpr double sameColor = 0.1;
  bool backgroundIsClass = false;
  for (const auto& color : classColors)
  {
    backgroundIsClass = backgroundIsClass || ColorDistance(color, backgroundPixel) < sameColor;
  }
  const bool hasBackground = !isTransparent && !backgroundIsClass;
  for (const auto& pixel : picture.Pixels)
  {
    const double contrast = ColorDistance(background, pixel);
    int nearest = -1;
    double least = hasBackground ? contrast : 1e300;
    for (std::size_t c = 0; c < classColors.size(); ++c)
    {
      const double d = ColorDistance(classColors[c], pixel);
      if (d < least)
      {
        least = d;
        nearest = static_cast<int>(c);
      }
    }
    double weight = isTransparent ? pixel[3] : std::min(1.0, contrast / std::sqrt(3.0));
    if (!classColors.empty())
    {
      weight = nearest >= 0 ? (isTransparent ? pixel[3] : 1.0) : 0.0;
      mask.Classes.push_back(nearest);
    }
    mask.Weights.push_back(weight < 0.02 ? 0.f : static_cast<float>(weight));
  }
  // The strongest pixel counts as fully wanted.
  const float strongest =
    mask.Weights.empty() ? 0.f : *std::max_element(mask.Weights.begin(), mask.Weights.end());
  for (float& w : mask.Weights)
  {
    w = strongest > 0.f ? w / strongest : 0.f;
  }
  return mask;
}

} // namespace waft
