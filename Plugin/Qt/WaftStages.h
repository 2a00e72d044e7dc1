// SPDX-License-Identifier: BSD-3-Clause
// The stages of the window's sources that can work in slices, as the client sees them.
#pragma once

#include <QString>

#include <vector>

class pqPipelineSource;
class vtkSMProxy;

namespace waft
{

/// Those of the window's sources that have shown the motion so far.
std::vector<pqPipelineSource*> HeldStages();

/// A source, where it can, is to show what there is so far after a short while of work.
void WorkInSlices(vtkSMProxy* source);

/// What a stage says of its work, and how much of it is done (0 to 1).
struct WorkOfStage
{
  QString Message;
  double Done = 0.0;
};
WorkOfStage WorkOf(vtkSMProxy* stage);

/// The next update of these goes on.
void GoOn(const std::vector<pqPipelineSource*>& held);

} // namespace waft
