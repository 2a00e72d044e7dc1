// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionResultsReader.h"

#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Files/ResultFiles.h"
#include "Bridge/Files/ShapeColors.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageFailure.h"
#include "Bridge/Pipeline/StageTimes.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <array>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkMotionResultsReader);

struct vtkMotionResultsReader::Contents
{
  waft::FlightResults Flight;
  waft::PosedMeshes Meshes;
  waft::StageCache Cache;
  std::string Error;
  // What does not change in time, filled once.
  vtkNew<vtkPolyData> Obstacles, Objects, Marks;

  void Load(const std::string& report)
  {
    waft::Result result = waft::ReadResults(report, this->Flight);
    result = result ? this->Keep() : result;
    this->Error = result.Message();
  }

  waft::Result Keep()
  {
    const waft::SceneInfo& scene = this->Flight.Scene;
    waft::ObstaclesToPolyData(this->Flight.Obstacles, 0.0, scene, this->Obstacles);
    waft::ObjectsToPolyData(this->Flight.Objects, scene, this->Objects);
    waft::AddArrivals(this->Flight.Constraints, this->Flight.Tracks, this->Objects);
    waft::ConstraintsToPolyData(this->Flight.Constraints, scene, this->Marks);
    waft::AddLandings(this->Flight.Constraints, this->Flight.Objects, this->Flight.Tracks,
                      this->Marks);
    std::vector<std::vector<std::array<double, 3>>> colors;
    for (const waft::Shape& shape : this->Flight.Shapes)
    {
      colors.push_back(waft::ColorsOfPoints(shape));
    }
    WAFT_RETURN_IF_FAILED(this->Meshes.Build(this->Flight.Shapes, colors, this->Flight.Objects,
                                             this->Flight.Tracks, scene));
    this->Meshes.SetSettled(waft::SettledFrames(this->Flight.Constraints, this->Flight.Tracks));
    this->Meshes.SetGround(this->Flight.Obstacles, scene.Bounds);
    return waft::Result::Ok();
  }
};

vtkMotionResultsReader::vtkMotionResultsReader() : Read(new Contents)
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(MARKS + 1);
}

vtkMotionResultsReader::~vtkMotionResultsReader() = default;

void vtkMotionResultsReader::SetFileName(const std::string& name)
{
  this->FileName = name;
  this->Modified();
}

vtkTypeBool vtkMotionResultsReader::ProcessRequest(vtkInformation* request,
                                                   vtkInformationVector** inputs,
                                                   vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs, {},
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkMotionResultsReader::RequestInformation(vtkInformation*, vtkInformationVector**,
                                               vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    // The pipeline asks the other ranks, of several, for their pieces only then.
    outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 0);
  }
  if (this->FileName.empty())
  {
    return waft::FailInformation(outputs); // RequestData asks for the name
  }
  if (!this->Read->Cache.IsCurrent(this, nullptr))
  {
    this->Read->Load(this->FileName);
    this->Read->Cache.MarkCurrent(this, nullptr);
  }
  if (!this->Read->Error.empty())
  {
    return waft::FailInformation(outputs);
  }
  waft::SetTimeSteps(this->Read->Flight.Scene.Time, outputs);
  return 1;
}

int vtkMotionResultsReader::RequestData(vtkInformation* request, vtkInformationVector**,
                                        vtkInformationVector* outputs)
{
  if (this->FileName.empty())
  {
    return waft::Fail(this, outputs,
                      "FileName: expected the report.json of results, found no name");
  }
  const Contents& read = *this->Read;
  if (!read.Error.empty())
  {
    return waft::Fail(this, outputs, read.Error);
  }
  if (waft::IsPieceOfOthers(request, outputs))
  {
    return waft::Empty(outputs);
  }
  const waft::FlightResults& flight = read.Flight;
  const waft::Timeline& line = flight.Scene.Time;
  const double time = waft::RequestedTimeOfAll(request, outputs, line);
  const double frame = time * line.FramesPerSecond;
  read.Meshes.Fill(flight.Tracks, flight.PoseTracks, static_cast<int>(std::lround(frame)),
                   vtkPolyData::GetData(outputs, MESHES));
  vtkPolyData::GetData(outputs, POSES)->ShallowCopy(flight.Poses);
  vtkPolyData* obstacles = vtkPolyData::GetData(outputs, OBSTACLES);
  obstacles->ShallowCopy(read.Obstacles);
  waft::MoveObstacles(flight.Obstacles, frame, obstacles);
  vtkPolyData::GetData(outputs, OBJECTS)->ShallowCopy(read.Objects);
  vtkPolyData::GetData(outputs, MARKS)->ShallowCopy(read.Marks);
  (void)waft::RequestedTimeOfAll(request, outputs, line); // filling has cleared the stamps
  return 1;
}

void vtkMotionResultsReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
