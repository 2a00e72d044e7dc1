// SPDX-License-Identifier: BSD-3-Clause
// A whole problem of the seed paper, motion and fields at once, against Ceres: E of both stated
// plainly in double precision, its unknowns the motion, the wind's potential and the strengths.
#include "CeresRun.h"
#include "ReferenceObjective.h"
#include "Spacetime/Fields/WindEstimate.h"
#include "Spacetime/Paper/ClosedCurl.h"
#include "Spacetime/Paper/FieldNormal.h"
#include "SpacetimeRuns.h"

#include <Eigen/SparseCore>
#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace waft;
using test::ReferenceObjective;

namespace
{

// What the fields cost for themselves, as the theory has it.
constexpr double Ridge = 0.05, Curvature = 0.3, TimeSmoothing = 0.3;
constexpr double LeastTimeFactor = 1e-3; // a weaker vortex is left out

class ReferencePaper
{
public:
  ReferencePaper(const ReferencePaper&) = delete;
  /// Vortices have the shapes of those.
  ReferencePaper(const SpacetimeModel& model, const std::vector<Vortex>& shapes) :
    Model(model), Motion(this->Model), Lattice(MakeWindLattice(model, 15.0)),
    Curl(ClosedCurl(this->Lattice)), Knots(static_cast<std::size_t>(KnotsOf(model, 15.0)))
  {
    this->Model.Fields.Vortices = shapes;
    this->Lattice.Knots.assign(this->Knots,
                               std::vector<float>(4 * this->Lattice.NumberOfNodes(), 0.0f));
    const double particles = static_cast<double>(model.NumberOfParticles());
    this->Mean = model.Weights.VelocityWeight * particles * (model.NumberOfFrames - 1) /
                 static_cast<double>(this->Lattice.NumberOfNodes() * this->Knots);
    for (Vortex vortex : shapes)
    {
      vortex.Strength = 1.0;
      double square = 0.0;
      for (std::size_t node = 0; node < this->Lattice.NumberOfNodes(); ++node)
      {
        const Vec3 at =
          this->Lattice.Origin + this->Lattice.Spacing.cwiseProduct(this->Index(node));
        for (int frame = 0; frame < model.NumberOfFrames; ++frame)
        {
          square += vortex.Acceleration(at, frame).squaredNorm();
        }
      }
      this->Squares.push_back(square / this->Lattice.FramesPerKnot);
    }
  }

