// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionAnimationWriter.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Files/AnimationFile.h"
#include "Bridge/Files/FileWriting.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Export/AnimationOptions.h"
#include "Export/GltfAnimation.h"
#include "Export/PosesCsv.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <cstddef>
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

} // namespace

struct vtkMotionAnimationWriter::Internals
{
  waft::StageCache Cache;
  bool Written = false;
  std::vector<std::string> Warnings;

  waft::Result Run(vtkAlgorithm* stage, vtkInformationVector** inputs, const std::string& fileName,
                   waft::Monitor& monitor);
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
  if (waft::HasEnding(fileName, ".csv"))
  {
    std::vector<waft::Track> tracks;
    std::vector<waft::PoseTrack> poses;
    WAFT_RETURN_IF_FAILED(waft::PosesFromPolyData(data, tracks, poses));
    WAFT_RETURN_IF_FAILED(waft::CheckOwn(fileName, waft::PosesCsvHeader, 100));
    return waft::WritePosesCsv(fileName, tracks, poses, info.Time, monitor);
  }
  if (waft::HasEnding(fileName, ".glb"))
  {
    WAFT_RETURN_IF_FAILED(waft::CheckOwn(fileName, waft::GltfSign, MostText));
    std::vector<waft::MotionObject> objects;
    WAFT_RETURN_IF_FAILED(waft::ObjectsFromPolyData(vtkPolyData::GetData(inputs[1]), objects));
    std::vector<waft::Shape> bodies;
    WAFT_RETURN_IF_FAILED(
      waft::BodiesFromMultiBlock(vtkMultiBlockDataSet::GetData(inputs[2]), bodies));
    return waft::WriteAnimation(fileName, data, objects, std::move(bodies),
                                vtkPolyData::GetData(inputs[3]), info, monitor, this->Warnings);
  }
  return waft::WrongEnding(fileName, Endings);
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
