// SPDX-License-Identifier: BSD-3-Clause
// The bodies of a run and the air about them as other ranks have them, by what the first one tells.
#pragma once

#include "Air/Run/AirState.h"
#include "Base/StateArchive.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace waft
{

/// What a body has of its own beside what SetUpBodies gives it.
struct BodyState
{
  std::vector<Vec3> Path;
  std::vector<int> TouchDowns, LiftOffs; // one a landing that a row asks for
  std::vector<Constraint> LandedFreely;  // one, or none
  std::vector<Vec3> Slips;               // of its poses; or empty

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Path...);
    visit(of.TouchDowns...);
    visit(of.LiftOffs...);
    visit(of.LandedFreely...);
    visit(of.Slips...);
  }
};

/// Without slips, which no task changes.
BodyState StateOf(const BodyProblem& body, const std::vector<Vec3>& path);
/// A body with the state but for its slips; the path is given.
void SetState(BodyState state, BodyProblem& body, std::vector<Vec3>& path);

/// For AirElsewhere of all other ranks. What goes with the whole run is told once. True: they have
/// another air; SendAir is to follow.
[[nodiscard]] bool TellRun(const AirContext& run, const HalfSeries& air, const AirBodies& bodies,
                           StateArchive& stream);
/// To all other ranks, from where it is to where it will be: it is by far the largest of all.
void SendAir(const HalfSeries& air, Communicator& ranks);

/// On another rank, from job to job.
class AirElsewhere
{
public:
  /// What the first rank tells and the air that may follow, before anything else is asked for.
  Result Hear(StateArchive& stream, const ParallelFor& parallel);
  const AirContext& Run() const;
  const HalfSeries& Air() const { return this->Series; }
  AirBodies& Bodies();

  explicit AirElsewhere(Communicator& ranks);
  ~AirElsewhere();
  AirElsewhere(const AirElsewhere&) = delete;
  void operator=(const AirElsewhere&) = delete;

private:
  struct Heard;
  Communicator& Ranks;
  std::unique_ptr<Heard> Now;
  HalfSeries Series;
  std::uint64_t Sum = 0; // of the series
};

} // namespace waft
