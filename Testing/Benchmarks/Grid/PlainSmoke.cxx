// SPDX-License-Identifier: BSD-3-Clause
#include "PlainSmoke.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace
{

double Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double Cubic(const double* f, double t)
{
  const double d = f[2] - f[1];
  double m1 = 0.5 * (f[2] - f[0]);
  double m2 = 0.5 * (f[3] - f[1]);
  m1 = std::clamp(m1, std::min(0.0, 3.0 * d), std::max(0.0, 3.0 * d));
  m2 = std::clamp(m2, std::min(0.0, 3.0 * d), std::max(0.0, 3.0 * d));
  return f[1] + t * (m1 + t * (3.0 * d - 2.0 * m1 - m2 + t * (m1 + m2 - 2.0 * d)));
}

} // namespace

PlainSmoke::PlainSmoke(int n, double h,
                       const std::function<bool(double, double, double)>& isSolid) :
  N(n),
  H(h)
{
  const std::size_t cells = static_cast<std::size_t>(n) * n * n;
  this->Solid.resize(cells);
  this->Smoke.assign(cells, 0.0);
  for (int k = 0; k < n; ++k)
  {
    for (int j = 0; j < n; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        this->Solid[this->Cell(i, j, k)] = isSolid((i + 0.5) * h, (j + 0.5) * h, (k + 0.5) * h);
      }
    }
  }
  for (std::vector<double>& u : this->U)
  {
    u.assign(static_cast<std::size_t>(n + 1) * n * n, 0.0);
  }
}

std::size_t PlainSmoke::Cell(int i, int j, int k) const
{
  return i + static_cast<std::size_t>(this->N) * (j + static_cast<std::size_t>(this->N) * k);
}

std::size_t PlainSmoke::Face(int axis, int i, int j, int k) const
{
  const int nx = this->N + (axis == 0 ? 1 : 0);
  const int ny = this->N + (axis == 1 ? 1 : 0);
  return i + static_cast<std::size_t>(nx) * (j + static_cast<std::size_t>(ny) * k);
}

bool PlainSmoke::IsOpen(int axis, int i, int j, int k) const
{
  const int at = axis == 0 ? i : axis == 1 ? j : k;
  return at > 0 && at < this->N && !this->Solid[this->Cell(i, j, k)] &&
         !this->Solid[this->Cell(i - (axis == 0), j - (axis == 1), k - (axis == 2))];
}

// axis: of the faces that the values are on, -1 for cell centres.
double PlainSmoke::Sample(const std::vector<double>& values, int axis, double x, double y,
                          double z) const
{
  const double p[3] = { x / this->H, y / this->H, z / this->H };
  int base[3];
  double t[3];
  int count[3];
  for (int c = 0; c < 3; ++c)
  {
    count[c] = this->N + (axis == c ? 1 : 0);
    const double s = std::clamp(p[c] - (axis == c ? 0.0 : 0.5), 0.0, count[c] - 1.0);
    base[c] = std::min(static_cast<int>(s), count[c] - 2);
    t[c] = s - base[c];
  }
  double inZ[4];
  for (int dk = -1; dk <= 2; ++dk)
  {
    double inY[4];
    for (int dj = -1; dj <= 2; ++dj)
    {
      double inX[4];
      for (int di = -1; di <= 2; ++di)
      {
        const int i = std::clamp(base[0] + di, 0, count[0] - 1);
        const int j = std::clamp(base[1] + dj, 0, count[1] - 1);
        const int k = std::clamp(base[2] + dk, 0, count[2] - 1);
        inX[di + 1] = values[axis < 0 ? this->Cell(i, j, k) : this->Face(axis, i, j, k)];
      }
      inY[dj + 1] = Cubic(inX, t[0]);
    }
    inZ[dk + 1] = Cubic(inY, t[1]);
  }
  return Cubic(inZ, t[2]);
}

