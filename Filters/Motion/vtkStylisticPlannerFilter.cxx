// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStylisticPlannerFilter.h"

#include "Base/StateArchive.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/TreeData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Files/EmbeddedDatabase.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Chain/Motion.h"
#include "Planning/InputCheck.h"
#include "Planning/PlanCache.h"
#include "Planning/PlanReport.h"
#include "Planning/Takes.h"

#include <vtkCompositeDataIterator.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>

#include <algorithm>
#include <cstdint>

vtkStandardNewMacro(vtkStylisticPlannerFilter);

namespace
{

enum InputPort
{
  DatabasePort,
  ObjectsPort,
  ConstraintsPort,
  ObstaclesPort,
  GuidesPort,
};

enum OutputPort
{
  TracksPort,
  TreesPort,
  ReportPort,
  AssignedPort,
  VorticesPort,
  TakesPort,
  FlightsPort,
  ObjectReportPort,
};

} // namespace

struct vtkStylisticPlannerFilter::Internals : waft::KeptStage
{
  vtkStylisticPlannerFilter* Self;
  waft::PlanCache Memory;
  waft::MotionDatabase Database; // stays in its place, where the memory's tools look for it
  std::vector<std::pair<vtkDataObject*, vtkMTimeType>> GivenDatabase; // its blocks, and when
  bool HasEmbeddedDatabase = false;
  std::uint64_t GivenObstacles = 0; // of what Obstacles was built from
  waft::ObstacleSet Obstacles;
  std::vector<waft::MotionObject> Objects;
  waft::PlanOutput Plan;

  explicit Internals(vtkStylisticPlannerFilter* self) :
    KeptStage(self, ObjectsPort, ObstaclesPort), Self(self)
  {
    this->Fields.KeepObstacles(); // an edit of a row does not pull them again
  }
  ~Internals() override { this->Discard(); }
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  double Slice() const override { return this->Self->Slice; }
  void Publish() override;
  bool IsActive() const override { return this->Self->Active; }
  void Clear() override
  {
    this->Memory = waft::PlanCache();
    this->Plan = waft::PlanOutput();
    this->Database = waft::MotionDatabase();
    this->GivenDatabase.clear();
    this->HasEmbeddedDatabase = false;
  }
  waft::Result TakeDatabase(vtkMultiBlockDataSet* data);
  waft::Result TakeObstacles();
  void KeepPlan(const waft::PlanOutput& plan, const std::vector<waft::TakeScore>& takes);
  waft::Result Adopt(vtkInformationVector**, const waft::Scene&,
                     const waft::Motion& motion) override
  {
    this->KeepPlan(motion.Plan, motion.Takes);
    return waft::Result::Ok();
  }
};

/// Takes the database over when it is another than the last time.
waft::Result vtkStylisticPlannerFilter::Internals::TakeDatabase(vtkMultiBlockDataSet* data)
{
  if (data == nullptr)
  {
    if (!this->HasEmbeddedDatabase)
    {
      this->GivenDatabase.clear();
      // Whole, on every rank.
      WAFT_RETURN_IF_FAILED(waft::ReadEmbeddedDatabase(this->Database));
      this->HasEmbeddedDatabase = true;
    }
    return waft::Result::Ok();
  }
  this->HasEmbeddedDatabase = false;
  std::vector<std::pair<vtkDataObject*, vtkMTimeType>> given{ { data, data->GetMTime() } };
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(data->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataObject* block = leaf->GetCurrentDataObject();
    given.emplace_back(block, block->GetMTime());
  }
  if (given != this->GivenDatabase)
  {
    this->GivenDatabase.clear();
    WAFT_RETURN_IF_FAILED(waft::DatabaseFromMultiBlock(data, this->Database));
    this->GivenDatabase = std::move(given);
  }
  return waft::Result::Ok();
}

/// Builds and checks the obstacles when they are others than the last time.
waft::Result vtkStylisticPlannerFilter::Internals::TakeObstacles()
{
  if (this->Fields.HoldsObstacles())
  {
    return waft::Result::Ok();
  }
  std::vector<waft::ObstacleMesh> given = this->Fields.TakeObstacles();
  const std::uint64_t digest = waft::DigestOf(given);
  if (digest == this->GivenObstacles)
  {
    return waft::Result::Ok();
  }
  const waft::Result built = waft::BuildPlanObstacles(std::move(given), this->Obstacles);
  this->GivenObstacles = built ? digest : 0;
  if (!built)
  {
    this->Fields.ForgetObstacles();
  }
  return built;
}

