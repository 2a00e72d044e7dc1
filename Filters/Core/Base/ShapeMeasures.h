// SPDX-License-Identifier: BSD-3-Clause
// What other stages ask of a thin body: its mass, its extent, how it lies.
#pragma once

#include "Base/Shape.h"

#include <string>

namespace waft
{

/// Whether each edge has two triangles.
bool IsClosed(const TriangleMesh& mesh);

/// Sum of the areas of the triangles [m^2].
double SurfaceArea(const TriangleMesh& mesh);

/// "1 of 300 triangles has no area" and what comes of it, for a mesh that has such triangles (two
/// corners in one point, or three on a line to single precision); empty for all others.
std::string RemarkOnFlatTriangles(const TriangleMesh& mesh);

/// Centre of mass of a shell of even thickness [m]; of the points when the area is zero.
Vec3 ShellCentroid(const TriangleMesh& mesh);

/// The longest side of the box around the mesh along the body's axes [m].
double LargestExtent(const TriangleMesh& mesh);

/// Half axes, along the body's own, of an ellipsoid about its centre that holds the mesh: of the
/// proportions of the box about it, but no thinner than a tenth of its length [m].
Vec3 EllipsoidAbout(const TriangleMesh& mesh);

/// Moves the mesh so that its shell's centre of mass is the origin.
void CenterOnMass(TriangleMesh& mesh);

/// Scales the mesh about the origin to a largest extent [m]; one without extent stays.
void ScaleToExtent(double size, TriangleMesh& mesh);

/// AreaDensity times the area [kg].
double ShellMass(const Shape& shape);

/// Half the largest extent [m].
double ClearanceRadius(const Shape& shape);

/// Height of the centre of mass above a plane that the body lies on with its z axis up [m].
double RestHeight(const Shape& shape);

/// How much light the body holds back, 0..1: a closed film lighter than 0.01 kg/m^2 (a soap bubble)
/// lets most of it through, all else is 1.
double Opacity(const Shape& shape);

} // namespace waft
