// SPDX-License-Identifier: BSD-3-Clause
// Flies the feather of a scene past a box, and tells where it passes its mark.
#include "Chain/BuiltinAssets.h"
#include "Chain/RunChain.h"
#include "Trajectory/DatabaseFile.h"

#include <iostream>

using namespace waft;

Result Fly(const std::string& sceneFile, const std::string& databaseFile, Motion& motion)
{
  Scene scene;
  SceneWind wind;
  MotionDatabase database;
  SilentMonitor monitor;
  WAFT_RETURN_IF_FAILED(ReadSceneAndWind(sceneFile, BuiltinAssets(), scene, wind));
  WAFT_RETURN_IF_FAILED(ReadDatabase(databaseFile, database));
  return RunChain({ scene, wind, database }, ChainOptions::At(Quality::Preview), SerialFor(),
                  monitor, motion);
}

int main(int count, char** words) // SCENE [DATABASE]
{
  Motion motion;
  const Result result = Fly(words[1], count > 2 ? words[2] : DATABASE, motion);
  for (const JoinedRow& row : motion.Report)
  {
    std::cout << "mark " << row.Row << ": " << ToString(row.Status) << ", at "
              << motion.Tracks[0].Positions[75].transpose() << "\n";
  }
  std::cerr << result.Message();
  return result ? 0 : 1;
}
