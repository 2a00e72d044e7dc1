// SPDX-License-Identifier: BSD-3-Clause
// The chain in one call against the stages as VTK algorithms, joined by the table of the chain: the
// same bits in every quality, port by port.
#include "Base/TemporaryFolder.h"
#include "Bridge/Data/AirData.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/TreeData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Chain/RunChain.h"

#include <vtkAirAssimilationFilter.h>
#include <vtkAppendPolyData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMotionSceneReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRotationRefineFilter.h>
#include <vtkSPHSpacetimeFilter.h>
#include <vtkSmartPointer.h>
#include <vtkStylisticPlannerFilter.h>
#include <vtkTable.h>
#include <vtkVortexFitFilter.h>

#include <gtest/gtest.h>

#include <map>

using namespace waft;

namespace
{

// Marks, a rest, an orientation and one that nobody can meet; a box that moves, a wind, a vortex.
constexpr const char* Everything = R"({"waft": 1, "seed": 7, "time": {"frames": 40},
  "shapes": {"leaf": {"builtin": "maple", "size": 0.12}},
  "objects": [{"shape": "leaf", "position": [-0.4, 0.1, 1.6]},
              {"shape": "leaf", "position": [0.5, -0.2, 0.5], "velocity": [0.1, 0, 0]},
              {"shape": "leaf", "position": [0.2, 0.6, 2.4]}],
  "constraints": [{"kind": "position", "object": 0, "frame": 30, "value": [-0.1, 0.2, 1.1]},
                  {"kind": "orientation", "object": 0, "frame": 20, "value": [0.7071, 0.7071, 0, 0],
                   "radius": 0.3},
                  {"kind": "rest", "object": 1, "frame": 28, "until": 39, "value": [0.6, -0.2, 0]},
                  {"kind": "position", "object": 2, "frame": 12, "value": [1.05, 1.05, 0.4]}],
  "obstacles": [{"kind": "box", "min": [0.9, 0.9, 0], "max": [1.2, 1.2, 0.5],
                 "motion": [{"frame": 0, "position": [0, 0, 0]},
                            {"frame": 39, "position": [0.3, -0.1, 0.7]}]}],
  "winds": [{"direction": [1, 0, 0], "strength": 0.5, "center": [0, 0, 1.5], "radius": 1.0,
             "centerTime": 0.6, "duration": 0.5}],
  "vortices": [{"p1": [0.2, 0, 0.5], "p2": [0.2, 0, 2.5], "strength": 0.4, "centerTime": 0.5,
                "duration": 0.5, "coreRadius": 0.2}]})";

ChainOptions Quick(Quality quality)
{
  ChainOptions options = ChainOptions::At(quality);
  options.Air.Resolution = 16;
  options.Air.LatticeResolution = 12;
  options.Air.Rounds = 1;
  options.Air.Candidates = 2;
  options.Optimiser.NumberOfGasParticles = 216;
  options.Optimiser.LeashIterations = 2;
  options.Optimiser.MaximumNumberOfIterations = 6;
  return options;
}

