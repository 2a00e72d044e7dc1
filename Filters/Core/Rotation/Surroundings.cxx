// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Surroundings.h"

#include "Rotation/PlaneBeside.h"
#include "Rotation/RigidBody.h"

#include <cmath>

namespace waft
{
namespace
{
constexpr std::size_t MostPlanes = 16;
} // namespace

Surroundings::Surroundings(const ContactInput& input, const std::vector<Quat>& orientations) :
  Input(input), Orientations(orientations), Scenes(orientations.size())
{
  this->ChooseFeelers();
}

void Surroundings::ChooseFeelers()
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

bool Surroundings::LookAround()
{
  bool any = false;
  for (std::size_t k = 0; k < this->Orientations.size(); ++k)
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
  std::vector<Quat> turns(this->Scenes.size(), Quat::Identity());
  for (std::size_t k = 0; k < this->Scenes.size(); ++k)
  {
    if (!this->AnyNear(k))
    {
      continue;
    }
    Scene& scene = this->Scenes[k];
    SurfaceHit hit;
    this->Input.Obstacles->SignedDistance((*this->Input.Positions)[k], static_cast<double>(k), hit);
    if ((*this->Input.Frames)[k].Freedom == PoseFreedom::Free)
    {
      const Vec3& place = (*this->Input.Positions)[k];
      hit = PlaneBeside(*this->Input.Obstacles, hit,
                        { &this->Input.Mesh->Points, this->Input.BoundingRadius,
                          this->Orientations[k], static_cast<double>(k), place, place });
    }
    scene.Planes.push_back({ hit.Point, hit.Normal });
    scene.Plain = this->FitsOnePlane(k);
    turns[k] = this->FlatTurn(k, hit.Normal);
    if (turns[k].w() < 0.0)
    {
      turns[k].coeffs() = -turns[k].coeffs();
    }
  }
  this->GoOneWayRound(turns);
  for (std::size_t k = 0; k < this->Scenes.size(); ++k)
  {
    this->Scenes[k].Turn = SignedLogMap(turns[k]);
  }
  return true;
}

void Surroundings::GoOneWayRound(std::vector<Quat>& turns) const
{
  const auto follow = [&](std::size_t k, std::size_t led, PoseFreedom freedom)
  {
    const std::vector<ContactFrame>& frames = *this->Input.Frames;
    if (frames[k].Freedom == freedom && frames[led].Freedom == freedom && this->AnyNear(k) &&
        this->AnyNear(led) && turns[k].dot(turns[led]) < 0.0)
    {
      turns[k].coeffs() = -turns[k].coeffs();
    }
  };
  for (std::size_t k = turns.size() - 1; k-- > 0;)
  {
    follow(k, k + 1, PoseFreedom::Landing);
  }
  for (std::size_t k = 1; k < turns.size(); ++k)
  {
    follow(k, k - 1, PoseFreedom::Leaving);
  }
}

bool Surroundings::AnyNear(std::size_t k) const
{
  const std::size_t reach = 2 * static_cast<std::size_t>(this->Input.SmoothingFrames);
  const std::size_t end = std::min(this->Orientations.size(), k + reach + 1);
  for (std::size_t i = k > reach ? k - reach : 0; i < end; ++i)
  {
    if (this->Scenes[i].Near)
    {
      return true;
    }
  }
  return false;
}

Quat Surroundings::FlatTurn(std::size_t k, const Vec3& normal) const
{
  const ContactFrame& frame = (*this->Input.Frames)[k];
  const Mat3 turn = this->Orientations[k].toRotationMatrix();
  Vec3 up = normal;
  if (frame.Freedom == PoseFreedom::Landing || frame.Freedom == PoseFreedom::Leaving)
  {
    up = frame.Target * Vec3::UnitZ();
  }
  else if (frame.Freedom == PoseFreedom::Free && turn.col(2).dot(normal) < 0.0)
  {
    up = -normal;
  }
  return LeastTurn(turn.col(2), up, turn.col(0));
}

bool Surroundings::FitsOnePlane(std::size_t k) const
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

Quat Surroundings::Blended(std::size_t k, double blend) const
{
  return (ExpMap(blend * this->Scenes[k].Turn) * this->Orientations[k]).normalized();
}

bool Surroundings::ChangesSide(std::size_t k) const
{
  const auto side = [&](std::size_t i)
  { return (this->Blended(i, 1.0) * Vec3::UnitZ()).dot(this->Scenes[i].Planes[0].Normal); };
  return !this->Scenes[k].Planes.empty() && !this->Scenes[k + 1].Planes.empty() &&
         side(k) * side(k + 1) < 0.0;
}

double Surroundings::Lowest(std::size_t k, double blend) const
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

double Surroundings::Deepest(const Vec3& center, const Quat& q, double frame, Vec3& deepest) const
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

bool Surroundings::FindMorePlanes(std::size_t k, double blend)
{
  Scene& scene = this->Scenes[k];
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

} // namespace waft
