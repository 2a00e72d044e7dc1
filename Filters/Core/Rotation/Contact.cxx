// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Contact.h"

#include "Base/SmoothStep.h"
#include "Rotation/RigidBody.h"
#include "Rotation/Surroundings.h"

#include <cmath>

namespace waft
{
namespace
{
constexpr double Flip = 0.6;       // rad, in a frame
constexpr double Rounding = 1e-10; // m: a vertex this far below a plane lies on it

class ContactSolver
{
public:
  ContactSolver(const ContactInput& input, std::vector<Quat>& orientations) :
    Input(input), Orientations(orientations), Count(orientations.size()),
    Around(input, orientations), Needed(orientations.size(), 0.0)
  {
  }

  double Solve(std::vector<unsigned char>& changed, std::vector<Vec3>& shifts)
  {
    if (!this->Around.LookAround())
    {
      return 0.0;
    }
    std::vector<double> blend(this->Count, 0.0);
    for (int round = 0; round < 6; ++round)
    {
      bool settled = true;
      for (std::size_t k = 0; k < this->Count; ++k)
      {
        if (this->Around.IsNear(k) && this->Movable(k))
        {
          const double least = this->LeastBlend(k, blend[k]);
          if (least > blend[k])
          {
            this->Needed[k] = std::max(this->Needed[k], least);
            settled = false;
          }
        }
      }
      if (settled)
      {
        break;
      }
      blend = this->Smooth();
    }
    double deepest = 0.0;
    for (std::size_t k = 0; k < this->Count; ++k)
    {
      if (!this->Movable(k))
      {
        blend[k] = 0.0; // of its neighbours
      }
      else if (this->Around.IsNear(k))
      {
        blend[k] = this->LeastBlend(k, blend[k]); // where smoothing was not enough
      }
      if (this->Around.IsNear(k))
      {
        deepest = std::max(deepest, this->Around.IsPlain(k) ? -this->Around.Lowest(k, blend[k])
                                                            : this->Lift(k, blend[k], shifts[k]));
      }
    }
    for (std::size_t k = 0; k < this->Count; ++k)
    {
      if (blend[k] > 0.0)
      {
        this->Orientations[k] = this->Around.Blended(k, blend[k]);
        changed[k] = 1;
      }
    }
    return deepest > Rounding ? deepest : 0.0;
  }

private:
  bool Movable(std::size_t k) const
  {
    return (*this->Input.Frames)[k].Freedom != PoseFreedom::Fixed;
  }

  /// Moves the centre of a frame out of the surface; returns the depth that is left [m].
  double Lift(std::size_t k, double blend, Vec3& shift) const
  {
    const Quat q = this->Around.Blended(k, blend);
    const Vec3& center = (*this->Input.Positions)[k];
    Vec3 moved = Vec3::Zero();
    Vec3 x;
    double depth = this->Around.Deepest(center, q, static_cast<double>(k), x);
    for (int round = 0; round < 12 && depth > Rounding && this->Movable(k); ++round)
    {
      SurfaceHit hit;
      this->Input.Obstacles->SignedDistance(x, static_cast<double>(k), hit);
      const Vec3 further = moved + (depth + 0.5 * Rounding) * hit.Normal;
      if (further.norm() > this->Input.MostShift)
      {
        break;
      }
      moved = further;
      depth = this->Around.Deepest(center + moved, q, static_cast<double>(k), x);
    }
    shift += moved;
    return depth;
  }

  /// The least blend from `start` on that leaves no vertex below; the best one when none does.
  double LeastBlend(std::size_t k, double start)
  {
    double blend = this->LeastPlaneBlend(k, start);
    while (this->Around.FindMorePlanes(k, blend))
    {
      blend = this->LeastPlaneBlend(k, start);
    }
    return blend;
  }

