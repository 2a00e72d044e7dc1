// SPDX-License-Identifier: BSD-3-Clause
// Terms of single points: walls, vortices, spline fields, the search of neighbour lists; written
// once for any Lanes.

/// 1 - psi of one plane at signed inner distance d, with its first and second derivative by d.
/// psi(d) = s^6 (3.5 - 4.5 s + 1.5 s^2), s = 1 - |d| / 2h; psi(-d) = 1 - psi(d).
inline void PlaneComplement(const SphConstants& c, Lanes d, Lanes& q, Lanes& q1, Lanes& q2)
{
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  const Lanes magnitude = Max(d, zero - d);
  const Lanes s = Max(zero, Fnma(magnitude, Lanes::Set(c.InverseSupport), one));
  const Lanes s2 = s * s;
  const Lanes s4 = s2 * s2;
  const Lanes psi =
    (s4 * s2) * Fma(s, Fma(s, Lanes::Set(1.5f), Lanes::Set(-4.5f)), Lanes::Set(3.5f));
  const Lanes slope = Lanes::Set(21.0f * c.InverseSupport) * (s4 * s) *
                      Fma(s, Fma(s, Lanes::Set(4.0f / 7.0f), Lanes::Set(-1.5f)), one);
  const Lanes curve = Lanes::Set(c.InverseSupport * c.InverseSupport) * s4 *
                      Fma(s, Fma(s, Lanes::Set(84.0f), Lanes::Set(-189.0f)), Lanes::Set(105.0f));
  q = Select(d < zero, psi, one - psi);
  q1 = slope;
  q2 = Select(d < zero, curve, zero - curve);
}

void WallTerms(const SphConstants& c, const SphBox& box, std::size_t n, const float* x,
               const float* y, const float* z, float* psi, SphRows gradient, SphRows hessian)
{
  const float* points[3] = { x, y, z };
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  for (std::size_t i = 0; i < n; i += 8)
  {
    Lanes q[3], q1[3], q2[3];
    for (int a = 0; a < 3; ++a)
    {
      const Lanes p = Lanes::Load(points[a] + i);
      Lanes low, low1, low2, high, high1, high2;
      PlaneComplement(c, p - Lanes::Set(box.Min[a]), low, low1, low2);
      PlaneComplement(c, Lanes::Set(box.Max[a]) - p, high, high1, high2);
      q[a] = low * high;
      q1[a] = low1 * high - low * high1;
      q2[a] = low2 * high + low * high2 - Lanes::Set(2.0f) * low1 * high1;
    }
    (one - q[0] * q[1] * q[2]).Store(psi + i);
    (zero - q1[0] * q[1] * q[2]).Store(gradient.Row(0) + i);
    (zero - q[0] * q1[1] * q[2]).Store(gradient.Row(1) + i);
    (zero - q[0] * q[1] * q1[2]).Store(gradient.Row(2) + i);
    (zero - q2[0] * q[1] * q[2]).Store(hessian.Row(0) + i);
    (zero - q1[0] * q1[1] * q[2]).Store(hessian.Row(1) + i);
    (zero - q1[0] * q[1] * q1[2]).Store(hessian.Row(2) + i);
    (zero - q[0] * q2[1] * q[2]).Store(hessian.Row(3) + i);
    (zero - q[0] * q1[1] * q1[2]).Store(hessian.Row(4) + i);
    (zero - q[0] * q[1] * q2[2]).Store(hessian.Row(5) + i);
  }
}

