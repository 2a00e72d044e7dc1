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
    visit(OptionField{ "Lift",
                       { 0, 4 },
                       "",
                       "Extra slope of the normal force at small angles of attack (Plate)." },
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
                       "How readily a body rolls on when it turns over: 0 flutters and glides "
                       "only, 1 is a plate's own, more tumbles sooner and longer (Plate)." },
          of.Roll...);
    visit(
      OptionField{ "Spin",
                   { -1, 1 },
                   "rad",
                   "Spin about the body's normal, like a winged seed's: the pitch of a propeller "
                   "in radians; 0.05 to 0.2 spins visibly, the sign says which way (Plate)." },
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
                       "The most that a body turns from a frame to the next, in degrees: flutter "
                       "and tumbling that frames cannot show are slowed to it. 0: by the body's "
                       "width, so that an eye can follow; narrow bodies turn as wider ones do." },
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