/// The stages as VTK algorithms, joined as the table has it.
class Joined
{
public:
  Joined(const std::string& scene, const ChainOptions& options)
  {
    for (const ChainStageTraits& stage : ChainStages())
    {
      if (RunsAt(stage.Stage, options.Detail))
      {
        this->Stages[stage.Stage] = this->Make(stage.Stage, scene, options);
        this->Join(stage, options.Detail);
      }
    }
  }
  template <class Data>
  Data* At(ChainStage stage, const char* output, double time = 0.0)
  {
    const int port = PortOf({ stage, output });
    this->Stages[stage]->UpdateTimeStep(time, -1, 1, 0, nullptr);
    this->Stages[stage]->Update(port);
    return Data::SafeDownCast(this->Stages[stage]->GetOutputDataObject(port));
  }
  bool Has(ChainStage stage) const { return this->Stages.count(stage) > 0; }

private:
  vtkSmartPointer<vtkAlgorithm> Make(ChainStage stage, const std::string& scene,
                                     const ChainOptions& options)
  {
    const int seed = 7;
    switch (stage)
    {
      case ChainStage::Scene:
      {
        auto reader = vtkSmartPointer<vtkMotionSceneReader>::New();
        reader->SetFileName(scene);
        return reader;
      }
      case ChainStage::Planner:
      {
        auto planner = vtkSmartPointer<vtkStylisticPlannerFilter>::New();
        planner->SetSeed(seed);
        return planner;
      }
      case ChainStage::Assimilation:
      {
        auto air = vtkSmartPointer<vtkAirAssimilationFilter>::New();
        air->SetSeed(seed);
        air->SetResolution(options.Air.Resolution);
        air->SetLatticeResolution(options.Air.LatticeResolution);
        air->SetRounds(options.Air.Rounds);
        air->SetCandidates(options.Air.Candidates);
        return air;
      }
      case ChainStage::Spacetime:
      {
        auto optimiser = vtkSmartPointer<vtkSPHSpacetimeFilter>::New();
        optimiser->SetNumberOfGasParticles(options.Optimiser.NumberOfGasParticles);
        optimiser->SetLeashIterations(options.Optimiser.LeashIterations);
        optimiser->SetMaximumNumberOfIterations(options.Optimiser.MaximumNumberOfIterations);
        return optimiser;
      }
      case ChainStage::Rotation:
      {
        auto rotation = vtkSmartPointer<vtkRotationRefineFilter>::New();
        rotation->SetSeed(seed);
        return rotation;
      }
      case ChainStage::VortexFit:
      {
        auto fit = vtkSmartPointer<vtkVortexFitFilter>::New();
        fit->SetSeed(seed);
        fit->SetQuantity(options.Fit.Quantity);
        fit->SetMaximumNewVortices(options.Fit.MaximumNewVortices);
        fit->SetMinimumGain(options.Fit.MinimumGain);
        fit->SetUniformBackground(options.Fit.UniformBackground);
        return fit;
      }
    }
    return nullptr;
  }
  void Join(const ChainStageTraits& stage, Quality quality)
  {
    for (std::size_t port = 0; port < stage.Inputs.size(); ++port)
    {
      const std::vector<ChainOutput> givers = GiversOf(stage.Inputs[port], quality);
      const auto source = [this](const ChainOutput& output)
      { return this->Stages[output.Stage]->GetOutputPort(PortOf(output)); };
      if (givers.size() == 1)
      {
        this->Stages[stage.Stage]->SetInputConnection(static_cast<int>(port), source(givers[0]));
      }
      else if (givers.size() > 1)
      {
        auto all = vtkSmartPointer<vtkAppendPolyData>::New();
        for (const ChainOutput& giver : givers)
        {
          all->AddInputConnection(source(giver));
        }
        this->Appended.push_back(all);
        this->Stages[stage.Stage]->SetInputConnection(static_cast<int>(port), all->GetOutputPort());
      }
    }
  }

  std::map<ChainStage, vtkSmartPointer<vtkAlgorithm>> Stages;
  std::vector<vtkSmartPointer<vtkAlgorithm>> Appended;
};

const MotionDatabase& EmbeddedDatabase()
{
  static const MotionDatabase database = []
  {
    vtkNew<vtkMultiBlockDataSet> data;
    MotionDatabase read;
    EXPECT_TRUE(ReadBlocksFile(WAFT_SOURCE_DIR "/Data/Database/embedded.vtm", data));
    EXPECT_TRUE(DatabaseFromMultiBlock(data, read));
    return read;
  }();
  return database;
}

/// Fails where an array or the points of one differ from those of the other in a bit. Clocks tell
/// of the machine.
void ExpectSame(vtkFieldData* ours, vtkFieldData* wanted, const std::string& what)
{
  ASSERT_EQ(ours->GetNumberOfArrays(), wanted->GetNumberOfArrays()) << what;
  for (int i = 0; i < wanted->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* theirs = wanted->GetAbstractArray(i);
    const std::string name = theirs->GetName();
    vtkAbstractArray* own = ours->GetAbstractArray(theirs->GetName());
    ASSERT_NE(own, nullptr) << what << ": " << name;
    ASSERT_EQ(own->GetNumberOfValues(), theirs->GetNumberOfValues()) << what << ": " << name;
    for (vtkIdType k = 0; k < theirs->GetNumberOfValues() && name != "Seconds"; ++k)
    {
      ASSERT_EQ(own->GetVariantValue(k), theirs->GetVariantValue(k))
        << what << ": " << name << " " << k;
    }
  }
}

void ExpectSame(vtkTable* ours, vtkTable* wanted, const std::string& what)
{
  ExpectSame(ours->GetRowData(), wanted->GetRowData(), what);
}