  std::size_t Potentials() const
  {
    return this->Knots * static_cast<std::size_t>(this->Curl.cols());
  }
  std::size_t OfMotion() const { return this->Motion.Size(); }
  std::size_t Size() const { return this->OfMotion() + this->Potentials() + this->Squares.size(); }
  const SpacetimeModel& Problem() const { return this->Model; }
  std::vector<double> From(const StateVector& state) const
  {
    std::vector<double> z = this->Motion.From(state);
    z.resize(this->Size(), 0.0);
    for (std::size_t n = 0; n < this->Squares.size(); ++n)
    {
      z[this->OfMotion() + this->Potentials() + n] = this->Model.Fields.Vortices[n].Strength;
    }
    return z;
  }
  /// What the fields' unknowns are measured by: one over the root of E's second derivative,
  /// roughly.
  std::vector<double> Scales() const
  {
    std::vector<double> scales(this->Size() - this->OfMotion(), 0.0);
    for (std::size_t u = 0; u < this->Potentials(); ++u)
    {
      const auto column = static_cast<Eigen::Index>(u) % this->Curl.cols();
      scales[u] = 1.0 / std::sqrt(this->Mean * this->Curl.col(column).squaredNorm());
    }
    for (std::size_t n = 0; n < this->Squares.size(); ++n)
    {
      scales[this->Potentials() + n] = 1.0 / std::sqrt(this->Mean * this->Squares[n]);
    }
    return scales;
  }
  /// E, and its gradient unless null.
  double Evaluate(const double* z, double* gradient)
  {
    const double* potential = z + this->OfMotion();
    std::vector<Eigen::VectorXd> wind = this->NoWind();
    AirFields fields = this->Model.Fields;
    fields.Wind = this->Lattice;
    for (std::size_t k = 0; k < this->Knots; ++k)
    {
      wind[k] = this->Curl *
                Eigen::Map<const Eigen::VectorXd>(
                  potential + k * static_cast<std::size_t>(this->Curl.cols()), this->Curl.cols());
      for (Eigen::Index i = 0; i < wind[k].size(); ++i)
      {
        fields.Wind.Knots[k][static_cast<std::size_t>(i / 3 * 4 + i % 3)] =
          static_cast<float>(wind[k][i]);
      }
    }
    for (std::size_t n = 0; n < this->Squares.size(); ++n)
    {
      fields.Vortices[n].Strength = potential[this->Potentials() + n];
    }
    return this->Evaluate(z, fields, wind, gradient);
  }
  /// The same with given fields in place of those that z has.
  double Evaluate(const double* z, const AirFields& fields, double* gradient)
  {
    std::vector<Eigen::VectorXd> wind = this->NoWind();
    for (std::size_t k = 0; k < fields.Wind.Knots.size(); ++k)
    {
      for (Eigen::Index i = 0; i < wind[k].size(); ++i)
      {
        wind[k][i] = fields.Wind.Knots[k][static_cast<std::size_t>(i / 3 * 4 + i % 3)];
      }
    }
    return this->Evaluate(z, fields, wind, gradient);
  }

private:
  double Evaluate(const double* z, const AirFields& fields,
                  const std::vector<Eigen::VectorXd>& wind, double* gradient)
  {
    this->Model.Fields = fields;
    if (gradient == nullptr)
    {
      return this->Motion.Evaluate(z, nullptr) + this->Penalty(wind, nullptr);
    }
    std::fill(gradient, gradient + this->Size(), 0.0);
    std::vector<Vec3> pushes;
    const double e = this->Motion.Evaluate(z, gradient, &pushes);
    std::vector<Eigen::VectorXd> byWind = this->NoWind();
    const double cost = this->Penalty(wind, &byWind);
    double* byPotential = gradient + this->OfMotion();
    double* byStrength = byPotential + this->Potentials();
    this->AddPushes(z, pushes, byWind, byStrength);
    for (std::size_t n = 0; n < this->Squares.size(); ++n)
    {
      byStrength[n] += this->Mean * Ridge * this->Squares[n] * fields.Vortices[n].Strength;
    }
    for (std::size_t k = 0; k < this->Knots; ++k)
    {
      Eigen::Map<Eigen::VectorXd>(byPotential + k * static_cast<std::size_t>(this->Curl.cols()),
                                  this->Curl.cols()) = this->Curl.transpose() * byWind[k];
    }
    return e + cost;
  }
  Vec3 Index(std::size_t node) const
  {
    const auto& n = this->Lattice.Dimensions;
    const auto k = static_cast<int>(node);
    return Vec3(k % n[0], k / n[0] % n[1], k / n[0] / n[1]);
  }
  std::vector<Eigen::VectorXd> NoWind() const
  {
    return std::vector<Eigen::VectorXd>(
      this->Knots,
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * this->Lattice.NumberOfNodes())));
  }
  double Penalty(const std::vector<Eigen::VectorXd>& wind, std::vector<Eigen::VectorXd>* by) const
  {
    double sum = 0.0;
    const auto add = [&](double weight, double value) { sum += weight * value * value; };
    for (std::size_t n = 0; n < this->Squares.size(); ++n)
    {
      add(Ridge * this->Squares[n], this->Model.Fields.Vortices[n].Strength);
    }
    const auto& dimensions = this->Lattice.Dimensions;
    const int steps[3] = { 1, dimensions[0], dimensions[0] * dimensions[1] };
    for (std::size_t k = 0; k < wind.size(); ++k)
    {
      for (Eigen::Index i = 0; i < wind[k].size(); ++i)
      {
        const Vec3 at = this->Index(static_cast<std::size_t>(i / 3));
        add(Ridge, wind[k][i]);
        if (by != nullptr)
        {
          (*by)[k][i] += this->Mean * Ridge * wind[k][i];
        }
        for (int a = 0; a < 3; ++a)
        {
          if (at[a] < 1.0 || at[a] > dimensions[a] - 2.0)
          {
            continue;
          }
          const double bend =
            wind[k][i - 3 * steps[a]] - 2.0 * wind[k][i] + wind[k][i + 3 * steps[a]];
          add(Curvature, bend);
          for (int side = -1; side <= 1 && by != nullptr; ++side)
          {
            (*by)[k][i + 3 * side * steps[a]] +=
              this->Mean * Curvature * bend * (side == 0 ? -2.0 : 1.0);
          }
        }
        if (k > 0)
        {
          const double change = wind[k][i] - wind[k - 1][i];
          add(TimeSmoothing, change);
          if (by != nullptr)
          {
            (*by)[k][i] += this->Mean * TimeSmoothing * change;
            (*by)[k - 1][i] -= this->Mean * TimeSmoothing * change;
          }
        }
      }
    }
    return 0.5 * this->Mean * sum;
  }
  // From the slopes by the bodies' accelerations.
  void AddPushes(const double* z, const std::vector<Vec3>& pushes,
                 std::vector<Eigen::VectorXd>& byWind, double* byStrength) const
  {
    const std::size_t bodies = this->Model.NumberOfBodies();
    for (std::size_t place = 0; place < pushes.size(); ++place)
    {
      const auto frame = static_cast<int>(place / bodies);
      const Vec3 x = this->Motion.PlaceOf(z, place / bodies, place % bodies);
      for (std::size_t n = 0; n < this->Squares.size(); ++n)
      {
        Vortex unit = this->Model.Fields.Vortices[n];
        unit.Strength = 1.0;
        byStrength[n] += unit.TimeFactor(frame) >= LeastTimeFactor
                           ? pushes[place].dot(unit.Acceleration(x, frame))
                           : 0.0;
      }
      const double time = frame / this->Lattice.FramesPerKnot;
      const auto knot = std::min(static_cast<std::size_t>(time), this->Knots - 2);
      const double later = time - static_cast<double>(knot);
      const SplineStencil stencil = this->Lattice.Stencil(x);
      for (int n = 0; n < 27; ++n)
      {
        const int at[3] = { n % 3, n / 3 % 3, n / 9 };
        double weight = 1.0;
        for (int a = 0; a < 3; ++a)
        {
          weight *= stencil.Weights[a][at[a]];
        }
        const auto node = static_cast<Eigen::Index>(
          3 * this->Lattice.Node(stencil.First[0] + at[0], stencil.First[1] + at[1],
                                 stencil.First[2] + at[2]));
        byWind[knot].segment<3>(node) += (1.0 - later) * weight * pushes[place];
        byWind[knot + 1].segment<3>(node) += later * weight * pushes[place];
      }
    }
  }

  SpacetimeModel Model;
  ReferenceObjective Motion;
  SplineWind Lattice;
  Eigen::SparseMatrix<double> Curl;
  std::size_t Knots;
  double Mean = 0.0;           // weight at a node
  std::vector<double> Squares; // of vortices of strength 1 at the nodes of all knots
};

