// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/SplineFit.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace waft
{
namespace
{

using Vector = Eigen::VectorXd;

void SplineWeights(double x, int count, int& first, float w[3])
{
  const double c = std::clamp(x, 0.5, count - 1.5);
  const int centre = std::min(static_cast<int>(c + 0.5), count - 2);
  const double t = c - centre;
  first = centre - 1;
  w[0] = static_cast<float>(0.5 * (0.5 - t) * (0.5 - t));
  w[1] = static_cast<float>(0.75 - t * t);
  w[2] = static_cast<float>(0.5 * (0.5 + t) * (0.5 + t));
}

// The linear least-squares problem: unknowns are, knot by knot, the potential on a lattice with one
// more layer all around, then the mean flow.
class SplineFit
{
public:
  SplineFit(const SplineWind& shape, int knots, const std::vector<SplineSamples>& samples,
            const SplineFitOptions& options, const ParallelFor& parallel, const FrameShare* share);
  SplineWind Solve() const;

private:
  void Coefficients(const Vector& unknown, Vector& c) const; // curl and mean
  void CoefficientsAdjoint(const Vector& c, Vector& unknown) const;
  void Smooth(const Vector& c, Vector& out) const;            // adds the penalties' gradient
  void Data(const Vector& c, Vector& out, bool target) const; // B^T W B c, or B^T W target
  void Normal(const Vector& unknown, Vector& out) const;
  std::size_t Node(int i, int j, int k) const
  {
    return (static_cast<std::size_t>(k) * this->Shape.Dimensions[1] + j) *
             this->Shape.Dimensions[0] +
           i;
  }
  std::size_t Outer(int i, int j, int k) const // potential's lattice, from -1
  {
    return (static_cast<std::size_t>(k + 1) * (this->Shape.Dimensions[1] + 2) + j + 1) *
             (this->Shape.Dimensions[0] + 2) +
           i + 1;
  }
  std::size_t Nodes() const
  {
    return static_cast<std::size_t>(this->Shape.Dimensions[0]) * this->Shape.Dimensions[1] *
           this->Shape.Dimensions[2];
  }
  std::size_t OuterNodes() const
  {
    return static_cast<std::size_t>(this->Shape.Dimensions[0] + 2) *
           (this->Shape.Dimensions[1] + 2) * (this->Shape.Dimensions[2] + 2);
  }
  std::size_t UnknownsPerKnot() const { return 3 * this->OuterNodes() + 3; }

  struct Row
  {
    std::array<int, 3> First;
    float Spline[3][3];
    float Target[3];
    float Weight;
  };

  const SplineFitOptions& Options;
  const std::vector<SplineSamples>& Samples;
  ParallelFor Parallel;
  FrameShare Share;
  SplineWind Shape; // geometry only
  int Knots = 1;
  double MeanWeight = 1.0;
  std::vector<std::vector<Row>> Rows; // as Samples
};

SplineFit::SplineFit(const SplineWind& shape, int knots, const std::vector<SplineSamples>& samples,
                     const SplineFitOptions& options, const ParallelFor& parallel,
                     const FrameShare* share) :
  Options(options),
  Samples(samples), Parallel(parallel),
  Share(share != nullptr ? *share : FrameShare(samples.size())), Shape(shape), Knots(knots),
  Rows(samples.size())
{
  this->Shape.Knots.clear();
  double total = 0.0;
  for (std::size_t j = 0; j < samples.size(); ++j)
  {
    for (const SplineSamples::Sample& sample : samples[j].Samples)
    {
      Row row;
      row.Weight = static_cast<float>(sample.Weight);
      for (int a = 0; a < 3; ++a)
      {
        row.Target[a] = static_cast<float>(sample.Value[a]);
        SplineWeights((sample.Place[a] - this->Shape.Origin[a]) / this->Shape.Spacing[a],
                      this->Shape.Dimensions[a], row.First[a], row.Spline[a]);
      }
      this->Rows[j].push_back(row);
    }
  }
  // One rank after the other, in the order of the frames.
  const int ranks = this->Share.IsAlone() ? 1 : this->Share.Others().Size();
  for (int r = 0; r < ranks; ++r)
  {
    const bool isTurn = this->Share.IsAlone() || this->Share.Others().Rank() == r;
    for (std::size_t j = 0; j < samples.size() && isTurn; ++j)
    {
      for (const Row& row : this->Rows[j])
      {
        total += row.Weight;
      }
    }
    if (!this->Share.IsAlone())
    {
      this->Share.Others().Broadcast(&total, sizeof(total), r);
    }
  }
  this->MeanWeight = total / (static_cast<double>(this->Nodes()) * this->Knots);
}

void SplineFit::Coefficients(const Vector& unknown, Vector& c) const
{
  const auto& n = this->Shape.Dimensions;
  c.resize(3 * this->Nodes() * this->Knots);
  for (int knot = 0; knot < this->Knots; ++knot)
  {
    const double* a = unknown.data() + knot * this->UnknownsPerKnot();
    const double* mean = a + 3 * this->OuterNodes();
    const auto slope = [&](int component, int axis, int i, int j, int k)
    {
      const int d[3] = { axis == 0, axis == 1, axis == 2 };
      return (a[3 * this->Outer(i + d[0], j + d[1], k + d[2]) + component] -
              a[3 * this->Outer(i - d[0], j - d[1], k - d[2]) + component]) *
             0.5 / this->Shape.Spacing[axis];
    };
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        for (int i = 0; i < n[0]; ++i)
        {
          double* out = c.data() + 3 * (knot * this->Nodes() + this->Node(i, j, k));
          out[0] = mean[0] + slope(2, 1, i, j, k) - slope(1, 2, i, j, k);
          out[1] = mean[1] + slope(0, 2, i, j, k) - slope(2, 0, i, j, k);
          out[2] = mean[2] + slope(1, 0, i, j, k) - slope(0, 1, i, j, k);
        }
      }
    }
  }
}

