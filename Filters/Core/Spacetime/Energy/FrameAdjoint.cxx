// SPDX-License-Identifier: BSD-3-Clause
// The way back through a frame's terms, and the pushing apart of gas that is too near.
#include "Spacetime/Energy/FrameTerms.h"

#include <algorithm>
#include <cmath>

namespace waft
{

void FrameTerms::Adjoint(float* gradient)
{
  if (this->IsAlone())
  {
    for (std::size_t i = 0; i < 3 * this->BodyStride; ++i)
    {
      gradient[3 * this->BodyStride + i] -= this->Bars[i] + this->Bars[3 * this->BodyStride + i];
    }
    return;
  }
  const std::size_t ng = this->Model.NumberOfGas;
  const std::size_t n = this->Model.NumberOfParticles();
  const std::size_t per = this->Model.Offsets.size();
  const std::size_t p = this->ParticleStride;
  const std::size_t s = this->BodyStride;
  const float fraction = 1.0f / static_cast<float>(per);
  const bool inAir = !this->Model.Air.IsEmpty();
  const auto fill =
    [&](std::size_t particle, std::size_t body, float factor, float pushed, float drag)
  {
    SphAdjointRecord& record = this->Adjoints[particle];
    float* out = &record.AX;
    for (int c = 0; c < 3; ++c)
    {
      const float abar = this->AccelerationBar(c)[body];
      out[c] = pushed * abar;
      out[4 + c] = factor * (this->AverageBar(c)[body] + drag * abar);
    }
  };
  for (std::size_t k = 0; k < ng; ++k)
  {
    fill(k, this->Order[k], 1.0f, 1.0f, 0.0f);
  }
  for (std::size_t o = 0; o < this->Model.NumberOfObjects; ++o)
  {
    for (std::size_t k = 0; k < per; ++k)
    {
      const std::size_t particle = ng + o * per + k;
      fill(particle, ng + o, fraction, inAir ? 0.0f : fraction, this->Model.DragRates[o]);
      SphAdjointRecord& record = this->Adjoints[particle];
      float* average = &record.AX + 4;
      float byRaise = 0.0f;
      for (int c = 0; c < 3; ++c)
      {
        byRaise += average[c] * this->PairSums[particle].Second[c];
        average[c] *= this->Raise[particle - ng];
      }
      this->RaiseSlope[particle - ng] *= byRaise; // of E by Psi from here on
    }
  }
  this->Kernels.AdjointPressure(this->Constants, this->Records.data(), this->Adjoints.data(),
                                this->Pairs, n, this->Bar.data());
  const float* g0 = this->PsiGradient.data();
  const float* h = this->PsiHessian.data();
  const float* k6 = this->SpringSlope.data();
  for (std::size_t i = 0; i < n; ++i)
  {
    SphAdjointRecord& r = this->Adjoints[i];
    const float dot = g0[i] * r.AX + g0[p + i] * r.AY + g0[2 * p + i] * r.AZ;
    r.Density = this->PressureSlope[i] * (this->Bar[i] - 2.0f * dot);
    const float q = -2.0f * this->Records[i].Pressure;
    const float xx = q * h[i] + k6[i];
    const float xy = q * h[p + i] + k6[p + i];
    const float xz = q * h[2 * p + i] + k6[2 * p + i];
    const float yy = q * h[3 * p + i] + k6[3 * p + i];
    const float yz = q * h[4 * p + i] + k6[4 * p + i];
    const float zz = q * h[5 * p + i] + k6[5 * p + i];
    SphPairSum& sum = this->PairSums[i];
    sum = SphPairSum();
    const float byPsi = r.Density + (i < ng ? 0.0f : this->RaiseSlope[i - ng]);
    sum.First[0] = byPsi * g0[i] + xx * r.AX + xy * r.AY + xz * r.AZ;
    sum.First[1] = byPsi * g0[p + i] + xy * r.AX + yy * r.AY + yz * r.AZ;
    sum.First[2] = byPsi * g0[2 * p + i] + xz * r.AX + yz * r.AY + zz * r.AZ;
  }
  this->Kernels.AdjointState(this->Constants, this->Records.data(), this->Adjoints.data(),
                             this->Pairs, n, this->PairSums.data());
  const auto add = [&](std::size_t particle, std::size_t body)
  {
    const SphPairSum& sum = this->PairSums[particle];
    for (int c = 0; c < 3; ++c)
    {
      gradient[c * s + body] += sum.First[c];
      gradient[(3 + c) * s + body] += sum.Second[c];
    }
  };
  for (std::size_t k = 0; k < ng; ++k)
  {
    add(k, this->Order[k]);
  }
  for (std::size_t k = ng; k < n; ++k)
  {
    add(k, ng + (k - ng) / per);
  }
  if (inAir)
  {
    for (int c = 0; c < 3; ++c)
    {
      for (std::size_t i = 0; i < ng; ++i)
      {
        gradient[(3 + c) * s + i] -= this->Model.AirDrag * this->AccelerationBar(c)[i];
      }
    }
    return;
  }
  const std::size_t bodies = this->Model.NumberOfBodies();
  const float* j = this->Jacobian.data();
  for (int c = 0; c < 3; ++c)
  {
    const float* a0 = this->AccelerationBar(0);
    const float* a1 = this->AccelerationBar(1);
    const float* a2 = this->AccelerationBar(2);
    float* g = gradient + c * s;
    float* gv = gradient + (3 + c) * s;
    const float* abar = this->AccelerationBar(c);
#pragma GCC ivdep
    for (std::size_t i = 0; i < bodies; ++i)
    {
      g[i] += j[c * s + i] * a0[i] + j[(3 + c) * s + i] * a1[i] + j[(6 + c) * s + i] * a2[i];
      gv[i] -= this->BackgroundDrag * abar[i];
    }
  }
  for (std::size_t o = 0; o < this->Model.NumberOfObjects; ++o)
  {
    const std::size_t i = ng + o;
    Vec3 bar;
    for (int c = 0; c < 3; ++c)
    {
      bar[c] = this->AccelerationBar(c)[i];
    }
    const Vec3 byPosition = this->Damping[o].ByPosition.transpose() * bar;
    const Vec3 byVelocity = this->Damping[o].ByVelocity.transpose() * bar;
    for (int c = 0; c < 3; ++c)
    {
      gradient[c * s + i] += static_cast<float>(byPosition[c]);
      gradient[(3 + c) * s + i] += static_cast<float>(byVelocity[c]);
    }
  }
}

// The kernel's pull vanishes between particles at one place, and E does not mind that no gas would
// stay so.
double FrameTerms::Crowding(float factor, float* gradient) const
{
  const auto reach = static_cast<float>(this->Model.Weights.GasDistance);
  const float least = 1.0f - reach * this->Constants.InverseSupport; // of s
  const std::size_t s = this->BodyStride;
  const SphPairs& pairs = this->Pairs;
  double sum = 0.0;
  for (std::size_t i = 0; i < this->Model.NumberOfGas; ++i)
  {
    if (!(pairs.Nearest[i] > least)) // nearly always
    {
      continue;
    }
    for (std::size_t k = 8 * pairs.Starts[i]; k < 8 * pairs.Starts[i + 1]; ++k)
    {
      const SphPairGroup& group = pairs.Groups[k / 8];
      const std::size_t l = k % 8;
      if (!(group.S[l] > least))
      {
        continue;
      }
      const float d[3] = { group.X[l], group.Y[l], group.Z[l] };
      const float r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
      const float depth = std::max(0.0f, reach - r);
      sum += 0.5 * depth * depth;
      for (int c = 0; c < 3 && gradient && r > 0.0f; ++c)
      {
        const float pull = factor * depth * d[c] / r;
        gradient[c * s + this->Order[i]] -= pull;
        gradient[c * s + this->Order[group.Other[l] / 8]] += pull;
      }
    }
  }
  return sum;
}

} // namespace waft
