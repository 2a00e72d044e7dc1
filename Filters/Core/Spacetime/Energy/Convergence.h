// SPDX-License-Identifier: BSD-3-Clause
// The terms of E, and the log of how they fell: each column is named here, once.
#pragma once

#include <cmath>
#include <string>

namespace waft
{

/// E = c1 Ex + c2 Ev + c3 Ec + Penalties + Fields; each term is half a sum of squares.
struct SpacetimeTerms
{
  double E = 0.0;
  double Ex = 0.0, Ev = 0.0, Ec = 0.0;
  double Clearance = 0.0, Approach = 0.0, Contact = 0.0, Separation = 0.0; // weighted
  double Control = 0.0;                                                    // weighted
  double EvObjects = 0.0;                                                  // of Ev
  double Fields = 0.0; // of the air's fields themselves, weighted
  double E2 = 0.0;     // Eq. 2 as the paper has it
  /// Over free steps of objects: the sum of a . a, and of its product with each that makes it up.
  double Motion = 0.0, ByVortices = 0.0, ByWind = 0.0, ByGas = 0.0, ByDrag = 0.0, ByLanding = 0.0;
  /// Likewise the sum of squares of each, and of what nothing of the model gives.
  double VorticesSquared = 0.0, WindSquared = 0.0, GasSquared = 0.0, DragSquared = 0.0;
  double LandingSquared = 0.0, NoneSquared = 0.0;
  /// The five before. They are summed frame by frame, so a sum of the columns differs by rounding.
  double Penalties = 0.0;

  /// visit(member of *this...) of every number.
  template <class Visitor, class... Terms>
  static void Visit(Visitor&& visit, Terms&... of)
  {
    visit(of.E...);
    visit(of.Ex...);
    visit(of.Ev...);
    visit(of.Ec...);
    visit(of.Clearance...);
    visit(of.Approach...);
    visit(of.Contact...);
    visit(of.Separation...);
    visit(of.Control...);
    visit(of.EvObjects...);
    visit(of.Fields...);
    visit(of.E2...);
    visit(of.Motion...);
    visit(of.ByVortices...);
    visit(of.ByWind...);
    visit(of.ByGas...);
    visit(of.ByDrag...);
    visit(of.ByLanding...);
    visit(of.VorticesSquared...);
    visit(of.WindSquared...);
    visit(of.GasSquared...);
    visit(of.DragSquared...);
    visit(of.LandingSquared...);
    visit(of.NoneSquared...);
    visit(of.Penalties...);
  }
};

struct ConvergenceRow : SpacetimeTerms
{
  int Pass = 0;
  std::string Stage;
  int Iteration = 0;
  double MaxViolation = 0.0; // m
  double Leash = 0.0;        // m; 0: released
  double Seconds = 0.0;      // since RunSpacetime began
  /// Of a . a; not a number in a sampled air, and where nothing flies freely.
  double ShareVortices = 0.0, ShareWind = 0.0, ShareGas = 0.0, ShareDrag = 0.0;
  double ShareLanding = 0.0, ShareNone = 0.0;

