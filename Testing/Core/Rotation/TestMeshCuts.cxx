// SPDX-License-Identifier: BSD-3-Clause
// How deep posed meshes are in each other: by hand where that is plain, else against a slow
// reference that knows no trees, boxes or sweeps.
#include "Base/Random.h"
#include "Crowd.h"
#include "Refining.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{

constexpr double Millimetre = 1e-3;

/// Whether a segment goes through a triangle.
bool Pierces(const Vec3& p, const Vec3& q, const TriangleCorners& t)
{
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double above = normal.dot(p - t[0]);
  const double below = normal.dot(q - t[0]);
  if (above * below > 0.0 || above == below)
  {
    return false;
  }
  const Vec3 x = p + above / (above - below) * (q - p);
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (normal.dot((t[(k + 1) % 3] - t[k]).cross(x - t[k])) < 0.0)
    {
      return false;
    }
  }
  return true;
}

std::vector<TriangleCorners> TrianglesOf(const PosedMesh& body, const Vec3& shift)
{
  std::vector<TriangleCorners> triangles;
  for (const auto& corners : body.Shape->Mesh().Triangles)
  {
    TriangleCorners triangle;
    for (std::size_t k = 0; k < 3; ++k)
    {
      triangle[k] =
        body.Orientation * body.Shape->Mesh().Points[static_cast<std::size_t>(corners[k])] +
        body.Position + shift;
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

bool PlainlyCut(const std::vector<TriangleCorners>& a, const std::vector<TriangleCorners>& b)
{
  for (const TriangleCorners& one : a)
  {
    for (const TriangleCorners& other : b)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        if (Pierces(one[k], one[(k + 1) % 3], other) || Pierces(other[k], other[(k + 1) % 3], one))
        {
          return true;
        }
      }
    }
  }
  return false;
}

Vec3 AnyDirection(Random& random)
{
  Vec3 direction;
  do
  {
    direction = Vec3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
  } while (direction.norm() > 1.0 || direction.norm() < 0.1);
  return direction.normalized();
}

bool PlainlyDeeper(const PosedMesh& a, const PosedMesh& b, double depth)
{
  const std::vector<TriangleCorners> fixed = TrianglesOf(a, Vec3::Zero());
  Random random(5, 1);
  bool deep = PlainlyCut(fixed, TrianglesOf(b, Vec3::Zero()));
  for (int k = 0; k < 400 && deep; ++k)
  {
    deep = PlainlyCut(fixed, TrianglesOf(b, depth * AnyDirection(random)));
  }
  return deep;
}

bool IsDeeper(const PosedMesh& a, const PosedMesh& b, double depth)
{
  MeshPair pair;
  pair.Place(a, b, depth);
  return pair.IsDeeper(depth);
}

bool Cut(const PosedMesh& a, const PosedMesh& b)
{
  MeshPair pair;
  pair.Place(a, b, 0.0);
  return pair.Cut();
}

} // namespace

TEST(MeshContact, AnEdgeThroughALeafIsAsDeepAsItSticksOut)
{
  const Shape sheet = Sheet(0.1, 0.06);
  const ContactMesh mesh(sheet.Mesh);
  const PosedMesh level{ &mesh };
  for (const double out : { -1.0, 1.5, 1.99, 2.2, 10.0 })
  {
    const PosedMesh upright{ &mesh, Vec3(0.01, 0.003, 0.05 - out * Millimetre),
                             About(Vec3::UnitY(), 90.0) };
    EXPECT_EQ(Cut(level, upright), out > 0.0) << out;
    EXPECT_EQ(IsDeeper(level, upright, 2.0 * Millimetre), out > 2.0) << out;
    EXPECT_EQ(IsDeeper(upright, level, 2.0 * Millimetre), out > 2.0) << out;
  }
}

TEST(MeshContact, RimsThatCrossPartBesideEachOther)
{
  const Shape sheet = Sheet(0.1, 0.06);
  const ContactMesh mesh(sheet.Mesh);
  const PosedMesh level{ &mesh };
  for (const double over : { -1.0, 1.5, 2.2 })
  {
    // Each goes through the other by a cut of that length along y.
    const PosedMesh upright{ &mesh, Vec3(0.0, 0.06 - over * Millimetre, 0.0),
                             About(Vec3::UnitY(), 90.0) };
    EXPECT_EQ(Cut(level, upright), over > 0.0) << over;
    EXPECT_EQ(IsDeeper(level, upright, 2.0 * Millimetre), over > 2.0) << over;
  }
}

