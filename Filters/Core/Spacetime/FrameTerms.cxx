// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/FrameTerms.h"

#include "Particles/SphSurfaces.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr float SpringStiffness = 0.3f;  // [1 / (dx frame^2)]: keeps gas off the walls
constexpr float FarAway = -1e4f;         // where the particle without mass lies [dx]
constexpr double LeastTimeFactor = 1e-3; // a vortex weaker than this share of itself is left out

} // namespace

FrameTerms::FrameTerms(const SpacetimeModel& model, const SphFluid& fluid,
                       const SphKernelTable& kernels) :
  Model(model),
  Fluid(fluid), Kernels(kernels), Constants(fluid.Constants()), BodyStride(model.Stride())
{
  const std::size_t n = model.NumberOfParticles();
  this->ParticleStride = (n + 15) / 16 * 16;
  const std::size_t p = this->ParticleStride;
  const std::size_t b = this->BodyStride;
  this->X.assign(3 * p, 0.0f);
  this->Records.resize(n + 1);
  this->Records[n] = { FarAway, FarAway, FarAway, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f };
  this->Adjoints.assign(n + 1, SphAdjointRecord{});
  for (auto* v : { &this->Density, &this->PressureSlope, &this->Psi, &this->Bar })
  {
    v->assign(p, 0.0f);
  }
  this->Bar.resize(p + 1); // the far one's entry included
  this->Density.resize(p + 1);
  this->PairStarts.resize(n + 1);
  this->PairSums.resize(n + 1);
  this->PsiGradient.assign(3 * p, 0.0f);
  this->PsiHessian.assign(6 * p, 0.0f);
  this->ParticleRates.assign(6 * p, 0.0f);
  this->ParticleBars.assign(6 * p, 0.0f);
  this->SpringForce.assign(3 * p, 0.0f);
  this->SpringSlope.assign(6 * p, 0.0f);
  this->Force.assign(3 * b, 0.0f);
  this->Jacobian.assign(9 * b, 0.0f);
  this->Rates.assign(6 * b, 0.0f);
  this->Bars.assign(6 * b, 0.0f);
  this->Cushions.resize(model.NumberOfObjects);
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

// Records and X, by place.
void FrameTerms::PlaceParticles(const float* state)
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
  SurfaceShare share;
  share.Value = this->Psi[i];
  for (int k = 0; k < 6; ++k)
  {
    share.Hessian(First[k], Second[k]) = share.Hessian(Second[k], First[k]) =
      this->PsiHessian[k * p + i];
  }
  for (int a = 0; a < 3; ++a)
  {
    share.Gradient[a] = this->PsiGradient[a * p + i];
  }
  share.Add(this->Fluid, d, normal, curvature);
  this->Psi[i] = static_cast<float>(share.Value);
  for (int k = 0; k < 6; ++k)
  {
    this->PsiHessian[k * p + i] = static_cast<float>(share.Hessian(First[k], Second[k]));
  }
  for (int a = 0; a < 3; ++a)
  {
    this->PsiGradient[a * p + i] = static_cast<float>(share.Gradient[a]);
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

void FrameTerms::AddWalls(int frame)
{
  SphBox box;
  for (int a = 0; a < 3; ++a)
  {
    box.Min[a] = 0.0f;
    box.Max[a] = static_cast<float>(this->Model.Size[a]);
  }
  const std::size_t p = this->ParticleStride;
  this->Kernels.Walls(this->Constants, box, p, this->X.data(), this->X.data() + p,
                      this->X.data() + 2 * p, this->Psi.data(),
                      this->ParticleRows(this->PsiGradient), this->ParticleRows(this->PsiHessian));
  std::fill(this->SpringSlope.begin(), this->SpringSlope.end(), 0.0f);
  constexpr int Diagonal[3] = { 0, 3, 5 };
  constexpr auto reach = static_cast<float>(SpringReach);
  for (int a = 0; a < 3; ++a)
  {
    const float* x = this->X.data() + a * p;
    float* force = this->SpringForce.data() + a * p;
    float* slope = this->SpringSlope.data() + Diagonal[a] * p;
    for (std::size_t i = 0; i < this->Model.NumberOfGas; ++i)
    {
      const float low = std::max(0.0f, reach - x[i]);
      const float high = std::max(0.0f, reach - (box.Max[a] - x[i]));
      force[i] = SpringStiffness * (low * low - high * high);
      slope[i] = -2.0f * SpringStiffness * (low + high);
    }
  }
  if (!this->Model.Obstacles.IsEmpty())
  {
    const std::size_t n = this->Model.NumberOfParticles();
    for (std::size_t i = 0; i < n; ++i)
    {
      this->AddObstacle(i, frame);
    }
  }
  if (!this->Model.Rest.IsEmpty())
  {
    this->Kernels.Rest(this->Model.Rest.View(), p, this->X.data(), this->X.data() + p,
                       this->X.data() + 2 * p, this->Psi.data(),
                       this->ParticleRows(this->PsiGradient), this->ParticleRows(this->PsiHessian));
  }
}

void FrameTerms::AddFields(const float* state, int frame)
{
  const std::size_t s = this->BodyStride;
  std::fill(this->Force.begin(), this->Force.end(), 0.0f);
  std::fill(this->Jacobian.begin(), this->Jacobian.end(), 0.0f);
  this->Active.clear();
  for (const Vortex& vortex : this->Model.Vortices)
  {
    const double factor = vortex.TimeFactor(frame);
    if (factor < LeastTimeFactor)
    {
      continue;
    }
    SphVortex v;
    for (int a = 0; a < 3; ++a)
    {
      v.P1[a] = static_cast<float>(vortex.P1[a]);
      v.P2[a] = static_cast<float>(vortex.P2[a]);
    }
    v.Strength = static_cast<float>(vortex.Strength * factor / (4.0 * M_PI));
    v.Core = static_cast<float>(vortex.CoreRadius * vortex.CoreRadius *
                                (vortex.P2 - vortex.P1).squaredNorm());
    this->Active.push_back(v);
  }
  const SphRows force{ this->Force.data(), s };
  const SphRows jacobian{ this->Jacobian.data(), s };
  this->Kernels.Vortices(this->Active.data(), this->Active.size(), s, state, state + s,
                         state + 2 * s, force, jacobian);
  this->VortexForce = this->Force;
  const std::size_t n = this->Model.NumberOfBodies();
  if (!this->Model.Wind.IsEmpty())
  {
    this->Model.Wind.At(frame, this->WindCoefficients);
    this->Kernels.Spline(this->Model.Wind.Field(this->WindCoefficients), 1.0f, n, state, state + s,
                         state + 2 * s, force, jacobian);
  }
  this->BackgroundDrag = 0.0f;
  const SplineWind& background = this->Model.Background;
  if (!background.IsEmpty())
  {
    background.At(frame, this->BackgroundCoefficients);
    this->BackgroundDrag = static_cast<float>(background.Drag);
    const float factor = background.Drag > 0.0 ? this->BackgroundDrag : 1.0f;
    this->Kernels.Spline(background.Field(this->BackgroundCoefficients), factor, n, state,
                         state + s, state + 2 * s, force, jacobian);
    for (std::size_t k = 0; k<3 * s&& this->BackgroundDrag> 0.0f; ++k)
    {
      this->Force[k] -= this->BackgroundDrag * state[3 * s + k];
    }
  }
}

void FrameTerms::AddCushions(const float* state, int frame, double step)
{
  const std::size_t s = this->BodyStride;
  for (std::size_t o = 0; o < this->Model.NumberOfObjects; ++o)
  {
    const std::size_t i = this->Model.NumberOfGas + o;
    const auto row = [&](int c) { return static_cast<double>(state[c * s + i]); };
    this->Cushions[o] = LandingCushion(this->Model, frame, step, o, Vec3(row(0), row(1), row(2)),
                                       Vec3(row(3), row(4), row(5)));
    for (int c = 0; c < 3; ++c)
    {
      this->Acceleration(c)[i] += static_cast<float>(this->Cushions[o].Acceleration[c]);
    }
  }
}

// For the pairs of a list with so many entries.
void FrameTerms::MakeRoom(std::size_t entries)
{
  const std::size_t room = entries + 16;
  if (this->PairOther.size() < room)
  {
    this->PairOther.resize(room + room / 8);
    this->PairGeometry.resize(4 * this->PairOther.size());
  }
  const std::size_t row = this->PairOther.size();
  float* geometry = this->PairGeometry.data();
  this->Pairs = { this->PairStarts.data(), geometry,           geometry + row,
                  geometry + 2 * row,      geometry + 3 * row, this->PairOther.data() };
}

void FrameTerms::Forward(const float* state, int frame, double step, NeighborList& list)
{
  const std::size_t ng = this->Model.NumberOfGas;
  const std::size_t n = this->Model.NumberOfParticles();
  const std::size_t p = this->ParticleStride;
  this->FillPositions(state);
  const float* x = this->X.data();
  list.Update(this->Kernels, n, ng, x, x + p, x + 2 * p, static_cast<float>(this->Fluid.Support()),
              this->Scratch);
  this->Order = list.Order().data();
  this->PlaceParticles(state);
  const SphNeighbors neighbors = list.View();
  this->AddWalls(frame);
  this->MakeRoom(list.NumberOfEntries());
  this->Kernels.Density(this->Constants, this->Records.data(), neighbors, n, this->Pairs,
                        this->Density.data());
  const float self = static_cast<float>(this->Fluid.GasMass * this->Fluid.Kernel(0.0));
  for (std::size_t i = 0; i < n; ++i)
  {
    this->Density[i] += this->Psi[i] + (i < ng ? self : 0.0f);
    this->Records[i].Pressure = static_cast<float>(this->Fluid.Pressure(this->Density[i]));
    this->PressureSlope[i] = static_cast<float>(this->Fluid.PressureSlope(this->Density[i]));
  }
  this->Kernels.Accelerate(this->Constants, this->Records.data(), this->Pairs, n,
                           &this->PairSums.data()->AX, { this->ParticleRates.data(), p },
                           { this->ParticleRates.data() + 3 * p, p });
  this->AddFields(state, frame);

  const std::size_t per = this->Model.Offsets.size();
  const float share = 1.0f / static_cast<float>(per);
  for (int c = 0; c < 3; ++c)
  {
    float* a = this->ParticleRates.data() + c * p;
    const float* d = this->ParticleRates.data() + (3 + c) * p;
    const float* gradient = this->PsiGradient.data() + c * p;
    const float* spring = this->SpringForce.data() + c * p;
    const float* external = this->External(c);
    for (std::size_t i = 0; i < n; ++i)
    {
      a[i] -= 2.0f * this->Records[i].Pressure * gradient[i];
    }
    float* bodyA = this->Acceleration(c);
    float* bodyD = this->Average(c);
    for (std::size_t k = 0; k < ng; ++k)
    {
      const std::size_t i = this->Order[k];
      bodyA[i] = a[k] + spring[k] + external[i];
      bodyD[i] = d[k];
    }
    for (std::size_t o = 0; o < this->Model.NumberOfObjects; ++o)
    {
      float sumA = 0.0f, sumD = 0.0f;
      for (std::size_t k = ng + o * per; k < ng + (o + 1) * per; ++k)
      {
        sumA += a[k];
        sumD += d[k];
      }
      bodyD[ng + o] = share * sumD;
      // Drag towards the air about the object: D is the mean velocity of the air relative to it.
      const float fall = c == 2 ? this->Model.Gravities[o] : 0.0f;
      bodyA[ng + o] =
        share * sumA + external[ng + o] - fall + this->Model.DragRates[o] * bodyD[ng + o];
    }
  }
  this->AddCushions(state, frame, step);
}

} // namespace waft
