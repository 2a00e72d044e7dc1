// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/FieldNormal.h"

#include "Base/FractionDone.h"
#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Paper/BlockTridiagonal.h"
#include "Spacetime/Paper/ClosedCurl.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double LeastTimeFactor = 1e-3; // as a frame's terms leave a vortex out
constexpr double Gauge = 1e-8; // of the mean weight: holds what of a potential moves no wind

/// A knot and the fraction of the way to the next one.
struct Time
{
  int Knot = 0;
  double Fraction = 0.0;
};

Time TimeOf(const SplineWind& lattice, int knots, int frame)
{
  const double s = frame / lattice.FramesPerKnot;
  const int knot = std::min(static_cast<int>(s), std::max(0, knots - 2));
  return { knot, s - knot };
}

} // namespace

struct FieldNormal::Span
{
  Span(const SplineWind& lattice, Eigen::Index vortices) :
    First(lattice), Both(lattice), Second(lattice), Frame(lattice),
    ByNode(Eigen::MatrixXd::Zero(3 * (1 + vortices),
                                 2 * static_cast<Eigen::Index>(lattice.NumberOfNodes()))),
    OfVortices(Eigen::MatrixXd::Zero(vortices, vortices)),
    RightOfVortices(Eigen::VectorXd::Zero(vortices))
  {
  }

  NodeMatrix First, Both, Second; // of the knot, of it and the next, of the next
  NodeMatrix Frame;               // of one frame
  /// A column a node, of both knots: three of the right side, three of what stands beside it for
  /// each strength.
  Eigen::MatrixXd ByNode;
  Eigen::MatrixXd OfVortices; // its lower half
  Eigen::VectorXd RightOfVortices;
};

FieldNormal::FieldNormal(const SpacetimeModel& model, const AirFields& fields,
                         const FieldChoice& choice) :
  Choice(choice),
  Lattice(MakeWindLattice(model, WindOptions().FramesPerKnot))
{
  const FieldPenalty penalty(model);
  const int knots = KnotsOf(model, this->Lattice.FramesPerKnot);
  const double weight = MeanNodeWeight(model, this->Lattice, knots);
  for (std::size_t n = 0; n < fields.Vortices.size() && choice.Vortices; ++n)
  {
    this->Vortices.push_back(fields.Vortices[n]);
    this->Vortices.back().Strength = 1.0;
  }
  this->Knots = choice.Wind ? knots : 0;
  const auto vortices = static_cast<Eigen::Index>(this->Vortices.size());
  const auto block = static_cast<Eigen::Index>(3 * this->Lattice.NumberOfNodes());
  this->Beside.setZero(block * this->Knots, vortices);
  this->OfVortices.setZero(vortices, vortices);
  this->Right.setZero(block * this->Knots);
  this->RightOfVortices.setZero(vortices);
  for (Eigen::Index n = 0; n < vortices; ++n)
  {
    const Vortex& unit = this->Vortices[static_cast<std::size_t>(n)];
    this->OfVortices(n, n) = weight * penalty.Ridge * VortexNorm(model, this->Lattice, unit);
  }
  if (!choice.Wind)
  {
    return;
  }
  this->Curl = ClosedCurl(this->Lattice);
  const NodeMatrix inSpace = PenaltyInSpace(this->Lattice, penalty);
  for (int k = 0; k < knots; ++k)
  {
    const int neighbours = (k > 0 ? 1 : 0) + (k + 1 < knots ? 1 : 0);
    this->Diagonal.emplace_back(this->Lattice);
    this->Diagonal.back().Add(inSpace, weight);
    this->Diagonal.back().AddToDiagonal(neighbours * weight * penalty.TimeSmoothing);
    if (k + 1 < knots)
    {
      this->Upper.emplace_back(this->Lattice);
      this->Upper.back().AddToDiagonal(-weight * penalty.TimeSmoothing);
    }
  }
}

