// SPDX-License-Identifier: BSD-3-Clause
#include "SceneFlight.h"

#include "SceneSources.h"
#include "StageChain.h"

#include <vtkNew.h>
#include <vtkPVDataInformation.h>
#include <vtkSMParaViewPipelineController.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxyIterator.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMTrace.h>

#include <algorithm>
#include <iterator>

namespace waft
{

namespace
{

constexpr const char* OfBody[] = { "Mass", "SettlingSpeed", "ClearanceRadius", "RestHeight",
                                   "ClassId" };

bool Gathers(vtkSMProxy* proxy)
{
  const std::string name = proxy->GetXMLName();
  return name == "AppendPolyData" || name == "GroupDataSets";
}

class Flying : public StageChain
{
public:
  Flying(vtkSMSessionProxyManager* session, Quality detail, bool isChosen) :
    StageChain(session, detail), Sources(session), IsChosen(isChosen)
  {
  }

  SceneFlight Run()
  {
    this->Flight.Refusal = this->Sources.Refusal();
    if (!this->Flight.Refusal.empty())
    {
      return this->Flight;
    }
    this->FindStages();
    this->GiveBodies();
    this->GiveObjects();
    for (const ChainPort& output : TraitsOf(ChainStage::Scene).Outputs)
    {
      this->Gather(output.Name);
    }
    for (const ChainStageTraits& stage : ChainStages())
    {
      if (stage.Stage != ChainStage::Scene)
      {
        this->Fly(stage);
      }
    }
    this->Flight.Plans = this->Stages[ChainStage::Planner];
    this->Flight.Bodies = this->Stages[ChainStage::Rotation];
    const std::vector<SourcePort> marks = JoinedTo(this->Flight.Bodies, "Constraints");
    this->Flight.Marks = { marks.front().Source, marks.front().Index };
    for (const char* output : { "Objects", "Constraints", "Shapes" })
    {
      for (const SourcePort& port : this->Sources.All(output))
      {
        this->Flight.Drawn.push_back(port.Source);
      }
    }
    return this->Flight;
  }

private:
  /// Those that fly some of the objects already, and in which quality.
  void FindStages()
  {
    for (const ChainStageTraits& stage : ChainStages())
    {
      vtkSMSourceProxy* found = stage.Stage != ChainStage::Scene ? this->Find(stage) : nullptr;
      if (found != nullptr)
      {
        this->Stages[stage.Stage] = found;
      }
    }
    const auto flies = [this](ChainStage stage)
    {
      const auto found = this->Stages.find(stage);
      return found != this->Stages.end() &&
             vtkSMPropertyHelper(found->second, "Active", /*quiet=*/true).GetAsInt() != 0;
    };
    if (!this->IsChosen && flies(ChainStage::Rotation))
    {
      const bool hasAir = flies(ChainStage::Assimilation);
      this->Detail = flies(ChainStage::Spacetime) ? (hasAir ? Quality::Full : Quality::Paper)
                                                  : (hasAir ? Quality::Air : Quality::Preview);
    }
  }

  /// The planner is the one that plans some of the objects; the others are those that fly its plan.
  vtkSMSourceProxy* Find(const ChainStageTraits& stage)
  {
    const auto planner = this->Stages.find(ChainStage::Planner);
    const std::vector<SourcePort> givers =
      planner != this->Stages.end()        ? std::vector<SourcePort>{ { planner->second, 0 } }
      : stage.Stage == ChainStage::Planner ? this->Sources.All("Objects")
                                           : std::vector<SourcePort>();
    vtkNew<vtkSMProxyIterator> every;
    every->SetSessionProxyManager(this->Manager);
    every->SetModeToOneGroup();
    for (every->Begin("sources"); !every->IsAtEnd(); every->Next())
    {
      vtkSMProxy* one = every->GetProxy();
      if (std::string(one->GetXMLName()) == stage.Proxy &&
          std::any_of(givers.begin(), givers.end(),
                      [one](const SourcePort& giver) { return LeadsTo(one, giver.Source); }))
      {
        return vtkSMSourceProxy::SafeDownCast(one);
      }
    }
    return nullptr;
  }