void ExpectSame(vtkDataSet* ours, vtkDataSet* wanted, const std::string& what)
{
  ASSERT_EQ(ours->GetNumberOfPoints(), wanted->GetNumberOfPoints()) << what;
  for (vtkIdType i = 0; i < wanted->GetNumberOfPoints(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_EQ(ours->GetPoint(i)[c], wanted->GetPoint(i)[c]) << what << ": point " << i;
    }
  }
  ExpectSame(ours->GetPointData(), wanted->GetPointData(), what);
}

} // namespace

class ChainFaces : public testing::TestWithParam<Quality>
{
};

TEST_P(ChainFaces, OneCallGivesWhatJoinedStagesGive)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.Write("scene.waft.json", Everything);
  const ChainOptions options = Quick(GetParam());
  Joined joined(file, options);

  Scene scene;
  SceneWind wind;
  const Result read = ReadSceneAndWind(file, VtkSceneAssets(), scene, wind);
  ASSERT_TRUE(read) << read.Message();
  Motion motion;
  SilentMonitor monitor;
  const Result result =
    RunChain({ scene, wind, EmbeddedDatabase() }, options, SmpFor(), monitor, motion);
  ASSERT_TRUE(result) << result.Message();
  EXPECT_FALSE(motion.IsStopped);

  vtkNew<vtkPolyData> data;
  vtkNew<vtkTable> table;
  vtkNew<vtkImageData> image;
  const SceneInfo& info = scene.Info;
  TracksToPolyData(motion.Plan.Tracks, info, data);
  ExpectSame(data, joined.At<vtkPolyData>(ChainStage::Planner, "Tracks"), "plan");
  ConstraintsToPolyData(motion.Plan.Constraints, info, data);
  ExpectSame(data, joined.At<vtkPolyData>(ChainStage::Planner, "Constraints"), "planned rows");
  ReportToTable(motion.Plan.Report, info, table);
  ExpectSame(table, joined.At<vtkTable>(ChainStage::Planner, "Report"), "planned report");
  EXPECT_EQ(joined.Has(ChainStage::Assimilation), !motion.Air.Tracks.empty());
  if (joined.Has(ChainStage::Assimilation))
  {
    TracksToPolyData(motion.Air.Tracks, info, data);
    AddControls(motion.Air, data);
    AddRowTimes(motion.Air.Constraints, data);
    ExpectSame(data, joined.At<vtkPolyData>(ChainStage::Assimilation, "Tracks"), "air's tracks");
    VorticesToPolyData(motion.Air.Vortices, info, data);
    ExpectSame(data, joined.At<vtkPolyData>(ChainStage::Assimilation, "Vortices"), "vortices");
    ReportToTable(motion.Air.Report, info, table);
    ExpectSame(table, joined.At<vtkTable>(ChainStage::Assimilation, "Report"), "air's report");
    AirToImage(motion.Air.Air->Velocity, motion.Air.Air->Wind, 0.5, info, image);
    ExpectSame(image, joined.At<vtkImageData>(ChainStage::Assimilation, "Air", 0.5), "air");
  }
  EXPECT_EQ(joined.Has(ChainStage::Spacetime), !motion.Optimised.Tracks.empty());
  if (joined.Has(ChainStage::Spacetime))
  {
    TracksToPolyData(motion.Optimised.Tracks, info, data);
    AddRowTimes(motion.Rows(), data);
    ExpectSame(data, joined.At<vtkPolyData>(ChainStage::Spacetime, "Tracks"), "optimised tracks");
    VorticesToPolyData(motion.Optimised.Vortices, info, data);
    ExpectSame(data, joined.At<vtkPolyData>(ChainStage::Spacetime, "Vortices"), "fitted vortices");
    ReportToTable(motion.Optimised.Report, info, table);
    ExpectSame(table, joined.At<vtkTable>(ChainStage::Spacetime, "Report"), "optimised report");
  }
  PosesToPolyData(motion.Tracks, motion.Turned.Poses, info, data);
  AddRowTimes(motion.RowsAtLast(), data);
  ExpectSame(data, joined.At<vtkPolyData>(ChainStage::Rotation, "Poses"), "poses");
  ReportToTable(motion.Turned.Report, info, table);
  ExpectSame(table, joined.At<vtkTable>(ChainStage::Rotation, "Report"), "turned report");
  if (joined.Has(ChainStage::VortexFit))
  {
    AirVortexFitToPolyData(motion.Fit, info, data);
    ExpectSame(data, joined.At<vtkPolyData>(ChainStage::VortexFit, "Vortices"), "vortices of air");
  }
}

INSTANTIATE_TEST_SUITE_P(Each, ChainFaces, testing::ValuesIn(Qualities),
                         [](const auto& about) { return std::string(ToString(about.param)); });
