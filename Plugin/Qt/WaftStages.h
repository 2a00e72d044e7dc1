// SPDX-License-Identifier: BSD-3-Clause
// The stages of the window's sources that can work beside it, as the client sees them.
#pragma once

#include <QPointer>
#include <QString>

#include <vector>

class pqPipelineSource;
class vtkSMProxy;

namespace waft
{

/// Those of the window's sources that have shown the motion so far. An update lets events through,
/// which may remove a source.
using Stages = std::vector<QPointer<pqPipelineSource>>;
Stages UnfinishedStages();

/// A source, where it can, is to show what there is so far after a short while of work, which goes
/// on beside.
void WorkInSlices(vtkSMProxy* source);

/// What stages say of their work, all together.
struct WorkOfStages
{
  bool IsBeside = false; // one goes on by itself
  bool IsHeld = false;
  bool HasArrived = false; // one has come to its end
  QString Message;
  double Done = 0.0;         // 0 to 1
  double SecondsLeft = -1.0; // below 0: not known yet
};
WorkOfStages WorkOf(const Stages& stages);

/// Those that go on by themselves wait.
void HoldWork(const Stages& stages);

/// Brings them up to date with what their work has come to, at a time of the session [s].
void UpdateStages(const Stages& stages, double time);

} // namespace waft
