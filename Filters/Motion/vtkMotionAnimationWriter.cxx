// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionAnimationWriter.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Files/FileWriting.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Export/AnimationOptions.h"
#include "Export/GltfAnimation.h"
#include "Export/PosesCsv.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkMotionAnimationWriter);

namespace
{

const char* const Endings = ".glb or .csv";
constexpr std::size_t MostText = std::size_t(1) << 28; // bytes of a .glb in which its sign stands

using waft::StageInput;

const waft::StageInputs Inputs = {
  { "Poses", StageInput::Type::Surface },
  { "Objects", StageInput::Type::Merged },
  { "Shapes", StageInput::Type::Blocks },
  { "Constraints", StageInput::Type::Merged, StageInput::Number::Optional },
};

/// By ObjectId, the frames at which a body does what is asked of it: those of its rows, and when it
/// comes to lie, asked for or not.
waft::Result FramesOfMarks(vtkPolyData* rows, vtkPolyData* poses, const waft::Timeline& time,
                           std::map<int, std::vector<int>>& frames)
{
  std::vector<waft::Constraint> constraints;
  if (rows->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(waft::ConstraintsFromPolyData(rows, time, constraints));
  }
  for (const waft::Constraint& row : constraints)
  {
    std::vector<int>& own = frames[row.ObjectId];
    own.insert(own.end(),
               { row.Frame, waft::LastFrame(row), row.TouchDown, row.Settled, row.LiftOff });
  }
  vtkDataArray* ids = poses->GetCellData()->GetArray(waft::names::ObjectId);
  for (const char* name : { waft::names::TouchDown, waft::names::Settled })
  {
    vtkDataArray* begun = poses->GetCellData()->GetArray(name);
    for (vtkIdType i = 0; begun != nullptr && i < begun->GetNumberOfTuples(); ++i)
    {
      frames[static_cast<int>(ids->GetTuple1(i))].push_back(static_cast<int>(begun->GetTuple1(i)));
    }
  }
  return waft::Result::Ok();
}

} // namespace

struct vtkMotionAnimationWriter::Internals
{
  waft::StageCache Cache;
  bool Written = false;
  std::vector<std::string> Warnings;

  waft::Result Run(vtkAlgorithm* stage, vtkInformationVector** inputs, const std::string& fileName,
                   waft::Monitor& monitor);
  waft::Result WriteGlb(vtkInformationVector** inputs, std::vector<waft::Track> tracks,
                        std::vector<waft::PoseTrack> poses, const waft::SceneInfo& info,
                        const std::string& fileName, waft::Monitor& monitor);
};

waft::Result vtkMotionAnimationWriter::Internals::Run(vtkAlgorithm* stage,
                                                      vtkInformationVector** inputs,
                                                      const std::string& fileName,
                                                      waft::Monitor& monitor)
{
  this->Warnings.clear();
  vtkPolyData* data = vtkPolyData::GetData(inputs[0]);
  waft::SceneInfo info;
  std::set<std::string> lacking;
  WAFT_RETURN_IF_FAILED(waft::SceneOfInputs(stage, inputs, 0, info, lacking));
  if (lacking.count(waft::names::FramesPerSecond) > 0) // of a scene no more is asked here
  {
    this->Warnings.push_back(waft::DefaultsText({ waft::names::FramesPerSecond }, info));
  }
  std::vector<waft::Track> tracks;
  std::vector<waft::PoseTrack> poses;
  WAFT_RETURN_IF_FAILED(waft::PosesFromPolyData(data, tracks, poses));
  if (waft::HasEnding(fileName, ".csv"))
  {
    WAFT_RETURN_IF_FAILED(waft::CheckOwn(fileName, waft::PosesCsvHeader, 100));
    return waft::WritePosesCsv(fileName, tracks, poses, info.Time, monitor);
  }
  if (waft::HasEnding(fileName, ".glb"))
  {
    WAFT_RETURN_IF_FAILED(waft::CheckOwn(fileName, waft::GltfSign, MostText));
    info.Time.NumberOfFrames = static_cast<int>(tracks[0].Positions.size());
    return this->WriteGlb(inputs, std::move(tracks), std::move(poses), info, fileName, monitor);
  }
  return waft::WrongEnding(fileName, Endings);
}

