// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PolygonSurface.h"

#include <map>
#include <utility>

namespace waft
{

void PolygonSurface::SetCornerCoordinates(const std::vector<TextureCoordinate>& ofCorners)
{
  this->TextureCoordinates.assign(this->Points.size(), TextureCoordinate{});
  std::vector<bool> hasOne(this->Points.size(), false);
  std::map<std::pair<int, TextureCoordinate>, int> others;
  for (std::size_t i = 0; i < this->Corners.size(); ++i)
  {
    int& corner = this->Corners[i];
    const auto point = static_cast<std::size_t>(corner);
    const TextureCoordinate own{ static_cast<float>(ofCorners[i][0]),
                                 static_cast<float>(ofCorners[i][1]) };
    if (!hasOne[point])
    {
      hasOne[point] = true;
      this->TextureCoordinates[point] = own;
    }
    else if (this->TextureCoordinates[point] != own)
    {
      const auto [other, isNew] =
        others.try_emplace({ corner, own }, static_cast<int>(this->Points.size()));
      if (isNew)
      {
        this->Points.push_back(this->Points[point]);
        this->TextureCoordinates.push_back(own);
      }
      corner = other->second;
    }
  }
}

} // namespace waft
