// SPDX-License-Identifier: BSD-3-Clause
// Whether the meshes of two posed bodies cut each other, and whether deeply. Bodies are thin, and
// their surfaces mostly open: how deep they are is how far one has to be shifted until they part.
#pragma once

#include "Base/Mesh.h"
#include "Obstacles/TriangleTree.h"

#include <array>
#include <vector>

namespace waft
{

/// The mesh of a shape, looked at before bodies of it meet others.
class ContactMesh
{
public:
  static constexpr std::size_t ClusterSize = 16; // as many as side by side across a leaf

  explicit ContactMesh(const TriangleMesh& mesh);

  const TriangleMesh& Mesh() const { return *this->Surface; }
  const TriangleTree& Tree() const { return this->Triangles; }
  const std::vector<Box>& Boxes() const { return this->Around; } // of its triangles
  /// About each ClusterSize of them, one after another.
  const std::vector<Box>& Clusters() const { return this->AroundSome; }
  const std::vector<Vec3>& Normals() const { return this->Upright; } // likewise; 0: without area
  double Radius() const { return this->Farthest; } // m, of all points about the origin
  double Length() const { return this->Extent; }   // m, the longest side of its box
  bool IsClosed() const { return this->Closed; }   // what is within cuts it, too

private:
  const TriangleMesh* Surface;
  TriangleTree Triangles;
  std::vector<Box> Around, AroundSome;
  std::vector<Vec3> Upright;
  double Farthest;
  double Extent;
  bool Closed;
};

/// A body's place and pose.
struct PosedMesh
{
  const ContactMesh* Shape = nullptr;
  Vec3 Position = Vec3::Zero();
  Quat Orientation = Quat::Identity();
};

/// Two posed bodies, one after another pair; one for each thread.
class MeshPair
{
public:
  /// reach: m, by which they may be shifted below.
  void Place(const PosedMesh& a, const PosedMesh& b, double reach);
  /// Whether they cut where b is shifted by that, in the axes of a.
  bool Cut(const Vec3& shift = Vec3::Zero());
  /// Whether they cut, and still do wherever b is shifted by `depth` [m]: along the normals of
  /// both, and in sixty-four directions all around, of which one is nearer than 0.3 rad to any. So
  /// nothing deeper is overlooked, and what is found is deeper than 0.95 of that.
  bool IsDeeper(double depth);

private:
  /// Two triangles whose boxes meet where b is shifted by more than Low and less than High.
  struct Touching
  {
    int A, B;
    Vec3 Low, High;
  };

  struct Boxed
  {
    int Triangle;
    Box Around;
  };

  TriangleCorners OfA(int triangle) const;
  TriangleCorners OfB(int triangle, const Vec3& shift) const;
  void ChooseOfB(const Box& near);
  void ChooseOfA(const Box& near, double reach);
  void PairUp(double reach);
  bool DoMeet(const Touching& both, const Vec3& shift) const;
  bool Contains(const Vec3& shift) const;

  PosedMesh A, B;
  Mat3 Turn = Mat3::Identity();     // of b in the axes of a
  Vec3 Apart = Vec3::Zero();        // likewise
  std::vector<Vec3> Points;         // of b, in the axes of a
  std::vector<Touching> Candidates; // triangles that are near enough
  std::vector<Boxed> SomeA, SomeB;  // that may be among them; boxes in the axes of a
};

} // namespace waft
