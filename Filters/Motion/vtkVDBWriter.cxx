// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBWriter.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/VolumeData.h"
#include "Bridge/Files/FileWriting.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Volumes/VolumeOptions.h"
#include "Volumes/VolumeSeries.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <cmath>
#include <set>
#include <string>

vtkStandardNewMacro(vtkVDBWriter);

namespace
{

const char* const Ending = ".vdb";

using waft::StageInput;

const waft::StageInputs Inputs = {
  { "Input", StageInput::Type::Image },
};

} // namespace

struct vtkVDBWriter::Internals
{
  waft::StageCache Cache;
  waft::TimeSweep Sweep{ { 0 } };
  int Step = 0;
  bool Written = false;
  vtkNew<vtkImageData> Asked; // the step nearest to the time that is asked for
  double AskedDistance = 0.0;

  waft::Result WriteStep(vtkAlgorithm* stage, vtkInformationVector** inputs,
                         const std::string& fileName);
  /// Keeps the step when none before was nearer to the time.
  void Keep(vtkInformation* input, double time);
};

waft::Result vtkVDBWriter::Internals::WriteStep(vtkAlgorithm* stage, vtkInformationVector** inputs,
                                                const std::string& fileName)
{
  if (!waft::HasEnding(fileName, Ending))
  {
    return waft::WrongEnding(fileName, Ending);
  }
  vtkInformation* input = inputs[0]->GetInformationObject(0);
  vtkImageData* image = vtkImageData::GetData(input);
  waft::Volume volume;
  WAFT_RETURN_IF_FAILED(waft::VolumeFromImage(image, volume));
  waft::SceneInfo scene;
  const bool hasScene = image->GetFieldData()->HasArray("FramesPerSecond");
  double b[6];
  image->GetBounds(b);
  scene.Bounds = waft::Box{ waft::Vec3(b[0], b[2], b[4]), waft::Vec3(b[1], b[3], b[5]) };
  const int steps = input->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  scene.Time.NumberOfFrames = std::max(steps, 1);
  std::set<std::string> lacking;
  WAFT_RETURN_IF_FAILED(waft::SceneOfInputs(stage, inputs, 0, scene, lacking));
  if (steps > 1 && this->Step == 0 && lacking.count(waft::names::FramesPerSecond) > 0)
  {
    vtkWarningWithObjectMacro(stage,
                              << waft::DefaultsText({ waft::names::FramesPerSecond }, scene));
  }
  const double time = waft::TimeSweep::DataTime(input);
  const int frame =
    hasScene ? static_cast<int>(std::lround(time * scene.Time.FramesPerSecond)) : this->Step;
  const std::string path = steps > 1 ? waft::SeriesFile(fileName, frame) : fileName;
  WAFT_RETURN_IF_FAILED(waft::CheckOwn(path, waft::VolumeSign, 4096));
  return waft::WriteVolume(path, volume, scene);
}

void vtkVDBWriter::Internals::Keep(vtkInformation* input, double time)
{
  const double distance = std::abs(waft::TimeSweep::DataTime(input) - time);
  if (this->Step == 0 || distance < this->AskedDistance)
  {
    this->Asked->ShallowCopy(vtkDataObject::GetData(input));
    this->AskedDistance = distance;
  }
}

vtkVDBWriter::vtkVDBWriter() : Impl(std::make_unique<Internals>())
{
  waft::TakeDefaults<waft::VolumeWriteOptions>(*this);
}

vtkVDBWriter::~vtkVDBWriter() = default;

int vtkVDBWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(Inputs, port, info);
}

vtkTypeBool vtkVDBWriter::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs)
{
  return waft::GuardedRequest(this, request, inputs, outputs, Inputs,
                              waft::RangesOf<waft::VolumeWriteOptions>(*this),
                              [&](vtkInformationVector** taken) {
                                return this->Superclass::ProcessRequest(request, taken, outputs);
                              });
}

int vtkVDBWriter::RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                                      vtkInformationVector* outputs)
{
  const bool isCurrent = this->FileName.empty() || this->Impl->Cache.IsCurrent(this, inputs);
  if (isCurrent)
  {
    return this->Superclass::RequestUpdateExtent(request, inputs, outputs); // the time asked for
  }
  this->Impl->Sweep.RequestSteps(this, request, inputs, outputs, false);
  return 1;
}

int vtkVDBWriter::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                              vtkInformationVector* outputs)
{
  using Sddp = vtkStreamingDemandDrivenPipeline;
  Internals& impl = *this->Impl;
  vtkInformation* input = inputs[0]->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outputs);
  if (this->FileName.empty() || impl.Cache.IsCurrent(this, inputs))
  {
    output->ShallowCopy(vtkImageData::GetData(inputs[0]));
    return 1;
  }
  impl.Step = impl.Sweep.IsFirst() ? 0 : impl.Step + 1;
  impl.Written = false;
  if (impl.Sweep.HasNewStep())
  {
    if (const waft::Result written = impl.WriteStep(this, inputs, this->FileName); !written)
    {
      impl.Sweep.Reset(request);
      return waft::Fail(this, outputs, written.Message());
    }
    vtkInformation* asked = outputs->GetInformationObject(0);
    impl.Keep(input, asked->Has(Sddp::UPDATE_TIME_STEP()) ? asked->Get(Sddp::UPDATE_TIME_STEP())
                                                          : waft::TimeSweep::DataTime(input));
  }
  waft::StageMonitor monitor(this);
  const bool goesOn = monitor.Tick(impl.Sweep.Fraction(), "Writing volumes");
  if (goesOn && impl.Sweep.Continue(request))
  {
    return 1;
  }
  impl.Sweep.Reset(request);
  if (goesOn)
  {
    impl.Written = true;
    impl.Cache.MarkCurrent(this, inputs);
  }
  output->ShallowCopy(impl.Asked);
  impl.Asked->Initialize();
  return 1;
}

bool vtkVDBWriter::Write()
{
  return waft::WriteAnew(this, this->FileName, Ending, this->Impl->Written);
}

void vtkVDBWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::VolumeWriteOptions>(os, indent, *this);
}