bool FieldNormal::Gather(const SpacetimeObjective& objective, const StateVector& state,
                         const ParallelFor& parallel, Monitor* monitor)
{
  constexpr std::size_t AtOnce = 4; // spans, so that a stop is heard soon
  const int knots = KnotsOf(objective.Model(), this->Lattice.FramesPerKnot);
  const TimeLevel& level = objective.Level();
  std::vector<std::pair<std::size_t, std::size_t>> spans(static_cast<std::size_t>(knots - 1));
  for (std::size_t j = 0; j + 1 < level.NumberOfFrames(); ++j)
  {
    auto& span =
      spans[static_cast<std::size_t>(TimeOf(this->Lattice, knots, level.Frames[j]).Knot)];
    span.first = span.second == 0 ? j : span.first;
    span.second = j + 1;
  }
  // One task a span of knots, added in their order: the same bits for any number of threads.
  for (std::size_t first = 0; first < spans.size(); first += AtOnce)
  {
    const std::size_t count = std::min(AtOnce, spans.size() - first);
    std::vector<Span> sums(count, Span(this->Lattice, this->RightOfVortices.size()));
    parallel(count,
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t k = begin; k < end; ++k)
               {
                 const auto& [from, to] = spans[first + k];
                 this->Gather(objective, state, from, to, sums[k]);
               }
             });
    for (std::size_t k = 0; k < count; ++k)
    {
      this->Add(static_cast<int>(first + k), sums[k]);
    }
    if (monitor && !monitor->Tick(FractionDone(first + count, spans.size()), {}))
    {
      return false;
    }
  }
  return true;
}

void FieldNormal::Gather(const SpacetimeObjective& objective, const StateVector& state,
                         std::size_t begin, std::size_t end, Span& span) const
{
  const SpacetimeModel& model = objective.Model();
  const TimeLevel& level = objective.Level();
  const SplineWind& wind = objective.Fields().Wind;
  const auto nodes = static_cast<Eigen::Index>(this->Lattice.NumberOfNodes());
  const bool isWithout = this->Vortices.empty() && !this->Choice.VorticesAct;
  std::vector<Vortex> absent; // of the fields, those that act at a frame
  std::vector<std::size_t> active;
  std::vector<double> factors;
  std::vector<Vec3> unit;
  Eigen::VectorXd asked(span.ByNode.rows()); // as a column of ByNode
  for (std::size_t j = begin; j < end; ++j)
  {
    const int frame = level.Frames[j];
    const double step = level.Steps[j + 1];
    const double t = TimeOf(this->Lattice, std::max(2, this->Knots), frame).Fraction;
    const double shares[2] = { 1.0 - t, t };
    absent.clear();
    for (const Vortex& vortex : objective.Fields().Vortices)
    {
      if (isWithout && vortex.TimeFactor(frame) >= LeastTimeFactor)
      {
        absent.push_back(vortex);
      }
    }
    active.clear();
    factors.clear();
    for (std::size_t n = 0; n < this->Vortices.size(); ++n)
    {
      const double factor = this->Vortices[n].TimeFactor(frame);
      if (factor >= LeastTimeFactor)
      {
        active.push_back(n);
        factors.push_back(factor);
      }
    }
    unit.resize(active.size());
    asked.setZero();
    span.Frame.Clear();
    for (std::size_t i = 0; i < model.NumberOfBodies(); ++i)
    {
      const bool isObject = i >= model.NumberOfGas;
      if ((isObject && !StepHasLaw(model, level, j + 1, i - model.NumberOfGas)) ||
          (this->Choice.Counts && !this->Choice.Counts(i)))
      {
        continue;
      }
      const Vec3 x = VectorAt(state.data() + j * model.FrameSize() + i, model.Stride());
      Vec3 target;
      objective.VelocityResidual(j + 1, i, target.data());
      target /= step;
      for (std::size_t n = 0; n < absent.size(); ++n)
      {
        target += absent[n].Acceleration(x, frame);
      }
      for (std::size_t n = 0; n < active.size(); ++n)
      {
        unit[n] = factors[n] * this->Vortices[active[n]].SpatialAcceleration(x);
        target += objective.Fields().Vortices[active[n]].Strength * unit[n];
      }
      if (this->Knots > 0 && !wind.IsEmpty())
      {
        target += SampleField(wind, x, frame);
      }
      const double weight = model.VelocityWeight(i) * level.StepWeights[j + 1] * step * step;
      for (std::size_t n = 0; n < active.size(); ++n)
      {
        const auto row = static_cast<Eigen::Index>(active[n]);
        span.RightOfVortices[row] += weight * unit[n].dot(target);
        for (std::size_t m = 0; m <= n; ++m)
        {
          span.OfVortices(row, static_cast<Eigen::Index>(active[m])) +=
            weight * unit[n].dot(unit[m]);
        }
      }
      if (this->Knots == 0)
      {
        continue;
      }
      asked.head<3>() = target;
      for (std::size_t n = 0; n < active.size(); ++n)
      {
        asked.segment<3>(3 * static_cast<Eigen::Index>(1 + active[n])) = unit[n];
      }
      const SplineStencil stencil = this->Lattice.Stencil(x);
      span.Frame.AddRow(this->Lattice, stencil, weight);
      for (int n = 0; n < 27; ++n)
      {
        const int a = n % 3, b = n / 3 % 3, c = n / 9;
        const auto node = static_cast<Eigen::Index>(
          this->Lattice.Node(stencil.First[0] + a, stencil.First[1] + b, stencil.First[2] + c));
        const double own =
          weight * stencil.Weights[0][a] * stencil.Weights[1][b] * stencil.Weights[2][c];
        for (int side = 0; side < 2; ++side)
        {
          span.ByNode.col(side * nodes + node) += shares[side] * own * asked;
        }
      }
    }
    span.First.Add(span.Frame, shares[0] * shares[0]);
    span.Both.Add(span.Frame, shares[0] * shares[1]);
    span.Second.Add(span.Frame, shares[1] * shares[1]);
  }
}

