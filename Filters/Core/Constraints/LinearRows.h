// SPDX-License-Identifier: BSD-3-Clause
// Exact constraints on one object as linear equations on its positions.
#pragma once

#include "Base/Types.h"

#include <map>
#include <set>
#include <vector>

namespace waft
{

/// A growing set of equations sum_f c_f x_f = b (x_f and b in space) in echelon form.
class LinearRows
{
public:
  enum class Answer
  {
    Independent,
    Implied, // follows from the others
    Contradictory
  };

  /// Adds an equation; `tag` names its origin. When it is contradictory nothing is added, `tags`
  /// holds the origins of what it contradicts and `gap` by how much [m, with the largest
  /// coefficient scaled to 1].
  Answer Add(const std::map<int, double>& coefficients, const Vec3& value, int tag,
             double tolerance, std::set<int>& tags, double& gap);

  /// Forgets all equations with this tag, which must be the last that was added.
  void Withdraw(int tag);

private:
  struct Row
  {
    std::map<int, double> Coefficients; // that of the lowest frame is 1
    Vec3 Value;
    int Tag;
    std::vector<int> Taken; // lowest frames of the rows that were subtracted from what was added
  };
  std::set<int> TagsOf(const Row& row) const;

  std::map<int, Row> Rows; // by lowest frame
  std::vector<int> Newest; // lowest frames of the rows with the tag that was added last
  int NewestTag = 0;
};

} // namespace waft
