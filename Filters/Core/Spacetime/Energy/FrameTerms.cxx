// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Energy/FrameTerms.h"

#include "Base/LargePages.h"
#include "Particles/SphSurfaces.h"
#include "Spacetime/Energy/WallCorrection.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr float SpringStiffness = 0.3f; // [1 / (dx frame^2)]: keeps gas off the walls
constexpr float FarAway = -1e4f;        // where the particles without mass lie [dx]

// max(0, x), exactly, without a branch: loops over it become vector ones.
inline float PositivePart(float x)
{
  return 0.5f * (x + std::abs(x));
}

} // namespace

FrameTerms::FrameTerms(const SpacetimeModel& model, const AirFields& fields, const SphFluid& fluid,
                       const SphKernelTable& kernels) :
  Model(model),
  Fields(fields), Fluid(fluid), Kernels(kernels), Constants(fluid.Constants()),
  BodyStride(model.Stride())
{
  const std::size_t n = model.NumberOfParticles();
  this->ParticleStride = (n + 15) / 16 * 16;
  const std::size_t p = this->ParticleStride;
  const std::size_t b = this->BodyStride;
  this->X.assign(3 * p, 0.0f);
  const std::size_t all = n + SphFarRecords;
  this->Records.assign(all, { FarAway, FarAway, FarAway, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f });
  this->Adjoints.assign(all, SphAdjointRecord{});
  for (auto* v : { &this->Density, &this->PressureSlope, &this->Psi, &this->Bar })
  {
    v->assign(std::max(p, all), 0.0f);
  }
  this->PairStarts.resize(n + 1);
  this->Nearest.resize(n);
  this->PairSums.resize(all);
  this->Raise.resize(n - model.NumberOfGas);
  this->RaiseSlope.resize(n - model.NumberOfGas);
  this->PsiGradient.assign(3 * p, 0.0f);
  this->PsiHessian.assign(6 * p, 0.0f);
  this->SpringForce.assign(3 * p, 0.0f);
  this->SpringSlope.assign(6 * p, 0.0f);
  this->Force.assign(3 * b, 0.0f);
  this->Jacobian.assign(9 * b, 0.0f);
  this->VortexForce.assign(3 * b, 0.0f);
  this->Rates.assign(6 * b, 0.0f);
  this->Bars.assign(6 * b, 0.0f);
  this->Damping.resize(model.NumberOfObjects);
}

std::vector<FrameTerms::AirAt> FrameTerms::Air() const
{
  std::vector<AirAt> air(this->Model.NumberOfParticles());
  for (std::size_t k = 0; k < air.size(); ++k)
  {
    const double density = this->Density[k];
    air[this->Order[k]] = { density, this->Records[k].Pressure * density * density, this->Psi[k] };
  }
  return air;
}

// X, by number.
void FrameTerms::FillPositions(const float* state)
{
  const std::size_t ng = this->Model.NumberOfGas;
  const std::size_t per = this->Model.Offsets.size();
  for (int c = 0; c < 3; ++c)
  {
    const float* from = state + c * this->BodyStride;
    float* row = this->X.data() + c * this->ParticleStride;
    std::copy(from, from + ng, row);
    for (std::size_t o = 0; o < this->Model.NumberOfObjects; ++o)
    {
      for (std::size_t k = 0; k < per; ++k)
      {
        row[ng + o * per + k] = from[ng + o] + this->Model.Offsets[k][c];
      }
    }
  }
}

// Records and X, in the order of the neighbour list.
void FrameTerms::PositionParticles(const float* state)
{
  const std::size_t ng = this->Model.NumberOfGas;
  const std::size_t n = this->Model.NumberOfParticles();
  const std::size_t per = this->Model.Offsets.size();
  const float gasMass = static_cast<float>(this->Fluid.GasMass);
  const float objectMass = static_cast<float>(this->Fluid.ObjectMass);
  const std::size_t s = this->BodyStride;
  const std::size_t p = this->ParticleStride;
  float* x = this->X.data();
  for (std::size_t k = 0; k < n; ++k)
  {
    const std::size_t i = this->Order[k];
    const float* v = state + 3 * s + (i < ng ? i : ng + (i - ng) / per);
    this->Records[k] = { x[i], x[p + i], x[2 * p + i], i < ng ? gasMass : objectMass,
                         v[0], v[s],     v[2 * s],     0.0f };
  }
  for (std::size_t k = 0; k < n; ++k)
  {
    x[k] = this->Records[k].X;
    x[p + k] = this->Records[k].Y;
    x[2 * p + k] = this->Records[k].Z;
  }
}