/// The eight sites about each point, blended by 6 u^5 - 15 u^4 + 10 u^3.
void RestTerms(const SphRestField& field, std::size_t n, const float* x, const float* y,
               const float* z, float* psi, SphRows gradient, SphRows hessian)
{
  const float* points[3] = { x, y, z };
  const Lanes zero = Lanes::Set(0.0f);
  const Lanes one = Lanes::Set(1.0f);
  for (std::size_t i = 0; i < n; i += 8)
  {
    // Weight of the second site along each axis, and its derivatives by the position.
    Lanes first[3], second[3], t[3], t1[3], t2[3];
    for (int a = 0; a < 3; ++a)
    {
      const float inverse = field.InverseCell[a];
      const Lanes last = Lanes::Set(static_cast<float>(field.Dimensions[a] - 1));
      const Lanes site = Fma(Lanes::Load(points[a] + i), Lanes::Set(inverse), Lanes::Set(0.5f));
      const Lanes c = Min(Max(site, zero), last);
      first[a] = Min(Floor(c), Max(last - one, zero));
      second[a] = Min(first[a] + one, last);
      const Lanes u = c - first[a];
      const Lanes v = one - u;
      const Lanes uv = u * v;
      t[a] = u * u * u * Fma(u, Fma(u, Lanes::Set(6.0f), Lanes::Set(-15.0f)), Lanes::Set(10.0f));
      t1[a] = Lanes::Set(30.0f * inverse) * uv * uv;
      t2[a] = Lanes::Set(60.0f * inverse * inverse) * uv * (v - u);
    }
    const Lanes nx = Lanes::Set(static_cast<float>(field.Dimensions[0]));
    const Lanes ny = Lanes::Set(static_cast<float>(field.Dimensions[1]));
    // Along x: value and difference of the four edges; then along y; then along z.
    Lanes low[2][2], step[2][2];
    for (int k = 0; k < 2; ++k)
    {
      for (int j = 0; j < 2; ++j)
      {
        const Lanes row = nx * Fma(ny, k ? second[2] : first[2], j ? second[1] : first[1]);
        const Lanes a = Gather(field.Values, row + first[0]);
        step[k][j] = Gather(field.Values, row + second[0]) - a;
        low[k][j] = Fma(t[0], step[k][j], a);
      }
    }
    Lanes value[2], byX[2], byY[2], byXY[2];
    for (int k = 0; k < 2; ++k)
    {
      byY[k] = low[k][1] - low[k][0];
      value[k] = Fma(t[1], byY[k], low[k][0]);
      byXY[k] = step[k][1] - step[k][0];
      byX[k] = Fma(t[1], byXY[k], step[k][0]);
    }
    const auto alongZ = [&](const Lanes* v) { return Fma(t[2], v[1] - v[0], v[0]); };
    const Lanes x1 = alongZ(byX);
    const Lanes y1 = alongZ(byY);
    const Lanes z1 = value[1] - value[0];
    const auto add = [](float* out, Lanes v) { (Lanes::Load(out) + v).Store(out); };
    add(psi + i, alongZ(value));
    add(gradient.Row(0) + i, t1[0] * x1);
    add(gradient.Row(1) + i, t1[1] * y1);
    add(gradient.Row(2) + i, t1[2] * z1);
    add(hessian.Row(0) + i, t2[0] * x1);
    add(hessian.Row(1) + i, t1[0] * t1[1] * alongZ(byXY));
    add(hessian.Row(2) + i, t1[0] * t1[2] * (byX[1] - byX[0]));
    add(hessian.Row(3) + i, t2[1] * y1);
    add(hessian.Row(4) + i, t1[1] * t1[2] * (byY[1] - byY[0]));
    add(hessian.Row(5) + i, t2[2] * z1);
  }
}

/// Eq. 13 with the denominator |r1 x r2|^2 + core. r1 x r2 = r0 x (x - p1) up to sign conventions
/// that cancel: (x - p1) x (x - p2) = r0 x (x - p1), so its derivative is r0 x dx.
void VortexTerms(const SphVortex* vortices, std::size_t count, std::size_t n, const float* x,
                 const float* y, const float* z, SphRows force, SphRows jacobian)
{
  const Lanes one = Lanes::Set(1.0f);
  const Lanes tiny = Lanes::Set(1e-12f);
  for (std::size_t k = 0; k < count; ++k)
  {
    const SphVortex& vortex = vortices[k];
    Lanes r0[3];
    for (int a = 0; a < 3; ++a)
    {
      r0[a] = Lanes::Set(vortex.P2[a] - vortex.P1[a]);
    }
    const Lanes core = Lanes::Set(vortex.Core);
    const Lanes strength = Lanes::Set(vortex.Strength);
    for (std::size_t i = 0; i < n; i += 8)
    {
      const Lanes p[3] = { Lanes::Load(x + i), Lanes::Load(y + i), Lanes::Load(z + i) };
      Lanes r1[3], r2[3];
      for (int a = 0; a < 3; ++a)
      {
        r1[a] = p[a] - Lanes::Set(vortex.P1[a]);
        r2[a] = p[a] - Lanes::Set(vortex.P2[a]);
      }
      const Lanes n1 = one / Sqrt(Max(tiny, Fma(r1[0], r1[0], Fma(r1[1], r1[1], r1[2] * r1[2]))));
      const Lanes n2 = one / Sqrt(Max(tiny, Fma(r2[0], r2[0], Fma(r2[1], r2[1], r2[2] * r2[2]))));
      const Lanes c1 = Fma(r0[0], r1[0], Fma(r0[1], r1[1], r0[2] * r1[2])) * n1;
      const Lanes c2 = Fma(r0[0], r2[0], Fma(r0[1], r2[1], r0[2] * r2[2])) * n2;
      const Lanes cross[3] = { r0[1] * r1[2] - r0[2] * r1[1], r0[2] * r1[0] - r0[0] * r1[2],
                               r0[0] * r1[1] - r0[1] * r1[0] };
      const Lanes q =
        one / (core + Fma(cross[0], cross[0], Fma(cross[1], cross[1], cross[2] * cross[2])));
      const Lanes along = c1 - c2;
      const Lanes factor = along * q;
      // d |cross|^2 / dx = 2 cross x r0.
      const Lanes turn[3] = { cross[1] * r0[2] - cross[2] * r0[1],
                              cross[2] * r0[0] - cross[0] * r0[2],
                              cross[0] * r0[1] - cross[1] * r0[0] };
      Lanes dFactor[3];
      for (int a = 0; a < 3; ++a)
      {
        const Lanes dAlong = n1 * (r0[a] - c1 * n1 * r1[a]) - n2 * (r0[a] - c2 * n2 * r2[a]);
        dFactor[a] = q * (dAlong - Lanes::Set(2.0f) * factor * turn[a]);
      }
      const Lanes zero = Lanes::Set(0.0f);
      const Lanes skew[9] = { zero,         zero - r0[2], r0[1], r0[2], zero,
                              zero - r0[0], zero - r0[1], r0[0], zero };
      for (int a = 0; a < 3; ++a)
      {
        float* f = force.Row(a) + i;
        (Lanes::Load(f) + strength * factor * cross[a]).Store(f);
        for (int b = 0; b < 3; ++b)
        {
          float* j = jacobian.Row(3 * a + b) + i;
          (Lanes::Load(j) + strength * (cross[a] * dFactor[b] + factor * skew[3 * a + b])).Store(j);
        }
      }
    }
  }
}

