// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/Motion.h"

namespace waft
{

ChainStage Motion::MovedBy() const
{
  return !this->Optimised.Tracks.empty() ? ChainStage::Spacetime
         : !this->Air.Tracks.empty()     ? ChainStage::Assimilation
                                         : ChainStage::Planner;
}

const std::vector<Track>& Motion::PathsBefore(ChainStage stage) const
{
  return stage > ChainStage::Spacetime && !this->Optimised.Tracks.empty() ? this->Optimised.Tracks
         : stage > ChainStage::Assimilation && !this->Air.Tracks.empty()  ? this->Air.Tracks
                                                                          : this->Plan.Tracks;
}

const std::vector<Track>& Motion::Paths() const
{
  return this->PathsBefore(ChainStage::Rotation);
}

const std::vector<Constraint>& Motion::RowsBefore(ChainStage stage) const
{
  return stage > ChainStage::Assimilation && !this->Air.Tracks.empty() ? this->Air.Constraints
                                                                       : this->Plan.Constraints;
}

const std::vector<Constraint>& Motion::Rows() const
{
  return this->RowsBefore(ChainStage::Rotation);
}

const std::vector<Constraint>& Motion::RowsAtLast() const
{
  return !this->Turned.Constraints.empty() ? this->Turned.Constraints : this->Air.Constraints;
}

const std::vector<ReportRow>& Motion::ReportOf(ChainStage stage) const
{
  return stage == ChainStage::Spacetime      ? this->Optimised.Report
         : stage == ChainStage::Assimilation ? this->Air.Report
                                             : this->Plan.Report;
}

} // namespace waft