  /// Who knows a body only by properties that were left as they are, and who has none, gets one;
  /// and numbers of bodies are those in the list of all.
  void GiveBodies()
  {
    std::vector<SourcePort> lists = this->Sources.All("Shapes");
    if (lists.empty())
    {
      vtkSMSourceProxy* leaf = this->Make("sources", "LeafShapeSource");
      this->Register(leaf, this->FreeName("Leaf"));
      lists.push_back({ leaf, 0 });
      this->Flight.Drawn.push_back(leaf);
    }
    const SourcePort all = this->Gathered("Shapes", lists);
    this->Scene["Shapes"] = all;
    for (const SourcePort& objects : this->Sources.All("Objects"))
    {
      if (objects.Source->GetProperty("Shapes") != nullptr)
      {
        this->GiveBody(objects.Source, all);
      }
    }
  }

  void GiveBody(vtkSMSourceProxy* objects, const SourcePort& all)
  {
    const std::vector<SourcePort> own = JoinedTo(objects, "Shapes");
    const bool isBare =
      own.empty() && std::all_of(std::begin(OfBody), std::end(OfBody),
                                 [objects](const char* name)
                                 { return objects->GetProperty(name)->IsValueDefault(); });
    if (own.empty() ? !isBare : own.front().Source == all.Source)
    {
      return;
    }
    vtkTypeInt64 before = 0; // shapes of other lists
    const std::vector<SourcePort> lists =
      Gathers(all.Source) ? JoinedTo(all.Source, "Input") : std::vector<SourcePort>{ all };
    for (const SourcePort& list : lists)
    {
      if (own.empty() || list.Source == own.front().Source)
      {
        break;
      }
      list.Source->UpdatePipeline();
      before += list.Source->GetDataInformation(list.Index)->GetNumberOfDataSets();
    }
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", objects);
    vtkSMPropertyHelper(objects, "Shapes").Set(all.Source, all.Index);
    vtkSMPropertyHelper number(objects, "ShapeId");
    number.Set(number.GetAsInt() + static_cast<int>(before));
    objects->UpdateVTKObjects();
  }

  /// Sources of marks that can be as many as the objects hear of all of them.
  void GiveObjects()
  {
    this->Gather("Objects");
    for (const SourcePort& marks : this->Sources.All("Constraints"))
    {
      if (marks.Source->GetProperty("Objects") != nullptr)
      {
        SM_SCOPED_TRACE(PropertiesModified).arg("proxy", marks.Source);
        const SourcePort& objects = this->Scene["Objects"];
        vtkSMPropertyHelper(marks.Source, "Objects").Set(objects.Source, objects.Index);
        marks.Source->UpdateVTKObjects();
      }
    }
  }

  void Gather(const char* output)
  {
    const std::vector<SourcePort>& ports = this->Sources.All(output);
    if (this->Scene.count(output) == 0 && !ports.empty())
    {
      this->Scene[output] = this->Gathered(output, ports);
    }
  }

  /// What the stages take of a scene now; without any, a list of shapes that objects have.
  std::vector<SourcePort> TakenNow(const std::string& output)
  {
    const auto isIt = [&output](const std::vector<ChainOutput>& givers) {
      return givers.size() == 1 && givers[0].Stage == ChainStage::Scene && givers[0].Name == output;
    };
    std::vector<SourcePort> taken;
    for (const auto& [stage, proxy] : this->Stages)
    {
      for (const ChainInput& input : TraitsOf(stage).Inputs)
      {
        if (taken.empty() && std::any_of(input.Givers.begin(), input.Givers.end(), isIt))
        {
          taken = JoinedTo(proxy, input.Name);
        }
      }
    }
    for (const SourcePort& objects : this->Sources.All("Objects"))
    {
      const std::vector<SourcePort> own =
        output == "Shapes" ? JoinedTo(objects.Source, "Shapes") : std::vector<SourcePort>();
      if (taken.empty() && !own.empty() && Gathers(own.front().Source))
      {
        taken = own;
      }
    }
    return taken;
  }

