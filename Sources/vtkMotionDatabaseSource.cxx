// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionDatabaseSource.h"

#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/SlicedStage.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Database/DatabaseBuild.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkTable.h>

#include <chrono>
#include <vector>

vtkStandardNewMacro(vtkMotionDatabaseSource);

namespace
{

/// A monitor with an end in time.
class TimedMonitor : public waft::Monitor
{
public:
  /// limit: s; 0: none.
  TimedMonitor(waft::Monitor& whole, double limit) : Whole(whole), Limit(limit) {}
  bool Tick(double fraction, const std::string& text) override
  {
    const std::chrono::duration<double> passed = Clock::now() - this->Start;
    return this->Whole.Tick(fraction, text) && (this->Limit <= 0.0 || passed.count() < this->Limit);
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
  waft::Monitor& Whole;
  double Limit;
};

enum DatabaseOutput
{
  DatabasePort,
  CoveragePort
};

} // namespace

struct vtkMotionDatabaseSource::Internals : waft::KeptStage
{
  vtkMotionDatabaseSource* Self;

  explicit Internals(vtkMotionDatabaseSource* self) :
    KeptStage(self, waft::FieldSweep::NoPort), Self(self)
  {
  }
  ~Internals() override { this->Discard(); }
  double Slice() const override { return this->Self->Slice; }
  bool HasTime() const override { return false; }
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
};

waft::Result vtkMotionDatabaseSource::Internals::Run(vtkInformationVector**, waft::Monitor& monitor)
{
  auto options = waft::OptionsOf<waft::DatabaseOptions>(*this->Self);
  options.SimulationsAtOnce = waft::ItemsAtOnce();
  TimedMonitor timed(monitor, this->Self->TimeLimit);
  waft::ControllerCommunicator ranks(this->Self->Controller);
  waft::MotionDatabase database;
  std::vector<waft::CoveragePoint> coverage;
  const waft::Result result =
    waft::BuildDatabase(options, ranks, waft::SmpFor(), timed, database, coverage);
  this->Rejoin();
  if (result && !database.Segments.empty())
  {
    waft::DatabaseToMultiBlock(database, this->KeptStage::Kept<vtkMultiBlockDataSet>(DatabasePort));
    waft::CoverageToTable(coverage, this->KeptStage::Kept<vtkTable>(CoveragePort));
  }
  return result;
}

vtkMotionDatabaseSource::vtkMotionDatabaseSource() : Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::DatabaseOptions>(*this);
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
}

vtkMotionDatabaseSource::~vtkMotionDatabaseSource() = default;

void vtkMotionDatabaseSource::SetController(vtkMultiProcessController* controller)
{
  this->Controller = controller; // which changes no byte of what comes out
}

vtkMultiProcessController* vtkMotionDatabaseSource::GetController()
{
  return this->Controller;
}

double vtkMotionDatabaseSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::DatabaseOptions>(property, value);
}

int vtkMotionDatabaseSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkMultiBlockDataSet" : "vtkTable");
  return 1;
}

vtkTypeBool vtkMotionDatabaseSource::ProcessRequest(vtkInformation* request,
                                                    vtkInformationVector** inputs,
                                                    vtkInformationVector* outputs)
{
  std::vector<waft::PropertyRange> ranges =
    waft::RangesOf<waft::DatabaseOptions, waft::SliceOptions>(*this);
  ranges.emplace_back("TimeLimit", this->TimeLimit, waft::limits::UpTo(1e9));
  return waft::GuardedRequest(
    this, request, outputs, ranges,
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkMotionDatabaseSource::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs)
{
  return this->Impl->RequestData(request, inputs, outputs);
}

waft::KeptStage& vtkMotionDatabaseSource::Kept()
{
  return *this->Impl;
}

WaftSlicesOf(vtkMotionDatabaseSource);

void vtkMotionDatabaseSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::DatabaseOptions, waft::SliceOptions>(os, indent, *this);
  os << indent << "TimeLimit: " << this->TimeLimit << " s\n";
}
