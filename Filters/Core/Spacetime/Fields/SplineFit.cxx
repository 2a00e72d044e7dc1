// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Fields/SplineFit.h"

#include "Spacetime/Fields/CurlPotential.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>

namespace waft
{
namespace
{

using Vector = Eigen::VectorXd;

// The linear least-squares problem; its unknowns are those of a CurlPotential.
class SplineFit
{
public:
  SplineFit(const SplineWind& shape, int knots, const std::vector<SplineSamples>& samples,
            const SplineFitOptions& options, const ParallelFor& parallel);
  SplineWind Solve() const;

private:
  void Smooth(const Vector& c, Vector& out) const;            // adds the penalties' gradient
  void Data(const Vector& c, Vector& out, bool target) const; // B^T W B c, or B^T W target
  void Normal(const Vector& unknown, Vector& out) const;

  struct Row
  {
    SplineStencil Nodes;
    std::array<float, 3> Target;
    float Weight;
  };
  // Of the field whose knot has the coefficients `knot`.
  std::array<float, 3> Value(const Row& row, const std::vector<float>& knot) const;
  // Calls visit(offset of a node's coefficients in a knot's, its weight) on a row's 27 nodes.
  template <class Visit>
  void ForNodes(const Row& row, float factor, const Visit& visit) const;

  const SplineFitOptions& Options;
  const std::vector<SplineSamples>& Samples;
  ParallelFor Parallel;
  SplineWind Shape; // geometry only
  int Knots = 1;
  CurlPotential Potential;
  double MeanWeight = 1.0;
  std::vector<std::vector<Row>> Rows; // as Samples
};

SplineFit::SplineFit(const SplineWind& shape, int knots, const std::vector<SplineSamples>& samples,
                     const SplineFitOptions& options, const ParallelFor& parallel) :
  Options(options),
  Samples(samples), Parallel(parallel), Shape(shape), Knots(knots), Potential(shape, knots),
  Rows(samples.size())
{
  this->Shape.Knots.clear();
  double total = 0.0;
  for (std::size_t j = 0; j < samples.size(); ++j)
  {
    for (const SplineSamples::Sample& sample : samples[j].Samples)
    {
      Row row;
      row.Nodes = shape.Stencil(sample.Position);
      row.Weight = static_cast<float>(sample.Weight);
      for (int a = 0; a < 3; ++a)
      {
        row.Target[a] = static_cast<float>(sample.Value[a]);
      }
      this->Rows[j].push_back(row);
      total += row.Weight;
    }
  }
  this->MeanWeight = total / (static_cast<double>(this->Shape.NumberOfNodes()) * this->Knots);
}

void SplineFit::Smooth(const Vector& c, Vector& out) const
{
  const auto& n = this->Shape.Dimensions;
  const double ridge = this->Options.Ridge * this->MeanWeight;
  const double curvature = this->Options.Curvature * this->MeanWeight;
  const double inTime = this->Options.TimeSmoothing * this->MeanWeight;
  out += ridge * c;
  const std::size_t block = 3 * this->Shape.NumberOfNodes();
  for (int knot = 0; knot + 1 < this->Knots; ++knot)
  {
    const auto a = c.segment(knot * block, block);
    const auto b = c.segment((knot + 1) * block, block);
    const Vector difference = inTime * (b - a);
    out.segment(knot * block, block) -= difference;
    out.segment((knot + 1) * block, block) += difference;
  }
  for (int knot = 0; knot < this->Knots; ++knot)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const int d[3] = { axis == 0, axis == 1, axis == 2 };
      for (int k = d[2]; k < n[2] - d[2]; ++k)
      {
        for (int j = d[1]; j < n[1] - d[1]; ++j)
        {
          for (int i = d[0]; i < n[0] - d[0]; ++i)
          {
            const std::size_t base = knot * block;
            const std::size_t m = base + 3 * this->Shape.Node(i, j, k);
            const std::size_t l = base + 3 * this->Shape.Node(i - d[0], j - d[1], k - d[2]);
            const std::size_t r = base + 3 * this->Shape.Node(i + d[0], j + d[1], k + d[2]);
            for (int x = 0; x < 3; ++x)
            {
              const double bend = curvature * (c[l + x] - 2.0 * c[m + x] + c[r + x]);
              out[l + x] += bend;
              out[m + x] -= 2.0 * bend;
              out[r + x] += bend;
            }
          }
        }
      }
    }
  }
}

template <class Visit>
void SplineFit::ForNodes(const Row& row, float factor, const Visit& visit) const
{
  const std::array<int, 3>& first = row.Nodes.First;
  const auto& weights = row.Nodes.Weights;
  for (int k = 0; k < 3; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      const std::size_t line = 3 * this->Shape.Node(first[0], first[1] + j, first[2] + k);
      const float w = weights[1][j] * weights[2][k] * factor;
      for (int i = 0; i < 3; ++i)
      {
        visit(line + 3 * i, w * weights[0][i]);
      }
    }
  }
}

