// SPDX-License-Identifier: BSD-3-Clause
// What the input ports of a stage take, said once a stage: a table of StageInput, which
// FillInputPortInformation and GuardedRequest are given.
//
// To VTK every port takes any data object, or none. Where a port said another type, VTK's executive
// would run the stage once for each block of composite data, with the outputs put side by side, and
// ends the process when the stage pulls its inputs over time. So a type is looked at here, by the
// input's name, and a stage is handed what its port takes whether that came by itself or in blocks;
// one that is needed and not there is told by its name as well.
#pragma once

#include "Base/Result.h"
#include "Base/Types.h"
#include "Bridge/Pipeline/PropertyCheck.h"
#include "Chain/ChainTable.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace waft
{

struct StageInput
{
  using Type = PortData;
  using Number = PortNumber;

  const char* Name; // that of the proxy's property
  Type Takes;
  Number Connections = Number::One;
};

using StageInputs = std::vector<StageInput>;

/// Of a stage of the chain, as its table has them.
StageInputs InputsOf(ChainStage stage);

/// What FillInputPortInformation is; returns 1.
int FillInput(const StageInputs& ports, int port, vtkInformation* info);
/// What FillOutputPortInformation is of a stage of the chain; returns 1.
int FillOutput(ChainStage stage, int port, vtkInformation* info);

/// GuardedRequest of a stage with inputs. `process` gets the input vectors, with the data as their
/// ports take them where it asks for information or data; data that a port does not take fail.
int GuardedRequest(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector** inputs,
                   vtkInformationVector* outputs, const StageInputs& ports,
                   const std::vector<PropertyRange>& properties,
                   const std::function<int(vtkInformationVector** inputs)>& process);

/// The scene of a stage: the field data of the input `port`, and what they lack from the other
/// inputs in their order, lists of blocks left out; a time line that none has from the time steps
/// of the first that has even ones. `lacking`: names of the field data that no input has, for which
/// info keeps what it had.
Result SceneOfInputs(vtkAlgorithm* stage, vtkInformationVector** inputs, int port, SceneInfo& info,
                     std::set<std::string>& lacking);
/// A sentence on what no input says and what is taken for it; empty when nothing is lacking.
std::string DefaultsText(const std::set<std::string>& lacking, const SceneInfo& info);

} // namespace waft
