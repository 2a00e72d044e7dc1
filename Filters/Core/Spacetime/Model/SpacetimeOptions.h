// SPDX-License-Identifier: BSD-3-Clause
// What a user sets of a run.
#pragma once

#include "Base/Result.h"
#include "Spacetime/Model/TermWeights.h"

#include <string>

namespace waft
{

inline constexpr int LeastSpacetimeFrames = 3; // that a run can move

/// Members have the defaults; the Visit templates say the rest of each field. They are three, by
/// what depends on a field.
struct SpacetimeOptions : TermWeights
{
  int NumberOfGasParticles = 2500;
  int NumberOfObjectParticles = 125;
  double SmoothingLength = 1.2;
  double CourantNumber = 0.5;
  double Viscosity = 0.2;
  double PressureExponent = 1.0;
  double EffectiveGravity = 0.8;
  double ContactDistance = -1.0;
  double WindDrag = 2.0;
  double AirDrag = 8.0;
  bool EstimateWind = true;
  bool FitVortexFields = true;
  int MaximumNumberOfVortices = 16;
  int WindCells = 5;
  double FieldRidge = 0.05;
  int Passes = 2;
  bool UseLeash = true;
  int LeashIterations = 20;
  bool MoveGas = true;
  /// A third of it on every fourth frame and in each of the last stages, two fifths in those
  /// between; see PlanSchedule.
  int MaximumNumberOfIterations = 150;
  double Tolerance = 0.01;
  int HistorySize = 6;
  int WindowLength = 0;
  double MemoryLimit = 0.0;
  double TimeLimit = 0.0; // one may break bit-equality
  bool WarmStart = true;
  double EditDuration = 1.0;
  double EditRadius = 1.0;
  std::string CheckpointFile;
  double CheckpointInterval = 10.0;

  Result Validate() const { return ValidateFields<SpacetimeOptions>(*this); }

  /// What E is made of.
  template <class Visitor, class... Holder>
  static void VisitPhysics(Visitor&& visit, Holder&... of)
  {
    TermWeights::Visit(visit, of...);
    visit(OptionField{ "NumberOfGasParticles",
                       { 64, 200000 },
                       "",
                       "Gas particles that fill the volume; they set the spacing dx." },
          of.NumberOfGasParticles...);
    visit(OptionField{ "NumberOfObjectParticles",
                       { 1, 100000 },
                       "",
                       "Particles of all objects together, shared among them, one to five each." },
          of.NumberOfObjectParticles...);
    visit(
      OptionField{ "SmoothingLength", { 0.8, 2 }, "dx", "Smoothing length h over the spacing dx." },
      of.SmoothingLength...);
    visit(OptionField{ "CourantNumber",
                       { 0.1, 1 },
                       "",
                       "Sound speed times frame step over h: how stiff the gas is." },
          of.CourantNumber...);
    visit(OptionField{ "Viscosity",
                       { 0, 2 },
                       "",
                       "Artificial viscosity alpha. The less, the sooner gas at rest stirs itself: "
                       "with 0.2 in half a minute." },
          of.Viscosity...);
    visit(
      OptionField{
        "PressureExponent", { 1, 7 }, "", "Exponent gamma of the equation of state, Eq. 12." },
      of.PressureExponent...);
    visit(OptionField{ "EffectiveGravity",
                       { 0, 20 },
                       "m/s^2",
                       "Reduced gravity of the objects in m/s^2; with it and drag they fall at "
                       "their SettlingSpeed in still air." }
            .Without("Air"),
          of.EffectiveGravity...);
    visit(OptionField{ "ContactDistance",
                       { -1, 100 },
                       "m",
                       "Distance between centres that objects keep, in metres; negative: from "
                       "their sizes; 0: none." },
          of.ContactDistance...);
    visit(OptionField{ "WindDrag",
                       { 0, 100 },
                       "1/s",
                       "Rate in 1/s with which a wind given as a velocity draws the gas." }
            .Without("Air"),
          of.WindDrag...);
    visit(
      OptionField{
        "AirDrag",
        { 0, 100 },
        "1/s",
        "Rate in 1/s with which gas that moves otherwise than a sampled air comes back to it. "
        "With less its disorder shakes the objects." }
        .With("Air"),
      of.AirDrag...);
    visit(
      FlagField(
        "EstimateWind",
        "Estimate a smooth wind from what nothing else explains, and freeze it in the prediction.")
        .Without("Air"),
      of.EstimateWind...);
    visit(FlagField("FitVortexFields", "Fit the vortices anew between the passes.").Without("Air"),
          of.FitVortexFields...);
    visit(
      OptionField{ "MaximumNumberOfVortices",
                   { 0, 1000 },
                   "",
                   "How many of the vortices that the planned paths bring stir the air, the "
                   "strongest of each place and time first; those of the scene itself always do." },
      of.MaximumNumberOfVortices...);
    visit(OptionField{ "WindCells",
                       { 2, 10 },
                       "",
                       "Cells of the estimated wind's lattice along the longest side of the "
                       "volume. With the default a solve for it takes a second, with 10 minutes "
                       "and 4 GB." }
            .Without("Air"),
          of.WindCells...);
    visit(OptionField{ "FieldRidge",
                       { 1e-6, 10 },
                       "",
                       "What an acceleration of vortices and estimated wind costs, over what "
                       "leaving as much unexplained costs." }
            .Without("Air"),
          of.FieldRidge...);
  }

