// SPDX-License-Identifier: BSD-3-Clause
// The four pair sums over the neighbour lists (Shi et al. 2005, Appendix B, with v_ij = v_i - v_j)
// and their adjoint, written once for any Lanes.
template <typename Index>
void DensitySum(const SphConstants& c, const SphRecord* records, const std::uint32_t* starts,
                const Index* list, std::size_t n, float* density)
{
  const float* base = &records->X;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  const Lanes five = Lanes::Set(5.0f);
  const Lanes four = Lanes::Set(4.0f);
  const Lanes inverse = Lanes::Set(c.InverseSupport);
  for (std::size_t i = 0; i < n; ++i)
  {
    const Lanes xi = Lanes::Set(records[i].X);
    const Lanes yi = Lanes::Set(records[i].Y);
    const Lanes zi = Lanes::Set(records[i].Z);
    Lanes sum = zero;
    for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
    {
      Lanes q[4];
      LoadFour(base, list + 8 * k, q);
      const Lanes x = xi - q[0];
      const Lanes y = yi - q[1];
      const Lanes z = zi - q[2];
      const Lanes r = Sqrt(Fma(x, x, Fma(y, y, z * z)));
      const Lanes s = Max(zero, Fnma(r, inverse, one));
      const Lanes s2 = s * s;
      sum = Fma(q[3] * (s2 * s2), Fnma(four, s, five), sum);
    }
    density[i] = c.KernelScale * Sum(sum);
  }
}

template <typename Index>
void AccelerationSum(const SphConstants& c, const SphRecord* records, const std::uint32_t* starts,
                     const Index* list, std::size_t n, SphRows acceleration, SphRows average)
{
  const float* base = &records->X;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  const Lanes five = Lanes::Set(5.0f);
  const Lanes four = Lanes::Set(4.0f);
  const Lanes inverse = Lanes::Set(c.InverseSupport);
  const Lanes core = Lanes::Set(c.ViscousCore);
  const Lanes threshold = Lanes::Set(c.ObjectMassThreshold);
  const Lanes objectKappa = Lanes::Set(c.ObjectKappa);
  for (std::size_t i = 0; i < n; ++i)
  {
    const SphRecord& me = records[i];
    const Lanes xi = Lanes::Set(me.X), yi = Lanes::Set(me.Y), zi = Lanes::Set(me.Z);
    const Lanes ui = Lanes::Set(me.U), vi = Lanes::Set(me.V), wi = Lanes::Set(me.W);
    const Lanes pi = Lanes::Set(me.Pressure);
    const Lanes gasKappa = Lanes::Set(me.Mass < c.ObjectMassThreshold ? c.ObjectKappa : c.Kappa);
    Lanes ax = zero, ay = zero, az = zero, dx = zero, dy = zero, dz = zero;
    for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
    {
      Lanes q[4], w[4];
      LoadFour(base, list + 8 * k, q);
      LoadFour(base + 4, list + 8 * k, w);
      const Lanes x = xi - q[0], y = yi - q[1], z = zi - q[2];
      const Lanes u = ui - w[0], v = vi - w[1], t = wi - w[2];
      const Lanes r2 = Fma(x, x, Fma(y, y, z * z));
      const Lanes s = Max(zero, Fnma(Sqrt(r2), inverse, one));
      const Lanes s2 = s * s;
      const Lanes vx = Fma(u, x, Fma(v, y, t * z));
      const Lanes kappa = Less(q[3], threshold, objectKappa, gasKappa);
      const Lanes tension = Fnma(kappa, vx / (r2 + core), pi + w[3]);
      const Lanes factor = tension * (q[3] * (s2 * s));
      const Lanes weight = q[3] * ((s2 * s2) * Fnma(four, s, five));
      ax = Fma(factor, x, ax);
      ay = Fma(factor, y, ay);
      az = Fma(factor, z, az);
      dx = Fma(weight, u, dx);
      dy = Fma(weight, v, dy);
      dz = Fma(weight, t, dz);
    }
    acceleration.Row(0)[i] = -c.GradientScale * Sum(ax);
    acceleration.Row(1)[i] = -c.GradientScale * Sum(ay);
    acceleration.Row(2)[i] = -c.GradientScale * Sum(az);
    average.Row(0)[i] = -c.KernelScale * Sum(dx);
    average.Row(1)[i] = -c.KernelScale * Sum(dy);
    average.Row(2)[i] = -c.KernelScale * Sum(dz);
  }
}

template <typename Index>
void AdjointPressureSum(const SphConstants& c, const SphRecord* records,
                        const SphAdjointRecord* adjoints, const std::uint32_t* starts,
                        const Index* list, std::size_t n, float* pressure)
{
  const float* base = &records->X;
  const float* adjointBase = &adjoints->AX;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  const Lanes inverse = Lanes::Set(c.InverseSupport);
  for (std::size_t i = 0; i < n; ++i)
  {
    const SphRecord& me = records[i];
    const SphAdjointRecord& bar = adjoints[i];
    const Lanes xi = Lanes::Set(me.X), yi = Lanes::Set(me.Y), zi = Lanes::Set(me.Z);
    const Lanes mi = Lanes::Set(me.Mass);
    const Lanes ai = Lanes::Set(bar.AX), bi = Lanes::Set(bar.AY), ci = Lanes::Set(bar.AZ);
    Lanes sum = zero;
    for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
    {
      Lanes q[4], b[4];
      LoadFour(base, list + 8 * k, q);
      LoadFour(adjointBase, list + 8 * k, b);
      const Lanes x = xi - q[0], y = yi - q[1], z = zi - q[2];
      const Lanes s = Max(zero, Fnma(Sqrt(Fma(x, x, Fma(y, y, z * z))), inverse, one));
      const Lanes bx = Fnma(mi, b[0], q[3] * ai);
      const Lanes by = Fnma(mi, b[1], q[3] * bi);
      const Lanes bz = Fnma(mi, b[2], q[3] * ci);
      sum = Fma((s * s) * s, Fma(bx, x, Fma(by, y, bz * z)), sum);
    }
    pressure[i] = -c.GradientScale * Sum(sum);
  }
}

