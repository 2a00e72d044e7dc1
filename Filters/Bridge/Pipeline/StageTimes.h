// SPDX-License-Identifier: BSD-3-Clause
// The time steps that a stage offers, and the time that it is asked for.
#pragma once

#include "Base/Types.h"

class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace waft
{

/// The number of input ports of a stage is read from it; gives all outputs the time steps of the
/// first input that has any, or whose data carry a scene's field data, else none.
void PassTimeSteps(vtkAlgorithm* stage, vtkInformationVector** inputs,
                   vtkInformationVector* outputs);
/// Gives all outputs the frames of a time line.
void SetTimeSteps(const Timeline& line, vtkInformationVector* outputs);

/// The output port that a pass serves.
int AskingPort(vtkInformation* request);
/// The time asked of an output port [s], clamped to the time line, and stamped on its data.
double RequestedTime(vtkInformationVector* outputs, int port, const Timeline& line);
/// The time asked of the output port that this pass of RequestData serves, clamped to the time
/// line, and stamped on the data of all ports. A stage of several ports that vary in time takes
/// this one: the pipeline notes after a pass that every port was made for the asking port's time,
/// and does not ask the others for that time again.
double RequestedTimeOfAll(vtkInformation* request, vtkInformationVector* outputs,
                          const Timeline& line);
/// The same as RequestedTime, as the nearest frame.
int RequestedFrame(vtkInformationVector* outputs, int port, const Timeline& line);

} // namespace waft