void SplineFit::CoefficientsAdjoint(const Vector& c, Vector& unknown) const
{
  const auto& n = this->Shape.Dimensions;
  unknown.setZero(static_cast<Eigen::Index>(this->UnknownsPerKnot()) * this->Knots);
  for (int knot = 0; knot < this->Knots; ++knot)
  {
    double* a = unknown.data() + knot * this->UnknownsPerKnot();
    double* mean = a + 3 * this->OuterNodes();
    const auto spread = [&](int component, int axis, int i, int j, int k, double value)
    {
      const int d[3] = { axis == 0, axis == 1, axis == 2 };
      const double part = value * 0.5 / this->Shape.Spacing[axis];
      a[3 * this->Outer(i + d[0], j + d[1], k + d[2]) + component] += part;
      a[3 * this->Outer(i - d[0], j - d[1], k - d[2]) + component] -= part;
    };
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        for (int i = 0; i < n[0]; ++i)
        {
          const double* in = c.data() + 3 * (knot * this->Nodes() + this->Node(i, j, k));
          for (int axis = 0; axis < 3; ++axis)
          {
            mean[axis] += in[axis];
          }
          spread(2, 1, i, j, k, in[0]);
          spread(1, 2, i, j, k, -in[0]);
          spread(0, 2, i, j, k, in[1]);
          spread(2, 0, i, j, k, -in[1]);
          spread(1, 0, i, j, k, in[2]);
          spread(0, 1, i, j, k, -in[2]);
        }
      }
    }
  }
}

