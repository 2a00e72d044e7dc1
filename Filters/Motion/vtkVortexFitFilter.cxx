// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVortexFitFilter.h"

#include "Bridge/ArrayNames.h"
#include "Bridge/Arrays.h"
#include "Bridge/SceneData.h"
#include "Bridge/StageExecution.h"
#include "Bridge/TrackData.h"
#include "Vortex/VortexFit.h"
#include "Vortex/VortexSamples.h"

#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>

vtkStandardNewMacro(vtkVortexFitFilter);

struct vtkVortexFitFilter::Internals
{
  waft::StageCache Cache;
  waft::SceneInfo Info;
  std::vector<waft::Vortex> Fitted;
  vtkNew<vtkPolyData> Tracks;

  waft::Result Run(vtkPolyData* tracks, vtkPolyData* priors, bool subtractWind,
                   waft::VortexFitOptions options, waft::Monitor& monitor);
  void Annotate(vtkPolyData* input, const std::vector<waft::Track>& tracks);
};

waft::Result vtkVortexFitFilter::Internals::Run(vtkPolyData* input, vtkPolyData* lines,
                                                bool subtractWind, waft::VortexFitOptions options,
                                                waft::Monitor& monitor)
{
  this->Info = waft::SceneInfo();
  WAFT_RETURN_IF_FAILED(waft::SceneInfoFromFieldData(input, this->Info));
  std::vector<waft::Track> tracks;
  if (input->GetNumberOfCells() == 0)
  {
    return waft::Result::Error("Tracks: no lines, expected one polyline per object");
  }
  WAFT_RETURN_IF_FAILED(waft::TracksFromPolyData(input, tracks));
  std::vector<waft::Vortex> priors;
  if (lines)
  {
    WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(lines, priors));
  }
  std::vector<waft::VortexSample> samples;
  WAFT_RETURN_IF_FAILED(waft::SamplesFromTracks(tracks, this->Info.Time, subtractWind, samples));
  options.Bounds = this->Info.Bounds;
  this->Fitted.clear();
  const waft::Result result = waft::FitVortices(samples, priors, options, monitor, this->Fitted);
  if (result)
  {
    this->Annotate(input, tracks);
  }
  return result;
}

void vtkVortexFitFilter::Internals::Annotate(vtkPolyData* input,
                                             const std::vector<waft::Track>& tracks)
{
  const auto count = static_cast<std::size_t>(input->GetNumberOfPoints());
  std::vector<waft::Vec3> explained(count, waft::Vec3::Zero());
  std::vector<waft::Vec3> residual(count, waft::Vec3::Zero());
  vtkNew<vtkIdList> line;
  for (std::size_t t = 0; t < tracks.size(); ++t)
  {
    const std::vector<waft::Vec3> forces =
      waft::VortexForces(tracks[t], this->Fitted, this->Info.Time);
    input->GetCellPoints(static_cast<vtkIdType>(t), line);
    for (std::size_t k = 0; k < forces.size(); ++k)
    {
      const auto point = static_cast<std::size_t>(line->GetId(static_cast<vtkIdType>(k)));
      explained[point] = forces[k];
      residual[point] = tracks[t].Forces[k] - forces[k];
    }
  }
  this->Tracks->ShallowCopy(input);
  waft::AddVectors(this->Tracks->GetPointData(), waft::names::VortexForce, explained);
  waft::AddVectors(this->Tracks->GetPointData(), waft::names::ResidualForce, residual);
}

vtkVortexFitFilter::vtkVortexFitFilter() : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

vtkVortexFitFilter::~vtkVortexFitFilter() = default;

int vtkVortexFitFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkVortexFitFilter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                           vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  return 1;
}

int vtkVortexFitFilter::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                    vtkInformationVector* outputs)
{
  Internals& impl = *this->Impl;
  if (!impl.Cache.IsCurrent(this, inputs))
  {
    if (!(this->PriorFreedom > 0.0) || !std::isfinite(this->PriorFreedom))
    {
      return waft::Fail(this, outputs, "PriorFreedom: expected a number above 0");
    }
    waft::VortexFitOptions options;
    options.MaximumNewVortices = this->MaximumNewVortices;
    options.MinimumGain = this->MinimumGain;
    options.UniformBackground = this->UniformBackground;
    options.NumberOfStarts = this->NumberOfStarts;
    options.Sweeps = this->Sweeps;
    options.Seed = static_cast<std::uint64_t>(this->Seed);
    for (double* deviation :
         { &options.CenterDeviation, &options.AxisDeviation, &options.StrengthDeviation,
           &options.TimeDeviation, &options.ShapeDeviation })
    {
      *deviation *= this->PriorFreedom;
    }
    waft::StageMonitor monitor(this);
    const waft::Result result =
      impl.Run(vtkPolyData::GetData(inputs[0]), vtkPolyData::GetData(inputs[1]), this->SubtractWind,
               options, monitor);
    impl.Cache.Forget();
    if (!result)
    {
      return waft::Fail(this, outputs, result.Message());
    }
    if (!result.IsStopped())
    {
      impl.Cache.MarkCurrent(this, inputs);
    }
  }
  waft::VorticesToPolyData(impl.Fitted, impl.Info, vtkPolyData::GetData(outputs, 0));
  vtkPolyData::GetData(outputs, 1)->ShallowCopy(impl.Tracks);
  waft::RequestedTime(outputs, 0, impl.Info.Time);
  waft::RequestedTime(outputs, 1, impl.Info.Time);
  return 1;
}

void vtkVortexFitFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumNewVortices: " << this->MaximumNewVortices << "\n";
  os << indent << "MinimumGain: " << this->MinimumGain << "\n";
  os << indent << "SubtractWind: " << this->SubtractWind << "\n";
  os << indent << "UniformBackground: " << this->UniformBackground << "\n";
  os << indent << "PriorFreedom: " << this->PriorFreedom << "\n";
  os << indent << "NumberOfStarts: " << this->NumberOfStarts << "\n";
  os << indent << "Sweeps: " << this->Sweeps << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
}
