// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are pulled over time, when several ports or several stages share one source.
#include "PipelineTesting.h"

#include "Base/TemporaryFolder.h"

#include "Bridge/Pipeline/StageExecution.h"

#include <vtkAppendPolyData.h>
#include <vtkInformationVector.h>
#include <vtkMotionSceneReader.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{

constexpr int Frames = 31;
constexpr int ObstaclesOut = 2; // ports of the reader
constexpr int VorticesOut = 4;

// A box that goes from x = 0 to x = 1 in 30 frames.
const char* const MovingBox = R"({"waft": 1, "time": {"frames": 31}, "ground": {"enabled": false},
  "obstacles": [{"kind": "box", "min": [0, 0, 1], "max": [0.5, 1, 2], "motion":
    [{"frame": 0, "position": [0.25, 0.5, 1.5]}, {"frame": 30, "position": [1.25, 0.5, 1.5]}]}]})";

double LeftSide(vtkPolyData* surface)
{
  return surface->GetBounds()[0];
}

/// A stage like any other: notes where its obstacles (port 0, swept) stand at each step; whatever
/// comes in at port 1 is not swept. Gives the position that it noted for the time asked, as a
/// point.
class SweepProbe : public vtkPolyDataAlgorithm
{
public:
  static SweepProbe* New();
  vtkTypeMacro(SweepProbe, vtkPolyDataAlgorithm);

  std::vector<double> Times;
  std::vector<double> Positions;
  int Runs = 0;
  int Passes = 0;

protected:
  SweepProbe() { this->SetNumberOfInputPorts(2); }
  int FillInputPortInformation(int port, vtkInformation* info) override
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port);
    return 1;
  }
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override
  {
    waft::PassTimeSteps(this, inputs, outputs);
    return 1;
  }
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override
  {
    this->Sweep.RequestSteps(this, request, inputs, outputs, this->Cache.IsCurrent(this, inputs));
    return 1;
  }
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override
  {
    ++this->Passes;
    vtkPolyData* surface = vtkPolyData::GetData(inputs[0]);
    if (!this->Cache.IsCurrent(this, inputs))
    {
      if (this->Sweep.IsFirst())
      {
        this->Times.clear();
        this->Positions.clear();
      }
      if (this->Sweep.HasNewStep())
      {
        this->Times.push_back(waft::TimeSweep::DataTime(inputs[0]->GetInformationObject(0)));
        this->Positions.push_back(LeftSide(surface));
      }
      if (this->Sweep.Continue(request))
      {
        return 1;
      }
      ++this->Runs;
      this->Cache.MarkCurrent(this, inputs);
    }
    const waft::Timeline line{ Frames, 30.0 };
    const double time = waft::RequestedTimeOfAll(request, outputs, line);
    vtkNew<vtkPoints> point;
    point->SetDataTypeToDouble();
    point->InsertNextPoint(this->Positions[static_cast<std::size_t>(std::lround(30.0 * time))], 0,
                           1);
    vtkPolyData::GetData(outputs)->SetPoints(point);
    return 1;
  }

private:
  waft::StageCache Cache;
  waft::TimeSweep Sweep{ { 0 } };
};
vtkStandardNewMacro(SweepProbe);

void ExpectTheWholeMotion(const SweepProbe& probe)
{
  ASSERT_EQ(probe.Positions.size(), static_cast<std::size_t>(Frames));
  for (int k = 0; k < Frames; ++k)
  {
    const auto at = static_cast<std::size_t>(k);
    EXPECT_NEAR(probe.Times[at], k / 30.0, 1e-12) << "frame " << k;
    EXPECT_NEAR(probe.Positions[at], k / 30.0, 1e-12) << "frame " << k;
  }
}

struct Pipeline
{
  waft::test::TemporaryFolder Folder;
  vtkNew<vtkMotionSceneReader> Reader;
  vtkNew<SweepProbe> First;
  vtkNew<SweepProbe> Second;

  Pipeline()
  {
    this->Reader->SetFileName(this->Folder.Write("a.waft.json", MovingBox));
    this->First->SetInputConnection(0, this->Reader->GetOutputPort(ObstaclesOut));
    this->First->SetInputConnection(1, this->Reader->GetOutputPort(VorticesOut));
    this->Second->SetInputConnection(0, this->Reader->GetOutputPort(ObstaclesOut));
    this->Second->SetInputConnection(1, this->First->GetOutputPort());
  }
};

} // namespace

