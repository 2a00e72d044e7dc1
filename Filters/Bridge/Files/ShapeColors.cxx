// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/ShapeColors.h"

#include "Bridge/Files/SceneFiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace waft
{

namespace
{

constexpr float CutAway = 0.5F; // alpha, as where bodies are drawn

const std::array<float, 4>& PixelAt(const Picture& picture, const std::array<double, 2>& place)
{
  const auto index = [](double at, int count)
  {
    const double share = at == 1.0 ? 1.0 : at - std::floor(at); // textures repeat
    return static_cast<std::size_t>(std::min(static_cast<int>(share * count), count - 1));
  };
  return picture.Pixels[index(place[1], picture.Height) * static_cast<std::size_t>(picture.Width) +
                        index(place[0], picture.Width)];
}

std::array<double, 3> MeanOf(const Picture& picture)
{
  std::array<double, 3> sum{ 0.0, 0.0, 0.0 };
  double count = 0.0;
  for (const std::array<float, 4>& pixel : picture.Pixels)
  {
    if (pixel[3] >= CutAway)
    {
      for (std::size_t c = 0; c < sum.size(); ++c)
      {
        sum[c] += pixel[c];
      }
      count += 1.0;
    }
  }
  for (double& part : sum)
  {
    part /= std::max(count, 1.0);
  }
  return sum;
}

} // namespace

std::vector<std::array<double, 3>> ColorsOfPoints(const Shape& shape)
{
  const std::size_t count = shape.Mesh.Points.size();
  Picture picture;
  const bool isPainted =
    shape.HasPicture() && shape.TextureCoordinates.size() == count && LoadPictureOf(shape, picture);
  if (!isPainted)
  {
    return std::vector<std::array<double, 3>>(count, shape.Color);
  }
  const std::array<double, 3> mean = MeanOf(picture);
  std::vector<std::array<double, 3>> colors;
  for (const std::array<double, 2>& place : shape.TextureCoordinates)
  {
    const std::array<float, 4>& pixel = PixelAt(picture, place);
    std::array<double, 3> color = mean;
    for (std::size_t c = 0; c < color.size(); ++c)
    {
      color[c] = (pixel[3] < CutAway ? mean[c] : static_cast<double>(pixel[c])) * shape.Tint[c];
    }
    colors.push_back(color);
  }
  return colors;
}

} // namespace waft
