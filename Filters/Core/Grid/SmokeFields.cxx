// SPDX-License-Identifier: BSD-3-Clause
// Reading the air: the fields of a frame, figures about the flow, a given flow as a start.
#include "Grid/SmokeInternals.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

template <typename Body>
void ForSamples(const StaggeredLayout& layout, int faceAxis, const Body& body)
{
  for (int k = 0; k < layout.Count(2, faceAxis); ++k)
  {
    for (int j = 0; j < layout.Count(1, faceAxis); ++j)
    {
      for (int i = 0; i < layout.Count(0, faceAxis); ++i)
      {
        body(i, j, k, layout.Index(i, j, k));
      }
    }
  }
}

void Interleave(const StaggeredLayout& layout, const std::array<FloatArray, 3>& from,
                std::vector<std::array<float, 3>>& to)
{
  to.resize(static_cast<std::size_t>(layout.N[0]) * layout.N[1] * layout.N[2]);
  std::size_t q = 0;
  ForSamples(layout, -1,
             [&](int, int, int, std::ptrdiff_t p) {
               to[q++] = { from[0][p], from[1][p], from[2][p] };
             });
}

} // namespace

void SmokeSolver::ReadVelocity(SmokeFrame& frame) const
{
  const Internals& s = *this->Impl;
  const StaggeredLayout& layout = s.Layout;
  frame.Frame = s.Frame;
  frame.Time = s.Time;
  frame.Dimensions = layout.N;
  frame.Spacing = s.Options.Spacing();
  frame.Origin = s.Options.Bounds.Min + 0.5 * frame.Spacing;
  std::array<FloatArray, 3> field;
  for (FloatArray& component : field)
  {
    component.resize(layout.Size());
  }
  s.ComputeCenters(SerialFor(), field);
  const std::vector<unsigned char>& solid = s.Solids.CenterIsSolid();
  ForSamples(layout, -1,
             [&](int, int, int, std::ptrdiff_t p)
             {
               for (int axis = 0; solid[p] && axis < 3; ++axis)
               {
                 field[axis][p] = 0.0f;
               }
             });
  Interleave(layout, field, frame.Velocity);
}

void SmokeSolver::Read(SmokeFrame& frame) const
{
  this->ReadVelocity(frame);
  const Internals& s = *this->Impl;
  const StaggeredLayout& layout = s.Layout;
  const ParallelFor serial = SerialFor();

  std::array<FloatArray, 3> field;
  std::array<FloatArray, 3> vorticity;
  FloatArray size(layout.Size());
  for (int axis = 0; axis < 3; ++axis)
  {
    field[axis].assign(layout.Size(), 0.0f);
    vorticity[axis].assign(layout.Size(), 0.0f);
  }
  s.ComputeCenters(serial, field);
  for (FloatArray& component : field)
  {
    FillGhosts(layout, s.DerivedEnds, -1, component.data());
  }
  s.ComputeVorticity(serial, field, vorticity, size);
  const std::vector<unsigned char>& solid = s.Solids.CenterIsSolid();
  std::array<FloatArray, 3> center = field;
  ForSamples(layout, -1,
             [&](int, int, int, std::ptrdiff_t p)
             {
               for (int axis = 0; solid[p] && axis < 3; ++axis)
               {
                 vorticity[axis][p] = 0.0f;
               }
             });
  Interleave(layout, vorticity, frame.Vorticity);

  const auto clear = [&]
  {
    for (FloatArray& component : field)
    {
      std::fill(component.begin(), component.end(), 0.0f);
    }
  };
  clear();
  s.AddVortices(s.Time, serial, Pointers(field));
  Interleave(layout, field, frame.VortexForce);
  clear();
  s.AddWinds(s.Time, 0.0, serial, ConstPointers(center), Pointers(field));
  Interleave(layout, field, frame.WindForce);

  const std::size_t cells = s.Options.NumberOfCells();
  frame.Density.resize(cells);
  frame.Pressure.resize(cells);
  frame.Obstacle.resize(cells);
  const PaddedCells padded(layout.N);
  const float scale =
    s.PotentialStep > 0.0 ? static_cast<float>(s.Options.AirDensity / s.PotentialStep) : 0.0f;
  std::size_t q = 0;
  ForSamples(layout, -1,
             [&](int i, int j, int k, std::ptrdiff_t p)
             {
               frame.Obstacle[q] = solid[p];
               frame.Density[q] = solid[p] ? 0.0f : s.Density[p];
               frame.Pressure[q] = solid[p] ? 0.0f : scale * s.Potential[padded.Index(i, j, k)];
               ++q;
             });
}