  double LeastPlaneBlend(std::size_t k, double start) const
  {
    constexpr int Samples = 24;
    double best = start;
    double height = this->Around.Lowest(k, start);
    if (height >= -Rounding)
    {
      return start;
    }
    double before = start;
    for (int i = 1; i <= Samples; ++i)
    {
      double here = start + (1.0 - start) * i / Samples;
      const double lowest = this->Around.Lowest(k, here);
      if (lowest >= -Rounding)
      {
        for (int halving = 0; halving < 16; ++halving)
        {
          const double middle = 0.5 * (before + here);
          (this->Around.Lowest(k, middle) >= -Rounding ? here : before) = middle;
        }
        return here;
      }
      if (lowest > height)
      {
        height = lowest;
        best = here;
      }
      before = here;
    }
    return best;
  }

  /// At least what is needed in every frame, and smooth: the greatest in a window, averaged over
  /// windows of the same width.
  std::vector<double> Smooth() const
  {
    const long reach = this->Input.SmoothingFrames;
    const long count = static_cast<long>(this->Count);
    std::vector<double> widened(this->Count, 0.0);
    for (long k = 0; k < count; ++k)
    {
      for (long i = std::max(0L, k - reach); i <= std::min(count - 1, k + reach); ++i)
      {
        widened[k] = std::max(widened[k], this->Needed[i]);
      }
    }
    std::vector<double> smooth(this->Count, 0.0);
    for (long k = 0; k < count; ++k)
    {
      for (long i = k - reach; i <= k + reach; ++i)
      {
        smooth[k] += widened[std::clamp(i, 0L, count - 1)];
      }
      smooth[k] = std::min(1.0, smooth[k] / static_cast<double>(2 * reach + 1));
      if (!this->Around.AnyNear(static_cast<std::size_t>(k)))
      {
        smooth[k] = 0.0;
      }
    }
    this->EaseAtFlips(smooth);
    return smooth;
  }

  /// Where the body turns on its other side, what frames around would lay it flat by ends: on
  /// either side of there it would lie on another side.
  void EaseAtFlips(std::vector<double>& blend) const
  {
    std::vector<double> eased = blend;
    const double reach = 2.0 * this->Input.SmoothingFrames + 1.0;
    for (std::size_t k = 0; k + 1 < this->Count; ++k)
    {
      if (!(blend[k] + blend[k + 1] > 0.0) || !this->Around.ChangesSide(k) ||
          !this->Flips(k, blend))
      {
        continue;
      }
      for (std::size_t i = 0; i < this->Count; ++i)
      {
        const double away = std::abs(static_cast<double>(i) - static_cast<double>(k) - 0.5);
        const double part = away < reach ? SmoothStep(away / reach) : 1.0;
        eased[i] = std::min(eased[i], std::max(this->Needed[i], part * blend[i]));
      }
    }
    blend = eased;
  }

  /// Does this frame turn the body by much more than it turned before?
  bool Flips(std::size_t k, const std::vector<double>& blend) const
  {
    const auto turn = [&](const Quat& from, const Quat& to)
    { return LogMap(to * from.conjugate()).norm(); };
    return this->Movable(k) && this->Movable(k + 1) &&
           turn(this->Around.Blended(k, blend[k]), this->Around.Blended(k + 1, blend[k + 1])) >
             Flip + turn(this->Orientations[k], this->Orientations[k + 1]);
  }

  const ContactInput& Input;
  std::vector<Quat>& Orientations;
  std::size_t Count;
  Surroundings Around;
  std::vector<double> Needed; // blend, one a frame
};
} // namespace

double KeepAboveSurfaces(const ContactInput& input, std::vector<Quat>& orientations,
                         std::vector<unsigned char>& changed, std::vector<Vec3>& shifts)
{
  if (input.Obstacles == nullptr || input.Obstacles->IsEmpty() || orientations.empty())
  {
    return 0.0;
  }
  return ContactSolver(input, orientations).Solve(changed, shifts);
}

} // namespace waft
