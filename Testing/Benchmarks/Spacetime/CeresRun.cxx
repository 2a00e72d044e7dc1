// SPDX-License-Identifier: BSD-3-Clause
#include "CeresRun.h"

#include "ReferenceObjective.h"
#include "Spacetime/Solver/Lbfgs.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <ctime>

namespace waft
{
namespace
{

using test::ReferenceObjective;

double Seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

class Cost : public ceres::FirstOrderFunction
{
public:
  Cost(const SpacetimeModel& model, int& evaluations) :
    Model(model), Reference(model), Evaluations(evaluations)
  {
  }
  bool Evaluate(const double* z, double* cost, double* gradient) const override
  {
    ++this->Evaluations;
    const std::vector<double> held = HeldInBox(this->Model, z, this->Reference.Size());
    *cost = this->Reference.Evaluate(held.data(), gradient);
    if (gradient != nullptr)
    {
      HoldGradient(this->Model, z, held, gradient);
    }
    return true;
  }
  int NumParameters() const override { return static_cast<int>(this->Reference.Size()); }

private:
  const SpacetimeModel& Model;
  ReferenceObjective Reference;
  int& Evaluations;
};

} // namespace

std::vector<double> HeldInBox(const SpacetimeModel& model, const double* z, std::size_t size)
{
  std::vector<double> held(z, z + size);
  for (std::size_t k = 0; k < size; ++k)
  {
    if (k / 6 % model.NumberOfBodies() < model.NumberOfGas && k % 6 < 3)
    {
      held[k] = std::clamp(held[k], 0.0, model.Size[static_cast<int>(k % 6)]);
    }
  }
  return held;
}

void HoldGradient(const SpacetimeModel& model, const double* z, const std::vector<double>& held,
                  double* gradient)
{
  for (std::size_t k = 0; k < held.size(); ++k)
  {
    const std::size_t frame = k / 6 / model.NumberOfBodies();
    const std::size_t body = k / 6 % model.NumberOfBodies();
    const bool isFixed =
      body >= model.NumberOfGas && k % 6 < 3 &&
      (model.Flag(static_cast<int>(frame), body - model.NumberOfGas) & FixedPosition);
    gradient[k] = isFixed || held[k] != z[k] ? 0.0 : gradient[k];
  }
}

CeresComparison CompareWithCeres(StandardProblem& problem, int iterations, int ceresIterations,
                                 const ParallelFor& parallel)
{
  SpacetimeModel& model = problem.Setup.Model;
  model.Weights.Separation = 0.0;
  const ReferenceObjective reference(model);
  CeresComparison result;

  std::vector<double> z = reference.From(problem.Setup.Start);
  result.Start = reference.Evaluate(z.data(), nullptr);
  ceres::GradientProblem ceresProblem(new Cost(model, result.Ceres.Evaluations));
  ceres::GradientProblemSolver::Options options;
  options.max_num_iterations = ceresIterations;
  options.function_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  ceres::GradientProblemSolver::Summary summary;
  double from = Seconds();
  ceres::Solve(options, ceresProblem, z.data(), &summary);
  result.Ceres.Seconds = Seconds() - from;
  z = HeldInBox(model, z.data(), z.size());
  result.Ceres.Cost = reference.Evaluate(z.data(), nullptr);

  const TimeLevel level = TimeLevel::Full(model.NumberOfFrames, 1);
  from = Seconds();
  SpacetimeObjective objective(model, model.Fields, level, parallel, FastestSphKernels());
  const TimelinePreconditioner preconditioner(model, level, parallel);
  HardConstraints constraints(model, level, problem.Setup.Table, parallel);
  Lbfgs solver(level.NumberOfFrames(), model.FrameSize(), parallel, 10);
  LbfgsOptions lbfgs;
  lbfgs.MaximumNumberOfIterations = iterations;
  lbfgs.Tolerance = 0.0;
  StateVector state = problem.Setup.Start;
  const auto count = [&](int, const SpacetimeTerms&)
  {
    ++result.Waft.Evaluations;
    return true;
  };
  LbfgsMemory memory;
  (void)solver.Minimise(objective, preconditioner, constraints, lbfgs, count, nullptr, memory,
                        state);
  result.Waft.Seconds = Seconds() - from;
  z = reference.From(state);
  result.Waft.Cost = reference.Evaluate(z.data(), nullptr);
  return result;
}

} // namespace waft
