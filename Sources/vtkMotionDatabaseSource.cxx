// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionDatabaseSource.h"

#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Database/DatabaseBuild.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkTable.h>

#include <chrono>
#include <vector>

vtkStandardNewMacro(vtkMotionDatabaseSource);

namespace
{

/// Progress and abort of a stage, and an end in time.
class TimedMonitor : public waft::StageMonitor
{
public:
  /// limit: s; 0: none.
  TimedMonitor(vtkAlgorithm* stage, double limit) : StageMonitor(stage), Limit(limit) {}
  bool Tick(double fraction, const std::string& text) override
  {
    const std::chrono::duration<double> passed = Clock::now() - this->Start;
    return StageMonitor::Tick(fraction, text) &&
           (this->Limit <= 0.0 || passed.count() < this->Limit);
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
  double Limit;
};

} // namespace

struct vtkMotionDatabaseSource::Internals
{
  waft::StageCache Cache;
  vtkNew<vtkMultiBlockDataSet> Kept; // the database
  vtkNew<vtkTable> KeptCoverage;
};

vtkMotionDatabaseSource::vtkMotionDatabaseSource() : Impl(std::make_unique<Internals>())
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
  std::vector<waft::PropertyRange> ranges = waft::RangesOf<waft::DatabaseOptions>(*this);
  ranges.emplace_back("TimeLimit", this->TimeLimit, waft::limits::UpTo(1e9));
  return waft::GuardedRequest(
    this, request, outputs, ranges,
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkMotionDatabaseSource::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs)
{
  Internals& impl = *this->Impl;
  if (!impl.Cache.IsCurrent(this, inputs))
  {
    auto options = waft::OptionsOf<waft::DatabaseOptions>(*this);
    impl.Cache.Forget();
    waft::MotionDatabase database;
    std::vector<waft::CoveragePoint> coverage;
    TimedMonitor monitor(this, this->TimeLimit);
    const waft::ParallelFor parallelFor = waft::SmpFor();
    options.SimulationsAtOnce = waft::ItemsAtOnce();
    waft::ControllerCommunicator ranks(this->Controller);
    const waft::Result result =
      waft::BuildDatabase(options, ranks, parallelFor, monitor, database, coverage);
    if (!result)
    {
      return waft::Fail(this, outputs, result.Message());
    }
    if (result.IsStopped() && database.Segments.empty())
    {
      vtkMultiBlockDataSet::GetData(outputs)->Initialize();
      vtkTable::GetData(outputs, 1)->Initialize();
      return 1;
    }
    waft::DatabaseToMultiBlock(database, impl.Kept);
    waft::CoverageToTable(coverage, impl.KeptCoverage);
    if (!result.IsStopped())
    {
      impl.Cache.MarkCurrent(this, inputs);
    }
  }
  vtkMultiBlockDataSet::GetData(outputs)->ShallowCopy(impl.Kept);
  vtkTable::GetData(outputs, 1)->ShallowCopy(impl.KeptCoverage);
  return 1;
}

void vtkMotionDatabaseSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::DatabaseOptions>(os, indent, *this);
  os << indent << "TimeLimit: " << this->TimeLimit << " s\n";
}
