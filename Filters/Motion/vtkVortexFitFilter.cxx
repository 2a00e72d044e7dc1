// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVortexFitFilter.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Chain/Motion.h"
#include "Vortex/AirVortexFit.h"
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

namespace
{

enum InputPort
{
  TracksPort,
  PriorsPort,
  NumberOfInputs
};

enum OutputPort
{
  VorticesPort,
  ExplainedPort,
  NumberOfOutputs
};

const waft::StageInputs Inputs = waft::InputsOf(waft::ChainStage::VortexFit);

} // namespace

struct vtkVortexFitFilter::Internals : waft::KeptStage
{
  vtkVortexFitFilter* Self;

  explicit Internals(vtkVortexFitFilter* self) : KeptStage(self, TracksPort), Self(self) {}
  waft::VortexFitOptions Options() const;
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  waft::Result Adopt(vtkInformationVector** inputs, const waft::Scene& scene,
                     const waft::Motion& motion) override;
  void KeepForces(vtkPolyData* input, const std::vector<waft::Track>& tracks,
                  const std::vector<waft::Vortex>& fitted);
};

waft::VortexFitOptions vtkVortexFitFilter::Internals::Options() const
{
  auto options = waft::OptionsOf<waft::VortexFitOptions>(*this->Self);
  options.Bounds = this->Scene.Bounds;
  for (double* deviation :
       { &options.CenterDeviation, &options.AxisDeviation, &options.StrengthDeviation,
         &options.TimeDeviation, &options.ShapeDeviation })
  {
    *deviation *= this->Self->PriorFreedom;
  }
  return options;
}

waft::Result vtkVortexFitFilter::Internals::Run(vtkInformationVector** inputs,
                                                waft::Monitor& monitor)
{
  if (!(this->Self->PriorFreedom > 0.0) || !std::isfinite(this->Self->PriorFreedom))
  {
    return waft::Result::Error("PriorFreedom: expected a number above 0");
  }
  vtkPolyData* input = vtkPolyData::GetData(inputs[TracksPort]);
  std::vector<waft::Track> tracks;
  WAFT_RETURN_IF_FAILED(waft::TracksFromPolyData(input, tracks, "Input"));
  std::vector<waft::Vortex> priors;
  if (vtkPolyData* lines = vtkPolyData::GetData(inputs[PriorsPort]))
  {
    WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(lines, priors));
  }
  const waft::VortexFitOptions options = this->Options();
  waft::AirVortexFit found;
  waft::Result result = waft::Result::Ok();
  if (options.Quantity == AirAcceleration)
  {
    result = waft::FitAirVortices(tracks, this->Scene.Time, priors, options, monitor, found);
    WAFT_RETURN_IF_FAILED(waft::TakeAirAccelerations(this->Scene.Time, tracks));
  }
  else
  {
    std::vector<waft::VortexSample> samples;
    WAFT_RETURN_IF_FAILED(
      waft::SamplesFromTracks(tracks, this->Scene.Time, this->Self->SubtractWind, samples));
    result = waft::FitVortices(samples, priors, options, monitor, found.Vortices);
  }
  if (result)
  {
    auto* kept = this->Kept<vtkPolyData>(VorticesPort);
    if (options.Quantity == AirAcceleration)
    {
      waft::AirVortexFitToPolyData(found, this->Scene, kept);
    }
    else
    {
      waft::VorticesToPolyData(found.Vortices, this->Scene, kept);
    }
    this->KeepForces(input, tracks, found.Vortices);
  }
  return result;
}

waft::Result vtkVortexFitFilter::Internals::Adopt(vtkInformationVector** inputs, const waft::Scene&,
                                                  const waft::Motion& motion)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[TracksPort]);
  std::vector<waft::Track> tracks;
  WAFT_RETURN_IF_FAILED(waft::TracksFromPolyData(input, tracks, "Input"));
  WAFT_RETURN_IF_FAILED(waft::TakeAirAccelerations(this->Scene.Time, tracks));
  waft::AirVortexFitToPolyData(motion.Fit, this->Scene, this->Kept<vtkPolyData>(VorticesPort));
  this->KeepForces(input, tracks, motion.Fit.Vortices);
  return waft::Result::Ok();
}

void vtkVortexFitFilter::Internals::KeepForces(vtkPolyData* input,
                                               const std::vector<waft::Track>& tracks,
                                               const std::vector<waft::Vortex>& fitted)
{
  const auto count = static_cast<std::size_t>(input->GetNumberOfPoints());
  std::vector<waft::Vec3> explained(count, waft::Vec3::Zero());
  std::vector<waft::Vec3> residual(count, waft::Vec3::Zero());
  vtkNew<vtkIdList> line;
  for (std::size_t t = 0; t < tracks.size(); ++t)
  {
    const std::vector<waft::Vec3> forces = waft::VortexForces(tracks[t], fitted, this->Scene.Time);
    input->GetCellPoints(static_cast<vtkIdType>(t), line);
    for (std::size_t k = 0; k < forces.size(); ++k)
    {
      const auto point = static_cast<std::size_t>(line->GetId(static_cast<vtkIdType>(k)));
      explained[point] = forces[k];
      residual[point] = tracks[t].Forces[k] - forces[k];
    }
  }
  auto* kept = this->Kept<vtkPolyData>(ExplainedPort);
  kept->ShallowCopy(input);
  waft::AddVectors(kept->GetPointData(), waft::names::VortexForce, explained);
  waft::AddVectors(kept->GetPointData(), waft::names::ResidualForce, residual);
}

vtkVortexFitFilter::vtkVortexFitFilter() : Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::VortexFitOptions>(*this);
  this->SetNumberOfInputPorts(NumberOfInputs);
  this->SetNumberOfOutputPorts(NumberOfOutputs);
}

vtkVortexFitFilter::~vtkVortexFitFilter() = default;

double vtkVortexFitFilter::InRange(const char* property, double value)
{
  return waft::InRange<waft::VortexFitOptions>(property, value);
}

waft::KeptStage& vtkVortexFitFilter::Kept()
{
  return *this->Impl;
}

int vtkVortexFitFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(Inputs, port, info);
}

vtkTypeBool vtkVortexFitFilter::ProcessRequest(vtkInformation* request,
                                               vtkInformationVector** inputs,
                                               vtkInformationVector* outputs)
{
  std::vector<waft::PropertyRange> ranges = waft::RangesOf<waft::VortexFitOptions>(*this);
  ranges.emplace_back("PriorFreedom", this->PriorFreedom, waft::limits::Around0(1e9));
  return waft::GuardedRequest(this, request, inputs, outputs, Inputs, ranges,
                              [&](vtkInformationVector** taken) {
                                return this->Superclass::ProcessRequest(request, taken, outputs);
                              });
}

int vtkVortexFitFilter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                           vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  return 1;
}

int vtkVortexFitFilter::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                    vtkInformationVector* outputs)
{
  return this->Impl->RequestData(request, inputs, outputs);
}

void vtkVortexFitFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::VortexFitOptions>(os, indent, *this);
  os << indent << "SubtractWind: " << this->SubtractWind << "\n";
  os << indent << "PriorFreedom: " << this->PriorFreedom << "\n";
}