TEST(TimeSweep, SweptAndUnsweptPortsMayShareASource)
{
  Pipeline p;
  p.First->Update();
  ExpectTheWholeMotion(*p.First);
  EXPECT_EQ(p.First->Runs, 1);
}

TEST(TimeSweep, StagesInARowMayShareASource)
{
  Pipeline p;
  p.Second->Update();
  ExpectTheWholeMotion(*p.First);
  ExpectTheWholeMotion(*p.Second);
  EXPECT_EQ(p.First->Runs, 1);
  EXPECT_EQ(p.Second->Runs, 1);
}

TEST(TimeSweep, AStageThatIsCurrentDoesNotMoveASharedSource)
{
  Pipeline p;
  p.First->Update();
  p.Second->Update();
  ExpectTheWholeMotion(*p.Second);
  EXPECT_EQ(p.First->Runs, 1);
  p.Second->Modified();
  p.Second->UpdateTimeStep(0.5);
  ExpectTheWholeMotion(*p.Second);
  EXPECT_EQ(p.First->Runs, 1);
  EXPECT_EQ(p.Second->Runs, 2);
}

// Each stage and each port has a filter of its own between the source and itself, as in ParaView.
TEST(TimeSweep, PlainFiltersMayStandBetweenTheSourceAndTheStages)
{
  Pipeline p;
  vtkNew<vtkAppendPolyData> between[3];
  between[0]->SetInputConnection(p.Reader->GetOutputPort(ObstaclesOut));
  between[1]->SetInputConnection(p.Reader->GetOutputPort(VorticesOut));
  between[2]->SetInputConnection(p.Reader->GetOutputPort(ObstaclesOut));
  p.First->SetInputConnection(0, between[0]->GetOutputPort());
  p.First->SetInputConnection(1, between[1]->GetOutputPort());
  p.Second->SetInputConnection(0, between[2]->GetOutputPort());
  p.Second->Update();
  ExpectTheWholeMotion(*p.First);
  ExpectTheWholeMotion(*p.Second);
}

TEST(TimeSweep, ASourceOfItsOwnIsLeftWhereItStands)
{
  Pipeline p;
  p.Second->RemoveAllInputConnections(0);
  p.Second->RemoveAllInputConnections(1);
  ExecutionCount reads(p.Reader);
  p.First->Update();
  EXPECT_EQ(reads.Value, Frames);
  p.First->UpdateTimeStep(0.3);
  EXPECT_EQ(reads.Value, Frames);
  EXPECT_EQ(p.First->Runs, 1);
}

TEST(TimeSweep, FiltersAfterAStageSeeOneTime)
{
  Pipeline p;
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(p.Second->GetOutputPort());
  both->AddInputConnection(p.Reader->GetOutputPort(ObstaclesOut));
  int runs = 0;
  for (const bool isNew : { true, false })
  {
    for (const int frame : { 12, 30, 6 })
    {
      if (isNew)
      {
        p.First->Modified();
        p.Second->Modified();
        runs += 2;
      }
      both->UpdateTimeStep(frame / 30.0);
      const double* bounds = both->GetOutput()->GetBounds();
      EXPECT_NEAR(bounds[0], frame / 30.0, 1e-12);
      EXPECT_NEAR(bounds[1], frame / 30.0 + 0.5, 1e-12);
      EXPECT_EQ(p.First->Runs + p.Second->Runs, runs);
    }
  }
  ExpectTheWholeMotion(*p.Second);
}

TEST(TimeSweep, PlayingTakesOnePassAFrame)
{
  Pipeline p;
  p.Second->Update();
  const int passes = p.Second->Passes;
  const int passesOfFirst = p.First->Passes;
  for (const int frame : { 20, 3, 3, 17 })
  {
    p.Second->UpdateTimeStep(frame / 30.0);
    EXPECT_NEAR(LeftSide(p.Second->GetOutput()), frame / 30.0, 1e-12);
  }
  EXPECT_EQ(p.Second->Passes, passes + 3);
  EXPECT_EQ(p.First->Passes, passesOfFirst) << "it serves the second alone";
  EXPECT_EQ(p.First->Runs + p.Second->Runs, 2);
}
