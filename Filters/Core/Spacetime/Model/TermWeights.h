// SPDX-License-Identifier: BSD-3-Clause
// Weights of the terms of E that a user sets, as the optimiser takes them.
#pragma once

#include "Base/OptionFields.h"

namespace waft
{

struct TermWeights
{
  double PositionWeight = 5.0;   // c1 of Eq. 2
  double VelocityWeight = 10.0;  // c2
  double CoherenceWeight = 0.05; // c3
  double SpatialShare = 0.5;     // c31 of Eq. 4; c32 = 1 - c31
  double ObjectCoherence = 24.0;
  double ObjectPosition = 30.0;
  int TemporalWindow = 1;  // w of Eq. 4
  double XsphFactor = 0.0; // epsilon of Eq. 10

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "PositionWeight",
                       { 1e-06, 1e+06 },
                       "",
                       "Weight c1 of Eq. 2: positions follow their prediction." },
          of.PositionWeight...);
    visit(OptionField{ "VelocityWeight",
                       { 1e-06, 1e+06 },
                       "",
                       "Weight c2 of Eq. 2: velocities follow their prediction." },
          of.VelocityWeight...);
    visit(OptionField{ "CoherenceWeight",
                       { 0, 1e+06 },
                       "",
                       "Weight c3 of Eq. 2: how much objects move with the air about them." },
          of.CoherenceWeight...);
    visit(
      OptionField{
        "SpatialShare",
        { 0, 1 },
        "",
        "Fraction c31 of neighbours in space in Eq. 4; the rest is neighbours in time." },
      of.SpatialShare...);
    visit(OptionField{ "ObjectCoherence",
                       { 0, 1e+06 },
                       "",
                       "How often the air about it counts in Eq. 4 for an object, where it counts "
                       "once for gas: objects are what is seen." }
            .Without("Air"),
          of.ObjectCoherence...);
    visit(
      OptionField{
        "ObjectPosition",
        { 0.001, 1e+06 },
        "",
        "How often the position weight counts for an object, where it counts once for gas: a step "
        "of its own beside its velocity is seen as a kink at the next mark." },
      of.ObjectPosition...);
    visit(OptionField{ "TemporalWindow", { 1, 30 }, "frames", "Frames w to either side in Eq. 4." },
          of.TemporalWindow...);
    visit(
      OptionField{ "XsphFactor", { 0, 1 }, "", "Factor epsilon of the XSPH correction, Eq. 10." },
      of.XsphFactor...);
  }
};

} // namespace waft