/// Fields are measured by their scales.
class PaperCost : public ceres::FirstOrderFunction
{
public:
  explicit PaperCost(ReferencePaper& reference) : Reference(reference), Scales(reference.Scales())
  {
  }
  std::vector<double> ToUnknowns(const double* scaled) const
  {
    std::vector<double> z =
      HeldInBox(this->Reference.Problem(), scaled, this->Reference.OfMotion());
    for (std::size_t k = 0; k < this->Scales.size(); ++k)
    {
      z.push_back(this->Scales[k] * scaled[this->Reference.OfMotion() + k]);
    }
    return z;
  }
  std::vector<double> FromUnknowns(std::vector<double> z) const
  {
    for (std::size_t k = 0; k < this->Scales.size(); ++k)
    {
      z[this->Reference.OfMotion() + k] /= this->Scales[k];
    }
    return z;
  }
  bool Evaluate(const double* scaled, double* cost, double* gradient) const override
  {
    std::vector<double> z = this->ToUnknowns(scaled);
    *cost = this->Reference.Evaluate(z.data(), gradient);
    if (gradient != nullptr)
    {
      for (std::size_t k = 0; k < this->Scales.size(); ++k)
      {
        gradient[this->Reference.OfMotion() + k] *= this->Scales[k];
      }
      z.resize(this->Reference.OfMotion());
      HoldGradient(this->Reference.Problem(), scaled, z, gradient);
    }
    return true;
  }
  int NumParameters() const override { return static_cast<int>(this->Reference.Size()); }

private:
  ReferencePaper& Reference;
  std::vector<double> Scales;
};

