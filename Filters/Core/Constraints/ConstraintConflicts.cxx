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

KeptConstraints::KeptConstraints(const Vec3& start, double tolerance) : Tolerance(tolerance)
{
  ConstraintBall ball;
  ball.Stencil = { { 0, 1.0 } };
  ball.Value = start;
  this->Add(ball);
}

Contradiction KeptConstraints::Add(const ConstraintBall& ball)
{
  Contradiction found =
    IsPositional(ball.Kind) ? this->CheckPosition(ball) : this->CheckSameDerivative(ball);
  if (found.IsEmpty() && !IsPositional(ball.Kind))
  {
    found = this->CheckDerivative(ball, ball);
  }
  std::set<int> lines;
  double gap = 0.0;
  if (found.IsEmpty() && ball.Radius == 0.0 &&
      this->Exact.Add(ball.Stencil, ball.Value, ball.Line, this->Tolerance, lines, gap) ==
        LinearRows::Answer::Contradictory)
  {
    found = { ball, lines,
              "no positions satisfy all of them, " + NumberText(gap) + " m are missing" };
  }
  if (found.IsEmpty())
  {
    this->Keep(ball);
  }
  return found;
}

void KeptConstraints::Keep(const ConstraintBall& ball)
{
  this->Begin(ball.Line);
  if (!IsPositional(ball.Kind))
  {
    this->Derivatives.push_back(ball);
    return;
  }
  // Another ball about the same place that is no smaller says nothing new: of ten thousand equal
  // rows one is kept.
  std::vector<ConstraintBall>& own = this->Positions[ball.Frame];
  const bool isSaid = std::any_of(own.begin(), own.end(),
                                  [&](const ConstraintBall& other) {
                                    return other.Value == ball.Value && other.Radius <= ball.Radius;
                                  });
  if (!isSaid)
  {
    own.push_back(ball);
    this->NewestFrames.push_back(ball.Frame);
  }
}

void KeptConstraints::Begin(int line)
{
  if (this->NewestLine != line)
  {
    this->NewestLine = line;
    this->NewestFrames.clear();
  }
}

Contradiction KeptConstraints::CheckPosition(const ConstraintBall& ball) const
{
  const auto positions = this->Positions.find(ball.Frame);
  for (std::size_t n = 0; positions != this->Positions.end() && n < positions->second.size(); ++n)
  {
    const ConstraintBall& other = positions->second[n];
    const double distance = (ball.Value - other.Value).norm();
    if (distance > ball.Radius + other.Radius + this->Tolerance)
    {
      return { ball, { other.Line }, Apart(distance, ball.Radius + other.Radius, ball.Kind) };
    }
  }
  for (const ConstraintBall& derivative : this->Derivatives)
  {
    Contradiction found;
    if (derivative.Stencil.count(ball.Frame))
    {
      found = this->CheckDerivative(derivative, ball);
    }
    if (!found.IsEmpty())
    {
      return found;
    }
  }
  return {};
}

Contradiction KeptConstraints::CheckSameDerivative(const ConstraintBall& ball) const
{
  for (const ConstraintBall& other : this->Derivatives)
  {
    const double distance = (ball.Value - other.Value).norm();
    if (other.Kind == ball.Kind && other.Frame == ball.Frame &&
        distance > ball.Radius + other.Radius + this->Tolerance)
    {
      return { ball, { other.Line }, Apart(distance, ball.Radius + other.Radius, ball.Kind) };
    }
  }
  return {};
}

/// Positions at all frames of a derivative's stencil decide whether it can hold: the smallest ball
/// of each frame counts, the candidate's among them.
Contradiction KeptConstraints::CheckDerivative(const ConstraintBall& derivative,
                                               const ConstraintBall& candidate) const
{
  Vec3 centre = -derivative.Value;
  double reach = derivative.Radius;
  double largest = 0.0;
  std::set<int> lines{ derivative.Line };
  for (const auto& [frame, c] : derivative.Stencil)
  {
    const ConstraintBall* best =
      IsPositional(candidate.Kind) && candidate.Frame == frame ? &candidate : nullptr;
    const auto positions = this->Positions.find(frame);
    for (std::size_t n = 0; positions != this->Positions.end() && n < positions->second.size(); ++n)
    {
      const ConstraintBall& position = positions->second[n];
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
             " to the one wanted, expected " + NumberText(derivative.Radius) };
}

Contradiction KeptConstraints::AddOrientation(const Constraint& row, int line)
{
  for (const auto& [other, otherLine] : this->Orientations)
  {
    const double angle = row.Orientation.angularDistance(other.Orientation);
    if (other.Frame == row.Frame &&
        angle > row.Radius + other.Radius + TraitsOf(row.Kind).Tolerance)
    {
      ConstraintBall ball;
      ball.Line = line;
      ball.Kind = row.Kind;
      ball.Frame = row.Frame;
      return { ball, { otherLine }, Apart(angle, row.Radius + other.Radius, row.Kind) };
    }
  }
  this->Begin(line);
  this->Orientations.emplace_back(row, line);
  return {};
}

void KeptConstraints::Withdraw(int line)
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
