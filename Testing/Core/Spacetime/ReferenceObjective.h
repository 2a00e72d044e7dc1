// SPDX-License-Identifier: BSD-3-Clause
// E of Eqs. 2-4 over all frames and its gradient in double precision by brute force: plain code to
// hold the fast objective against, and a problem for other solvers. Gas, objects, vortices, gravity
// and the walls' spring; no drag, obstacles, winds or terms beside the paper's.
#pragma once

#include "Particles/SphReference.h"
#include "Spacetime/SpacetimeModel.h"
#include "Spacetime/StateVector.h"

#include <vector>

namespace waft
{
namespace test
{

class ReferenceObjective
{
public:
  explicit ReferenceObjective(const SpacetimeModel& model) : Model(model) {}

  /// Unknowns: x, y, z, u, v, w of each body of each frame.
  std::size_t Size() const { return 6 * this->Model.NumberOfBodies() * this->Model.NumberOfFrames; }

  std::vector<double> From(const StateVector& state) const
  {
    std::vector<double> z(this->Size());
    this->ForEach([&](std::size_t k, std::size_t place) { z[k] = state[place]; });
    return z;
  }
  StateVector To(const std::vector<double>& z) const
  {
    StateVector state(this->Model.FrameSize() * this->Model.NumberOfFrames, 0.0f);
    this->ForEach([&](std::size_t k, std::size_t place)
                  { state[place] = static_cast<float>(z[k]); });
    return state;
  }