Vec3 SmokeSolver::Internals::FaceAt(int axis, int i, int j, int k) const
{
  Vec3 at(i + 0.5, j + 0.5, k + 0.5);
  at[axis] -= 0.5;
  return this->Options.Bounds.Min + at.cwiseProduct(this->Options.Spacing());
}

void SmokeSolver::Internals::ProjectAlone()
{
  const FloatArray pressure = this->Potential;
  const double step = this->PotentialStep;
  this->PotentialStep = 0.0;
  std::fill(this->Potential.begin(), this->Potential.end(), 0.0f);
  this->Project(1.0 / this->Options.FramesPerSecond, SerialFor(), [] { return true; });
  this->Potential = pressure;
  this->PotentialStep = step;
  this->FinishVelocity();
}

Result SmokeSolver::SetVelocity(const std::function<Vec3(const Vec3&)>& velocity, bool project)
{
  Internals& s = *this->Impl;
  if (s.Velocity[0].empty())
  {
    return Result::Error("The solver has not begun");
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    ForSamples(s.Layout, axis,
               [&](int i, int j, int k, std::ptrdiff_t p)
               {
                 s.Velocity[axis][p] =
                   s.Solids.Fractions(axis)[p] > 0.0f
                     ? static_cast<float>(velocity(s.FaceAt(axis, i, j, k))[axis])
                     : s.Solids.ClosedVelocity(axis, p);
               });
  }
  s.Frame = 0;
  s.Time = 0.0;
  if (project)
  {
    std::fill(s.Potential.begin(), s.Potential.end(), 0.0f);
    s.ProjectAlone();
  }
  s.FinishVelocity();
  return Result::Ok();
}

void SmokeSolver::SetDensity(const std::function<double(const Vec3&)>& density)
{
  Internals& s = *this->Impl;
  const Vec3 spacing = s.Options.Spacing();
  s.HasSmoke = true;
  ForSamples(s.Layout, -1,
             [&](int i, int j, int k, std::ptrdiff_t p)
             {
               const Vec3 x =
                 s.Options.Bounds.Min + Vec3(i + 0.5, j + 0.5, k + 0.5).cwiseProduct(spacing);
               s.Density[p] = static_cast<float>(density(x));
             });
  s.FinishScalar(s.Density);
}

double SmokeSolver::KineticEnergy() const
{
  return this->Impl->Energy(this->Impl->Velocity, SerialFor());
}

double SmokeSolver::Enstrophy() const
{
  SmokeFrame frame;
  this->Read(frame);
  double sum = 0.0;
  for (const std::array<float, 3>& w : frame.Vorticity)
  {
    sum += static_cast<double>(w[0]) * w[0] + static_cast<double>(w[1]) * w[1] +
           static_cast<double>(w[2]) * w[2];
  }
  return 0.5 * sum * this->Impl->Options.Spacing().prod();
}

double SmokeSolver::MaximumDivergence() const
{
  const Internals& s = *this->Impl;
  const Vec3 spacing = s.Options.Spacing();
  double largest = 0.0;
  ForSamples(s.Layout, -1,
             [&](int, int, int, std::ptrdiff_t p)
             {
               double sum =
                 s.Solids.SolidDivergence().empty() ? 0.0 : s.Solids.SolidDivergence()[p];
               for (int axis = 0; axis < 3; ++axis)
               {
                 const std::ptrdiff_t q = p + s.Layout.Stride(axis);
                 const std::vector<float>& open = s.Solids.Fractions(axis);
                 sum += (static_cast<double>(open[q]) * s.Velocity[axis][q] -
                         static_cast<double>(open[p]) * s.Velocity[axis][p]) /
                        spacing[axis];
               }
               largest = std::max(largest, std::abs(sum));
             });
  return largest;
}

std::vector<float> SmokeSolver::FaceVelocities(int axis) const
{
  const Internals& s = *this->Impl;
  std::vector<float> values;
  ForSamples(s.Layout, axis,
             [&](int, int, int, std::ptrdiff_t p)
             {
               values.push_back(s.Solids.Fractions(axis)[p] > 0.0f
                                  ? s.Velocity[axis][p]
                                  : s.Solids.ClosedVelocity(axis, p));
             });
  return values;
}

std::vector<float> SmokeSolver::FaceFractions(int axis) const
{
  const Internals& s = *this->Impl;
  std::vector<float> values;
  ForSamples(s.Layout, axis,
             [&](int, int, int, std::ptrdiff_t p)
             { values.push_back(s.Solids.Fractions(axis)[p]); });
  return values;
}

} // namespace waft
