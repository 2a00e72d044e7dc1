// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LinearRows.h"

#include <cmath>

namespace waft
{

LinearRows::Answer LinearRows::Add(const std::map<int, double>& coefficients, const Vec3& value,
                                   int tag, double tolerance, std::set<int>& tags, double& gap)
{
  Row row{ coefficients, value, { tag }, tag };
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
      return Answer::Independent;
    }
    for (const auto& [f, coefficient] : found->second.Coefficients)
    {
      row.Coefficients[f] -= c * coefficient;
    }
    row.Coefficients.erase(frame);
    row.Value -= c * found->second.Value;
    row.Tags.insert(found->second.Tags.begin(), found->second.Tags.end());
  }
  gap = row.Value.norm();
  if (gap <= tolerance)
  {
    return Answer::Implied;
  }
  tags = row.Tags;
  tags.erase(tag);
  return Answer::Contradictory;
}

void LinearRows::Withdraw(int tag)
{
  for (auto it = this->Rows.begin(); it != this->Rows.end();)
  {
    it = it->second.Tag == tag ? this->Rows.erase(it) : std::next(it);
  }
}

} // namespace waft
