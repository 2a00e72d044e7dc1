// SPDX-License-Identifier: BSD-3-Clause
// The four pair sums over the neighbour lists (Shi et al. 2005, Appendix B, with v_ij = v_i - v_j)
// and their adjoint, written once for any Lanes. A pair is visited once: what i gets from j is up
// to the masses minus what j gets from i. j is always gas.
template <typename Index>
void DensitySum(const SphConstants& c, const SphRecord* records, const std::uint32_t* starts,
                const Index* list, std::size_t n, const SphPairs& pairs, float* density)
{
  const float* base = &records->X;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  const Lanes five = Lanes::Set(5.0f);
  const Lanes four = Lanes::Set(4.0f);
  const Lanes inverse = Lanes::Set(c.InverseSupport);
  const Lanes support2 = Lanes::Set(1.0f / (c.InverseSupport * c.InverseSupport));
  for (std::size_t i = 0; i < n; ++i)
  {
    density[i] = 0.0f;
  }
  std::size_t end = 0;
  pairs.Starts[0] = 0;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Lanes xi = Lanes::Set(records[i].X);
    const Lanes yi = Lanes::Set(records[i].Y);
    const Lanes zi = Lanes::Set(records[i].Z);
    const std::size_t begin = end;
    for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
    {
      Lanes q[4];
      LoadFour(base, list + 8 * k, q);
      const Lanes x = xi - q[0];
      const Lanes y = yi - q[1];
      const Lanes z = zi - q[2];
      const Lanes r2 = Fma(x, x, Fma(y, y, z * z));
      const unsigned mask = LessMask(r2, support2);
      const Compressor compressor(mask);
      compressor.Store(x, pairs.X + end);
      compressor.Store(y, pairs.Y + end);
      compressor.Store(z, pairs.Z + end);
      compressor.Store(Max(zero, Fnma(Sqrt(r2), inverse, one)), pairs.S + end);
      compressor.Store(list + 8 * k, pairs.Other + end);
      end += static_cast<std::size_t>(__builtin_popcount(mask));
    }
    // At the edge of the support all terms vanish.
    for (; end % 8 != 0; ++end)
    {
      pairs.X[end] = pairs.Y[end] = pairs.Z[end] = 1.0f;
      pairs.S[end] = 0.0f;
      pairs.Other[end] = static_cast<std::uint32_t>(n);
    }
    pairs.Starts[i + 1] = static_cast<std::uint32_t>(end / 8);
    const Lanes scale = Lanes::Set(c.KernelScale * records[i].Mass);
    Lanes sum = zero;
    for (std::size_t k = begin; k < end; k += 8)
    {
      const Lanes s = Lanes::Load(pairs.S + k);
      const Lanes s2 = s * s;
      const Lanes w = scale * ((s2 * s2) * Fnma(four, s, five));
      sum = sum + w;
      float weights[8];
      w.Store(weights);
      for (int l = 0; l < 8; ++l)
      {
        density[pairs.Other[k + l]] += weights[l];
      }
    }
    density[i] += c.GasMass / records[i].Mass * Sum(sum);
  }
}

