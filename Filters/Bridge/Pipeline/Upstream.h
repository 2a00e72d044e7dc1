// SPDX-License-Identifier: BSD-3-Clause
// What feeds a stage in the pipeline, and whom else that serves.
#pragma once

class vtkAlgorithm;
class vtkExecutive;
class vtkInformation;
class vtkInformationVector;

namespace waft
{

/// Null where nothing makes the input.
vtkExecutive* ProducerOf(vtkInformation* input);

/// What the stage itself says of the output that comes in.
vtkInformation* ProducedInformation(vtkInformation* input);

/// Whether nobody else takes an output of the source of this input.
bool IsOnlyConsumer(vtkAlgorithm* stage, vtkInformation* input);

/// Whether what is upstream of a stage serves others as well, which are not upstream of it.
bool HasCommonUpstream(vtkAlgorithm* stage, vtkInformationVector** inputs);

} // namespace waft
