// SPDX-License-Identifier: BSD-3-Clause
// One step of smoke in a closed box as a textbook writes it: the reference of the benchmark.
#pragma once

#include <array>
#include <functional>
#include <vector>

/// n^3 voxels of side h in a closed box, solids by whole voxels, doubles, one loop a formula:
/// limited cubic advection with midpoint backtrace, vorticity confinement, conjugate gradients
/// without a preconditioner.
class PlainSmoke
{
public:
  PlainSmoke(int n, double h, const std::function<bool(double, double, double)>& isSolid);

  struct Seconds
  {
    double Advection = 0.0;
    double Forces = 0.0;
    double Pressure = 0.0;
    int Iterations = 0;
  };
  /// force: acceleration at a point [m/s^2]; points from the box's corner [m].
  using Field = std::function<std::array<double, 3>(double, double, double)>;
  Seconds Step(double dt, double confinement, double tolerance, const Field& force);
  double KineticEnergy() const;

private:
  std::size_t Cell(int i, int j, int k) const;
  std::size_t Face(int axis, int i, int j, int k) const;
  bool IsOpen(int axis, int i, int j, int k) const;
  double Sample(const std::vector<double>& values, int axis, double x, double y, double z) const;
  std::array<double, 3> VelocityAt(double x, double y, double z) const;
  void Advect(double dt);
  void AddForces(double dt, double confinement, const Field& force);
  int Project(double dt, double tolerance);

  int N;
  double H;
  std::vector<char> Solid;
  std::array<std::vector<double>, 3> U;
  std::vector<double> Smoke;
};