TEST(MeshContact, WhatLiesCloseDoesNotCut)
{
  const Shape leaf = CurledLeaf();
  const ContactMesh mesh(leaf.Mesh);
  EXPECT_FALSE(mesh.IsClosed());
  EXPECT_FALSE(Cut({ &mesh }, { &mesh, Vec3(0.0, 0.0, 0.3 * Millimetre) }));
  EXPECT_TRUE(Cut({ &mesh }, { &mesh, Vec3(0.02, 0.0, 0.3 * Millimetre) }));
}

TEST(MeshContact, ABodyWithinAClosedOneIsDeep)
{
  const Shape small = Ball(0.01, 8);
  const Shape large = Ball(0.03, 8);
  const ContactMesh inner(small.Mesh);
  const ContactMesh outer(large.Mesh);
  EXPECT_TRUE(outer.IsClosed());
  const PosedMesh within{ &inner, Vec3(0.002, 0.0, 0.001) };
  EXPECT_TRUE(IsDeeper({ &outer }, within, 2.0 * Millimetre));
  EXPECT_TRUE(IsDeeper(within, { &outer }, 2.0 * Millimetre));
  EXPECT_FALSE(IsDeeper({ &outer }, { &inner, Vec3(0.045, 0.0, 0.0) }, 2.0 * Millimetre));
}

TEST(MeshContact, AgreesWithAPlainReference)
{
  Shape leaf = Sheet(0.1, 0.06, 3);
  for (Vec3& p : leaf.Mesh.Points)
  {
    p.z() = 3.0 * p.x() * p.x() + 6.0 * p.y() * p.y();
  }
  const ContactMesh mesh(leaf.Mesh);
  Random random(3, 7);
  int cut = 0, deep = 0, shallow = 0;
  for (int k = 0; k < 160; ++k)
  {
    const auto pose = [&]
    {
      return PosedMesh{ &mesh, 0.035 * random.Uniform(0, 1) * AnyDirection(random),
                        About(AnyDirection(random), random.Uniform(0, 180)) };
    };
    const PosedMesh a = pose();
    const PosedMesh b = pose();
    const double depth = random.Uniform(0.5, 12.0) * Millimetre;
    EXPECT_EQ(Cut(a, b), PlainlyCut(TrianglesOf(a, Vec3::Zero()), TrianglesOf(b, Vec3::Zero())))
      << k;
    const bool deeper = IsDeeper(a, b, depth);
    cut += Cut(a, b) ? 1 : 0;
    deep += deeper ? 1 : 0;
    shallow += Cut(a, b) && !deeper ? 1 : 0;
    if (deeper)
    {
      EXPECT_TRUE(PlainlyDeeper(a, b, 0.93 * depth)) << k;
    }
    else
    {
      EXPECT_FALSE(PlainlyDeeper(a, b, 1.05 * depth)) << k;
    }
  }
  EXPECT_GT(deep, 25);
  EXPECT_GT(shallow, 8);
  EXPECT_LT(cut, 160);
}

TEST(MeshCuts, FindsThePairsAndFramesThatAPlainLoopFinds)
{
  Crowd crowd(CurledLeaf());
  Random random(9, 1);
  const auto place = [&]
  { return Vec3(random.Uniform(0, 0.5), random.Uniform(0, 0.5), random.Uniform(0, 0.5)); };
  for (int o = 0; o < 25; ++o)
  {
    const Vec3 from = place();
    const Vec3 to = place();
    crowd.Add(from, to, About(AnyDirection(random), random.Uniform(0, 180)), 12);
  }
  const PosedMotion motion = crowd.Motion();
  const KeptDistances kept = KeptOf(motion, {}, 30.0);
  const std::vector<MeshCut> cuts = FindMeshCuts(motion, kept, TouchedDepth, ThreadedFor(2));
  const std::vector<MeshCut> again = FindMeshCuts(motion, kept, TouchedDepth, ThreadedFor(1));
  std::size_t next = 0;
  ASSERT_EQ(cuts.size(), again.size());
  for (int f = 0; f < 12; ++f)
  {
    for (std::size_t a = 0; a < 25; ++a)
    {
      for (std::size_t b = a + 1; b < 25; ++b)
      {
        const auto frame = static_cast<std::size_t>(f);
        if (IsDeeper(motion.At(a, frame), motion.At(b, frame),
                     TouchedDepth * crowd.Meshes->front().Length()))
        {
          ASSERT_LT(next, cuts.size());
          EXPECT_EQ(cuts[next].Frame, f);
          EXPECT_EQ(cuts[next].A, a);
          EXPECT_EQ(cuts[next].B, b);
          EXPECT_EQ(again[next].A, a);
          ++next;
        }
      }
    }
  }
  EXPECT_EQ(next, cuts.size());
  EXPECT_GT(next, 10U);
}