void SplineFit::Smooth(const Vector& c, Vector& out) const
{
  const auto& n = this->Shape.Dimensions;
  const double ridge = this->Options.Ridge * this->MeanWeight;
  const double curvature = this->Options.Curvature * this->MeanWeight;
  const double inTime = this->Options.TimeSmoothing * this->MeanWeight;
  out += ridge * c;
  const std::size_t block = 3 * this->Nodes();
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
            const std::size_t m = base + 3 * this->Node(i, j, k);
            const std::size_t l = base + 3 * this->Node(i - d[0], j - d[1], k - d[2]);
            const std::size_t r = base + 3 * this->Node(i + d[0], j + d[1], k + d[2]);
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

void SplineFit::Data(const Vector& c, Vector& out, bool target) const
{
  const std::size_t frames = this->Samples.size();
  const std::size_t block = 3 * this->Nodes();
  std::vector<float> parts(frames * block, 0.0f);
  const FrameRange& own = this->Share.Own();
  const auto knotOf = [&](std::size_t j, double& t)
  {
    const double s = this->Samples[j].Frame / this->Shape.FramesPerKnot;
    const int knot = std::min(static_cast<int>(s), std::max(0, this->Knots - 2));
    t = s - knot;
    return knot;
  };
  this->Parallel(own.Size(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   std::vector<float> here(block, 0.0f);
                   for (std::size_t j = own.Begin + begin; j < own.Begin + end; ++j)
                   {
                     double t;
                     const int knot = knotOf(j, t);
                     for (std::size_t i = 0; i < block && !target; ++i)
                     {
                       const double b = this->Knots > 1 ? c[(knot + 1) * block + i] : 0.0;
                       here[i] = static_cast<float>((1.0 - t) * c[knot * block + i] + t * b);
                     }
                     float* part = parts.data() + j * block;
                     for (const Row& sample : this->Rows[j])
                     {
                       float value[3] = { sample.Target[0], sample.Target[1], sample.Target[2] };
                       for (int pass = target ? 1 : 0; pass < 2; ++pass)
                       {
                         if (pass == 0)
                         {
                           value[0] = value[1] = value[2] = 0.0f;
                         }
                         for (int k = 0; k < 3; ++k)
                         {
                           for (int b = 0; b < 3; ++b)
                           {
                             const std::size_t row =
                               3 * this->Node(sample.First[0], sample.First[1] + b,
                                              sample.First[2] + k);
                             const float w = sample.Spline[1][b] * sample.Spline[2][k] *
                                             (pass == 0 ? 1.0f : sample.Weight);
                             for (int a = 0; a < 3; ++a)
                             {
                               const float wa = w * sample.Spline[0][a];
                               for (int x = 0; x < 3; ++x)
                               {
                                 if (pass == 0)
                                 {
                                   value[x] += wa * here[row + 3 * a + x];
                                 }
                                 else
                                 {
                                   part[row + 3 * a + x] += wa * value[x];
                                 }
                               }
                             }
                           }
                         }
                       }
                     }
                   }
                 });
  this->Share.Gather(parts, block);
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
  this->Coefficients(unknown, c);
  Vector product = Vector::Zero(c.size());
  this->Data(c, product, false);
  this->Smooth(c, product);
  this->CoefficientsAdjoint(product, out);
  // The potential has a gauge freedom; this fixes it without touching the wind.
  out += 1e-6 * this->MeanWeight * unknown;
}

SplineWind SplineFit::Solve() const
{
  const std::size_t block = 3 * this->Nodes();
  Vector right = Vector::Zero(static_cast<Eigen::Index>(block) * this->Knots);
  this->Data(right, right, true);
  Vector residual;
  this->CoefficientsAdjoint(right, residual);
  // Unknowns of the mean flow weigh on all nodes, those of the potential on few: scale them.
  const std::size_t per = this->UnknownsPerKnot();
  Vector scale = Vector::Constant(residual.size(), this->Shape.Spacing.squaredNorm() / 3.0);
  for (int knot = 0; knot < this->Knots; ++knot)
  {
    scale.segment(knot * per + 3 * this->OuterNodes(), 3)
      .setConstant(1.0 / static_cast<double>(this->Nodes()));
  }
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
  this->Coefficients(x, c);
  SplineWind wind = this->Shape;
  for (int knot = 0; knot < this->Knots; ++knot)
  {
    std::vector<float> values(4 * this->Nodes(), 0.0f);
    for (std::size_t i = 0; i < this->Nodes(); ++i)
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
                          const SplineFitOptions& options, const ParallelFor& parallel,
                          const FrameShare* share)
{
  return SplineFit(shape, numberOfKnots, samples, options, parallel, share).Solve();
}

Vec3 SampleField(const SplineWind& field, const Vec3& x, double frame)
{
  const double last = static_cast<double>(field.Knots.size() - 1);
  const double s = std::clamp(frame / field.FramesPerKnot, 0.0, last);
  const auto knot = static_cast<std::size_t>(s);
  const std::size_t next = std::min(knot + 1, field.Knots.size() - 1);
  const double t = s - static_cast<double>(knot);
  int first[3];
  float w[3][3];
  for (int a = 0; a < 3; ++a)
  {
    SplineWeights((x[a] - field.Origin[a]) / field.Spacing[a], field.Dimensions[a], first[a], w[a]);
  }
  Vec3 value = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 3; ++i)
      {
        const std::size_t node =
          4 * ((static_cast<std::size_t>(first[2] + k) * field.Dimensions[1] + first[1] + j) *
                 field.Dimensions[0] +
               first[0] + i);
        const double weight = static_cast<double>(w[0][i]) * w[1][j] * w[2][k];
        for (int a = 0; a < 3; ++a)
        {
          value[a] +=
            weight * ((1.0 - t) * field.Knots[knot][node + a] + t * field.Knots[next][node + a]);
        }
      }
    }
  }
  return value;
}

} // namespace waft
