// SPDX-License-Identifier: BSD-3-Clause
// E over the frames of a level in double precision by brute force, as rows r of which it is half
// the sum of squares, with their tangent and adjoint: plain code to hold the fast objective
// against, and a problem for other solvers.
#pragma once

#include "Particles/SphReference.h"
#include "ReferenceForces.h"
#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Model/TimeLevel.h"

#include <vector>

namespace waft
{
namespace test
{

class ReferenceObjective
{
public:
  /// All frames, or those of a level. The model must outlive the reference.
  explicit ReferenceObjective(const SpacetimeModel& model);
  ReferenceObjective(const SpacetimeModel& model, TimeLevel level);

  using Numbers = std::vector<double>;

  /// Unknowns: x, y, z, u, v, w of each body of each frame.
  std::size_t Size() const { return 6 * this->Model.NumberOfBodies() * this->NumberOfFrames(); }
  Numbers From(const StateVector& state) const;
  StateVector To(const Numbers& z) const;

  /// The rows at z; their change for a change of z; the transpose of that, for weights of the rows.
  Numbers Rows(const double* z) const;
  Numbers Tangent(const double* z, const Numbers& change) const;
  Numbers Adjoint(const double* z, const Numbers& weights) const;
  /// E, and unless null its gradient, and its slope by what accelerates each body [frame * bodies +
  /// body], by which fields of any kind are known to act on it.
  double Evaluate(const double* z, double* gradient,
                  std::vector<Vec3>* byAcceleration = nullptr) const;
  Vec3 PlaceOf(const double* z, std::size_t j, std::size_t body) const
  {
    return this->At(z, j, body, 0);
  }

private:
  /// What the rows are made of, of a frame: each body's place, velocity, acceleration a and
  /// velocity average D, and how a and D depend on the former.
  struct Frame
  {
    SphState Particles;
    std::vector<OutsideForce> Outside;
    std::vector<Vec3> Accelerations, Averages;
    // Of each particle: D, the factor with which it counts, and that factor's gradient.
    std::vector<Vec3> Drawn, RaiseGradients;
    std::vector<double> Raises;
  };
  enum Quantity
  {
    Place,
    Speed,
    Acceleration,
    Average,
    NumberOfQuantities
  };
  /// The rows' values and their derivatives by the quantities.
  struct RowSet
  {
    struct Entry
    {
      std::size_t Row, Column;
      double Value;
    };
    Numbers Values;
    std::vector<Entry> Entries;
    /// Of the row that comes next.
    void Depends(std::size_t column, double value)
    {
      this->Entries.push_back({ this->Values.size(), column, value });
    }
  };

  std::size_t NumberOfFrames() const { return this->Level.NumberOfFrames(); }
  std::size_t Unknown(std::size_t j, std::size_t body, int component) const
  {
    return 6 * (j * this->Model.NumberOfBodies() + body) + component;
  }
  std::size_t Column(std::size_t j, std::size_t body, Quantity quantity, int component) const
  {
    return 3 * (NumberOfQuantities * (j * this->Model.NumberOfBodies() + body) + quantity) +
           component;
  }
  Vec3 At(const double* z, std::size_t j, std::size_t body, int first) const
  {
    return Vec3(z + this->Unknown(j, body, first));
  }
  template <typename Function>
  void ForEach(Function function) const;
  SphVolume Volume(std::size_t j) const;
  std::size_t FirstParticle(std::size_t body) const;
  std::size_t ParticlesOf(std::size_t body) const;
  double DragRate(std::size_t body) const;
  Vec3 Mean(const std::vector<Vec3>& values, std::size_t body) const;
  void Raise(std::size_t j, Frame& frame, std::vector<Vec3>& averages) const;

  std::vector<Frame> Frames(const double* z) const;
  RowSet MakeRows(const double* z, const std::vector<Frame>& frames) const;
  void AddMotion(const double* z, const std::vector<Frame>& frames, std::size_t j,
                 RowSet& rows) const;
  void AddCoherence(const double* z, const std::vector<Frame>& frames, std::size_t j,
                    RowSet& rows) const;
  void AddClearance(const double* z, std::size_t j, RowSet& rows) const;
  void AddApproach(const double* z, std::size_t j, RowSet& rows) const;
  /// root (distance - |x_a - x_b|) for bodies nearer to each other, of objects their PairDistance.
  void AddPairs(const double* z, std::size_t j, std::size_t first, std::size_t last,
                double distance, double weight, RowSet& rows) const;
  /// The weighted sum of the rows by each quantity, and from there by the unknowns.
  Numbers ByQuantities(const RowSet& rows, const Numbers& weights) const;
  Numbers PullBack(const std::vector<Frame>& frames, const Numbers& bars) const;

  const SpacetimeModel& Model;
  TimeLevel Level;
  SphFluid Fluid;
};

} // namespace test
} // namespace waft
