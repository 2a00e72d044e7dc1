// SPDX-License-Identifier: BSD-3-Clause
// A vortex or a wind of the artist's, made by hand.
#pragma once

#include "Base/ForceFields.h"
#include "Base/SceneFrame.h"

#include <string>

namespace waft
{

struct Scene;

/// What comes and goes over time as a bell does.
struct PassingForce : SceneFrame
{
  double CenterTime = 5.0;
  double Duration = 3.0;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "CenterTime", limits::Time, "s", "When it is strongest, in seconds." },
          of.CenterTime...);
    visit(OptionField{ "Duration", limits::Duration, "s",
                       "Standard deviation of its strength over time, in seconds." },
          of.Duration...);
    SceneFrame::Visit(visit, of...);
  }
};

struct VortexSourceOptions : PassingForce
{
  int VortexId = 0;
  Vec3 P1{ 0.0, 0.0, 0.5 };
  Vec3 P2{ 0.0, 0.0, 3.5 };
  double Strength = 2.0;
  double CoreRadius = 0.3;

  /// Fails where the poles are one point.
  Result Make(Vortex& vortex) const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "VortexId", limits::Id, "",
                       "The number of the vortex; different in each of those that are appended." },
          of.VortexId...);
    visit(OptionField{ "P1", limits::Coordinate, "m", "One end of the vortex's axis, in metres." },
          of.P1...);
    visit(OptionField{ "P2", limits::Coordinate, "m",
                       "The other end: the air turns round the way from the first to it as the "
                       "fingers of a right hand, in metres." },
          of.P2...);
    visit(OptionField{ "Strength", limits::VortexStrength, "m^2/s^2",
                       "How hard it turns the air, in square metres per second squared; below 0 "
                       "the other way." },
          of.Strength...);
    visit(OptionField{ "CoreRadius", limits::Length, "m",
                       "Where the acceleration is largest, in metres from the axis." },
          of.CoreRadius...);
    PassingForce::Visit(visit, of...);
  }
};

enum class WindKind
{
  Gust = 0,
  Front = 1
};

struct WindSourceOptions : PassingForce
{
  WindKind Kind = WindKind::Gust;
  Vec3 Direction{ 1.0, 0.0, 0.0 };
  double Strength = 1.0;
  Vec3 Center{ 0.0, 0.0, 2.0 };
  double Radius = 1.0;
  Vec3 Origin{ -2.0, 0.0, 2.0 };
  Vec3 Heading{ 1.0, 0.0, 0.0 };
  double Speed = 2.5;
  double Width = 8.0;
  int StartFrame = 0;

  /// The one wind or front of a scene. Fails where Direction, or the Heading of a front, is 0.
  Result Make(Scene& scene) const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(
      OptionField{
        "Kind", { 0, 1 }, "", "A gust about a place and a time, or a front whose edge travels." },
      of.Kind...);
    visit(OptionField{ "Direction", limits::Direction, "",
                       "Where the wind blows; its length does not matter." },
          of.Direction...);
    visit(OptionField{ "Strength", limits::Acceleration, "m/s^2",
                       "Acceleration of the air at the centre, in metres per second squared." },
          of.Strength...);
    visit(
      OptionField{ "Center", limits::Coordinate, "m", "Where the wind is strongest, in metres." },
      of.Center...);
    visit(OptionField{ "Origin", limits::Coordinate, "m",
                       "A point on the edge of a front at Start Frame, in metres." },
          of.Origin...);
    visit(OptionField{ "Heading", limits::Direction, "",
                       "Where a front goes and blows; its length does not matter." },
          of.Heading...);
    visit(
      OptionField{ "Speed", limits::Speed, "m/s", "Of the edge of a front, in metres per second." },
      of.Speed...);
    visit(OptionField{ "Width", limits::Length, "m",
                       "Over which a front blows behind its edge, in metres." },
          of.Width...);
    visit(OptionField{ "StartFrame", limits::UpTo(limits::MostInt), "",
                       "Frame at which the edge of a front is at Origin." },
          of.StartFrame...);
    visit(OptionField{ "Radius", limits::Length, "m",
                       "Standard deviation of its strength about the centre, in metres." },
          of.Radius...);
    PassingForce::Visit(visit, of...);
  }
};

/// A scene file of these winds alone, as AuthoredScene keeps what made a field.
std::string AuthoredWinds(const Scene& scene);

} // namespace waft
