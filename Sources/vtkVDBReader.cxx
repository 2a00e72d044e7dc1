// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVDBReader.h"

#include "Bridge/Data/VolumeData.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Volumes/VolumeOptions.h"
#include "Volumes/VolumeSequence.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkVDBReader);

struct vtkVDBReader::Internals
{
  waft::StageCache Cache;
  waft::VolumeSequence Sequence;
  std::string Error;

  std::size_t NearestStep(double time) const
  {
    std::size_t nearest = 0;
    for (std::size_t s = 1; s < this->Sequence.NumberOfSteps(); ++s)
    {
      if (std::abs(this->Sequence.Time(s) - time) < std::abs(this->Sequence.Time(nearest) - time))
      {
        nearest = s;
      }
    }
    return nearest;
  }
};

vtkVDBReader::vtkVDBReader() : Impl(std::make_unique<Internals>())
{
  waft::TakeDefaults<waft::VolumeReadOptions>(*this);
  this->SetNumberOfInputPorts(0);
}

vtkVDBReader::~vtkVDBReader() = default;

double vtkVDBReader::InRange(const char* property, double value)
{
  return waft::InRange<waft::VolumeReadOptions>(property, value);
}

void vtkVDBReader::SetFileName(const std::string& name)
{
  this->FileName = name;
  this->Modified();
}

vtkTypeBool vtkVDBReader::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs)
{
  std::vector<waft::PropertyRange> ranges = waft::RangesOf<waft::VolumeReadOptions>(*this);
  if (this->FramesPerSecond != 0.0) // a rate that is given is one that a scene may have
  {
    ranges.emplace_back("FramesPerSecond", this->FramesPerSecond, waft::limits::FramesPerSecond);
  }
  return waft::GuardedRequest(
    this, request, outputs, ranges,
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkVDBReader::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                     vtkInformationVector* outputs)
{
  using Sddp = vtkStreamingDemandDrivenPipeline;
  Internals& impl = *this->Impl;
  vtkInformation* output = outputs->GetInformationObject(0);
  if (!this->FileName.empty() && !impl.Cache.IsCurrent(this, inputs))
  {
    impl.Error = impl.Sequence.Open(this->FileName, this->FramesPerSecond).Message();
    impl.Cache.MarkCurrent(this, inputs);
    for (const std::string& grid : impl.Sequence.LeftOut())
    {
      vtkWarningMacro(<< grid << ": left out, it is of another kind or on another lattice");
    }
  }
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  output->Set(Sddp::WHOLE_EXTENT(), extent, 6);
  output->Remove(Sddp::TIME_STEPS());
  output->Remove(Sddp::TIME_RANGE());
  if (this->FileName.empty() || !impl.Error.empty())
  {
    return 1; // RequestData says what is missing
  }
  const waft::Volume& lattice = impl.Sequence.Lattice();
  for (int axis = 0; axis < 3; ++axis)
  {
    extent[2 * axis + 1] = lattice.Dimensions[axis] - 1;
  }
  output->Set(Sddp::WHOLE_EXTENT(), extent, 6);
  output->Set(vtkDataObject::ORIGIN(), lattice.Origin.data(), 3);
  output->Set(vtkDataObject::SPACING(), lattice.Spacing.data(), 3);
  std::vector<double> times;
  for (std::size_t s = 0; s < impl.Sequence.NumberOfSteps(); ++s)
  {
    times.push_back(impl.Sequence.Time(s));
  }
  const double range[2] = { times.front(), times.back() };
  output->Set(Sddp::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
  output->Set(Sddp::TIME_RANGE(), range, 2);
  return 1;
}

int vtkVDBReader::RequestData(vtkInformation*, vtkInformationVector**,
                              vtkInformationVector* outputs)
{
  using Sddp = vtkStreamingDemandDrivenPipeline;
  const Internals& impl = *this->Impl;
  if (this->FileName.empty())
  {
    return waft::Fail(this, outputs, "FileName: expected a .vdb file, found no name");
  }
  if (!impl.Error.empty())
  {
    return waft::Fail(this, outputs, impl.Error);
  }
  vtkInformation* output = outputs->GetInformationObject(0);
  const double asked =
    output->Has(Sddp::UPDATE_TIME_STEP()) ? output->Get(Sddp::UPDATE_TIME_STEP()) : 0.0;
  const std::size_t step = impl.NearestStep(asked);
  waft::Volume volume;
  if (const waft::Result read = impl.Sequence.Read(step, volume); !read)
  {
    return waft::Fail(this, outputs, read.Message());
  }
  vtkImageData* image = vtkImageData::GetData(outputs);
  waft::VolumeToImage(volume, impl.Sequence.Scene(), image);
  image->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), impl.Sequence.Time(step));
  return 1;
}

void vtkVDBReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::VolumeReadOptions>(os, indent, *this);
}
