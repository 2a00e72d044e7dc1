// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ConstraintConflicts.h"

#include "Base/NumberText.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

std::string Apart(double distance, double allowed, ConstraintKind kind)
{
  const std::string unit = std::string(" ") + TraitsOf(kind).Unit;
  return NumberText(distance) + unit + " apart, expected at most " + NumberText(allowed) + unit;
}

} // namespace

ObjectWishes::ObjectWishes(const Vec3& start, double tolerance) : Tolerance(tolerance)
{
  Wish wish;
  wish.Stencil = { { 0, 1.0 } };
  wish.Value = start;
  this->Add(wish);
}

Contradiction ObjectWishes::Add(const Wish& wish)
{
  Contradiction found =
    IsPositional(wish.Kind) ? this->CheckPosition(wish) : this->CheckSameDerivative(wish);
  if (found.IsEmpty() && !IsPositional(wish.Kind))
  {
    found = this->CheckDerivative(wish, wish);
  }
  std::set<int> lines;
  double gap = 0.0;
  if (found.IsEmpty() && wish.Radius == 0.0 &&
      this->Exact.Add(wish.Stencil, wish.Value, wish.Line, this->Tolerance, lines, gap) ==
        LinearRows::Answer::Contradictory)
  {
    found = { wish, lines,
              "no positions satisfy all of them, " + NumberText(gap) + " m are missing" };
  }
  if (found.IsEmpty())
  {
    this->Keep(wish);
  }
  return found;
}

void ObjectWishes::Keep(const Wish& wish)
{
  this->Begin(wish.Line);
  if (!IsPositional(wish.Kind))
  {
    this->Derivatives.push_back(wish);
    return;
  }
  // Another ball about the same place that is no smaller says nothing new: of ten thousand equal
  // rows one is kept.
  std::vector<Wish>& own = this->Positions[wish.Frame];
  const bool isSaid = std::any_of(
    own.begin(), own.end(),
    [&](const Wish& other) { return other.Value == wish.Value && other.Radius <= wish.Radius; });
  if (!isSaid)
  {
    own.push_back(wish);
    this->NewestFrames.push_back(wish.Frame);
  }
}

void ObjectWishes::Begin(int line)
{
  if (this->NewestLine != line)
  {
    this->NewestLine = line;
    this->NewestFrames.clear();
  }
}

Contradiction ObjectWishes::CheckPosition(const Wish& wish) const
{
  const auto positions = this->Positions.find(wish.Frame);
  for (std::size_t n = 0; positions != this->Positions.end() && n < positions->second.size(); ++n)
  {
    const Wish& other = positions->second[n];
    const double distance = (wish.Value - other.Value).norm();
    if (distance > wish.Radius + other.Radius + this->Tolerance)
    {
      return { wish, { other.Line }, Apart(distance, wish.Radius + other.Radius, wish.Kind) };
    }
  }
  for (const Wish& derivative : this->Derivatives)
  {
    Contradiction found;
    if (derivative.Stencil.count(wish.Frame))
    {
      found = this->CheckDerivative(derivative, wish);
    }
    if (!found.IsEmpty())
    {
      return found;
    }
  }
  return {};
}

Contradiction ObjectWishes::CheckSameDerivative(const Wish& wish) const
{
  for (const Wish& other : this->Derivatives)
  {
    const double distance = (wish.Value - other.Value).norm();
    if (other.Kind == wish.Kind && other.Frame == wish.Frame &&
        distance > wish.Radius + other.Radius + this->Tolerance)
    {
      return { wish, { other.Line }, Apart(distance, wish.Radius + other.Radius, wish.Kind) };
    }
  }
  return {};
}

/// Positions at all frames of a derivative's stencil decide whether it can hold: the smallest ball
/// of each frame counts, the candidate's among them.
Contradiction ObjectWishes::CheckDerivative(const Wish& derivative, const Wish& candidate) const
{
  Vec3 centre = -derivative.Value;
  double reach = derivative.Radius;
  double largest = 0.0;
  std::set<int> lines{ derivative.Line };
  for (const auto& [frame, c] : derivative.Stencil)
  {
    const Wish* best =
      IsPositional(candidate.Kind) && candidate.Frame == frame ? &candidate : nullptr;
    const auto positions = this->Positions.find(frame);
    for (std::size_t n = 0; positions != this->Positions.end() && n < positions->second.size(); ++n)
    {
      const Wish& position = positions->second[n];
      best = !best || position.Radius < best->Radius ? &position : best;
    }
    if (!best)
    {
      return {};
    }
    centre += c * best->Value;
    reach += std::abs(c) * best->Radius;
    largest = std::max(largest, std::abs(c));
    lines.insert(best->Line);
  }
  if (largest == 0.0 || centre.norm() <= reach + largest * this->Tolerance)
  {
    return {};
  }
  lines.erase(candidate.Line);
  return { candidate, lines,
           "the places allow no " + std::string(ToString(derivative.Kind)) + " nearer than " +
             NumberText(centre.norm() - reach + derivative.Radius) +
             " to the one wished, expected " + NumberText(derivative.Radius) };
}

Contradiction ObjectWishes::AddOrientation(const Constraint& row, int line)
{
  for (const auto& [other, otherLine] : this->Orientations)
  {
    const double angle = row.Orientation.angularDistance(other.Orientation);
    if (other.Frame == row.Frame &&
        angle > row.Radius + other.Radius + TraitsOf(row.Kind).Tolerance)
    {
      Wish wish;
      wish.Line = line;
      wish.Kind = row.Kind;
      wish.Frame = row.Frame;
      return { wish, { otherLine }, Apart(angle, row.Radius + other.Radius, row.Kind) };
    }
  }
  this->Begin(line);
  this->Orientations.emplace_back(row, line);
  return {};
}

void ObjectWishes::Withdraw(int line)
{
  if (this->NewestLine != line)
  {
    return;
  }
  this->Exact.Withdraw(line);
  while (!this->Derivatives.empty() && this->Derivatives.back().Line == line)
  {
    this->Derivatives.pop_back();
  }
  for (const int frame : this->NewestFrames)
  {
    this->Positions[frame].pop_back();
  }
  this->NewestFrames.clear();
  while (!this->Orientations.empty() && this->Orientations.back().second == line)
  {
    this->Orientations.pop_back();
  }
}

} // namespace waft