  /// E, and its gradient unless null.
  double Evaluate(const double* z, double* gradient) const
  {
    const SpacetimeWeights& w = this->Model.Weights;
    const std::size_t bodies = this->Model.NumberOfBodies();
    const int frames = this->Model.NumberOfFrames;
    const double own = this->Model.Fluid.GasMass * this->Model.Fluid.Kernel(0.0);
    const double spatial = w.Coherence * w.SpatialShare / ((1.0 - own) * (1.0 - own));
    const double temporal = w.Coherence * (1.0 - w.SpatialShare);
    const auto X = [&](int j, std::size_t i) { return Vec3(z + 6 * (j * bodies + i)); };
    const auto V = [&](int j, std::size_t i) { return Vec3(z + 6 * (j * bodies + i) + 3); };
    const auto add = [&](int j, std::size_t i, int offset, const Vec3& g)
    {
      for (int c = 0; c < 3 && gradient; ++c)
      {
        gradient[6 * (j * bodies + i) + offset + c] += g[c];
      }
    };
    if (gradient)
    {
      std::fill(gradient, gradient + this->Size(), 0.0);
    }
    double e = 0.0;
    for (int j = 0; j < frames; ++j)
    {
      const bool last = j + 1 == frames;
      SphState particles;
      SphRates rates;
      const std::vector<Vec3> a = this->Rates(z, j, particles, rates);
      SphRates bars;
      bars.Accelerations.assign(particles.Positions.size(), Vec3::Zero());
      bars.Averages = bars.Accelerations;
      for (std::size_t i = 0; i < bodies; ++i)
      {
        const double weight = this->Model.BodyWeight(i);
        const Vec3 d = this->Mean(rates.Averages, i);
        Vec3 dbar = weight * spatial * d;
        Vec3 abar = Vec3::Zero();
        e += 0.5 * weight * spatial * d.squaredNorm();
        if (!last)
        {
          const Vec3 rx = X(j + 1, i) - X(j, i) - V(j + 1, i) - w.XsphFactor * d;
          const Vec3 rv = V(j + 1, i) - V(j, i) - a[i];
          e += 0.5 * weight * (w.Position * rx.squaredNorm() + w.Velocity * rv.squaredNorm());
          const Vec3 gx = weight * w.Position * rx, gv = weight * w.Velocity * rv;
          add(j + 1, i, 0, gx);
          add(j, i, 0, -gx);
          add(j + 1, i, 3, gv - gx);
          add(j, i, 3, -gv);
          abar = -gv;
          dbar -= w.XsphFactor * gx;
        }
        Vec3 rt = V(j, i);
        const double share = 1.0 / ((j > 0) + !last);
        for (const int k : { j - 1, j + 1 })
        {
          rt -= k >= 0 && k < frames ? Vec3(share * V(k, i)) : Vec3(Vec3::Zero());
        }
        e += 0.5 * weight * temporal * rt.squaredNorm();
        add(j, i, 3, weight * temporal * rt);
        for (const int k : { j - 1, j + 1 })
        {
          if (k >= 0 && k < frames)
          {
            add(k, i, 3, -share * weight * temporal * rt);
          }
        }
        add(j, i, 0, this->OutsideSlope(X(j, i), j, i).transpose() * abar);
        const std::size_t per = i < this->Model.NumberOfGas ? 1 : this->Model.Offsets.size();
        for (std::size_t p = this->First(i); p < this->First(i) + per; ++p)
        {
          bars.Accelerations[p] = abar / double(per);
          bars.Averages[p] = dbar / double(per);
        }
      }
      if (gradient)
      {
        SphState adjoint;
        AdjointSph(this->Model.Fluid, this->Volume(j), particles, bars, adjoint);
        for (std::size_t i = 0; i < bodies; ++i)
        {
          const std::size_t per = i < this->Model.NumberOfGas ? 1 : this->Model.Offsets.size();
          for (std::size_t p = this->First(i); p < this->First(i) + per; ++p)
          {
            add(j, i, 0, adjoint.Positions[p]);
            add(j, i, 3, adjoint.Velocities[p]);
          }
        }
      }
    }
    return e;
  }

private:
  template <typename Function>
  void ForEach(Function function) const
  {
    std::size_t k = 0;
    for (int j = 0; j < this->Model.NumberOfFrames; ++j)
    {
      for (std::size_t i = 0; i < this->Model.NumberOfBodies(); ++i)
      {
        for (int c = 0; c < 6; ++c)
        {
          function(k++, j * this->Model.FrameSize() + c * this->Model.Stride() + i);
        }
      }
    }
  }
  SphVolume Volume(int j) const
  {
    SphVolume volume(this->Model.Size);
    volume.Rest = &this->Model.Rest;
    volume.Obstacles = &this->Model.Obstacles;
    volume.Frame = j;
    return volume;
  }
  std::size_t First(std::size_t body) const
  {
    const std::size_t gas = this->Model.NumberOfGas;
    return body < gas ? body : gas + (body - gas) * this->Model.Offsets.size();
  }
  Vec3 Mean(const std::vector<Vec3>& values, std::size_t body) const
  {
    const std::size_t per = body < this->Model.NumberOfGas ? 1 : this->Model.Offsets.size();
    Vec3 sum = Vec3::Zero();
    for (std::size_t p = this->First(body); p < this->First(body) + per; ++p)
    {
      sum += values[p];
    }
    return sum / double(per);
  }
  // Accelerations of all bodies at a frame.
  std::vector<Vec3> Rates(const double* z, int j, SphState& particles, SphRates& rates) const
  {
    const std::size_t bodies = this->Model.NumberOfBodies();
    particles.NumberOfGas = this->Model.NumberOfGas;
    for (std::size_t i = 0; i < bodies; ++i)
    {
      const double* q = z + 6 * (j * bodies + i);
      if (i < this->Model.NumberOfGas)
      {
        particles.Positions.emplace_back(q);
        particles.Velocities.emplace_back(q + 3);
        continue;
      }
      for (const auto& offset : this->Model.Offsets)
      {
        particles.Positions.push_back(Vec3(q) + Vec3(offset[0], offset[1], offset[2]));
        particles.Velocities.emplace_back(q + 3);
      }
    }
    EvaluateSph(this->Model.Fluid, this->Volume(j), particles, rates);
    std::vector<Vec3> a;
    for (std::size_t i = 0; i < bodies; ++i)
    {
      const Vec3 x(z + 6 * (j * bodies + i));
      Vec3 sum = this->Mean(rates.Accelerations, i);
      for (const Vortex& vortex : this->Model.Vortices)
      {
        sum += vortex.TimeFactor(j) < 1e-3 ? Vec3(Vec3::Zero()) : vortex.Acceleration(x, j);
      }
      if (i >= this->Model.NumberOfGas)
      {
        sum.z() -= this->Model.Gravities[i - this->Model.NumberOfGas];
      }
      for (int c = 0; c < 3 && i < this->Model.NumberOfGas; ++c)
      {
        const double low = std::max(0.0, 0.3 - x[c]);
        const double high = std::max(0.0, 0.3 - (this->Model.Size[c] - x[c]));
        sum[c] += 0.3 * (low * low - high * high);
      }
      a.push_back(sum);
    }
    return a;
  }
  // Derivative of vortices and spring by the place.
  Mat3 OutsideSlope(const Vec3& x, int j, std::size_t i) const
  {
    Mat3 sum = Mat3::Zero();
    for (const Vortex& vortex : this->Model.Vortices)
    {
      Mat3 slope = Mat3::Zero();
      if (vortex.TimeFactor(j) >= 1e-3)
      {
        (void)vortex.Acceleration(x, j, slope);
        sum += slope;
      }
    }
    for (int c = 0; c < 3 && i < this->Model.NumberOfGas; ++c)
    {
      sum(c, c) -=
        0.6 * (std::max(0.0, 0.3 - x[c]) + std::max(0.0, 0.3 - (this->Model.Size[c] - x[c])));
    }
    return sum;
  }

  const SpacetimeModel& Model;
};

} // namespace test
} // namespace waft
