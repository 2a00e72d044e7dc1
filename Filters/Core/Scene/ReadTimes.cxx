// SPDX-License-Identifier: BSD-3-Clause
// When rows of an entry are met: at one frame, or each at one of its own in a window.
#include "Scene/SceneReader.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace waft
{
namespace
{

constexpr std::uint64_t OrderStream = 0x6f72646572;
constexpr std::uint64_t ShareStream = 0x7368617265;
constexpr const char* Orders =
  "air, left-to-right, right-to-left, top-down, bottom-up, outward, inward, random, letters, "
  "words, lines, {\"direction\": [x, y, z]} or a list of ranks";

template <class Target>
std::vector<double> KeysOf(const std::vector<Target>& targets,
                           const std::function<double(const Target&)>& key)
{
  std::vector<double> keys;
  std::transform(targets.begin(), targets.end(), std::back_inserter(keys), key);
  return keys;
}

TimeSpread ReadSpread(const SceneNode& node)
{
  if (!node.Has("spread"))
  {
    return TimeSpread::Even;
  }
  const SceneNode field = node.At("spread", "");
  const TimeSpread* found = FindTimeSpread(field.Text());
  if (found == nullptr)
  {
    field.Fail("even, ease-in or ease-out");
  }
  return *found;
}

} // namespace

void SceneReader::RowTimes::Set(std::size_t target, Constraint& row) const
{
  row.FrameFrom = this->IsWindow ? this->Window.From : -1;
  row.IsOpenWindow = this->IsOpen;
  row.Frame = this->Frames.empty() ? this->Window.To : this->Frames[target];
  row.Until = row.Frame;
}

SceneReader::RowTimes SceneReader::ReadTimes(const SceneNode& node,
                                             const std::vector<Target>& targets, int row) const
{
  RowTimes times;
  const SceneNode frame = node.At("frame", "a frame of the scene");
  times.IsWindow = frame.Json().is_object();
  const bool isByAir =
    !node.Has("order") || (node.At("order", "").IsString() && node.At("order", "").Text() == "air");
  const TimeSpread spread = ReadSpread(node);
  if (!times.IsWindow && !isByAir)
  {
    node.At("order", "").FailWith("expected `order` only where `frame` is a window {`from`, `to`}");
  }
  if (isByAir && spread != TimeSpread::Even)
  {
    node.At("spread", "")
      .FailWith("expected `spread` only with an `order` other than air, which "
                "takes the frames of least control");
  }
  if (!times.IsWindow)
  {
    times.Window.From = times.Window.To = this->Frame(frame);
    return times;
  }
  frame.CheckFields("window");
  times.Window.From = this->Frame(frame.At("from", "the first frame of the window"));
  const SceneNode to = frame.At("to", "the last frame of the window");
  times.Window.To = static_cast<int>(to.Integer(
    times.Window.From, this->Out.Info.Time.NumberOfFrames - 1, "a frame not before `from`"));
  if (isByAir)
  {
    times.IsOpen = times.Window.To > times.Window.From;
    return times;
  }
  const SceneNode order = node.At("order", "");
  const bool isInGroups = order.IsString() && (order.Text() == "letters" ||
                                               order.Text() == "words" || order.Text() == "lines");
  for (const double part : this->ReadOrder(order, targets, spread, row))
  {
    times.Frames.push_back(FrameAt(times.Window, isInGroups ? TimeSpread::Even : spread, part));
  }
  return times;
}

std::vector<SceneReader::Target> SceneReader::StartsAsTargets(const std::vector<Vec3>& positions)
{
  std::vector<Target> starts;
  for (const Vec3& position : positions)
  {
    starts.push_back({ position, -1, position.x(), position.z(), {} });
  }
  return starts;
}

std::vector<int> SceneReader::ReadReleases(const SceneNode& node,
                                           const std::vector<Vec3>& positions, int entry) const
{
  const std::size_t count = positions.size();
  const TimeSpread spread = ReadSpread(node);
  const bool isSpread = node.Has("release") && node.At("release", "").Json().is_object();
  const bool isRandom = !node.Has("order") || (node.At("order", "").IsString() &&
                                               node.At("order", "").Text() == "random");
  const bool hasWindow = isSpread && node.At("release", "").Has("to");
  if (!isSpread && !isRandom)
  {
    node.At("order", "")
      .FailWith("expected `order` only where `release` is a window {`from`, "
                "`to`} or {`from`, `rate`}");
  }
  if (!hasWindow && spread != TimeSpread::Even)
  {
    node.At("spread", "")
      .FailWith("expected `spread` only where `release` is a window {`from`, "
                "`to`}");
  }
  if (!isSpread)
  {
    const int frame = node.Has("release") ? this->Frame(node.At("release", "")) : 0;
    return std::vector<int>(count, frame > 0 ? frame : -1);
  }
  const SceneNode releases = node.At("release", "");
  releases.CheckFields("releases");
  const int last = this->Out.Info.Time.NumberOfFrames - 1;
  const int from = this->Frame(releases.At("from", "the frame of the first release"));
  double length = 0.0; // of all releases, frames
  double rate = 0.0;
  if (releases.Has("to") == releases.Has("rate"))
  {
    releases.FailWith("expected either `to` or `rate` beside `from`");
  }
  if (hasWindow)
  {
    length =
      static_cast<double>(releases.At("to", "").Integer(from, last, "a frame not before `from`")) -
      from;
  }
  else if (releases.Take("rate", rate))
  {
    length = static_cast<double>(count - 1) * this->Out.Info.Time.FramesPerSecond / rate;
    if (std::lround(from + length) > last)
    {
      releases.At("rate", "")
        .FailWith("expected a rate by which all " + std::to_string(count) +
                  " are released by frame " + std::to_string(last));
    }
  }
  const std::vector<double> parts =
    node.Has("order") && !isRandom
      ? this->ReadOrder(node.At("order", ""), StartsAsTargets(positions), spread, entry)
      : PartsByChance(count, this->Out.Info.Seed,
                      ReleaseStream + static_cast<std::uint64_t>(entry));
  std::vector<int> frames;
  for (const double part : parts)
  {
    frames.push_back(from + static_cast<int>(std::lround(SpreadOf(spread, part) * length)));
  }
  return frames;
}

Vec3 SceneReader::ReadAway(const SceneNode& leave) const
{
  if (leave.Has("direction"))
  {
    const SceneNode direction = leave.At("direction", "");
    if (leave.Has("side"))
    {
      direction.FailWith("expected either `side` or `direction`");
    }
    return direction.Direction();
  }
  if (!leave.Has("side"))
  {
    return Vec3::Zero();
  }
  const SceneNode side = leave.At("side", "");
  const auto* found = std::find_if(std::begin(SidesOut), std::end(SidesOut),
                                   [&](const SideOut& one) { return side.Text() == one.Name; });
  if (found == std::end(SidesOut))
  {
    side.Fail("left, right, front, back or top");
  }
  return found->Direction();
}

std::vector<Leaving> SceneReader::ReadLeavings(const SceneNode& leave,
                                               const std::vector<Target>& targets, int earliest,
                                               int entry) const
{
  leave.CheckFields("leave");
  const int last = this->Out.Info.Time.NumberOfFrames - 1;
  const SceneNode frame = leave.At("frame", "a frame of the scene, or a window");
  const bool isWindow = frame.Json().is_object();
  const TimeSpread spread = ReadSpread(leave);
  FrameWindow window;
  const auto after = [&](const SceneNode& one)
  { return static_cast<int>(one.Integer(earliest, last, "a frame not before the last arrival")); };
  window.From = window.To = isWindow ? 0 : after(frame);
  if (isWindow)
  {
    frame.CheckFields("window");
    window.From = after(frame.At("from", "the frame at which the first goes"));
    window.To = static_cast<int>(frame.At("to", "the frame at which the last goes")
                                   .Integer(window.From, last, "a frame not before `from`"));
  }
  const std::uint64_t seed = this->Out.Info.Seed;
  const auto stream = static_cast<std::uint64_t>(entry);
  const std::vector<double> parts =
    leave.Has("order") ? this->ReadOrder(leave.At("order", ""), targets, spread, entry)
                       : PartsByChance(targets.size(), seed, LeaveStream + stream);
  const std::vector<double> chances = PartsByChance(targets.size(), seed, ShareStream + stream);
  const auto count = static_cast<double>(targets.size());
  double share = 1.0;
  leave.Take("share", share);
  Leaving leaving;
  leaving.Away = this->ReadAway(leave);
  leaving.HasPlace = leave.Take("place", leaving.Place) ? 1 : 0;
  if (leaving.HasPlace != 0 && !leaving.Away.isZero())
  {
    leave.At("place", "").FailWith("expected either `side`, `direction` or `place`");
  }
  if (leaving.HasPlace != 0 && this->Out.Info.Bounds.InnerDistance(leaving.Place) < 0.0)
  {
    leave.At("place", "").Fail("a place in the volume");
  }
  leaving.Fade = leave.Has("fade") ? this->Frame(leave.At("fade", "")) : 0;
  std::vector<Leaving> all(targets.size());
  for (std::size_t t = 0; t < targets.size(); ++t)
  {
    if (chances[t] * (count - 1.0) + 0.5 >= share * count)
    {
      continue; // it stays
    }
    int axis = 2;
    (void)this->Out.Info.Bounds.WayOut(targets[t].Position, leaving.Away, &axis);
    const bool isFloor = axis == 2 && leaving.Away.z() < 0.0;
    if (!leaving.Away.isZero() &&
        (isFloor || this->Out.Info.Open[static_cast<std::size_t>(axis)] == 0))
    {
      leave.FailWith("expected a way out by a side that is open (/domain/open), found " +
                     std::string(isFloor ? "the floor" : OpenSides[axis]) + " closed");
    }
    all[t] = leaving;
    all[t].From = FrameAt(window, spread, parts[t]);
  }
  return all;
}

void SceneReader::ReadLeave(const SceneNode& node, const std::vector<Target>& targets, int row,
                            std::size_t first)
{
  if (!node.Has("leave"))
  {
    return;
  }
  std::vector<Constraint*> rows; // by target
  int arrives = 0;
  for (std::size_t i = first; i < this->Out.Constraints.size(); ++i)
  {
    Constraint& own = this->Out.Constraints[i];
    if (IsPositional(own.Kind))
    {
      rows.push_back(&own);
      arrives = std::max(arrives, own.Frame);
    }
  }
  std::vector<Target> there = targets; // in the world, whatever they are on
  for (std::size_t t = 0; t < rows.size(); ++t)
  {
    there[t].Position = rows[t]->Value;
  }
  const std::vector<Leaving> leavings =
    this->ReadLeavings(node.At("leave", ""), there, arrives, row);
  for (std::size_t t = 0; t < rows.size(); ++t)
  {
    rows[t]->Goes = leavings[t];
    if (IsRest(rows[t]->Kind) && leavings[t].From >= 0)
    {
      rows[t]->Until = std::min(rows[t]->Until, leavings[t].From);
    }
  }
}

std::vector<double> SceneReader::ReadOrder(const SceneNode& node,
                                           const std::vector<Target>& targets, TimeSpread spread,
                                           int row) const
{
  const auto byKey = [&](const std::function<double(const Target&)>& key)
  { return PartsByKey(KeysOf<Target>(targets, key)); };
  if (node.IsArray())
  {
    const std::size_t count = node.Size("a list of ranks");
    if (count != targets.size())
    {
      node.FailWith("expected " + std::to_string(targets.size()) + " ranks, one a target, found " +
                    std::to_string(count));
    }
    std::vector<int> ranks;
    for (std::size_t i = 0; i < count; ++i)
    {
      ranks.push_back(static_cast<int>(node.Item(i).Integer(0, static_cast<std::int64_t>(count) - 1,
                                                            "a rank below the number of targets")));
    }
    return PartsByRank(ranks);
  }
  if (node.Json().is_object())
  {
    node.CheckFields("orderDirection");
    const SceneNode direction = node.At("direction", "a direction [x, y, z]");
    const Vec3 along = direction.Vector();
    if (!(along.norm() > 1e-12))
    {
      direction.Fail("a direction that is not zero");
    }
    return byKey([&](const Target& target) { return target.Position.dot(along); });
  }
  if (!node.IsString())
  {
    node.Fail(Orders);
  }
  const std::string word = node.Text();
  if (word == "letters" || word == "words" || word == "lines")
  {
    std::vector<int> groups;
    for (const Target& target : targets)
    {
      if (!target.Place)
      {
        node.FailWith("expected an order by " + word + " only of targets that are a text");
      }
      groups.push_back(word == "letters" ? target.Place->Letter
                       : word == "words" ? target.Place->Word
                                         : target.Place->Line);
    }
    return PartsByGroup(groups, spread);
  }
  if (const PlaceOrder* order = FindPlaceOrder(word))
  {
    std::vector<OrderedPlace> places;
    for (const Target& target : targets)
    {
      places.push_back({ target.Across, target.Up, target.Position });
    }
    return PartsByPlace(*order, places, this->Out.Info.Seed,
                        OrderStream + static_cast<std::uint64_t>(row));
  }
  node.Fail(Orders);
}

} // namespace waft
