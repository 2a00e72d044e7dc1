// SPDX-License-Identifier: BSD-3-Clause
// The rows whose squares make up E.
#include "ReferenceObjective.h"

#include "Spacetime/Energy/ObjectTerms.h"

#include <cmath>

namespace waft
{
namespace test
{
namespace
{

constexpr double ClearanceMargin = 0.03; // kept beyond what is asked for [dx]

} // namespace

// Eq. 3: the step from level frame j to the next one.
void ReferenceObjective::AddMotion(const double* z, const std::vector<Frame>& frames, std::size_t j,
                                   RowSet& rows) const
{
  const SpacetimeWeights& w = this->Model.Weights;
  const double s = this->Level.Steps[j + 1];
  for (std::size_t i = 0; i < this->Model.NumberOfBodies(); ++i)
  {
    if (i >= this->Model.NumberOfGas &&
        StepIsBound(this->Model, this->Level, j + 1, i - this->Model.NumberOfGas))
    {
      continue;
    }
    const double weight = this->Model.BodyWeight(i) * this->Level.StepWeights[j + 1];
    const double x =
      std::sqrt((i < this->Model.NumberOfGas ? 1.0 : w.ObjectPosition) * w.PositionWeight * weight);
    const double v = std::sqrt(w.VelocityWeight * weight);
    const Vec3 next = this->At(z, j + 1, i, 3);
    const Vec3 rx = this->At(z, j + 1, i, 0) - this->At(z, j, i, 0) -
                    s * (next + w.XsphFactor * frames[j].Averages[i]);
    const Vec3 rv = next - this->At(z, j, i, 3) - s * frames[j].Accelerations[i];
    for (int c = 0; c < 3; ++c)
    {
      rows.Depends(this->Column(j + 1, i, Place, c), x);
      rows.Depends(this->Column(j, i, Place, c), -x);
      rows.Depends(this->Column(j + 1, i, Speed, c), -x * s);
      rows.Depends(this->Column(j, i, Average, c), -x * s * w.XsphFactor);
      rows.Values.push_back(x * rx[c]);
      rows.Depends(this->Column(j + 1, i, Speed, c), v);
      rows.Depends(this->Column(j, i, Speed, c), -v);
      rows.Depends(this->Column(j, i, Acceleration, c), -v * s);
      rows.Values.push_back(v * rv[c]);
    }
  }
}

// Eq. 4.
void ReferenceObjective::AddCoherence(const double* z, const std::vector<Frame>& frames,
                                      std::size_t j, RowSet& rows) const
{
  const SpacetimeWeights& w = this->Model.Weights;
  const double own = this->Model.Fluid.GasMass * this->Model.Fluid.Kernel(0.0);
  for (std::size_t i = 0; i < this->Model.NumberOfBodies(); ++i)
  {
    double slip = 0.0;
    double air = 1.0;
    if (i >= this->Model.NumberOfGas)
    {
      const std::size_t object = i - this->Model.NumberOfGas;
      slip = this->Model.SettlingSlip(object);
      air = w.ObjectCoherence * this->Model.CoherenceFraction(this->Level.Frames[j], object);
    }
    const double weight = w.CoherenceWeight * this->Model.BodyWeight(i);
    const double space =
      std::sqrt(weight * air * w.SpatialShare * this->Level.FrameWeights[j]) / (1.0 - own);
    const double time = std::sqrt(weight * (1.0 - w.SpatialShare) * this->Level.SmoothWeights[j]);
    Vec3 rt = this->At(z, j, i, 3);
    for (const TimeLevel::Neighbour& neighbour : this->Level.Rows[j])
    {
      rt -= neighbour.Coefficient * this->At(z, neighbour.Frame, i, 3);
    }
    const Vec3 rs = frames[j].Averages[i] - slip * Vec3::UnitZ();
    for (int c = 0; c < 3; ++c)
    {
      rows.Depends(this->Column(j, i, Average, c), space);
      rows.Values.push_back(space * rs[c]);
      rows.Depends(this->Column(j, i, Speed, c), time);
      for (const TimeLevel::Neighbour& neighbour : this->Level.Rows[j])
      {
        rows.Depends(this->Column(neighbour.Frame, i, Speed, c), -time * neighbour.Coefficient);
      }
      rows.Values.push_back(time * rt[c]);
    }
  }
}

void ReferenceObjective::AddClearance(const double* z, std::size_t j, RowSet& rows) const
{
  const int frame = this->Level.Frames[j];
  const double root = std::sqrt(this->Model.Weights.Clearance * this->Level.FrameWeights[j]);
  for (std::size_t o = 0; o < this->Model.NumberOfObjects; ++o)
  {
    if (this->Model.Flag(frame, o) & FixedPosition)
    {
      continue;
    }
    const std::size_t i = this->Model.NumberOfGas + o;
    const Vec3 x = this->At(z, j, i, 0);
    const auto keep = [&](double clearance, double distance, const Vec3& normal)
    {
      if (clearance > distance)
      {
        for (int c = 0; c < 3; ++c)
        {
          rows.Depends(this->Column(j, i, Place, c), -root * normal[c]);
        }
        rows.Values.push_back(root * (clearance - distance));
      }
    };
    for (int c = 0; c < 3; ++c)
    {
      const double usual = this->Model.Clearances[o].Radius + ClearanceMargin;
      keep(c == 2 ? FloorClearance(this->Model, frame, o) : usual, x[c], Vec3::Unit(c));
      keep(usual, this->Model.Size[c] - x[c], -Vec3::Unit(c));
    }
    if (!this->Model.Obstacles.IsEmpty())
    {
      Vec3 normal;
      Mat3 curvature;
      const double distance = this->Model.Obstacles.Evaluate(x, frame, normal, curvature);
      keep(ObstacleClearance(this->Model, frame, o), distance, normal);
    }
  }
}

void ReferenceObjective::AddApproach(const double* z, std::size_t j, RowSet& rows) const
{
  const int frame = this->Level.Frames[j];
  const double root = std::sqrt(this->Model.Weights.Reach * this->Level.FrameWeights[j]);
  for (std::size_t o = 0; o < this->Model.NumberOfObjects && !this->Model.Reach.empty(); ++o)
  {
    const std::size_t place = frame * this->Model.NumberOfObjects + o;
    const std::size_t i = this->Model.NumberOfGas + o;
    const Vec3 d = this->At(z, j, i, 0) - this->Model.Approach[place];
    const double beyond = d.norm() - this->Model.Reach[place];
    if (this->Model.Reach[place] > 0.0f && beyond > 0.0 &&
        !(this->Model.Flags[place] & FixedPosition))
    {
      for (int c = 0; c < 3; ++c)
      {
        rows.Depends(this->Column(j, i, Place, c), root * d[c] / d.norm());
      }
      rows.Values.push_back(root * beyond);
    }
  }
}

void ReferenceObjective::AddPairs(const double* z, std::size_t j, std::size_t first,
                                  std::size_t last, double distance, double weight,
                                  RowSet& rows) const
{
  const std::size_t gas = this->Model.NumberOfGas;
  const double root = std::sqrt(weight * this->Level.FrameWeights[j]);
  const auto isFixed = [&](std::size_t i)
  { return i >= gas && (this->Model.Flag(this->Level.Frames[j], i - gas) & FixedPosition); };
  for (std::size_t a = first; a < last; ++a)
  {
    for (std::size_t b = a + 1; b < last; ++b)
    {
      const Vec3 d = this->At(z, j, a, 0) - this->At(z, j, b, 0);
      const double r = d.norm();
      const double reach =
        a < gas ? distance : PairDistance(this->Model, this->Level.Frames[j], a - gas, b - gas);
      if (r >= reach || (isFixed(a) && isFixed(b)))
      {
        continue;
      }
      for (int c = 0; c < 3; ++c)
      {
        rows.Depends(this->Column(j, a, Place, c), -root * d[c] / r);
        rows.Depends(this->Column(j, b, Place, c), root * d[c] / r);
      }
      rows.Values.push_back(root * (reach - r));
    }
  }
}

ReferenceObjective::RowSet ReferenceObjective::MakeRows(const double* z,
                                                        const std::vector<Frame>& frames) const
{
  const SpacetimeWeights& w = this->Model.Weights;
  RowSet rows;
  for (std::size_t j = 0; j < frames.size(); ++j)
  {
    if (j + 1 < frames.size())
    {
      this->AddMotion(z, frames, j, rows);
    }
    this->AddCoherence(z, frames, j, rows);
    this->AddClearance(z, j, rows);
    this->AddApproach(z, j, rows);
    this->AddPairs(z, j, this->Model.NumberOfGas, this->Model.NumberOfBodies(), w.ContactDistance,
                   w.Contact, rows);
    this->AddPairs(z, j, 0, this->Model.NumberOfGas, w.GasDistance, w.Separation, rows);
  }
  return rows;
}

} // namespace test
} // namespace waft