waft::Result vtkMotionAnimationWriter::Internals::WriteGlb(vtkInformationVector** inputs,
                                                           std::vector<waft::Track> tracks,
                                                           std::vector<waft::PoseTrack> poses,
                                                           const waft::SceneInfo& info,
                                                           const std::string& fileName,
                                                           waft::Monitor& monitor)
{
  std::vector<waft::MotionObject> objects;
  WAFT_RETURN_IF_FAILED(waft::ObjectsFromPolyData(vtkPolyData::GetData(inputs[1]), objects));
  std::vector<waft::Shape> bodies;
  WAFT_RETURN_IF_FAILED(
    waft::BodiesFromMultiBlock(vtkMultiBlockDataSet::GetData(inputs[2]), bodies));
  std::vector<waft::AnimatedShape> shapes;
  for (waft::Shape& body : bodies)
  {
    waft::AnimatedShape shape;
    shape.Body = std::move(body);
    if (!shape.Body.Texture.empty())
    {
      const waft::Result read = waft::ReadImageFile(shape.Body.Texture, shape.Texture);
      if (!read)
      {
        this->Warnings.push_back("shape '" + shape.Body.Name + "': " + read.Message());
      }
    }
    else if (!shape.Body.Skin.empty())
    {
      shape.Texture = { shape.Body.Skin, "image/png" };
    }
    shapes.push_back(std::move(shape));
  }
  vtkPolyData* rows = vtkPolyData::GetData(inputs[3]);
  std::map<int, std::vector<int>> marks;
  if (rows != nullptr)
  {
    WAFT_RETURN_IF_FAILED(FramesOfMarks(rows, vtkPolyData::GetData(inputs[0]), info.Time, marks));
  }
  const waft::ShapesOfTracks shapeOf("Poses", objects, shapes.size());
  std::vector<waft::AnimatedObject> animated;
  for (std::size_t i = 0; i < tracks.size(); ++i)
  {
    int shapeId = 0;
    WAFT_RETURN_IF_FAILED(shapeOf.Find(tracks[i].ObjectId, shapeId));
    animated.push_back({ tracks[i].ObjectId, static_cast<std::size_t>(shapeId),
                         std::move(tracks[i].Positions), std::move(poses[i].Orientations),
                         std::move(marks[tracks[i].ObjectId]) });
    poses[i] = waft::PoseTrack();
  }
  return waft::WriteAnimationGlb(
    fileName, shapes, std::move(animated), info.Time.FramesPerSecond, monitor,
    rows != nullptr ? waft::MostWholeKeys : waft::AnyNumberOfKeys, info.Bounds);
}

vtkMotionAnimationWriter::vtkMotionAnimationWriter() : Impl(std::make_unique<Internals>())
{
  waft::TakeDefaults<waft::AnimationOptions>(*this);
  this->SetNumberOfInputPorts(4);
}

vtkMotionAnimationWriter::~vtkMotionAnimationWriter() = default;

int vtkMotionAnimationWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(Inputs, port, info);
}

vtkTypeBool vtkMotionAnimationWriter::ProcessRequest(vtkInformation* request,
                                                     vtkInformationVector** inputs,
                                                     vtkInformationVector* outputs)
{
  return waft::GuardedRequest(this, request, inputs, outputs, Inputs,
                              waft::RangesOf<waft::AnimationOptions>(*this),
                              [&](vtkInformationVector** taken) {
                                return this->Superclass::ProcessRequest(request, taken, outputs);
                              });
}

int vtkMotionAnimationWriter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                                 vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  return 1;
}

int vtkMotionAnimationWriter::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs)
{
  Internals& impl = *this->Impl;
  if (waft::IsWithFirstRank(vtkPolyData::GetData(inputs[0])))
  {
    vtkPolyData::GetData(outputs)->Initialize();
    return 1;
  }
  if (!this->FileName.empty() && !impl.Cache.IsCurrent(this, inputs))
  {
    impl.Written = false;
    waft::StageMonitor monitor(this);
    const waft::Result result = impl.Run(this, inputs, this->FileName, monitor);
    for (const std::string& warning : impl.Warnings)
    {
      vtkWarningMacro(<< warning);
    }
    if (!result)
    {
      return waft::Fail(this, outputs, result.Message());
    }
    if (!result.IsStopped())
    {
      impl.Written = true;
      impl.Cache.MarkCurrent(this, inputs);
    }
  }
  vtkPolyData::GetData(outputs)->ShallowCopy(vtkPolyData::GetData(inputs[0]));
  return 1;
}

bool vtkMotionAnimationWriter::Write()
{
  return waft::WriteAnew(this, this->FileName, Endings, this->Impl->Written);
}

void vtkMotionAnimationWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::AnimationOptions>(os, indent, *this);
}
