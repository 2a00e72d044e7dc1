// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "Export/PosesCsv.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

using namespace waft;

TEST(PosesCsv, ReadsBackBitByBit)
{
  Random random(7);
  std::vector<Track> tracks(2);
  std::vector<PoseTrack> poses(2);
  const Timeline time{ 5, 24.0 };
  for (int i = 0; i < 2; ++i)
  {
    tracks[i].ObjectId = poses[i].ObjectId = 3 * i;
    for (int k = 0; k < 5; ++k)
    {
      tracks[i].Positions.push_back(random.Direction());
      const Vec3 axis = random.Direction();
      poses[i].Orientations.emplace_back(Eigen::AngleAxisd(random.Uniform(), axis));
      poses[i].AngularVelocities.push_back(1e-7 * random.Direction());
    }
  }
  std::string text;
  const auto collect = [&text](const std::string& part)
  {
    text += part;
    return true;
  };
  ASSERT_TRUE(PosesCsv(tracks, poses, time, collect));
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "object,frame,time,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz");
  for (int i = 0; i < 2; ++i)
  {
    const std::vector<Vec3> velocities = CentralDifferences(tracks[i].Positions, time.Step());
    for (int k = 0; k < 5; ++k)
    {
      ASSERT_TRUE(std::getline(lines, line));
      std::vector<double> v;
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');)
      {
        v.push_back(std::strtod(cell.c_str(), nullptr));
      }
      const Quat& q = poses[i].Orientations[k];
      const Vec3& x = tracks[i].Positions[k];
      const Vec3& w = poses[i].AngularVelocities[k];
      const std::vector<double> expected{ 3.0 * i,
                                          1.0 * k,
                                          k / 24.0,
                                          x.x(),
                                          x.y(),
                                          x.z(),
                                          q.w(),
                                          q.x(),
                                          q.y(),
                                          q.z(),
                                          velocities[k].x(),
                                          velocities[k].y(),
                                          velocities[k].z(),
                                          w.x(),
                                          w.y(),
                                          w.z() };
      EXPECT_EQ(v, expected);
    }
  }
  EXPECT_FALSE(std::getline(lines, line));
  poses[1].ObjectId = 9;
  text.clear();
  EXPECT_FALSE(PosesCsv(tracks, poses, time, collect));
  EXPECT_TRUE(text.empty());
}

TEST(PosesCsv, IsNotWrittenWhenItIsStopped)
{
  struct StoppingMonitor : Monitor
  {
    bool Tick(double, const std::string&) override { return false; }
  };
  StoppingMonitor monitor;
  const Vec3 place = Vec3::Zero();
  std::vector<Track> tracks(1);
  tracks[0].Positions = { place };
  const std::vector<PoseTrack> poses{ { 0, { Quat::Identity() }, { place }, { place } } };
  const Result result = WritePosesCsv("/nowhere/poses.csv", tracks, poses, { 1, 24.0 }, monitor);
  EXPECT_TRUE(result); // a folder that is not there would fail
  EXPECT_TRUE(result.IsStopped());
}

TEST(PosesCsv, SaysWhoIsInTheShotWhereAnyIsNot)
{
  std::vector<Track> tracks(2);
  std::vector<PoseTrack> poses(2);
  for (int i = 0; i < 2; ++i)
  {
    tracks[i].ObjectId = poses[i].ObjectId = i;
    tracks[i].Positions.assign(4, Vec3(i, 0.0, 0.0));
    poses[i].Orientations.assign(4, Quat::Identity());
    poses[i].AngularVelocities.assign(4, Vec3::Zero());
  }
  tracks[1].FirstPresent = 2;
  std::string text;
  ASSERT_TRUE(PosesCsv(tracks, poses, { 4, 24.0 },
                       [&text](const std::string& part)
                       {
                         text += part;
                         return true;
                       }));
  std::istringstream lines(text);
  std::string line, present;
  std::getline(lines, line);
  EXPECT_EQ(line, "object,frame,time,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,present");
  while (std::getline(lines, line))
  {
    present += line.back();
  }
  EXPECT_EQ("11110011", present);
}
