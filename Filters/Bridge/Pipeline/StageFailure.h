// SPDX-License-Identifier: BSD-3-Clause
// What a stage does when it fails: it is done, and all after it is silent.
//
// A stage that fails says why in one sentence, once, leaves its outputs empty and marks them with
// that sentence (field data `Failure`). To the pipeline it has executed: it does so again when a
// property or an input has changed, and not at each port and time that somebody asks for. A stage
// with such an input does not run; its outputs are empty and have the same mark, and it says
// nothing. In both the progress text is the sentence until the stage runs well again.
#pragma once

#include <string>

class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace waft
{

/// Leaves every output empty; returns 1 for RequestData to return.
int Empty(vtkInformationVector* outputs);

/// Reports an error of the stage, unless it has said so since anything changed last, and leaves
/// every output empty and marked; returns 1 for RequestData to return.
int Fail(vtkAlgorithm* stage, vtkInformationVector* outputs, const std::string& message);

/// In RequestInformation, of what RequestData will report: the outputs have no times, and pictures
/// no extent. So has what comes after it. Returns 1.
int FailInformation(vtkInformationVector* outputs);
bool HasNoInformation(vtkInformation* output);
void RemoveTimes(vtkInformationVector* outputs);

/// At the beginning of RequestData: true when an input is one of a stage that failed, and this one
/// has given up as well. Not of several ranks, where all of them must find it.
bool HasFailedInput(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector* outputs);

/// What is reported of an earlier failure is over, in a request for information or for data.
void ForgetFailure(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector* outputs);

/// Whether the last execution failed, the stage's own or one before it.
bool HasFailed(vtkAlgorithm* stage);

} // namespace waft
