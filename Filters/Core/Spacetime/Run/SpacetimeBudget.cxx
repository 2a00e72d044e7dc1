// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/SpacetimeBudget.h"

#include "Particles/GasLattice.h"
#include "Spacetime/Paper/FieldNormal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace waft
{
namespace
{

constexpr double Megabyte = 1e6;
constexpr std::size_t ShortestWindow = 8; // frames
constexpr double ListGrowth = 1.3;        // of a list's room over its entries
constexpr double WallFraction = 0.85;     // of neighbours that walls leave, on average
constexpr double UsualSkin = 0.2;         // [dx]
constexpr double SmallParts = 4e6;        // factors, fields, work space of the threads

} // namespace

SpacetimeBudget::SpacetimeBudget(const SpacetimeModel& model, const SpacetimeOptions& options)
{
  const double frame = sizeof(float) * double(model.FrameSize());
  const double particles = double(model.NumberOfParticles());
  const double rows = sizeof(float) * 9.0 * double(model.Stride());
  const double exported = sizeof(float) * 17.0 * particles;
  const double reach = 2.0 * options.SmoothingLength + UsualSkin;
  const double neighbours =
    WallFraction * 4.0 / 3.0 * M_PI * reach * reach * reach + 4.0; // whole groups of eight
  const double entry = particles < 65535.0 ? 2.0 : 4.0;
  // Of the positions of its construction a list may keep the last ones too; see NeighbourCourse.
  const double list = particles * (ListGrowth * entry * neighbours + 8.0 * sizeof(float));
  // The motion, the one it began with, and the rows of an evaluation of the whole.
  this->Base = SmallParts + model.NumberOfFrames * (2.0 * frame + rows);
  if (options.EstimateWind && model.Air.IsEmpty())
  {
    this->Base += FieldBytes(model);
  }
  if (!model.Air.IsEmpty()) // deviations and the air's Jacobians
  {
    this->Base += model.NumberOfFrames * (frame + rows);
  }
  this->Exported = model.NumberOfFrames * exported;
  // Of a window: its part of the state, L-BFGS with its pairs, rows and lists.
  this->PerFrame = frame * (6.0 + 2.0 * options.HistorySize) + rows + list;
  this->Halo = static_cast<std::size_t>(4 * options.TemporalWindow);
  this->Asked = static_cast<std::size_t>(options.WindowLength);
}

std::size_t SpacetimeBudget::WindowOf(std::size_t frames, double limit) const
{
  const double room = limit * Megabyte - this->Base;
  const std::size_t wanted = this->Asked > 0 ? std::min(frames, this->Asked) : frames;
  const std::size_t held = wanted < frames ? std::min(frames, wanted + this->Halo) : frames;
  if (limit <= 0.0 || this->PerFrame * double(held) <= room)
  {
    return wanted;
  }
  const double fit = std::max(0.0, room / this->PerFrame - double(this->Halo));
  return std::max(ShortestWindow, static_cast<std::size_t>(fit));
}

Result SpacetimeBudget::Validate(std::size_t frames, const SpacetimeOptions& options,
                                 double machine) const
{
  const double least = this->Of(std::min(frames, ShortestWindow + this->Halo)) / Megabyte;
  const std::size_t asked = this->Asked > 0 ? std::min(frames, this->Asked + this->Halo) : frames;
  const double whole = this->Of(asked) / Megabyte;
  char text[300];
  if (this->Asked > 0 && this->Asked < ShortestWindow)
  {
    std::snprintf(text, sizeof(text),
                  "WindowLength: expected 0 or %zu frames at least, as hardly anything can move in "
                  "fewer, found %zu",
                  ShortestWindow, this->Asked);
    return Result::Error(text);
  }
  if (options.MemoryLimit > 0.0 && options.MemoryLimit < least)
  {
    std::snprintf(text, sizeof(text),
                  "MemoryLimit: %g MB, at least %.0f MB expected for so many frames and particles",
                  options.MemoryLimit, std::ceil(least));
    return Result::Error(text);
  }
  if (options.MemoryLimit <= 0.0 && whole * Megabyte > machine)
  {
    std::snprintf(text, sizeof(text),
                  "%zu frames of so many particles take %.0f MB, the machine has %.0f MB: expected "
                  "fewer frames or NumberOfGasParticles, or a MemoryLimit of %.0f MB or more",
                  asked, std::ceil(whole), machine / Megabyte, std::ceil(least));
    return Result::Error(text);
  }
  return Result::Ok();
}

Result CheckRoom(const Box& volume, int frames, std::size_t objects,
                 const SpacetimeOptions& options)
{
  if (frames < LeastSpacetimeFrames)
  {
    return Result::Error("NumberOfFrames: at least " + std::to_string(LeastSpacetimeFrames) +
                         " expected, found " + std::to_string(frames));
  }
  const GasLattice lattice = GasLattice::Make(volume, options.NumberOfGasParticles);
  WAFT_RETURN_IF_FAILED(lattice.CheckLayers());
  SpacetimeModel model;
  model.NumberOfFrames = frames;
  model.NumberOfGas = static_cast<std::size_t>(options.NumberOfGasParticles);
  model.NumberOfObjects = objects;
  return SpacetimeBudget(model, options).Validate(static_cast<std::size_t>(frames), options);
}

} // namespace waft