void FieldNormal::Add(int knot, const Span& span)
{
  this->OfVortices += Eigen::MatrixXd(span.OfVortices.selfadjointView<Eigen::Lower>());
  this->RightOfVortices += span.RightOfVortices;
  if (this->Knots == 0)
  {
    return;
  }
  const auto k = static_cast<std::size_t>(knot);
  const auto block = static_cast<Eigen::Index>(3 * this->Lattice.NumberOfNodes());
  this->Diagonal[k].Add(span.First, 1.0);
  this->Upper[k].Add(span.Both, 1.0);
  this->Diagonal[k + 1].Add(span.Second, 1.0);
  for (Eigen::Index node = 0; node < span.ByNode.cols(); ++node)
  {
    const Eigen::Index row = knot * block + 3 * node;
    this->Right.segment<3>(row) += span.ByNode.col(node).head<3>();
    for (Eigen::Index n = 0; n < this->Beside.cols(); ++n)
    {
      this->Beside.block<3, 1>(row, n) += span.ByNode.col(node).segment<3>(3 * (1 + n));
    }
  }
}

bool FieldNormal::Solve(AirFields& fields, Monitor* monitor) const
{
  const Eigen::Index vortices = this->RightOfVortices.size();
  Eigen::VectorXd strengths = Eigen::VectorXd::Zero(vortices);
  if (this->Knots == 0)
  {
    strengths = this->OfVortices.ldlt().solve(this->RightOfVortices);
  }
  else
  {
    const Eigen::Index block = this->Curl.rows();
    const Eigen::Index unknowns = this->Curl.cols();
    const Sparse adjoint = this->Curl.transpose();
    // Of the potential's coefficients; of a symmetric matrix the lower half is enough.
    const auto ofPotential = [&](const NodeMatrix& nodes, bool isHalf)
    {
      Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(unknowns, unknowns);
      Eigen::VectorXd column(block);
      for (Eigen::Index u = 0; u < unknowns; ++u)
      {
        column.setZero();
        for (Sparse::InnerIterator at(adjoint, u); at; ++at)
        {
          nodes.AddColumn(static_cast<std::size_t>(at.col()), at.value(), column);
        }
        for (Eigen::Index other = isHalf ? u : 0; other < unknowns; ++other)
        {
          double& sum = matrix(other, u);
          for (Sparse::InnerIterator at(adjoint, other); at; ++at)
          {
            sum += at.value() * column[at.col()];
          }
        }
      }
      return matrix;
    };
    BlockTridiagonal matrix;
    matrix.NumberOfBlocks = this->Diagonal.size();
    matrix.Diagonal = [&](std::size_t k)
    {
      Eigen::MatrixXd own = ofPotential(this->Diagonal[k], true);
      own.diagonal().array() += Gauge * own.diagonal().mean();
      return own;
    };
    matrix.Upper = [&](std::size_t k) { return ofPotential(this->Upper[k], false); };
    // The wind for the right side, and for each vortex of strength 1.
    Eigen::MatrixXd right(unknowns * this->Knots, 1 + vortices);
    for (int k = 0; k < this->Knots; ++k)
    {
      right.block(k * unknowns, 0, unknowns, 1) = adjoint * this->Right.segment(k * block, block);
      right.block(k * unknowns, 1, unknowns, vortices) =
        adjoint * this->Beside.middleRows(k * block, block);
    }
    Eigen::MatrixXd solved = right;
    if (!matrix.Solve(solved, monitor))
    {
      return false;
    }
    if (vortices > 0)
    {
      const Eigen::MatrixXd coupling = right.rightCols(vortices).transpose();
      const Eigen::MatrixXd left = this->OfVortices - coupling * solved.rightCols(vortices);
      const Eigen::VectorXd rest = this->RightOfVortices - coupling * solved.col(0);
      strengths = left.ldlt().solve(rest);
    }
    const Eigen::VectorXd potential = solved.col(0) - solved.rightCols(vortices) * strengths;
    Eigen::VectorXd coefficients(block * this->Knots);
    for (int k = 0; k < this->Knots; ++k)
    {
      coefficients.segment(k * block, block) =
        this->Curl * potential.segment(k * unknowns, unknowns);
    }
    this->SetWind(coefficients, fields.Wind);
  }
  for (Eigen::Index n = 0; n < vortices; ++n)
  {
    fields.Vortices[static_cast<std::size_t>(n)].Strength = strengths[n];
  }
  return true;
}

