// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/StageInputs.h"

#include "Base/NumberText.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Blocks.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Pipeline/StageExecution.h"

#include <vtkAlgorithm.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObject.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <cmath>
#include <utility>

using Sddp = vtkStreamingDemandDrivenPipeline;

namespace waft
{
namespace
{

std::string ListText(const std::vector<std::string>& parts)
{
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 < parts.size() ? ", " : " and ") + parts[i];
  }
  return text;
}

bool IsNeeded(const StageInput& port)
{
  return port.Connections == StageInput::Number::One || port.Connections == StageInput::Number::Any;
}

/// What is said of inputs that a stage cannot do without and has not; empty where it has all.
std::string LackingInputs(vtkInformationVector** inputs, const StageInputs& ports)
{
  std::vector<std::string> lacking;
  for (std::size_t port = 0; port < ports.size(); ++port)
  {
    if (IsNeeded(ports[port]) && inputs[port]->GetNumberOfInformationObjects() == 0)
    {
      lacking.emplace_back(ports[port].Name);
    }
  }
  return lacking.empty() ? "" : ListText(lacking) + ": expected an input, found none";
}

/// The inputs of one request, with other data objects where a port takes them otherwise.
class TakenInputs
{
public:
  TakenInputs(vtkInformationVector** given, const StageInputs& ports);
  Result Take(const StageInputs& ports);
  vtkInformationVector** Get() { return this->Raw.data(); }

private:
  // Those that are ours. Of the pipeline's own no reference is taken: with each that is given back
  // VTK looks for rings of references in the whole pipeline, at each request of each frame.
  std::vector<vtkSmartPointer<vtkInformationVector>> Vectors;
  std::vector<vtkInformationVector*> Raw;
};

TakenInputs::TakenInputs(vtkInformationVector** given, const StageInputs& ports) :
  Raw(given, given + ports.size())
{
}

template <class Data>
Result Replace(Result (*as)(vtkDataObject*, const std::string&, vtkSmartPointer<Data>&),
               const char* owner, vtkDataObject* data, vtkSmartPointer<vtkDataObject>& taken)
{
  if (Data::SafeDownCast(data) != nullptr && vtkCompositeDataSet::SafeDownCast(data) == nullptr)
  {
    return Result::Ok();
  }
  vtkSmartPointer<Data> found;
  WAFT_RETURN_IF_FAILED(as(data, owner, found));
  taken = found;
  return Result::Ok();
}

// `taken` stays empty where the data are what the port takes.
Result TakeAs(const StageInput& port, vtkDataObject* data, vtkSmartPointer<vtkDataObject>& taken)
{
  switch (port.Takes)
  {
    case StageInput::Type::Surface:
      return Replace(&OneSurface, port.Name, data, taken);
    case StageInput::Type::Merged:
      return Replace(&MergedSurface, port.Name, data, taken);
    case StageInput::Type::Image:
      return Replace(&OneImage, port.Name, data, taken);
    case StageInput::Type::Blocks:
      return Replace(&ListOfBlocks, port.Name, data, taken);
    case StageInput::Type::Surfaces:
    {
      std::vector<vtkPolyData*> all;
      WAFT_RETURN_IF_FAILED(SurfacesOf(data, port.Name, all));
      return all.size() > 1 ? Result::Ok() : Replace(&OneSurface, port.Name, data, taken);
    }
    case StageInput::Type::Anything:
      break;
  }
  return Result::Ok();
}

// All ports are looked at: where one fails the others are as they are taken, all the same.
Result TakenInputs::Take(const StageInputs& ports)
{
  Result result = Result::Ok();
  for (std::size_t port = 0; port < ports.size(); ++port)
  {
    for (int i = 0; i < this->Raw[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkDataObject* data = vtkDataObject::GetData(this->Raw[port], i);
      vtkSmartPointer<vtkDataObject> taken;
      const Result own = data != nullptr ? TakeAs(ports[port], data, taken) : Result::Ok();
      result = result ? own : result;
      if (taken == nullptr)
      {
        continue;
      }
      if (data->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP()))
      {
        taken->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(),
                                     data->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()));
      }
      vtkNew<vtkInformationVector> ownVector;
      ownVector->Copy(this->Raw[port], 1); // each information object is a copy, the data are not
      ownVector->GetInformationObject(i)->Set(vtkDataObject::DATA_OBJECT(), taken);
      this->Vectors.emplace_back(ownVector.Get());
      this->Raw[port] = ownVector.Get();
    }
  }
  return result;
}

// The field data array of this name of the input `first`, else of the first other that has it.
vtkAbstractArray* FindField(vtkAlgorithm* stage, vtkInformationVector** inputs, int first,
                            const char* name)
{
  for (int at = -1; at < stage->GetNumberOfInputPorts(); ++at)
  {
    const int port = at < 0 ? first : at;
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkDataObject* data = vtkDataObject::GetData(inputs[port], i);
      const bool isPlain = data != nullptr && !data->IsA("vtkMultiBlockDataSet");
      vtkAbstractArray* array = isPlain ? data->GetFieldData()->GetAbstractArray(name) : nullptr;
      if (array != nullptr)
      {
        return array;
      }
    }
  }
  return nullptr;
}