void AccelerationSum(const SphConstants& c, const SphRecord* records, const SphPairs& pairs,
                     std::size_t n, float* sums, SphRows acceleration, SphRows average)
{
  const float* base = &records->X;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes five = Lanes::Set(5.0f);
  const Lanes four = Lanes::Set(4.0f);
  const Lanes core = Lanes::Set(c.ViscousCore);
  for (std::size_t k = 0; k < 8 * (n + 1); ++k)
  {
    sums[k] = 0.0f;
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    const SphRecord& me = records[i];
    const Lanes ui = Lanes::Set(me.U), vi = Lanes::Set(me.V), wi = Lanes::Set(me.W);
    const Lanes pi = Lanes::Set(me.Pressure);
    const Lanes mass = Lanes::Set(me.Mass);
    const Lanes kappa = Lanes::Set(me.Mass < c.ObjectMassThreshold ? c.ObjectKappa : c.Kappa);
    Lanes own[8] = { zero, zero, zero, zero, zero, zero, zero, zero };
    for (std::size_t k = pairs.Starts[i]; k < pairs.Starts[i + 1]; ++k)
    {
      Lanes w[4];
      LoadFour(base + 4, pairs.Other + 8 * k, w);
      const Lanes x = Lanes::Load(pairs.X + 8 * k);
      const Lanes y = Lanes::Load(pairs.Y + 8 * k);
      const Lanes z = Lanes::Load(pairs.Z + 8 * k);
      const Lanes s = Lanes::Load(pairs.S + 8 * k);
      const Lanes u = ui - w[0], v = vi - w[1], t = wi - w[2];
      const Lanes r2 = Fma(x, x, Fma(y, y, z * z));
      const Lanes s2 = s * s;
      const Lanes vx = Fma(u, x, Fma(v, y, t * z));
      const Lanes tension = Fnma(kappa, vx / (r2 + core), pi + w[3]);
      const Lanes factor = (tension * mass) * (s2 * s);
      const Lanes weight = (mass * (s2 * s2)) * Fnma(four, s, five);
      const Lanes terms[8] = { factor * x, factor * y, factor * z, zero,
                               weight * u, weight * v, weight * t, zero };
      for (int a = 0; a < 8; ++a)
      {
        own[a] = own[a] + terms[a];
      }
      SubtractRecords(sums, pairs.Other + 8 * k, terms);
    }
    // The sums are of m_i; i's own are of its neighbours' mass.
    const Lanes others = Lanes::Set(c.GasMass / me.Mass);
    for (Lanes& a : own)
    {
      a = others * a;
    }
    AddSums(sums + 8 * i, own);
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      acceleration.Row(a)[i] = -c.GradientScale * sums[8 * i + a];
      average.Row(a)[i] = -c.KernelScale * sums[8 * i + 4 + a];
    }
  }
}

void AdjointPressureSum(const SphConstants& c, const SphRecord* records,
                        const SphAdjointRecord* adjoints, const SphPairs& pairs, std::size_t n,
                        float* pressure)
{
  const float* adjointBase = &adjoints->AX;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes scale = Lanes::Set(-c.GradientScale);
  const Lanes mj = Lanes::Set(c.GasMass);
  for (std::size_t i = 0; i <= n; ++i)
  {
    pressure[i] = 0.0f;
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    const SphAdjointRecord& bar = adjoints[i];
    const Lanes mi = Lanes::Set(records[i].Mass);
    const Lanes ai = mj * Lanes::Set(bar.AX);
    const Lanes bi = mj * Lanes::Set(bar.AY);
    const Lanes ci = mj * Lanes::Set(bar.AZ);
    Lanes sum = zero;
    for (std::size_t k = pairs.Starts[i]; k < pairs.Starts[i + 1]; ++k)
    {
      Lanes b[4];
      LoadFour(adjointBase, pairs.Other + 8 * k, b);
      const Lanes x = Lanes::Load(pairs.X + 8 * k);
      const Lanes y = Lanes::Load(pairs.Y + 8 * k);
      const Lanes z = Lanes::Load(pairs.Z + 8 * k);
      const Lanes s = Lanes::Load(pairs.S + 8 * k);
      const Lanes bx = Fnma(mi, b[0], ai);
      const Lanes by = Fnma(mi, b[1], bi);
      const Lanes bz = Fnma(mi, b[2], ci);
      const Lanes value = (scale * (s * s) * s) * Fma(bx, x, Fma(by, y, bz * z));
      sum = sum + value;
      float values[8];
      value.Store(values);
      for (int l = 0; l < 8; ++l)
      {
        pressure[pairs.Other[8 * k + l]] += values[l];
      }
    }
    pressure[i] += Sum(sum);
  }
}