waft::Result vtkStylisticPlannerFilter::Internals::Run(vtkInformationVector** inputs,
                                                       waft::Monitor& monitor)
{
  WAFT_RETURN_IF_FAILED(this->TakeDatabase(vtkMultiBlockDataSet::GetData(inputs[DatabasePort])));
  this->Objects.clear();
  WAFT_RETURN_IF_FAILED(
    waft::ObjectsFromPolyData(vtkPolyData::GetData(inputs[ObjectsPort]), this->Objects));
  std::vector<waft::Constraint> constraints;
  WAFT_RETURN_IF_FAILED(this->TakeConstraints(inputs[ConstraintsPort], constraints));
  WAFT_RETURN_IF_FAILED(this->TakeObstacles());
  std::vector<waft::Guide> guides;
  WAFT_RETURN_IF_FAILED(waft::GuidesFromPolyData(vtkPolyData::GetData(inputs[GuidesPort]), guides));
  waft::ControllerCommunicator ranks(this->Self->Controller);
  const waft::PlanInput input{ this->Database, this->Objects, constraints, this->Obstacles,
                               this->Scene,    guides,        &ranks };
  const auto options = waft::OptionsOf<waft::PlanOptions>(*this->Self);
  const auto choice = waft::OptionsOf<waft::TakeOptions>(*this->Self);
  waft::PlanOutput& plan = this->Plan;
  std::vector<waft::TakeScore> takes;
  const waft::Result result =
    waft::PlanTakes(input, options, choice, waft::SmpFor(), monitor, plan, takes, &this->Memory);
  this->Rejoin();
  this->Self->NumberOfPlannedObjects =
    static_cast<int>(std::count_if(plan.Objects.begin(), plan.Objects.end(),
                                   [](const waft::ObjectRow& object) { return object.IsPlanned; }));
  this->Warnings = waft::PlanRemarks(this->Database, this->Scene, plan);
  this->KeepPlan(plan, takes); // also when stopped: what was planned so far
  this->Plan = waft::PlanOutput();
  return result;
}

// What is not planned yet stands where it begins.
void vtkStylisticPlannerFilter::Internals::Publish()
{
  waft::TracksToPolyData(waft::TracksSoFar(this->Plan.Tracks, this->Objects, this->Scene.Time),
                         this->Scene, this->Kept<vtkPolyData>(TracksPort));
  waft::ConstraintsToPolyData(this->Plan.Constraints, this->Scene,
                              this->Kept<vtkPolyData>(AssignedPort));
}

void vtkStylisticPlannerFilter::Internals::KeepPlan(const waft::PlanOutput& plan,
                                                    const std::vector<waft::TakeScore>& takes)
{
  waft::TracksToPolyData(plan.Tracks, this->Scene, this->Kept<vtkPolyData>(TracksPort));
  waft::TreesToPolyData(plan.Trees, this->Scene, this->Kept<vtkPolyData>(TreesPort));
  waft::ReportToTable(plan.Report, this->Scene, this->Kept<vtkTable>(ReportPort));
  waft::AddDoubles(this->Kept<vtkTable>(ReportPort)->GetFieldData(), waft::names::TopSpeed,
                   { plan.TopSpeed });
  waft::ConstraintsToPolyData(plan.Constraints, this->Scene, this->Kept<vtkPolyData>(AssignedPort));
  waft::VorticesToPolyData(plan.Vortices, this->Scene, this->Kept<vtkPolyData>(VorticesPort));
  waft::FlightsToTable(plan.Flights, this->Scene, this->Kept<vtkTable>(FlightsPort));
  waft::ObjectRowsToTable(plan.Objects, this->Scene, this->Kept<vtkTable>(ObjectReportPort));
  waft::TakesToTable(takes, this->Scene, this->Kept<vtkTable>(TakesPort));
}

vtkStylisticPlannerFilter::vtkStylisticPlannerFilter() :
  vtkChainStageAlgorithm(waft::ChainStage::Planner), Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::PlanOptions, waft::TakeOptions>(*this);
}

vtkStylisticPlannerFilter::~vtkStylisticPlannerFilter() = default;

double vtkStylisticPlannerFilter::InRange(const char* property, double value)
{
  return waft::InRange<waft::PlanOptions, waft::TakeOptions>(property, value);
}

waft::KeptStage& vtkStylisticPlannerFilter::Kept()
{
  return *this->Impl;
}

std::vector<waft::PropertyRange> vtkStylisticPlannerFilter::Ranges() const
{
  return waft::RangesOf<waft::PlanOptions, waft::TakeOptions>(*this);
}

void vtkStylisticPlannerFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::PlanOptions, waft::TakeOptions>(os, indent, *this);
  os << indent << "NumberOfPlannedObjects: " << this->NumberOfPlannedObjects << "\n";
}