std::array<float, 3> SplineFit::Value(const Row& row, const std::vector<float>& knot) const
{
  std::array<float, 3> value{ 0.0f, 0.0f, 0.0f };
  this->ForNodes(row, 1.0f,
                 [&](std::size_t node, float weight)
                 {
                   for (int x = 0; x < 3; ++x)
                   {
                     value[x] += weight * knot[node + x];
                   }
                 });
  return value;
}

void SplineFit::Data(const Vector& c, Vector& out, bool target) const
{
  const std::size_t frames = this->Samples.size();
  const std::size_t block = 3 * this->Shape.NumberOfNodes();
  std::vector<float> parts(frames * block, 0.0f);
  const auto knotOf = [&](std::size_t j, double& t)
  {
    const double s = this->Samples[j].Frame / this->Shape.FramesPerKnot;
    const int knot = std::min(static_cast<int>(s), std::max(0, this->Knots - 2));
    t = s - knot;
    return knot;
  };
  this->Parallel(frames,
                 [&](std::size_t begin, std::size_t end)
                 {
                   std::vector<float> here(block, 0.0f);
                   for (std::size_t j = begin; j < end; ++j)
                   {
                     double t;
                     const int knot = knotOf(j, t);
                     for (std::size_t i = 0; i < block && !target; ++i)
                     {
                       const double b = this->Knots > 1 ? c[(knot + 1) * block + i] : 0.0;
                       here[i] = static_cast<float>((1.0 - t) * c[knot * block + i] + t * b);
                     }
                     float* part = parts.data() + j * block;
                     for (const Row& row : this->Rows[j])
                     {
                       const std::array<float, 3> value =
                         target ? row.Target : this->Value(row, here);
                       this->ForNodes(row, row.Weight,
                                      [&](std::size_t node, float weight)
                                      {
                                        for (int x = 0; x < 3; ++x)
                                        {
                                          part[node + x] += weight * value[x];
                                        }
                                      });
                     }
                   }
                 });
  for (std::size_t j = 0; j < frames; ++j)
  {
    double t;
    const int knot = knotOf(j, t);
    const float* part = parts.data() + j * block;
    for (std::size_t i = 0; i < block; ++i)
    {
      out[knot * block + i] += (1.0 - t) * part[i];
      if (this->Knots > 1)
      {
        out[(knot + 1) * block + i] += t * part[i];
      }
    }
  }
}

void SplineFit::Normal(const Vector& unknown, Vector& out) const
{
  Vector c;
  this->Potential.Curl(unknown, c);
  Vector product = Vector::Zero(c.size());
  this->Data(c, product, false);
  this->Smooth(c, product);
  this->Potential.Adjoint(product, out);
  // The potential has a gauge freedom; this fixes it without touching the wind.
  out += 1e-6 * this->MeanWeight * unknown;
}

SplineWind SplineFit::Solve() const
{
  const std::size_t block = 3 * this->Shape.NumberOfNodes();
  Vector right = Vector::Zero(this->Potential.NumberOfCoefficients());
  this->Data(right, right, true);
  Vector residual;
  this->Potential.Adjoint(right, residual);
  const Vector scale = this->Potential.Scale();
  Vector x = Vector::Zero(residual.size());
  Vector z = scale.cwiseProduct(residual);
  Vector p = z;
  double rz = residual.dot(z);
  const double goal = 1e-8 * rz;
  Vector ap;
  for (int k = 0; k < this->Options.Iterations && rz > goal && rz > 0.0; ++k)
  {
    this->Normal(p, ap);
    const double alpha = rz / p.dot(ap);
    x += alpha * p;
    residual -= alpha * ap;
    z = scale.cwiseProduct(residual);
    const double next = residual.dot(z);
    p = z + (next / rz) * p;
    rz = next;
  }
  Vector c;
  this->Potential.Curl(x, c);
  SplineWind wind = this->Shape;
  for (int knot = 0; knot < this->Knots; ++knot)
  {
    std::vector<float> values(4 * this->Shape.NumberOfNodes(), 0.0f);
    for (std::size_t i = 0; i < this->Shape.NumberOfNodes(); ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        values[4 * i + a] = static_cast<float>(c[knot * block + 3 * i + a]);
      }
    }
    wind.Knots.push_back(std::move(values));
  }
  return wind;
}

} // namespace

SplineWind FitSplineField(const SplineWind& shape, int numberOfKnots,
                          const std::vector<SplineSamples>& samples,
                          const SplineFitOptions& options, const ParallelFor& parallel)
{
  return SplineFit(shape, numberOfKnots, samples, options, parallel).Solve();
}

} // namespace waft