void AdjointStateSum(const SphConstants& c, const SphRecord* records,
                     const SphAdjointRecord* adjoints, const SphPairs& pairs, std::size_t n,
                     float* sums, SphRows position, SphRows velocity)
{
  const float* base = &records->X;
  const float* adjointBase = &adjoints->AX;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  const Lanes tiny = Lanes::Set(1e-6f);
  const Lanes support = Lanes::Set(1.0f / c.InverseSupport);
  const Lanes core = Lanes::Set(c.ViscousCore);
  const Lanes gradient = Lanes::Set(c.GradientScale);
  const Lanes second = Lanes::Set(c.SecondScale);
  const Lanes kernel5 = Lanes::Set(5.0f * c.KernelScale);
  const Lanes kernel4 = Lanes::Set(4.0f * c.KernelScale);
  const Lanes mj = Lanes::Set(c.GasMass);
  for (std::size_t k = 0; k < 8 * (n + 1); ++k)
  {
    sums[k] = 0.0f;
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    const SphRecord& me = records[i];
    const SphAdjointRecord& bar = adjoints[i];
    const Lanes ui = Lanes::Set(me.U), vi = Lanes::Set(me.V), wi = Lanes::Set(me.W);
    const Lanes mi = Lanes::Set(me.Mass), pi = Lanes::Set(me.Pressure);
    const Lanes ai = mj * Lanes::Set(bar.AX);
    const Lanes bi = mj * Lanes::Set(bar.AY);
    const Lanes ci = mj * Lanes::Set(bar.AZ);
    const Lanes di = mj * Lanes::Set(bar.DX);
    const Lanes ei = mj * Lanes::Set(bar.DY);
    const Lanes fi = mj * Lanes::Set(bar.DZ);
    const Lanes densityBar = mj * Lanes::Set(bar.Density);
    const Lanes kappa = Lanes::Set(me.Mass < c.ObjectMassThreshold ? c.ObjectKappa : c.Kappa);
    Lanes own[8] = { zero, zero, zero, zero, zero, zero, zero, zero };
    for (std::size_t k = pairs.Starts[i]; k < pairs.Starts[i + 1]; ++k)
    {
      const std::uint32_t* other = pairs.Other + 8 * k;
      Lanes w[4], b[4], d[4];
      LoadFour(base + 4, other, w);
      LoadFour(adjointBase, other, b);
      LoadFour(adjointBase + 4, other, d);
      const Lanes x = Lanes::Load(pairs.X + 8 * k);
      const Lanes y = Lanes::Load(pairs.Y + 8 * k);
      const Lanes z = Lanes::Load(pairs.Z + 8 * k);
      const Lanes s = Lanes::Load(pairs.S + 8 * k);
      const Lanes u = ui - w[0], v = vi - w[1], t = wi - w[2];
      const Lanes r2 = Fma(x, x, Fma(y, y, z * z));
      // s = 1 - r / 2h gives r back; one division does for 1 / r and 1 / (r^2 + core).
      const Lanes r = Max(Fnma(s, support, support), tiny);
      const Lanes near = r2 + core;
      const Lanes both = one / (r * near);
      const Lanes guard = both * r;
      const Lanes s2 = s * s;
      const Lanes F = gradient * (s2 * s);
      const Lanes G = (second * s2) * (both * near);
      const Lanes W = (s2 * s2) * Fnma(kernel4, s, kernel5);
      const Lanes bx = Fnma(mi, b[0], ai);
      const Lanes by = Fnma(mi, b[1], bi);
      const Lanes bz = Fnma(mi, b[2], ci);
      const Lanes Bx = Fnma(mi, d[0], di);
      const Lanes By = Fnma(mi, d[1], ei);
      const Lanes Bz = Fnma(mi, d[2], fi);
      const Lanes bDotX = Fma(bx, x, Fma(by, y, bz * z));
      const Lanes vDotX = Fma(u, x, Fma(v, y, t * z));
      const Lanes BDotV = Fma(Bx, u, Fma(By, v, Bz * t));
      const Lanes approach = vDotX * guard;
      const Lanes tension = Fnma(kappa, approach, pi + w[3]);
      const Lanes viscous = (kappa * F) * (bDotX * guard);
      const Lanes density = Fma(mi, b[3], densityBar);
      // The factor of x_ij: geometric stiffness, viscosity, average and density.
      Lanes along = F * (density - BDotV);
      along = Fnma(tension * G, bDotX, along);
      along = Fnma(viscous + viscous, approach, along);
      const Lanes stress = tension * F;
      const Lanes terms[8] = { Fma(along, x, Fma(viscous, u, zero - stress * bx)),
                               Fma(along, y, Fma(viscous, v, zero - stress * by)),
                               Fma(along, z, Fma(viscous, t, zero - stress * bz)),
                               zero,
                               Fnma(W, Bx, viscous * x),
                               Fnma(W, By, viscous * y),
                               Fnma(W, Bz, viscous * z),
                               zero };
      for (int a = 0; a < 8; ++a)
      {
        own[a] = own[a] + terms[a];
      }
      SubtractRecords(sums, other, terms);
    }
    AddSums(sums + 8 * i, own);
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      position.Row(a)[i] += sums[8 * i + a];
      velocity.Row(a)[i] += sums[8 * i + 4 + a];
    }
  }
}
