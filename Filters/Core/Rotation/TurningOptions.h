// SPDX-License-Identifier: BSD-3-Clause
// By what law bodies turn and glide.
#pragma once

#include "Base/OptionFields.h"
#include "Rotation/PanelBody.h"

namespace waft
{

/// Members have the defaults; Visit says the rest of each field.
struct TurningOptions
{
  AirModel Model = AirModel::Plate;
  double Damping = 0.3;
  double Lift = 2.9;
  double PressureShift = 0.0;
  double Follow = 0.5;
  double Roll = 1.0;
  double Spin = 0.0;
  double VariationPerObject = 0.15;
  double MaximumTurn = 0.0;
  int RasterSize = 128;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Model",
                       { 0, 1 },
                       "",
                       "How the air pushes: Paper is drag on each visible piece of surface, Plate "
                       "a thin plate that flutters and tumbles." },
          of.Model...);
    visit(OptionField{ "Damping",
                       { 0, 1000 },
                       "1/s",
                       "Rate at which rotation dies away besides the air's drag, per second." },
          of.Damping...);
    visit(
      OptionField{ "Lift",
                   { 0, 4 },
                   "",
                   "Extra lift where a body meets the air at a flat angle: more glides farther." },
      of.Lift...);
    visit(OptionField{ "PressureShift",
                       { 0, 1 },
                       "",
                       "How far ahead of its centre the air presses on an edge-on plate, in half "
                       "chords: more tumbles more readily (Plate)." },
          of.PressureShift...);
    visit(OptionField{ "Follow",
                       { 0, 1000 },
                       "1/s",
                       "Rate at which the hidden sideslip is forgotten, per second: more keeps "
                       "bodies calmer on their path (Plate)." },
          of.Follow...);
    visit(OptionField{ "Roll",
                       { 0, 4 },
                       "",
                       "How readily bodies tumble: 0 flutters and glides, 1 is natural, more "
                       "tumbles longer." },
          of.Roll...);
    visit(OptionField{ "Spin",
                       { -1, 1 },
                       "rad",
                       "Spin like a winged seed's, in radians of pitch: 0.05 to 0.2 is seen; "
                       "below 0 the other way." },
          of.Spin...);
    visit(OptionField{ "VariationPerObject",
                       { 0, 0.5 },
                       "",
                       "How much objects of one shape differ in their coefficients, each by an "
                       "amount of its own from the Seed." },
          of.VariationPerObject...);
    visit(OptionField{ "MaximumTurn",
                       { 0, 180 },
                       "degrees",
                       "Most degrees that a body turns from frame to frame; 0: as an eye can "
                       "follow bodies of its width." },
          of.MaximumTurn...);
    visit(
      OptionField{ "RasterSize",
                   { 8, 1024 },
                   "",
                   "Pixels on a side of the pictures of each shape that tell what hides what." },
      of.RasterSize...);
  }
};

} // namespace waft
