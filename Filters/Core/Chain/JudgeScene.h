// SPDX-License-Identifier: BSD-3-Clause
// What of a scene cannot be, and what will be hard, before anything is flown.
#pragma once

#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Constraints/Constraint.h"
#include "Scene/Scene.h"
#include "Trajectory/MotionDatabase.h"

#include <optional>
#include <string>
#include <vector>

namespace waft
{

/// A sentence about a scene, and what it is about; -1 and no place where it is about no one thing.
struct Finding
{
  bool IsPossible = true; // false: a row that cannot be met; else it is only hard, or odd
  std::string Kind;       // what it has in common with others
  std::string Text;
  int ObjectId = -1;
  int Frame = -1;
  int Row = -1; // of the scene's list
  int Target = -1;
  std::optional<Vec3> Place; // m

  /// "cannot be met: " or "hard: ", and the text.
  std::string Line() const;
};

struct SceneJudgement
{
  std::size_t NumberOfObjects = 0;
  std::vector<Constraint> Constraints; // as given, every row assigned, with its Status
  std::vector<ReportRow> Report;
  std::vector<Finding> Findings; // those that cannot be first, then what is odd, then what is hard

  std::size_t NumberOfImpossible() const;
  /// Line() of the first few findings of each kind, and of each kind how many more there are.
  std::vector<std::string> Lines() const;
};

/// What the planner will say of a scene's rows, and what it asks of bodies and air: legs longer
/// than air carries a body in their time, rests with no time to fall, bodies that no air bears,
/// gaps that no body passes, marks nearer to obstacles or to one another than bodies are wide,
/// volumes too full, scenes too large for the optimiser. Fails where no quality could fly it.
Result JudgeScene(const Scene& scene, const MotionDatabase& database, const ParallelFor& parallel,
                  SceneJudgement& judgement);

} // namespace waft
