// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are pulled over all their time steps.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace waft
{

/// Pulls inputs over all their time steps, one pass of RequestData a step, and after the last one
/// back to the time that was asked of the stage.
///
/// All input ports, swept or not, are asked for the same step, and a stage whose result is current
/// asks for the time that is asked of itself. So after every pass all that is upstream stands at
/// one time. This matters because ports often come from one source, directly or by way of other
/// stages: a source fills all its outputs whenever one of them is asked for another time, and the
/// consumer would see the time that was asked for last.
///
/// Two passes are spared, as sources may be slow: the one back, when nobody else takes anything of
/// all that is upstream; and, once the result is current, any of a source that serves this stage
/// alone: it does not execute, and so nothing upstream of it is disturbed.
class TimeSweep
{
public:
  /// In the constructor of the stage: the input ports whose steps are seen one by one. Of the
  /// others any step will do.
  explicit TimeSweep(std::vector<int> ports) : Ports(std::move(ports)) {}
  /// In RequestUpdateExtent.
  void RequestSteps(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector** inputs,
                    vtkInformationVector* outputs, bool isCurrent);
  /// The time of the data that an input shows in this pass [s] (0 without time).
  static double DataTime(vtkInformation* input);
  bool IsFirst() const { return this->Step == 0; }
  /// False in the pass back to the time that was asked: its step was seen already.
  bool HasNewStep() const { return this->Step < this->NumberOfSteps; }
  /// Fraction of the steps that were pulled.
  double Fraction() const;
  /// In RequestData, when this step's data was taken: true when another pass was asked for.
  bool Continue(vtkInformation* request);
  /// The same, but that the pass comes with the next execution of the stage.
  bool Pause(vtkInformation* request);
  /// The steps that are left are not wanted: true when the pass back was asked for.
  bool Leave(vtkInformation* request);
  /// After a failure in the middle of a sweep.
  void Reset(vtkInformation* request);

private:
  std::vector<int> Ports;
  std::size_t Step = 0;
  std::size_t NumberOfSteps = 1;
  bool MustReturn = false; // the last step is not the one that was asked of the stage
};

/// In RequestInformation: whether the data of an output are the same at all its time steps. A
/// TimeSweep does not pull such an input over time.
void SetStandsStill(vtkInformation* output, bool standsStill);

} // namespace waft