  /// What the stages take now, if that has them all; else all of it and them together.
  SourcePort Gathered(const std::string& output, const std::vector<SourcePort>& ports)
  {
    const std::vector<SourcePort> before = this->TakenNow(output);
    std::vector<SourcePort> added;
    std::copy_if(ports.begin(), ports.end(), std::back_inserter(added),
                 [&before](const SourcePort& port)
                 { return before.empty() || !LeadsTo(before.front().Source, port.Source); });
    if (added.empty())
    {
      return before.front();
    }
    if (before.empty() && added.size() == 1)
    {
      return added.front();
    }
    if (!before.empty() && Gathers(before.front().Source))
    {
      SM_SCOPED_TRACE(PropertiesModified).arg("proxy", before.front().Source);
      Append(before.front().Source, added);
      return before.front();
    }
    added.insert(added.begin(), before.begin(), before.end());
    vtkSMSourceProxy* all =
      this->Make("filters", output == "Shapes" ? "GroupDataSets" : "AppendPolyData");
    Append(all, added);
    this->Register(all, this->FreeName(output.c_str()));
    return { all, 0 };
  }

  static void Append(vtkSMSourceProxy* gatherer, const std::vector<SourcePort>& ports)
  {
    for (const SourcePort& port : ports)
    {
      vtkSMPropertyHelper(gatherer, "Input").Add(port.Source, port.Index);
    }
    gatherer->UpdateVTKObjects();
  }

  void Fly(const ChainStageTraits& stage)
  {
    const auto found = this->Stages.find(stage.Stage);
    const bool runs = RunsAt(stage.Stage, this->Detail);
    if (found == this->Stages.end())
    {
      if (runs)
      {
        this->Add(stage);
      }
      return;
    }
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", found->second);
    vtkSMPropertyHelper(found->second, "Active", /*quiet=*/true).Set(runs ? 1 : 0);
    if (this->IsChosen)
    {
      this->PutOnQuality(stage, found->second);
    }
    if (runs)
    {
      this->Add(stage);
    }
    found->second->UpdateVTKObjects();
  }

  void PutOnQuality(const ChainStageTraits& stage, vtkSMSourceProxy* proxy)
  {
    for (const Quality quality : Qualities)
    {
      for (const auto& setting : SettingsOf(stage.Stage, quality))
      {
        proxy->GetProperty(setting.first.c_str())->ResetToDefault();
      }
    }
    this->Prepare(stage, proxy);
  }

  void Register(vtkSMSourceProxy* proxy, const std::string& name) override
  {
    proxy->UpdateVTKObjects();
    vtkNew<vtkSMParaViewPipelineController> controller;
    controller->RegisterPipelineProxy(proxy, name.c_str());
    this->Flight.Made.push_back(proxy);
  }

  SceneSources Sources;
  bool IsChosen;
  SceneFlight Flight;
};

/// What stages take of a scene: the last of them that have the input from none of their own.
std::vector<SourcePort> TakenOfScene(vtkSMProxy* stage, const char* input)
{
  const auto isStage = [](const SourcePort& port)
  { return port.Source->GetProperty("WorkInSlices") != nullptr; };
  const std::vector<SourcePort> taken = JoinedTo(stage, input);
  if (!taken.empty() && !isStage(taken.front()))
  {
    return taken;
  }
  const std::vector<SourcePort> before = JoinedTo(stage, "Tracks");
  return before.empty() ? before : TakenOfScene(before.front().Source, input);
}

} // namespace

bool SaveFlownScene(vtkSMSourceProxy* bodies, const std::string& file)
{
  const auto proxy = vtkSmartPointer<vtkSMProxy>::Take(
    bodies->GetSessionProxyManager()->NewProxy("filters", "MotionSceneWriter"));
  auto* writer = vtkSMSourceProxy::SafeDownCast(proxy);
  for (const ChainPort& output : TraitsOf(ChainStage::Scene).Outputs)
  {
    for (const SourcePort& port : TakenOfScene(bodies, output.Name))
    {
      vtkSMPropertyHelper(writer, output.Name).Set(port.Source, port.Index);
    }
  }
  vtkSMPropertyHelper(writer, "FileName").Set(file.c_str());
  writer->UpdateVTKObjects();
  writer->UpdatePipeline();
  return writer->GetDataInformation(0)->GetNumberOfPoints() > 0; // none where it fails
}

SceneFlight FlySources(vtkSMSessionProxyManager* session, int quality, bool isChosen)
{
  return Flying(session, static_cast<Quality>(quality), isChosen).Run();
}

} // namespace waft
