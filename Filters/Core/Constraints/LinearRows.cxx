// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LinearRows.h"

#include <cmath>

namespace waft
{

LinearRows::Answer LinearRows::Add(const std::map<int, double>& coefficients, const Vec3& value,
                                   int tag, double tolerance, std::set<int>& tags, double& gap)
{
  Row row{ coefficients, value, tag, {} };
  double largest = 0.0;
  for (const auto& [frame, c] : coefficients)
  {
    largest = std::max(largest, std::abs(c));
  }
  if (largest == 0.0)
  {
    return Answer::Implied;
  }
  for (auto& [frame, c] : row.Coefficients)
  {
    c /= largest;
  }
  row.Value /= largest;
  while (!row.Coefficients.empty())
  {
    const auto [frame, c] = *row.Coefficients.begin();
    if (std::abs(c) < 1e-12)
    {
      row.Coefficients.erase(frame);
      continue;
    }
    const auto found = this->Rows.find(frame);
    if (found == this->Rows.end())
    {
      for (auto& [f, coefficient] : row.Coefficients)
      {
        coefficient /= c;
      }
      row.Value /= c;
      this->Rows.emplace(frame, std::move(row));
      if (this->NewestTag != tag)
      {
        this->Newest.clear();
        this->NewestTag = tag;
      }
      this->Newest.push_back(frame);
      return Answer::Independent;
    }
    for (const auto& [f, coefficient] : found->second.Coefficients)
    {
      row.Coefficients[f] -= c * coefficient;
    }
    row.Coefficients.erase(frame);
    row.Value -= c * found->second.Value;
    row.Taken.push_back(frame);
  }
  gap = row.Value.norm();
  if (gap <= tolerance)
  {
    return Answer::Implied;
  }
  tags = this->TagsOf(row);
  tags.erase(tag);
  return Answer::Contradictory;
}

/// Of all that a row is made of: rows name what was subtracted from them, since lists of tags would
/// grow with the square of their number along a chain of differences.
std::set<int> LinearRows::TagsOf(const Row& row) const
{
  std::set<int> tags{ row.Tag };
  std::set<int> seen;
  std::vector<int> open = row.Taken;
  while (!open.empty())
  {
    const int frame = open.back();
    open.pop_back();
    if (seen.insert(frame).second)
    {
      const Row& taken = this->Rows.at(frame);
      tags.insert(taken.Tag);
      open.insert(open.end(), taken.Taken.begin(), taken.Taken.end());
    }
  }
  return tags;
}

void LinearRows::Withdraw(int tag)
{
  if (this->NewestTag != tag)
  {
    return;
  }
  for (const int frame : this->Newest)
  {
    this->Rows.erase(frame);
  }
  this->Newest.clear();
}

} // namespace waft