template <typename Index>
void AdjointStateSum(const SphConstants& c, const SphRecord* records,
                     const SphAdjointRecord* adjoints, const std::uint32_t* starts,
                     const Index* list, std::size_t n, SphRows position, SphRows velocity)
{
  const float* base = &records->X;
  const float* adjointBase = &adjoints->AX;
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  const Lanes two = Lanes::Set(2.0f);
  const Lanes tiny = Lanes::Set(1e-12f);
  const Lanes inverse = Lanes::Set(c.InverseSupport);
  const Lanes core = Lanes::Set(c.ViscousCore);
  const Lanes gradient = Lanes::Set(c.GradientScale);
  const Lanes second = Lanes::Set(c.SecondScale);
  const Lanes kernel5 = Lanes::Set(5.0f * c.KernelScale);
  const Lanes kernel4 = Lanes::Set(4.0f * c.KernelScale);
  const Lanes threshold = Lanes::Set(c.ObjectMassThreshold);
  const Lanes objectKappa = Lanes::Set(c.ObjectKappa);
  for (std::size_t i = 0; i < n; ++i)
  {
    const SphRecord& me = records[i];
    const SphAdjointRecord& bar = adjoints[i];
    const Lanes xi = Lanes::Set(me.X), yi = Lanes::Set(me.Y), zi = Lanes::Set(me.Z);
    const Lanes ui = Lanes::Set(me.U), vi = Lanes::Set(me.V), wi = Lanes::Set(me.W);
    const Lanes mi = Lanes::Set(me.Mass), pi = Lanes::Set(me.Pressure);
    const Lanes ai = Lanes::Set(bar.AX), bi = Lanes::Set(bar.AY), ci = Lanes::Set(bar.AZ);
    const Lanes di = Lanes::Set(bar.DX), ei = Lanes::Set(bar.DY), fi = Lanes::Set(bar.DZ);
    const Lanes densityBar = Lanes::Set(bar.Density);
    const Lanes gasKappa = Lanes::Set(me.Mass < c.ObjectMassThreshold ? c.ObjectKappa : c.Kappa);
    Lanes gx = zero, gy = zero, gz = zero, hx = zero, hy = zero, hz = zero;
    for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
    {
      const Index* index = list + 8 * k;
      Lanes q[4], w[4], b[4], d[4];
      LoadFour(base, index, q);
      LoadFour(base + 4, index, w);
      LoadFour(adjointBase, index, b);
      LoadFour(adjointBase + 4, index, d);
      const Lanes x = xi - q[0], y = yi - q[1], z = zi - q[2];
      const Lanes u = ui - w[0], v = vi - w[1], t = wi - w[2];
      const Lanes mj = q[3];
      const Lanes r2 = Fma(x, x, Fma(y, y, z * z));
      const Lanes r = Sqrt(Max(r2, tiny));
      const Lanes s = Max(zero, Fnma(r, inverse, one));
      const Lanes s2 = s * s;
      const Lanes F = gradient * (s2 * s);
      const Lanes G = second * (s2 / r);
      const Lanes W = (s2 * s2) * Fnma(kernel4, s, kernel5);
      const Lanes bx = Fnma(mi, b[0], mj * ai);
      const Lanes by = Fnma(mi, b[1], mj * bi);
      const Lanes bz = Fnma(mi, b[2], mj * ci);
      const Lanes Bx = Fnma(mi, d[0], mj * di);
      const Lanes By = Fnma(mi, d[1], mj * ei);
      const Lanes Bz = Fnma(mi, d[2], mj * fi);
      const Lanes bDotX = Fma(bx, x, Fma(by, y, bz * z));
      const Lanes vDotX = Fma(u, x, Fma(v, y, t * z));
      const Lanes BDotV = Fma(Bx, u, Fma(By, v, Bz * t));
      const Lanes kappa = Less(mj, threshold, objectKappa, gasKappa);
      const Lanes guard = one / (r2 + core);
      const Lanes approach = vDotX * guard;
      const Lanes tension = Fnma(kappa, approach, pi + w[3]);
      const Lanes viscous = (kappa * F) * (bDotX * guard);
      const Lanes density = Fma(mj, densityBar, mi * b[3]);
      // The factor of x_ij: geometric stiffness, viscosity, average and density.
      Lanes along = F * (density - BDotV);
      along = Fnma(tension * G, bDotX, along);
      along = Fnma(two * viscous, approach, along);
      const Lanes stress = tension * F;
      gx = gx + Fma(along, x, Fma(viscous, u, zero - stress * bx));
      gy = gy + Fma(along, y, Fma(viscous, v, zero - stress * by));
      gz = gz + Fma(along, z, Fma(viscous, t, zero - stress * bz));
      hx = hx + Fnma(W, Bx, viscous * x);
      hy = hy + Fnma(W, By, viscous * y);
      hz = hz + Fnma(W, Bz, viscous * z);
    }
    position.Row(0)[i] += Sum(gx);
    position.Row(1)[i] += Sum(gy);
    position.Row(2)[i] += Sum(gz);
    velocity.Row(0)[i] += Sum(hx);
    velocity.Row(1)[i] += Sum(hy);
    velocity.Row(2)[i] += Sum(hz);
  }
}
