// SPDX-License-Identifier: BSD-3-Clause
// The stages of the window's sources that can work beside it, as the client sees them.
#pragma once

#include <QPointer>
#include <QString>

#include <cstddef>
#include <vector>

class pqPipelineSource;
class vtkSMProxy;

namespace waft
{

/// Those of the window's sources that have shown the motion so far. An update lets events through,
/// which may remove a source.
using Stages = std::vector<QPointer<pqPipelineSource>>;
Stages UnfinishedStages();

/// Whether a source is a stage whose work can go on beside; whether such a stage has nothing left
/// to do.
bool WorksInSlices(vtkSMProxy* source);
bool IsComplete(vtkSMProxy* source);

/// The window's sources that a source takes from, be it through others, itself, and those that take
/// from it; none of nullptr.
std::vector<pqPipelineSource*> RelatedTo(vtkSMProxy* source);

/// A source, where it can, is to show what there is so far after a short while of work, which goes
/// on beside.
void WorkInSlices(vtkSMProxy* source);

/// A Waft Animation whose scene was edited, and whose air, which is kept, does not take bodies to
/// their marks.
bool WantsNewAir(vtkSMProxy* source);

/// A source that is deleted, where it works in slices, ends its work and lets go of its motion: the
/// window itself may keep it until another is made.
void LetGo(vtkSMProxy* source);

/// What stages say of their work, all together.
struct WorkOfStages
{
  bool IsBeside = false; // one goes on by itself
  bool IsHeld = false;
  bool HasArrived = false; // one has come to its end
  QString Message;
  double Done = 0.0;         // 0 to 1, of all that were begun
  double SecondsLeft = -1.0; // below 0: not known yet
};
/// `begun`: how many there were, at most, since the last of them rested; those that are no more
/// are done, and those that wait for others have all before them.
WorkOfStages WorkOf(const Stages& stages, std::size_t begun);

/// Those that go on by themselves wait.
void HoldWork(const Stages& stages);

/// Brings them up to date with what their work has come to, at a time of the session [s].
void UpdateStages(const Stages& stages, double time);

} // namespace waft