std::array<double, 3> PlainSmoke::VelocityAt(double x, double y, double z) const
{
  std::array<double, 3> v;
  const double p[3] = { x / this->H, y / this->H, z / this->H };
  for (int axis = 0; axis < 3; ++axis)
  {
    int base[3];
    double t[3];
    for (int c = 0; c < 3; ++c)
    {
      const int count = this->N + (axis == c ? 1 : 0);
      const double s = std::clamp(p[c] - (axis == c ? 0.0 : 0.5), 0.0, count - 1.0);
      base[c] = std::min(static_cast<int>(s), count - 2);
      t[c] = s - base[c];
    }
    v[axis] = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const int a = corner & 1, b = (corner >> 1) & 1, c = corner >> 2;
      v[axis] += (a ? t[0] : 1.0 - t[0]) * (b ? t[1] : 1.0 - t[1]) * (c ? t[2] : 1.0 - t[2]) *
                 this->U[axis][this->Face(axis, base[0] + a, base[1] + b, base[2] + c)];
    }
  }
  return v;
}

void PlainSmoke::Advect(double dt)
{
  std::array<std::vector<double>, 3> moved = this->U;
  std::vector<double> smoke = this->Smoke;
  for (int axis = -1; axis < 3; ++axis)
  {
    for (int k = 0; k < this->N + (axis == 2); ++k)
    {
      for (int j = 0; j < this->N + (axis == 1); ++j)
      {
        for (int i = 0; i < this->N + (axis == 0); ++i)
        {
          const double x = (i + (axis == 0 ? 0.0 : 0.5)) * this->H;
          const double y = (j + (axis == 1 ? 0.0 : 0.5)) * this->H;
          const double z = (k + (axis == 2 ? 0.0 : 0.5)) * this->H;
          const std::array<double, 3> v = this->VelocityAt(x, y, z);
          const std::array<double, 3> m =
            this->VelocityAt(x - 0.5 * dt * v[0], y - 0.5 * dt * v[1], z - 0.5 * dt * v[2]);
          const double value = this->Sample(axis < 0 ? this->Smoke : this->U[axis], axis,
                                            x - dt * m[0], y - dt * m[1], z - dt * m[2]);
          (axis < 0 ? smoke[this->Cell(i, j, k)] : moved[axis][this->Face(axis, i, j, k)]) = value;
        }
      }
    }
  }
  this->U = std::move(moved);
  this->Smoke = std::move(smoke);
}

void PlainSmoke::AddForces(double dt, double confinement, const Field& force)
{
  const int n = this->N;
  const std::size_t cells = this->Solid.size();
  std::array<std::vector<double>, 3> center, curl, total;
  std::vector<double> size(cells, 0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis].assign(cells, 0.0);
    curl[axis].assign(cells, 0.0);
    total[axis].assign(cells, 0.0);
  }
  const auto forCells = [n](const auto& body)
  {
    for (int k = 0; k < n; ++k)
    {
      for (int j = 0; j < n; ++j)
      {
        for (int i = 0; i < n; ++i)
        {
          body(i, j, k);
        }
      }
    }
  };
  const auto slope = [&](const std::vector<double>& f, int axis, int i, int j, int k)
  {
    int low[3] = { i, j, k };
    int high[3] = { i, j, k };
    low[axis] = std::max(low[axis] - 1, 0);
    high[axis] = std::min(high[axis] + 1, n - 1);
    return (f[this->Cell(high[0], high[1], high[2])] - f[this->Cell(low[0], low[1], low[2])]) /
           (2.0 * this->H);
  };
  forCells(
    [&](int i, int j, int k)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        center[axis][this->Cell(i, j, k)] =
          0.5 *
          (this->U[axis][this->Face(axis, i, j, k)] +
           this->U[axis][this->Face(axis, i + (axis == 0), j + (axis == 1), k + (axis == 2))]);
      }
    });
  forCells(
    [&](int i, int j, int k)
    {
      const std::size_t c = this->Cell(i, j, k);
      for (int axis = 0; axis < 3; ++axis)
      {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        curl[axis][c] = slope(center[v], u, i, j, k) - slope(center[u], v, i, j, k);
        size[c] += curl[axis][c] * curl[axis][c];
      }
      size[c] = std::sqrt(size[c]);
    });
  forCells(
    [&](int i, int j, int k)
    {
      const std::size_t c = this->Cell(i, j, k);
      double g[3];
      double length = 1e-12;
      for (int axis = 0; axis < 3; ++axis)
      {
        g[axis] = slope(size, axis, i, j, k);
        length += g[axis] * g[axis];
      }
      length = std::sqrt(length);
      const std::array<double, 3> f =
        force((i + 0.5) * this->H, (j + 0.5) * this->H, (k + 0.5) * this->H);
      for (int axis = 0; axis < 3; ++axis)
      {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        total[axis][c] =
          f[axis] + confinement * this->H * (g[u] * curl[v][c] - g[v] * curl[u][c]) / length;
      }
    });
  forCells(
    [&](int i, int j, int k)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        if (this->IsOpen(axis, i, j, k))
        {
          const std::size_t before = this->Cell(i - (axis == 0), j - (axis == 1), k - (axis == 2));
          this->U[axis][this->Face(axis, i, j, k)] +=
            0.5 * dt * (total[axis][this->Cell(i, j, k)] + total[axis][before]);
        }
      }
    });
}