TEST(MeshCuts, MarksThatLeaveTooLittleRoomAreToldApart)
{
  // Two pairs fly through each other in the middle of the motion; marks hold one of the pairs
  // together there.
  Crowd crowd(CurledLeaf());
  constexpr int Frames = 121;
  for (const double aside : { 0.0, 1.0 })
  {
    crowd.Add(Vec3(aside, -1.0, 0.0), Vec3(aside, 1.0, 0.0), Quat::Identity(), Frames);
    crowd.Add(Vec3(aside, 1.0, 0.0), Vec3(aside, -1.0, 0.0), About(Vec3::UnitX(), 70.0), Frames);
  }
  std::vector<Constraint> rows(2);
  for (int k = 0; k < 2; ++k)
  {
    rows[static_cast<std::size_t>(k)].ObjectId = k;
    rows[static_cast<std::size_t>(k)].Frame = 60;
  }
  const PosedMotion motion = crowd.Motion();
  const std::vector<MeshCut> cuts =
    FindMeshCuts(motion, KeptOf(motion, rows, 30.0), TouchedDepth, ThreadedFor(1));
  int held = 0, free = 0;
  for (const MeshCut& cut : cuts)
  {
    EXPECT_EQ(cut.NearMarks, cut.A == 0);
    (cut.A == 0 ? held : free) += 1;
  }
  EXPECT_GT(held, 0);
  EXPECT_EQ(held, free);
  rows[0].Status = ConstraintStatus::Unreachable;
  for (const MeshCut& cut :
       FindMeshCuts(motion, KeptOf(motion, rows, 30.0), TouchedDepth, ThreadedFor(1)))
  {
    EXPECT_FALSE(cut.NearMarks);
  }
}

TEST(MeshCuts, AHeapAtRestIsPassedOver)
{
  Crowd crowd(CurledLeaf());
  crowd.Add(Vec3::Zero(), Vec3::Zero(), Quat::Identity(), 5);
  crowd.Add(Vec3(0.02, 0.0, 0.0), Vec3(0.02, 0.0, 0.0), About(Vec3::UnitX(), 60.0), 5);
  const auto cuts = [&]
  {
    const PosedMotion motion = crowd.Motion();
    return FindMeshCuts(motion, KeptOf(motion, {}, 30.0), TouchedDepth, ThreadedFor(1)).size();
  };
  EXPECT_EQ(cuts(), 1U) << "at the first frame nobody knows";
  crowd.Poses[0].Orientations[2] = About(Vec3::UnitZ(), 1.0);
  crowd.Poses[1].Orientations[2] = About(Vec3::UnitX(), 61.0);
  EXPECT_EQ(cuts(), 3U) << "they turn there and back";
  std::vector<Constraint> rests(2);
  for (int k = 0; k < 2; ++k)
  {
    rests[static_cast<std::size_t>(k)].ObjectId = k;
    rests[static_cast<std::size_t>(k)].Kind = ConstraintKind::Rest;
    rests[static_cast<std::size_t>(k)].TouchDown = 2 * k;
    rests[static_cast<std::size_t>(k)].Until = 4;
  }
  PosedMotion motion = crowd.Motion();
  TakeRests(rests, motion);
  EXPECT_EQ(FindMeshCuts(motion, KeptOf(motion, {}, 30.0), TouchedDepth, ThreadedFor(1)).size(), 2U)
    << "both lie from frame 3 on, and rock";
}
