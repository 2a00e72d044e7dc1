// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/SolidParts.h"

#include "Obstacles/ObstacleSet.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <set>

using namespace waft;
using namespace waft::testing;

namespace
{

const Box Slab{ Vec3(-2, -2, 0), Vec3(2, 2, 0.2) };
const Box OnIt{ Vec3(-0.5, -0.5, 0.2), Vec3(0.5, 0.5, 1.0) };  // shares a part of a face
const Box Beside{ Vec3(0.5, -0.5, 0.2), Vec3(1.0, 0.5, 1.0) }; // shares a whole face with that

TriangleMesh Together(const std::vector<TriangleMesh>& meshes)
{
  TriangleMesh all;
  for (const TriangleMesh& mesh : meshes)
  {
    Append(all, mesh);
  }
  return all;
}

} // namespace

TEST(SolidParts, SolidsThatTouchAreToldApart)
{
  const TriangleMesh mesh = Together({ MakeBox(Slab), MakeBox(OnIt), MakeBox(Beside) });
  int count = 0;
  const std::vector<int> solid = SolidOfTriangles(mesh, count);
  EXPECT_EQ(count, 3);
  ASSERT_EQ(solid.size(), 36u);
  for (std::size_t t = 0; t < solid.size(); ++t)
  {
    EXPECT_EQ(solid[t], static_cast<int>(t / 12)) << t;
  }
}

TEST(SolidParts, ATorusOfSplitPointsIsOne)
{
  int count = 0;
  const std::vector<int> solid = SolidOfTriangles(TorusMesh(Vec3::Zero(), 1.0, 0.3, 24, 12), count);
  EXPECT_EQ(count, 1);
  EXPECT_EQ(std::set<int>(solid.begin(), solid.end()), std::set<int>{ 0 });
}

TEST(SolidParts, AHollowIsItsShells)
{
  const TriangleMesh hollow = Together({ MakeBox({ Vec3(-1, -1, 0), Vec3(1, 1, 2) }),
                                         MakeBox({ Vec3(-0.8, -0.8, 0.2), Vec3(0.8, 0.8, 1.8) }),
                                         MakeBox({ Vec3(-0.2, -0.2, 0.8), Vec3(0.2, 0.2, 1.2) }),
                                         MakeBox({ Vec3(3, 3, 0), Vec3(4, 4, 1) }) });
  int count = 0;
  const std::vector<int> solid = SolidOfTriangles(hollow, count);
  EXPECT_EQ(count, 3); // the shell with its hollow, what lies in the hollow, what stands beside
  EXPECT_EQ(solid[0], 0);
  EXPECT_EQ(solid[12], 0);
  EXPECT_EQ(solid[24], 1);
  EXPECT_EQ(solid[36], 2);
}

TEST(SolidParts, NothingIsNoSolid)
{
  int count = 7;
  EXPECT_TRUE(SolidOfTriangles({}, count).empty());
  EXPECT_EQ(count, 0);
}
