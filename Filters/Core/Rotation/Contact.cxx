// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Contact.h"

#include "Rotation/RigidBody.h"

#include <cmath>

namespace waft
{
namespace
{
constexpr double Rounding = 1e-10; // m: a vertex this far below a plane lies on it
constexpr std::size_t MostPlanes = 16;

struct Plane
{
  Vec3 Point;
  Vec3 Normal;
};

/// One frame's surroundings and the turn that would lay the body flat in them.
struct Surroundings
{
  bool Near = false;
  bool Plain = true; // the surface is the first plane, as far as the body reaches
  std::vector<Plane> Planes;
  Vec3 Turn = Vec3::Zero(); // rotation vector from the pose to the flat one [rad]
};

class ContactSolver
{
public:
  ContactSolver(const ContactInput& input, std::vector<Quat>& orientations) :
    Input(input), Orientations(orientations), Count(orientations.size()),
    Scenes(orientations.size()), Needed(orientations.size(), 0.0)
  {
    this->ChooseFeelers();
  }

  double Solve(std::vector<unsigned char>& changed, std::vector<Vec3>& shifts)
  {
    if (!this->LookAround())
    {
      return 0.0;
    }
    std::vector<double> blend(this->Count, 0.0);
    for (int round = 0; round < 6; ++round)
    {
      bool settled = true;
      for (std::size_t k = 0; k < this->Count; ++k)
      {
        if (this->Scenes[k].Near && this->Movable(k))
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
      if (this->Scenes[k].Near && this->Movable(k))
      {
        blend[k] = this->LeastBlend(k, blend[k]); // where smoothing was not enough
      }
      if (this->Scenes[k].Near)
      {
        deepest = std::max(deepest, this->Scenes[k].Plain ? -this->Lowest(k, blend[k])
                                                          : this->Lift(k, blend[k], shifts[k]));
      }
    }
    for (std::size_t k = 0; k < this->Count; ++k)
    {
      if (blend[k] > 0.0 && this->Movable(k))
      {
        this->Orientations[k] = this->Blended(k, blend[k]);
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

  /// Vertices that stand out in some direction, and some of the others: those that touch curved or
  /// broken surfaces first.
  void ChooseFeelers()
  {
    const std::vector<Vec3>& points = this->Input.Mesh->Points;
    std::vector<unsigned char> chosen(points.size(), 0);
    for (int x = -1; x <= 1; ++x)
    {
      for (int y = -1; y <= 1; ++y)
      {
        for (int z = -1; z <= 1; ++z)
        {
          const Vec3 direction(x, y, 0.5 * z);
          std::size_t best = 0;
          for (std::size_t i = 1; i < points.size(); ++i)
          {
            best = points[i].dot(direction) > points[best].dot(direction) ? i : best;
          }
          chosen[best] = 1;
        }
      }
    }
    const std::size_t stride = std::max<std::size_t>(points.size() / 12, 1);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      if (chosen[i] != 0 || i % stride == 0)
      {
        this->Feelers.push_back(points[i]);
      }
    }
  }

  /// The nearest surface of each frame that a vertex could reach; false when there is none.
  bool LookAround()
  {
    bool any = false;
    for (std::size_t k = 0; k < this->Count; ++k)
    {
      const double distance = this->Input.Obstacles->SignedDistance(
        (*this->Input.Positions)[k], static_cast<double>(k), 2.0 * this->Input.BoundingRadius);
      this->Scenes[k].Near = distance < this->Input.BoundingRadius;
      any = any || this->Scenes[k].Near;
    }
    if (!any)
    {
      return false;
    }
    Quat after = Quat::Identity();
    bool linked = false;
    for (std::size_t k = this->Count; k-- > 0;)
    {
      Surroundings& scene = this->Scenes[k];
      linked = linked && this->AnyNear(k);
      if (!this->AnyNear(k))
      {
        continue;
      }
      SurfaceHit hit;
      this->Input.Obstacles->SignedDistance((*this->Input.Positions)[k], static_cast<double>(k),
                                            hit);
      scene.Planes.push_back({ hit.Point, hit.Normal });
      scene.Plain = this->IsPlain(k);
      Quat turn = this->FlatTurn(k, hit.Normal);
      const bool oneSided = (*this->Input.Frames)[k].Freedom != PoseFreedom::Free;
      if (oneSided && linked && turn.dot(after) < 0.0)
      {
        turn.coeffs() = -turn.coeffs(); // the same way round as a frame later
      }
      else if (!(oneSided && linked) && turn.w() < 0.0)
      {
        turn.coeffs() = -turn.coeffs();
      }
      scene.Turn = SignedLogMap(turn);
      after = turn;
      linked = oneSided;
    }
    return true;
  }

  bool AnyNear(std::size_t k) const
  {
    const std::size_t reach = 2 * static_cast<std::size_t>(this->Input.SmoothingFrames);
    const std::size_t end = std::min(this->Count, k + reach + 1);
    for (std::size_t i = k > reach ? k - reach : 0; i < end; ++i)
    {
      if (this->Scenes[i].Near)
      {
        return true;
      }
    }
    return false;
  }

  Quat FlatTurn(std::size_t k, const Vec3& normal) const
  {
    const ContactFrame& frame = (*this->Input.Frames)[k];
    const Mat3 turn = this->Orientations[k].toRotationMatrix();
    Vec3 up = normal;
    if (frame.Freedom == PoseFreedom::Landing)
    {
      up = frame.Target * Vec3::UnitZ();
    }
    else if (frame.Freedom == PoseFreedom::Free && turn.col(2).dot(normal) < 0.0)
    {
      up = -normal;
    }
    return LeastTurn(turn.col(2), up, turn.col(0));
  }

  Quat Blended(std::size_t k, double blend) const
  {
    return (ExpMap(blend * this->Scenes[k].Turn) * this->Orientations[k]).normalized();
  }

  /// Height of the lowest vertex above the planes of this frame [m].
  double Lowest(std::size_t k, double blend) const
  {
    const Quat q = this->Blended(k, blend);
    double lowest = 1e300;
    for (const Plane& plane : this->Scenes[k].Planes)
    {
      const double center = ((*this->Input.Positions)[k] - plane.Point).dot(plane.Normal);
      const Vec3 down = q.conjugate() * plane.Normal;
      for (const Vec3& point : this->Input.Mesh->Points)
      {
        lowest = std::min(lowest, center + down.dot(point));
      }
    }
    return lowest;
  }

  /// Is the surface about this frame's pose the first plane alone?
  bool IsPlain(std::size_t k) const
  {
    const Plane& plane = this->Scenes[k].Planes[0];
    for (const Vec3& feeler : this->Feelers)
    {
      const Vec3 x = (*this->Input.Positions)[k] + this->Orientations[k] * feeler;
      const double height = (x - plane.Point).dot(plane.Normal);
      if (std::abs(this->Input.Obstacles->SignedDistance(x, static_cast<double>(k),
                                                         std::max(height, 0.0) + 1e-6) -
                   height) > 2e-6)
      {
        return false;
      }
    }
    return true;
  }

  /// The vertex deepest below a surface and its depth [m], 0 when none is below.
  double Deepest(const Vec3& center, const Quat& q, double frame, Vec3& deepest) const
  {
    double depth = 0.0;
    for (const Vec3& point : this->Input.Mesh->Points)
    {
      const Vec3 x = center + q * point;
      const double d = this->Input.Obstacles->SignedDistance(x, frame, 1e-6);
      if (-d > depth)
      {
        depth = -d;
        deepest = x;
      }
    }
    return depth;
  }

  /// Adds the plane that the deepest vertex is below of; false when there is none.
  bool FindMorePlanes(std::size_t k, double blend)
  {
    Surroundings& scene = this->Scenes[k];
    Vec3 x;
    if (scene.Plain || scene.Planes.size() >= MostPlanes ||
        this->Deepest((*this->Input.Positions)[k], this->Blended(k, blend), static_cast<double>(k),
                      x) < 1e-7)
    {
      return false;
    }
    SurfaceHit hit;
    this->Input.Obstacles->SignedDistance(x, static_cast<double>(k), hit);
    for (const Plane& plane : scene.Planes)
    {
      if (plane.Normal.dot(hit.Normal) > 1.0 - 1e-9 &&
          std::abs((hit.Point - plane.Point).dot(plane.Normal)) < 1e-9)
      {
        return false; // known, and turning alone does not get above it
      }
    }
    // A face that looks away from the centre is the far side of something thin.
    if (((*this->Input.Positions)[k] - hit.Point).dot(hit.Normal) <= 0.0)
    {
      return false;
    }
    scene.Planes.push_back({ hit.Point, hit.Normal });
    return true;
  }

  /// Moves the centre of a frame out of the surface; returns the depth that is left [m].
  double Lift(std::size_t k, double blend, Vec3& shift) const
  {
    const Quat q = this->Blended(k, blend);
    const Vec3& center = (*this->Input.Positions)[k];
    Vec3 moved = Vec3::Zero();
    Vec3 x;
    double depth = this->Deepest(center, q, static_cast<double>(k), x);
    for (int round = 0; round < 12 && depth > Rounding && this->Movable(k); ++round)
    {
      SurfaceHit hit;
      this->Input.Obstacles->SignedDistance(x, static_cast<double>(k), hit);
      const Vec3 further = moved + (depth + 0.5 * Rounding) * hit.Normal;
      if ((shift + further).norm() > this->Input.MostShift)
      {
        break;
      }
      moved = further;
      depth = this->Deepest(center + moved, q, static_cast<double>(k), x);
    }
    shift += moved;
    return depth;
  }

  /// The least blend from `start` on that leaves no vertex below; the best one when none does.
  double LeastBlend(std::size_t k, double start)
  {
    double blend = this->LeastPlaneBlend(k, start);
    while (this->FindMorePlanes(k, blend))
    {
      blend = this->LeastPlaneBlend(k, start);
    }
    return blend;
  }

  double LeastPlaneBlend(std::size_t k, double start) const
  {
    constexpr int Places = 24;
    double best = start;
    double height = this->Lowest(k, start);
    if (height >= -Rounding)
    {
      return start;
    }
    double before = start;
    for (int i = 1; i <= Places; ++i)
    {
      double here = start + (1.0 - start) * i / Places;
      const double lowest = this->Lowest(k, here);
      if (lowest >= -Rounding)
      {
        for (int halving = 0; halving < 16; ++halving)
        {
          const double middle = 0.5 * (before + here);
          (this->Lowest(k, middle) >= -Rounding ? here : before) = middle;
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
      if (!this->AnyNear(static_cast<std::size_t>(k)))
      {
        smooth[k] = 0.0;
      }
    }
    return smooth;
  }

  const ContactInput& Input;
  std::vector<Quat>& Orientations;
  std::size_t Count;
  std::vector<Surroundings> Scenes;
  std::vector<double> Needed;
  std::vector<Vec3> Feelers;
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