  /// From the sums.
  void SetShares(bool inAir)
  {
    const double all = inAir || this->Motion <= 0.0 ? std::nan("") : this->Motion;
    this->ShareVortices = this->ByVortices / all;
    this->ShareWind = this->ByWind / all;
    this->ShareGas = this->ByGas / all;
    this->ShareDrag = this->ByDrag / all;
    this->ShareLanding = this->ByLanding / all;
    this->ShareNone = 1.0 - (this->ShareVortices + this->ShareWind + this->ShareGas +
                             this->ShareDrag + this->ShareLanding);
    this->E2 = inAir ? std::nan("") : this->E2;
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    SpacetimeTerms::Visit(visit, of...);
    visit(of.Pass...);
    visit(of.Stage...);
    visit(of.Iteration...);
    visit(of.MaxViolation...);
    visit(of.Leash...);
    visit(of.Seconds...);
    visit(of.ShareVortices...);
    visit(of.ShareWind...);
    visit(of.ShareGas...);
    visit(of.ShareDrag...);
    visit(of.ShareLanding...);
    visit(of.ShareNone...);
  }
};

struct ConvergenceColumn
{
  const char* Name;
  const char* Unit; // of lengths in gas spacings dx and times in frames, where it is of the solver
  const char* Meaning;
};

/// visit(column, member of ConvergenceRow) in the order of the table.
template <class Visitor>
void VisitConvergence(Visitor&& visit)
{
  using Row = ConvergenceRow;
  visit(ConvergenceColumn{ "Pass", "", "alternation of solving with estimating the fields" },
        &Row::Pass);
  visit(ConvergenceColumn{ "Stage", "", "what was done" }, &Row::Stage);
  visit(ConvergenceColumn{ "Iteration", "", "in the stage; 0: what it begins with" },
        &Row::Iteration);
  visit(ConvergenceColumn{ "E", "", "what is minimised: c1 Ex + c2 Ev + c3 Ec and the penalties" },
        &Row::E);
  visit(ConvergenceColumn{ "Ex", "dx^2", "positions against their prediction, Eq. 3" }, &Row::Ex);
  visit(ConvergenceColumn{ "Ev", "(dx/frame)^2", "velocities against their prediction, Eq. 3" },
        &Row::Ev);
  visit(ConvergenceColumn{ "Ec", "(dx/frame)^2", "velocities against their neighbours', Eq. 4" },
        &Row::Ec);
  visit(ConvergenceColumn{ "MaxViolation", "m", "largest miss of a position" }, &Row::MaxViolation);
  visit(ConvergenceColumn{ "Leash", "m", "radius of the leash; 0: released" }, &Row::Leash);
  visit(ConvergenceColumn{ "Seconds", "s", "since the run began" }, &Row::Seconds);
  visit(
    ConvergenceColumn{ "Clearance", "dx^2", "weighted: objects too near to a wall or obstacle" },
    &Row::Clearance);
  visit(ConvergenceColumn{ "Approach", "dx^2",
                           "weighted: objects too far from where they start or land" },
        &Row::Approach);
  visit(ConvergenceColumn{ "Contact", "dx^2", "weighted: objects too near to one another" },
        &Row::Contact);
  visit(ConvergenceColumn{ "Separation", "dx^2", "weighted: gas too near to gas" },
        &Row::Separation);
  visit(ConvergenceColumn{ "Control", "(dx/frame)^2",
                           "weighted: in a sampled air, jerks of what moves objects beside it" },
        &Row::Control);
  visit(ConvergenceColumn{ "EvObjects", "(dx/frame)^2", "of Ev: objects; the rest is gas" },
        &Row::EvObjects);
  visit(ConvergenceColumn{ "Fields", "(dx/frame)^2",
                           "weighted: strengths of vortices and coefficients of the wind" },
        &Row::Fields);
  visit(ConvergenceColumn{ "E2", "", "Eq. 2 alone: objects weigh as gas does" }, &Row::E2);
  visit(ConvergenceColumn{ "ShareVortices", "",
                           "of the objects' acceleration a: sum a_k . a over sum a . a in free "
                           "steps, by vortices" },
        &Row::ShareVortices);
  visit(ConvergenceColumn{ "ShareWind", "", "by the estimated and the given wind" },
        &Row::ShareWind);
  visit(ConvergenceColumn{ "ShareGas", "", "by the gas' pressure and viscosity" }, &Row::ShareGas);
  visit(ConvergenceColumn{ "ShareDrag", "", "by drag towards the air, settling within" },
        &Row::ShareDrag);
  visit(ConvergenceColumn{ "ShareLanding", "", "by the damping of landings" }, &Row::ShareLanding);
  visit(ConvergenceColumn{ "ShareNone", "", "by nothing of the model: rv / s" }, &Row::ShareNone);
}

} // namespace waft
