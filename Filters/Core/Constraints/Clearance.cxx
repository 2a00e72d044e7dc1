// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Clearance.h"

#include <cmath>

namespace waft
{

namespace
{

constexpr double RoomWorthMeasuring = 4.0; // of the radius

} // namespace

const ContactStretch* ClearanceField::ContactAt(double frame) const
{
  for (const ContactStretch& contact : this->Contacts)
  {
    if (frame >= contact.FirstFrame && frame <= contact.LastFrame)
    {
      return &contact;
    }
  }
  return nullptr;
}

double ClearanceField::Distance(const Vec3& x, double frame, double limit) const
{
  const ContactStretch* contact = this->ContactAt(frame);
  double distance = std::min({ x.x() - this->Bounds.Min.x(), x.y() - this->Bounds.Min.y(),
                               this->Bounds.Max.x() - x.x(), this->Bounds.Max.y() - x.y(),
                               this->Bounds.Max.z() - x.z(), limit });
  if (contact != nullptr)
  {
    distance = std::min(distance, (x - contact->Centre).dot(contact->Normal) + this->Rule.Radius);
  }
  else
  {
    distance = std::min(distance, x.z() - this->Bounds.Min.z());
  }
  if (this->Obstacles != nullptr && !this->Obstacles->IsEmpty())
  {
    distance =
      std::min(distance, this->Obstacles->SignedDistance(
                           x, frame, distance, contact != nullptr ? contact->Surface : -1));
  }
  return distance;
}

double ClearanceField::Distance(const Vec3& x, double frame, Vec3& away) const
{
  const ContactStretch* contact = this->ContactAt(frame);
  double distance = 1e30;
  const auto offer = [&](double d, const Vec3& direction)
  {
    if (d < distance)
    {
      distance = d;
      away = direction;
    }
  };
  offer(x.x() - this->Bounds.Min.x(), Vec3::UnitX());
  offer(x.y() - this->Bounds.Min.y(), Vec3::UnitY());
  offer(this->Bounds.Max.x() - x.x(), -Vec3::UnitX());
  offer(this->Bounds.Max.y() - x.y(), -Vec3::UnitY());
  offer(this->Bounds.Max.z() - x.z(), -Vec3::UnitZ());
  if (contact != nullptr)
  {
    offer((x - contact->Centre).dot(contact->Normal) + this->Rule.Radius, contact->Normal);
  }
  else
  {
    offer(x.z() - this->Bounds.Min.z(), Vec3::UnitZ());
  }
  if (this->Obstacles != nullptr && !this->Obstacles->IsEmpty())
  {
    SurfaceHit hit;
    const double d =
      this->Obstacles->SignedDistance(x, frame, hit, contact != nullptr ? contact->Surface : -1);
    // Outside, away from the closest point (it may lie on an edge); inside, out of the face.
    const Vec3 apart = x - hit.Point;
    offer(d, d > 1e-9 && apart.norm() > 1e-9 ? Vec3(apart.normalized()) : hit.Normal);
  }
  return distance;
}

double ClearanceField::Required(const Vec3& x) const
{
  double required = this->Rule.Radius;
  for (const TightMark& mark : this->TightMarks)
  {
    // Grows with the distance to the mark, no faster than a path can leave the surface.
    required = std::min(required, mark.Distance + 0.3 * (x - mark.Position).norm());
  }
  return required;
}

int ClearanceField::FirstHit(const std::vector<Vec3>& samples, int first, int last,
                             double firstFrame, double framesPerSample, double margin) const
{
  const bool moving = this->Obstacles != nullptr && this->Obstacles->HasMoving();
  int k = first;
  while (k <= last)
  {
    const double frame = firstFrame + (k - first) * framesPerSample;
    const bool atContact = this->ContactAt(frame) != nullptr;
    const double wanted = this->Required(samples[k]) + (atContact ? -1e-9 : margin);
    // Room beyond a few radii only costs time to measure.
    const double slack =
      this->Distance(samples[k], frame, wanted + RoomWorthMeasuring * this->Rule.Radius) - wanted;
    if (slack < 0.0)
    {
      return k;
    }
    // Still obstacles: nothing can be hit before the path has covered the slack.
    double way = 0.0;
    int next = k + 1;
    while (!moving && next < last &&
           atContact == (this->ContactAt(firstFrame + (next - first) * framesPerSample) != nullptr))
    {
      way += (samples[next] - samples[next - 1]).norm();
      if (way > 0.7 * slack)
      {
        break;
      }
      ++next;
    }
    k = k == last ? last + 1 : std::min(next, last);
  }
  return -1;
}

double ClearanceField::Slack(const Vec3& a, double frameA, const Vec3& b, double frameB,
                             int points) const
{
  double slack = 1e30;
  for (int i = 0; i < points; ++i)
  {
    const double u = static_cast<double>(i) / points;
    const Vec3 x = a + u * (b - a);
    slack = std::min(
      slack, this->Distance(x, frameA + u * (frameB - frameA), slack + 2.0 * this->Rule.Radius) -
               this->Required(x));
  }
  return slack;
}

} // namespace waft
