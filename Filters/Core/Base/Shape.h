// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Mesh.h"
#include "Base/Types.h"

#include <array>
#include <string>
#include <vector>

namespace waft
{

/// A thin body as a triangle mesh with a texture: centred on its centre of mass; body axes x along
/// the length, y across, z along the normal (curled edges towards +z). One block of the data set
/// Shapes.
struct Shape
{
  std::string Name;
  TriangleMesh Mesh;                                     // m
  std::vector<std::array<double, 2>> TextureCoordinates; // one a point, or empty
  double DragCoefficient = 1.2;
  double AreaDensity = 0.1;   // kg/m^2
  double Thickness = 0.0005;  // m
  double SettlingSpeed = 0.8; // m/s, terminal fall speed in still air
  double Damping = 0.0;       // 1/s, at which the stickiness of the air stops its turning
  int ClassId = -1;
  std::array<double, 3> Color{ 1.0, 1.0, 1.0 }; // 0..1, as a screen is told; without a texture
  std::array<double, 3> Tint{ 1.0, 1.0, 1.0 };  // 0..1, times the texture's: a colour asked for
  std::string Texture;                          // path of an image, or empty
  std::string Skin;     // without a Texture: the bytes of a PNG file that was painted, or empty
  std::string Authored; // part of a scene file that says this shape (Scene/Scene.h), or empty

  bool HasPicture() const { return !this->Texture.empty() || !this->Skin.empty(); }

  /// What its flight depends on.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Mesh...);
    visit(of.DragCoefficient...);
    visit(of.Thickness...);
    visit(of.Damping...);
  }
};

} // namespace waft