// The frames of the first input with even time steps from 0 on.
bool TimelineOfSteps(vtkAlgorithm* stage, vtkInformationVector** inputs, Timeline& line)
{
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      const int steps = input->Length(Sddp::TIME_STEPS());
      const double* times = steps > 1 ? input->Get(Sddp::TIME_STEPS()) : nullptr;
      const double step = steps > 1 ? (times[steps - 1] - times[0]) / (steps - 1) : 0.0;
      bool isEven = step > 0.0 && times[0] == 0.0;
      for (int k = 1; isEven && k < steps; ++k)
      {
        isEven = std::abs(times[k] - k * step) < 1e-6 * step * steps;
      }
      if (isEven)
      {
        line = Timeline{ steps, 1.0 / step };
        return true;
      }
    }
  }
  return false;
}

} // namespace

StageInputs InputsOf(ChainStage stage)
{
  StageInputs inputs;
  for (const ChainInput& input : TraitsOf(stage).Inputs)
  {
    inputs.push_back({ input.Name, input.Takes, input.Connections });
  }
  return inputs;
}

int FillOutput(ChainStage stage, int port, vtkInformation* info)
{
  const ChainPort& given = TraitsOf(stage).Outputs[static_cast<std::size_t>(port)];
  info->Set(vtkDataObject::DATA_TYPE_NAME(), DataTypeOf(given.Gives));
  return 1;
}

int FillInput(const StageInputs& ports, int port, vtkInformation* info)
{
  const StageInput::Number number = ports[static_cast<std::size_t>(port)].Connections;
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  // VTK itself would say of one that is not there, at each request, the number of its port.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  if (number == StageInput::Number::Any || number == StageInput::Number::AnyOrNone)
  {
    info->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  }
  return 1;
}

int GuardedRequest(vtkAlgorithm* stage, vtkInformation* request, vtkInformationVector** inputs,
                   vtkInformationVector* outputs, const StageInputs& ports,
                   const std::vector<PropertyRange>& properties,
                   const std::function<int(vtkInformationVector** inputs)>& process)
{
  return GuardedRequest(
    stage, request, outputs, properties,
    [&]
    {
      const bool isForData = request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()) != 0;
      if (const std::string lack = LackingInputs(inputs, ports); !lack.empty())
      {
        return isForData ? Fail(stage, outputs, lack)
               : request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION())
                 ? FailInformation(outputs)
                 : 1;
      }
      TakenInputs taken(inputs, ports);
      if (isForData || request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
      {
        const Result result = taken.Take(ports);
        if (isForData && !result)
        {
          request->Remove(Sddp::CONTINUE_EXECUTING());
          return Fail(stage, outputs, result.Message());
        }
      }
      return process(taken.Get());
    });
}

Result SceneOfInputs(vtkAlgorithm* stage, vtkInformationVector** inputs, int port, SceneInfo& info,
                     std::set<std::string>& lacking)
{
  lacking.clear();
  vtkNew<vtkFieldData> fields;
  // Without another one air, sides and end are as elsewhere.
  const std::set<std::string> needed = { names::Bounds, names::NumberOfFrames,
                                         names::FramesPerSecond, names::Seed };
  for (const char* name :
       { names::Bounds, names::NumberOfFrames, names::FramesPerSecond, names::AirDensity,
         names::Open, names::Breeze, names::Loops, names::Seed })
  {
    if (vtkAbstractArray* array = FindField(stage, inputs, port, name))
    {
      fields->AddArray(array);
    }
    else if (needed.count(name) > 0)
    {
      lacking.insert(name);
    }
  }
  if (lacking.count(names::NumberOfFrames) > 0 && lacking.count(names::FramesPerSecond) > 0 &&
      TimelineOfSteps(stage, inputs, info.Time))
  {
    lacking.erase(names::NumberOfFrames);
    lacking.erase(names::FramesPerSecond);
  }
  return SceneInfoFromFieldData(fields, info);
}

std::string DefaultsText(const std::set<std::string>& lacking, const SceneInfo& info)
{
  const std::pair<const char*, std::string> all[] = {
    { names::Bounds,
      "a volume from " + PointText(info.Bounds.Min) + " to " + PointText(info.Bounds.Max) + " m" },
    { names::NumberOfFrames, std::to_string(info.Time.NumberOfFrames) + " frames" },
    { names::FramesPerSecond, NumberText(info.Time.FramesPerSecond) + " a second" },
    { names::Seed, "seed " + std::to_string(info.Seed) },
  };
  std::vector<std::string> absent, taken;
  for (const auto& [name, text] : all)
  {
    if (lacking.count(name) > 0)
    {
      absent.push_back(std::string("`") + name + "`");
      taken.push_back(text);
    }
  }
  return absent.empty()
           ? ""
           : "no input has the field data " + ListText(absent) + ": taken are " + ListText(taken);
}

} // namespace waft