/// Weights and slopes of the three quadratic B-splines about x (in node units); returns the first.
inline int SplineWeights(float x, int count, float w[3], float d[3])
{
  const float limit = static_cast<float>(count) - 1.5f;
  const bool clamped = x < 0.5f || x > limit;
  const float c = x < 0.5f ? 0.5f : (x > limit ? limit : x);
  int centre = static_cast<int>(c + 0.5f);
  centre = centre > count - 2 ? count - 2 : centre;
  const float t = c - static_cast<float>(centre);
  w[0] = 0.5f * (0.5f - t) * (0.5f - t);
  w[1] = 0.75f - t * t;
  w[2] = 0.5f * (0.5f + t) * (0.5f + t);
  d[0] = clamped ? 0.0f : t - 0.5f;
  d[1] = clamped ? 0.0f : -2.0f * t;
  d[2] = clamped ? 0.0f : t + 0.5f;
  return centre - 1;
}

void SplineTerms(const SphSplineField& field, float factor, std::size_t n, const float* x,
                 const float* y, const float* z, SphRows force, SphRows jacobian)
{
  const float* points[3] = { x, y, z };
  for (std::size_t i = 0; i < n; ++i)
  {
    float w[3][3], d[3][3];
    int first[3];
    for (int a = 0; a < 3; ++a)
    {
      first[a] = SplineWeights((points[a][i] - field.Origin[a]) * field.InverseSpacing[a],
                               field.Dimensions[a], w[a], d[a]);
    }
    float value[4] = {}, gx[4] = {}, gy[4] = {}, gz[4] = {};
    for (int k = 0; k < 3; ++k)
    {
      for (int j = 0; j < 3; ++j)
      {
        const float* row =
          field.Coefficients +
          4 * ((static_cast<std::size_t>(first[2] + k) * field.Dimensions[1] + first[1] + j) *
                 field.Dimensions[0] +
               first[0]);
        float line[4], slope[4];
        for (int c = 0; c < 4; ++c)
        {
          line[c] = w[0][0] * row[c] + w[0][1] * row[4 + c] + w[0][2] * row[8 + c];
          slope[c] = d[0][0] * row[c] + d[0][1] * row[4 + c] + d[0][2] * row[8 + c];
        }
        const float wyz = w[1][j] * w[2][k];
        const float dy = d[1][j] * w[2][k];
        const float dz = w[1][j] * d[2][k];
        for (int c = 0; c < 4; ++c)
        {
          value[c] += wyz * line[c];
          gx[c] += wyz * slope[c];
          gy[c] += dy * line[c];
          gz[c] += dz * line[c];
        }
      }
    }
    for (int a = 0; a < 3; ++a)
    {
      force.Row(a)[i] += factor * value[a];
      jacobian.Row(3 * a)[i] += factor * field.InverseSpacing[0] * gx[a];
      jacobian.Row(3 * a + 1)[i] += factor * field.InverseSpacing[1] * gy[a];
      jacobian.Row(3 * a + 2)[i] += factor * field.InverseSpacing[2] * gz[a];
    }
  }
}

std::size_t NearPoints(const float* x, const float* y, const float* z, std::size_t begin,
                       std::size_t end, const float* p, float radius2, std::uint32_t* found)
{
  const Lanes px = Lanes::Set(p[0]), py = Lanes::Set(p[1]), pz = Lanes::Set(p[2]);
  const Lanes limit = Lanes::Set(radius2);
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; i += 8)
  {
    const Lanes dx = Lanes::Load(x + i) - px;
    const Lanes dy = Lanes::Load(y + i) - py;
    const Lanes dz = Lanes::Load(z + i) - pz;
    unsigned mask = (Fma(dx, dx, Fma(dy, dy, dz * dz)) < limit).Bits();
    if (end - i < 8)
    {
      mask &= (1u << (end - i)) - 1u;
    }
    StoreBits(LaneOrder(mask, 0)(BitsFrom(static_cast<std::uint32_t>(i))), found + count);
    count += static_cast<std::size_t>(__builtin_popcount(mask));
  }
  return count;
}
