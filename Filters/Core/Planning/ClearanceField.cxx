// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/ClearanceField.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

constexpr double RoomWorthMeasuring = 4.0; // of the radius

} // namespace

void ClearanceField::ForgetLanding(int frame)
{
  this->Landings.erase(std::remove_if(this->Landings.begin(), this->Landings.end(),
                                      [frame](const LandingWindow& landing)
                                      { return landing.Frame == frame; }),
                       this->Landings.end());
}

double ClearanceField::SceneFrame(double frame) const
{
  if (this->SceneFrames.empty() || frame <= this->FirstFrame)
  {
    return frame;
  }
  const double after = frame - this->FirstFrame;
  const std::size_t last = this->SceneFrames.size() - 1;
  const std::size_t low = std::min(static_cast<std::size_t>(after), last);
  const std::size_t high = std::min(low + 1, last);
  const double part = after - static_cast<double>(low);
  return high > low
           ? this->SceneFrames[low] + part * (this->SceneFrames[high] - this->SceneFrames[low])
           : this->SceneFrames[low] + part;
}

const LandingWindow* ClearanceField::LandingAt(double frame) const
{
  for (const LandingWindow& landing : this->Landings)
  {
    if (frame >= landing.First && frame <= landing.Last)
    {
      return &landing;
    }
  }
  return nullptr;
}

double ClearanceField::Distance(const Vec3& x, double frame, double limit) const
{
  const LandingWindow* landing = this->LandingAt(frame);
  const double now = this->SceneFrame(frame);
  double distance = std::min({ x.x() - this->Bounds.Min.x(), x.y() - this->Bounds.Min.y(),
                               this->Bounds.Max.x() - x.x(), this->Bounds.Max.y() - x.y(),
                               this->Bounds.Max.z() - x.z(), limit });
  if (landing != nullptr)
  {
    distance =
      std::min(distance, (x - landing->Centre.At(now)).dot(landing->Normal) + this->Rule.Radius);
  }
  else
  {
    distance = std::min(distance, x.z() - this->Bounds.Min.z());
  }
  if (this->Obstacles != nullptr && !this->Obstacles->IsEmpty())
  {
    distance =
      std::min(distance, this->Obstacles->SignedDistance(
                           x, now, distance, landing != nullptr ? landing->ObstacleId : -1));
  }
  return distance;
}

double ClearanceField::Required(const Vec3& x) const
{
  return waft::Required(this->Rule, this->TightMarks, x, x);
}

int ClearanceField::FirstHit(const std::vector<Vec3>& samples, int first, int last,
                             double firstFrame, double framesPerSample, double margin) const
{
  const bool moving = this->Obstacles != nullptr && this->Obstacles->HasMoving();
  int k = first;
  while (k <= last)
  {
    const double frame = firstFrame + (k - first) * framesPerSample;
    const bool lands = this->LandingAt(frame) != nullptr;
    const double wanted = this->Required(samples[k]) + (lands ? -1e-9 : margin);
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
           lands == (this->LandingAt(firstFrame + (next - first) * framesPerSample) != nullptr))
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