void FieldNormal::SetWind(const Eigen::VectorXd& coefficients, SplineWind& wind) const
{
  const std::size_t nodes = this->Lattice.NumberOfNodes();
  wind = this->Lattice;
  for (int k = 0; k < this->Knots; ++k)
  {
    std::vector<float> values(4 * nodes, 0.0f);
    for (std::size_t i = 0; i < nodes; ++i)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        values[4 * i + a] = static_cast<float>(coefficients[static_cast<Eigen::Index>(
          3 * (static_cast<std::size_t>(k) * nodes + i) + a)]);
      }
    }
    wind.Knots.push_back(std::move(values));
  }
}

double FieldBytes(const SpacetimeModel& model)
{
  const SplineWind lattice = MakeWindLattice(model, WindOptions().FramesPerKnot);
  const double knots = KnotsOf(model, lattice.FramesPerKnot);
  double unknowns = 3.0;
  for (const int n : lattice.Dimensions)
  {
    unknowns *= n - 2;
  }
  const double nodes = 125.0 * static_cast<double>(lattice.NumberOfNodes());
  const double atWork = 20.0 * nodes + 8.0 * unknowns * unknowns;
  return sizeof(double) * (2.0 * knots * (unknowns * unknowns + nodes) + atWork);
}

} // namespace waft