int PlainSmoke::Project(double dt, double tolerance)
{
  const int n = this->N;
  const std::size_t cells = this->Solid.size();
  std::vector<double> x(cells, 0.0), r(cells, 0.0), s(cells, 0.0), q(cells, 0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int k = 0; k < n + (axis == 2); ++k)
    {
      for (int j = 0; j < n + (axis == 1); ++j)
      {
        for (int i = 0; i < n + (axis == 0); ++i)
        {
          if (!this->IsOpen(axis, i, j, k))
          {
            this->U[axis][this->Face(axis, i, j, k)] = 0.0;
            continue;
          }
          const double flux = this->U[axis][this->Face(axis, i, j, k)] / this->H;
          r[this->Cell(i, j, k)] += flux;
          r[this->Cell(i - (axis == 0), j - (axis == 1), k - (axis == 2))] -= flux;
        }
      }
    }
  }
  const auto apply = [&]
  {
    std::fill(q.begin(), q.end(), 0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int k = 0; k < n; ++k)
      {
        for (int j = 0; j < n; ++j)
        {
          for (int i = 0; i < n; ++i)
          {
            if (this->IsOpen(axis, i, j, k))
            {
              const std::size_t a = this->Cell(i, j, k);
              const std::size_t b = this->Cell(i - (axis == 0), j - (axis == 1), k - (axis == 2));
              const double flux = (s[a] - s[b]) / (this->H * this->H);
              q[a] += flux;
              q[b] -= flux;
            }
          }
        }
      }
    }
  };
  s = r;
  double rr = 0.0;
  double largest = 0.0;
  for (const double value : r)
  {
    rr += value * value;
    largest = std::max(largest, std::abs(value));
  }
  int iterations = 0;
  while (largest * dt > tolerance && iterations < 2000)
  {
    apply();
    double sq = 0.0;
    for (std::size_t c = 0; c < cells; ++c)
    {
      sq += s[c] * q[c];
    }
    const double alpha = rr / sq;
    double next = 0.0;
    largest = 0.0;
    for (std::size_t c = 0; c < cells; ++c)
    {
      x[c] += alpha * s[c];
      r[c] -= alpha * q[c];
      next += r[c] * r[c];
      largest = std::max(largest, std::abs(r[c]));
    }
    for (std::size_t c = 0; c < cells; ++c)
    {
      s[c] = r[c] + next / rr * s[c];
    }
    rr = next;
    ++iterations;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int k = 0; k < n; ++k)
    {
      for (int j = 0; j < n; ++j)
      {
        for (int i = 0; i < n; ++i)
        {
          if (this->IsOpen(axis, i, j, k))
          {
            // r = -div u: x is minus the potential of the usual sign.
            this->U[axis][this->Face(axis, i, j, k)] +=
              (x[this->Cell(i - (axis == 0), j - (axis == 1), k - (axis == 2))] -
               x[this->Cell(i, j, k)]) /
              this->H;
          }
        }
      }
    }
  }
  return iterations;
}

PlainSmoke::Seconds PlainSmoke::Step(double dt, double confinement, double tolerance,
                                     const Field& force)
{
  Seconds seconds;
  double start = Now();
  this->Advect(dt);
  seconds.Advection = Now() - start;
  start = Now();
  this->AddForces(dt, confinement, force);
  seconds.Forces = Now() - start;
  start = Now();
  seconds.Iterations = this->Project(dt, tolerance);
  seconds.Pressure = Now() - start;
  return seconds;
}

double PlainSmoke::KineticEnergy() const
{
  double sum = 0.0;
  for (const std::vector<double>& u : this->U)
  {
    for (const double value : u)
    {
      sum += value * value;
    }
  }
  return 0.5 * sum * this->H * this->H * this->H;
}