struct SmallPaper
{
  SmallPaper()
  {
    SceneOptions scene;
    scene.NumberOfObjects = 2;
    scene.NumberOfFrames = 21;
    this->Input = MakeScene(scene);
    this->Options.NumberOfGasParticles = 64;
    this->Options.NumberOfObjectParticles = 4;
    const Result result = MakeSetup(this->Input, this->Options, this->Setup);
    EXPECT_TRUE(result) << result.Message();
  }
  SpacetimeInput Input;
  SpacetimeOptions Options;
  SpacetimeSetup Setup;
};

} // namespace

TEST(PaperProblem, TheReferencesSlopesByTheFieldsAreThoseOfE)
{
  const SmallPaper paper;
  ASSERT_FALSE(paper.Setup.Model.Fields.Vortices.empty());
  ReferencePaper reference(paper.Setup.Model, paper.Setup.Model.Fields.Vortices);
  std::vector<double> z = reference.From(paper.Setup.Start);
  Random random(6);
  const std::vector<double> scales = reference.Scales();
  for (std::size_t k = 0; k < scales.size(); ++k)
  {
    z[reference.OfMotion() + k] += 0.05 * scales[k] * random.Normal();
  }
  std::vector<double> gradient(z.size());
  reference.Evaluate(z.data(), gradient.data());
  // E is a square in the fields, so a wide step is exact but for rounding.
  double error = 0.0, square = 0.0;
  for (std::size_t k = 0; k < scales.size(); k += k + 1 < reference.Potentials() ? 29 : 1)
  {
    double& value = z[reference.OfMotion() + k];
    const double before = value, step = scales[k];
    value = before + step;
    const double more = reference.Evaluate(z.data(), nullptr);
    value = before - step;
    const double less = reference.Evaluate(z.data(), nullptr);
    value = before;
    const double slope = 0.5 * (more - less);
    error += std::pow(slope - scales[k] * gradient[reference.OfMotion() + k], 2);
    square += slope * slope;
  }
  EXPECT_LT(std::sqrt(error / square), 1e-5);
}

TEST(PaperProblem, EndsAtTheCostOfCeresOrLower)
{
  SmallPaper paper;
  paper.Options.Tolerance = 0.0;
  paper.Options.MaximumNumberOfIterations = 600;
  SpacetimeOutput output;
  const SolverState last = LastState(paper.Input, paper.Options, output);
  const AirFields& fields = last.Fields;
  ReferencePaper reference(paper.Setup.Model, fields.Vortices);
  const std::vector<double> found = reference.From(last.Motion);
  std::vector<double> gradient(reference.Size());
  const double waft = reference.Evaluate(found.data(), fields, gradient.data());
  EXPECT_NEAR(output.Convergence.back().E, waft, 1e-4 * waft);
  const std::vector<double> scales = reference.Scales();
  double square = 0.0;
  for (std::size_t k = 0; k < scales.size(); ++k)
  {
    square += std::pow(scales[k] * gradient[reference.OfMotion() + k], 2);
  }
  EXPECT_LT(std::sqrt(square / (2.0 * waft)), 1e-5); // the fields are those of least E
  // Ceres has the shapes that the run has found. It begins with the plan and gas at rest, as the
  // run did, then with the run's motion without wind.
  auto* cost = new PaperCost(reference); // the problem's
  const ceres::GradientProblem problem(cost);
  const auto solve = [&](const std::vector<double>& from, int iterations)
  {
    ceres::GradientProblemSolver::Options options;
    options.max_num_iterations = iterations;
    options.function_tolerance = 1e-9;
    options.logging_type = ceres::SILENT;
    ceres::GradientProblemSolver::Summary summary;
    std::vector<double> z = cost->FromUnknowns(from);
    ceres::Solve(options, problem, z.data(), &summary);
    return reference.Evaluate(cost->ToUnknowns(z.data()).data(), nullptr);
  };
  const double ofPlan = solve(reference.From(paper.Setup.Start), 1000);
  const double goneOn = solve(found, 300);
  std::printf("[ figure ] E of the plan %.4g; of Waft %.4g, of Ceres %.4g, which goes on from Waft "
              "to %.4g\n",
              output.Convergence.front().E, waft, ofPlan, goneOn);
  EXPECT_LE(waft, ofPlan);
  EXPECT_LT(ofPlan, 0.2 * output.Convergence.front().E);
  EXPECT_GT(goneOn, 0.98 * waft); // hardly anything is left to be had
}