// One more surface beside the walls: 1 - Psi is multiplied by 1 - psi(d).
void FrameTerms::AddObstacle(std::size_t i, int frame)
{
  const SphRecord& record = this->Records[i];
  Vec3 normal;
  Mat3 curvature;
  const double d =
    this->Model.Obstacles.Evaluate(Vec3(record.X, record.Y, record.Z), frame, normal, curvature);
  if (d >= this->Fluid.Support())
  {
    return;
  }
  constexpr int First[6] = { 0, 0, 0, 1, 1, 2 };
  constexpr int Second[6] = { 0, 1, 2, 1, 2, 2 };
  const std::size_t p = this->ParticleStride;
  SurfaceDensityPart surfaces;
  surfaces.Value = this->Psi[i];
  for (int k = 0; k < 6; ++k)
  {
    surfaces.Hessian(First[k], Second[k]) = surfaces.Hessian(Second[k], First[k]) =
      this->PsiHessian[k * p + i];
  }
  for (int a = 0; a < 3; ++a)
  {
    surfaces.Gradient[a] = this->PsiGradient[a * p + i];
  }
  surfaces.Add(this->Fluid, d, normal, curvature);
  this->Psi[i] = static_cast<float>(surfaces.Value);
  for (int k = 0; k < 6; ++k)
  {
    this->PsiHessian[k * p + i] = static_cast<float>(surfaces.Hessian(First[k], Second[k]));
  }
  for (int a = 0; a < 3; ++a)
  {
    this->PsiGradient[a * p + i] = static_cast<float>(surfaces.Gradient[a]);
  }
  if (i < this->Model.NumberOfGas && d < SpringReach)
  {
    const double depth = SpringReach - d;
    for (int a = 0; a < 3; ++a)
    {
      this->SpringForce[a * p + i] +=
        static_cast<float>(SpringStiffness * depth * depth * normal[a]);
    }
    for (int k = 0; k < 6; ++k)
    {
      this->SpringSlope[k * p + i] +=
        static_cast<float>(SpringStiffness * (depth * depth * curvature(First[k], Second[k]) -
                                              2.0 * depth * normal[First[k]] * normal[Second[k]]));
    }
  }
}

void FrameTerms::AddSprings(std::size_t begin, std::size_t end, const SphBox& box)
{
  const std::size_t p = this->ParticleStride;
  constexpr int OffDiagonal[3] = { 1, 2, 4 };
  constexpr int Diagonal[3] = { 0, 3, 5 };
  constexpr auto reach = static_cast<float>(SpringReach);
  for (int a = 0; a < 3; ++a)
  {
    const float size = box.Max[a];
    const float* x = this->X.data() + a * p;
    float* force = this->SpringForce.data() + a * p;
    float* slope = this->SpringSlope.data() + Diagonal[a] * p;
    float* none = this->SpringSlope.data() + OffDiagonal[a] * p;
#pragma GCC ivdep
    for (std::size_t i = begin; i < end; ++i)
    {
      const float low = PositivePart(reach - x[i]);
      const float high = PositivePart(reach - (size - x[i]));
      force[i] = SpringStiffness * (low * low - high * high);
      slope[i] = -2.0f * SpringStiffness * (low + high);
      none[i] = 0.0f;
    }
  }
}

void FrameTerms::AddWalls(int frame)
{
  SphBox box;
  for (int a = 0; a < 3; ++a)
  {
    box.Min[a] = 0.0f;
    box.Max[a] = static_cast<float>(this->Model.Size[a]);
  }
  const std::size_t p = this->ParticleStride;
  const std::size_t n = this->Model.NumberOfParticles();
  for (std::size_t begin = 0; begin < p; begin += Block)
  {
    const std::size_t end = std::min(p, begin + Block);
    const float* x = this->X.data() + begin;
    float* psi = this->Psi.data() + begin;
    const SphRows gradient = this->ParticleRows(this->PsiGradient, begin);
    const SphRows hessian = this->ParticleRows(this->PsiHessian, begin);
    this->Kernels.Walls(this->Constants, box, end - begin, x, x + p, x + 2 * p, psi, gradient,
                        hessian);
    this->AddSprings(begin, std::min(end, this->Model.NumberOfGas), box);
    for (std::size_t i = begin; i < std::min(end, n) && !this->Model.Obstacles.IsEmpty(); ++i)
    {
      this->AddObstacle(i, frame);
    }
    if (!this->Model.Rest.IsEmpty())
    {
      this->Kernels.Rest(this->Model.Rest.View(), end - begin, x, x + p, x + 2 * p, psi, gradient,
                         hessian);
    }
  }
}

