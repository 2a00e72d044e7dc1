// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/StageTimes.h"

#include "Bridge/Data/SceneData.h"
#include "Bridge/Pipeline/StageFailure.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace waft
{
namespace
{

using Sddp = vtkStreamingDemandDrivenPipeline;

// The time line that the data of an input carry, if any; a database or shapes have one of their
// own.
bool TimelineOf(vtkInformation* input, Timeline& line)
{
  vtkDataObject* data = vtkDataObject::GetData(input);
  if (!data || data->IsA("vtkMultiBlockDataSet") ||
      !data->GetFieldData()->HasArray("NumberOfFrames"))
  {
    return false;
  }
  SceneInfo info;
  if (!SceneInfoFromFieldData(data, info))
  {
    return false;
  }
  line = info.Time;
  return true;
}

} // namespace

void PassTimeSteps(vtkAlgorithm* stage, vtkInformationVector** inputs,
                   vtkInformationVector* outputs)
{
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      Timeline line;
      if (!input->Has(Sddp::TIME_STEPS()))
      {
        if (TimelineOf(input, line))
        {
          SetTimeSteps(line, outputs);
          return;
        }
        continue;
      }
      for (int out = 0; out < outputs->GetNumberOfInformationObjects(); ++out)
      {
        outputs->GetInformationObject(out)->CopyEntry(input, Sddp::TIME_STEPS());
        outputs->GetInformationObject(out)->CopyEntry(input, Sddp::TIME_RANGE());
      }
      return;
    }
  }
  RemoveTimes(outputs);
}

void SetTimeSteps(const Timeline& line, vtkInformationVector* outputs)
{
  std::vector<double> times;
  for (int frame = 0; frame < line.NumberOfFrames; ++frame)
  {
    times.push_back(line.Time(frame));
  }
  const double range[2] = { times.front(), times.back() };
  for (int out = 0; out < outputs->GetNumberOfInformationObjects(); ++out)
  {
    vtkInformation* output = outputs->GetInformationObject(out);
    output->Set(Sddp::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    output->Set(Sddp::TIME_RANGE(), range, 2);
  }
}

int AskingPort(vtkInformation* request)
{
  return request->Has(vtkExecutive::FROM_OUTPUT_PORT())
           ? std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT()))
           : 0;
}

double RequestedTime(vtkInformationVector* outputs, int port, const Timeline& line)
{
  vtkInformation* output = outputs->GetInformationObject(port);
  const double asked =
    output->Has(Sddp::UPDATE_TIME_STEP()) ? output->Get(Sddp::UPDATE_TIME_STEP()) : 0.0;
  const double time = std::clamp(asked, 0.0, line.Time(line.NumberOfFrames - 1));
  if (vtkDataObject* data = vtkDataObject::GetData(output))
  {
    data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
  return time;
}

double RequestedTimeOfAll(vtkInformation* request, vtkInformationVector* outputs,
                          const Timeline& line)
{
  const double time = RequestedTime(outputs, AskingPort(request), line);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    if (vtkDataObject* data = vtkDataObject::GetData(outputs->GetInformationObject(port)))
    {
      data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    }
  }
  return time;
}

int RequestedFrame(vtkInformationVector* outputs, int port, const Timeline& line)
{
  return static_cast<int>(std::lround(RequestedTime(outputs, port, line) * line.FramesPerSecond));
}

} // namespace waft
