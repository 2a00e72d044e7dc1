// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/AirOnTracks.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace waft
{

AirOnTracks::AirOnTracks(const std::vector<Track>& tracks, const Timeline& time) :
  Tracks(&tracks), Time(time)
{
  for (const Track& track : tracks)
  {
    this->NumberOfFrames = std::max(this->NumberOfFrames, track.Positions.size());
  }
}

AirOnTracks::AirOnTracks(const std::vector<std::vector<Vec3>>& velocities,
                         const std::vector<std::vector<Mat3>>& gradients) :
  Samples(velocities.size())
{
  for (std::size_t i = 0; i < velocities.size(); ++i)
  {
    for (std::size_t k = 0; k < velocities[i].size(); ++k)
    {
      this->Samples[i].push_back({ velocities[i][k].cast<float>(), gradients[i][k].cast<float>() });
    }
  }
}

Result AirOnTracks::Add(FieldSeries fields)
{
  WAFT_RETURN_IF_FAILED(fields.Validate("Air"));
  if (fields.IsEmpty())
  {
    return Result::Ok();
  }
  if (fields.Meaning != FieldMeaning::Velocity)
  {
    return Result::Error("Air: expected velocities, found accelerations");
  }
  if (this->IsEmpty())
  {
    this->Samples.resize(this->Tracks->size());
    this->Last = FieldSeries(static_cast<const SeriesLattice&>(fields));
    this->Last.Times.clear();
  }
  for (std::size_t k = 0; k < fields.Values.size(); ++k)
  {
    if (!this->Last.IsEmpty() && fields.Times[k] <= this->Last.Times.back())
    {
      return Result::Error("Air: expected times that increase");
    }
    this->Last.Times.push_back(fields.Times[k]);
    this->Last.Values.push_back(std::move(fields.Values[k]));
    this->SampleUntil(fields.Times[k]);
    if (this->Last.Values.size() > 1)
    {
      this->Last.Times.erase(this->Last.Times.begin());
      this->Last.Values.erase(this->Last.Values.begin());
    }
  }
  return Result::Ok();
}

void AirOnTracks::Finish()
{
  if (!this->IsEmpty())
  {
    this->SampleUntil(std::numeric_limits<double>::infinity());
  }
}

void AirOnTracks::SampleUntil(double time)
{
  for (; this->Frames < this->NumberOfFrames; ++this->Frames)
  {
    const double now = this->Time.Time(static_cast<double>(this->Frames));
    if (now > time)
    {
      return;
    }
    for (std::size_t i = 0; i < this->Tracks->size(); ++i)
    {
      const std::vector<Vec3>& positions = (*this->Tracks)[i].Positions;
      if (this->Frames < positions.size())
      {
        Mat3 gradient;
        const Vec3 velocity = this->Last.Sample(positions[this->Frames], now, gradient);
        this->Samples[i].push_back({ velocity.cast<float>(), gradient.cast<float>() });
      }
    }
  }
}

Vec3 AirOnTracks::Velocity(std::size_t i, std::size_t frame) const
{
  return this->Samples[i][frame].Velocity.cast<double>();
}

Mat3 AirOnTracks::Gradient(std::size_t i, std::size_t frame) const
{
  return this->Samples[i][frame].Gradient.cast<double>();
}

} // namespace waft