  /// What else decides on the result: how E is minimised.
  template <class Visitor, class... Holder>
  static void VisitSchedule(Visitor&& visit, Holder&... of)
  {
    visit(
      OptionField{
        "Passes", { 1, 10 }, "", "Alternations of solving with estimating the force fields." }
        .Without("Air"),
      of.Passes...);
    visit(FlagField("UseLeash", "Keep every point near the planned path at first, in a ball that "
                                "grows and is then removed.")
            .Without("Air"),
          of.UseLeash...);
    visit(
      OptionField{
        "LeashIterations", { 1, 10000 }, "", "Iterations at each of the five radii of the leash." }
        .Without("Air"),
      of.LeashIterations...);
    visit(FlagField("MoveGas", "Begin with gas that moves with the planned objects; off: with gas "
                               "at rest, from which the objects are calmed rather than it stirred.")
            .Without("Air"),
          of.MoveGas...);
    visit(OptionField{ "MaximumNumberOfIterations",
                       { 1, 100000 },
                       "",
                       "Iterations at most: a third of them on every fourth frame, two fifths in "
                       "each stage on every second, a third in each on all; in a sampled air two "
                       "ninths, in one stage on all frames." },
          of.MaximumNumberOfIterations...);
    visit(
      OptionField{
        "Tolerance",
        { 0, 1 },
        "",
        "A stage ends when E fell by less than this fraction in 20 iterations; 0: never." },
      of.Tolerance...);
    visit(OptionField{ "HistorySize", { 1, 20 }, "", "Pairs that L-BFGS keeps." },
          of.HistorySize...);
    visit(OptionField{ "WindowLength",
                       { 0, 1e+06 },
                       "frames",
                       "Frames of a level that are solved at once, in windows one after the other "
                       "and in several times the time, eight or more; the others stay meanwhile." }
            .Or("all"),
          of.WindowLength...);
    visit(
      OptionField{
        "MemoryLimit",
        { 0, 1e+09 },
        "MB",
        "Megabytes that a run may take besides its input. Frames are solved in windows, in several "
        "times the time, where all at once would take more." }
        .Or("no limit"),
      of.MemoryLimit...);
  }

  /// What tells neither problems nor their solutions apart.
  template <class Visitor, class... Holder>
  static void VisitUse(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "TimeLimit",
                       { 0, 1e+09 },
                       "s",
                       "Seconds after which the best motion so far is given; 0: no limit. With a "
                       "limit two runs may differ." },
          of.TimeLimit...);
    visit(FlagField("WarmStart", "Without effect: a run begins with the tracks that it is given."),
          of.WarmStart...);
    visit(
      OptionField{
        "EditDuration", { 0, 1000 }, "s", "Without effect: after an edit all is solved again." },
      of.EditDuration...);
    visit(
      OptionField{
        "EditRadius", { 0, 1000 }, "m", "Without effect: after an edit all is solved again." },
      of.EditRadius...);
    visit(TextField("CheckpointFile",
                    "Without effect: a run that was ended is solved again from its tracks."),
          of.CheckpointFile...);
    visit(OptionField{ "CheckpointInterval",
                       { 0, 1e+06 },
                       "s",
                       "Without effect: a run that was ended is solved again from its tracks." },
          of.CheckpointInterval...);
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    VisitPhysics(visit, of...);
    VisitSchedule(visit, of...);
    VisitUse(visit, of...);
  }
};

} // namespace waft