// For the pairs of a list with so many entries.
void FrameTerms::MakeRoom(std::size_t entries)
{
  const std::size_t groups = entries / 8 + 1;
  if (this->PairGroups.size() < groups)
  {
    AssignInLargePages(this->PairGroups, groups + groups / 8);
  }
  this->Pairs = { this->PairStarts.data(), this->PairGroups.data(), this->Nearest.data() };
}

// Without gas beside it the air deviates nowhere, and an object's D is its own deviation less.
void FrameTerms::ForwardAlone(const float* state)
{
  const std::size_t s = this->BodyStride;
  for (std::size_t i = 0; i < 3 * s; ++i)
  {
    this->Rates[i] = this->Rates[3 * s + i] = -state[3 * s + i];
  }
}

void FrameTerms::Forward(const float* state, int frame, double step, NeighbourList& list)
{
  if (this->IsAlone())
  {
    this->ForwardAlone(state);
    return;
  }
  const std::size_t ng = this->Model.NumberOfGas;
  const std::size_t n = this->Model.NumberOfParticles();
  const std::size_t p = this->ParticleStride;
  this->FillPositions(state);
  const float* x = this->X.data();
  list.Update(this->Kernels, n, ng, x, x + p, x + 2 * p, static_cast<float>(this->Fluid.Support()),
              this->Scratch);
  this->Order = list.Order().data();
  this->PositionParticles(state);
  const SphNeighbours neighbours = list.View();
  this->AddWalls(frame);
  this->MakeRoom(list.NumberOfEntries());
  this->Kernels.Density(this->Constants, this->Records.data(), neighbours, n, this->Pairs,
                        this->Density.data());
  const float self = static_cast<float>(this->Fluid.GasMass * this->Fluid.Kernel(0.0));
  const float* gradient = this->PsiGradient.data();
  const float* spring = this->SpringForce.data();
  for (std::size_t k = 0; k < n; ++k)
  {
    this->Density[k] += this->Psi[k] + (k < ng ? self : 0.0f);
    const auto pressure = static_cast<float>(this->Fluid.Pressure(this->Density[k]));
    this->Records[k].Pressure = pressure;
    this->PressureSlope[k] = static_cast<float>(this->Fluid.PressureSlope(this->Density[k]));
    SphPairSum& sum = this->PairSums[k];
    sum = SphPairSum();
    for (int c = 0; c < 3; ++c)
    {
      sum.First[c] = spring[c * p + k] - 2.0f * pressure * gradient[c * p + k];
    }
  }
  for (std::size_t k = ng; k < n; ++k)
  {
    const WallCorrection air(this->Psi[k]);
    this->Raise[k - ng] = static_cast<float>(air.Raise);
    this->RaiseSlope[k - ng] = static_cast<float>(air.Slope);
  }
  this->Kernels.Accelerate(this->Constants, this->Records.data(), this->Pairs, n,
                           this->PairSums.data());
  this->AddFields(state, frame);
  this->GatherRates(state);
  this->AddLandingDamping(state, frame, step);
}

// From the order of the neighbour list to bodies.
void FrameTerms::GatherRates(const float* state)
{
  const bool inAir = !this->Model.Air.IsEmpty();
  const std::size_t ng = this->Model.NumberOfGas;
  const std::size_t s = this->BodyStride;
  float* rates = this->Rates.data();
  const float* external = this->Force.data();
  for (std::size_t k = 0; k < ng; ++k)
  {
    const std::size_t i = this->Order[k];
    const SphPairSum& sum = this->PairSums[k];
    for (int c = 0; c < 3; ++c)
    {
      rates[c * s + i] = sum.First[c] + (inAir ? -this->Model.AirDrag * state[(3 + c) * s + i]
                                               : external[c * s + i]);
      rates[(3 + c) * s + i] = sum.Second[c];
    }
  }
  const std::size_t per = this->Model.Offsets.size();
  const float fraction = 1.0f / static_cast<float>(per);
  for (std::size_t o = 0; o < this->Model.NumberOfObjects; ++o)
  {
    const SphPairSum* sums = this->PairSums.data() + ng + o * per;
    for (int c = 0; c < 3; ++c)
    {
      float sumA = 0.0f, sumD = 0.0f;
      for (std::size_t k = 0; k < per; ++k)
      {
        sumA += sums[k].First[c];
        sumD += this->Raise[o * per + k] * sums[k].Second[c];
      }
      const std::size_t i = c * s + ng + o;
      const float average = fraction * sumD;
      // Drag towards the air about the object: D is the mean velocity of the air relative to it.
      const float fall = c == 2 ? this->Model.Gravities[o] : 0.0f;
      const float pushed = inAir ? 0.0f : fraction * sumA + external[i];
      rates[i] = pushed - fall + this->Model.DragRates[o] * average;
      rates[3 * s + i] = average;
    }
  }
}

} // namespace waft
