// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMMotionAnimationProxy.h"

#include "Chain/ChainTable.h"

#include <vtkClientServerStream.h>
#include <vtkObjectFactory.h>
#include <vtkPVXMLElement.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSmartPointer.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkSMMotionAnimationProxy);

namespace
{

constexpr const char* Requests[] = { "Unfold", "ShowStages" };

/// The stages that are being made.
class Unfolding
{
public:
  explicit Unfolding(vtkSMSourceProxy* source) :
    Source(source), Manager(source->GetSessionProxyManager()),
    Detail(static_cast<waft::Quality>(vtkSMPropertyHelper(source, "Quality").GetAsInt())),
    Last(static_cast<waft::ChainStage>(vtkSMPropertyHelper(source, "StopAfter").GetAsInt())),
    Seed(vtkSMPropertyHelper(source, "Seed").GetAsInt())
  {
    source->UpdatePropertyInformation(source->GetProperty("SliceInUse"));
    this->IsSliced = vtkSMPropertyHelper(source, "SliceInUse").GetAsDouble() > 0.0;
    if (this->Seed < 0)
    {
      this->Source->UpdatePipelineInformation();
      this->Source->UpdatePropertyInformation(source->GetProperty("SceneSeed"));
      this->Seed = vtkSMPropertyHelper(source, "SceneSeed").GetAsInt();
    }
  }
  void Run()
  {
    for (const waft::ChainStageTraits& stage : waft::ChainStages())
    {
      if (stage.Stage <= this->Last && waft::RunsAt(stage.Stage, this->Detail))
      {
        this->Add(stage);
      }
    }
  }

private:
  void Add(const waft::ChainStageTraits& stage)
  {
    const bool isFirst = stage.Stage == waft::ChainStage::Scene;
    vtkSMSourceProxy* proxy = this->Make(isFirst ? "sources" : "filters", stage.Proxy);
    this->Stages[stage.Stage] = proxy;
    for (const waft::ChainInput& input : stage.Inputs)
    {
      this->Join(proxy, input.Name, waft::GiversOf(input, this->Detail));
    }
    for (const auto& [name, value] : waft::SettingsOf(stage.Stage, this->Detail))
    {
      vtkSMPropertyHelper(proxy, name.c_str()).Set(value);
    }
    if (isFirst)
    {
      vtkSMPropertyHelper(proxy, "FileName")
        .Set(vtkSMPropertyHelper(this->Source, "FileName").GetAsString());
    }
    vtkSMPropertyHelper(proxy, "Seed", /*quiet=*/true).Set(this->Seed);
    for (const char* name : { "NumberOfTakes", "Take" })
    {
      vtkSMPropertyHelper(proxy, name, /*quiet=*/true)
        .Set(vtkSMPropertyHelper(this->Source, name).GetAsInt());
    }
    this->Register(proxy, stage.Name);
    if (this->IsSliced && proxy->GetProperty("WorkInSlices") != nullptr)
    {
      proxy->InvokeCommand("WorkInSlices");
    }
  }

  void Join(vtkSMSourceProxy* proxy, const char* input,
            const std::vector<waft::ChainOutput>& givers)
  {
    if (givers.empty())
    {
      return;
    }
    const auto stageOf = [this](const waft::ChainOutput& giver)
    { return this->Stages[giver.Stage]; };
    const auto portOf = [](const waft::ChainOutput& giver)
    { return static_cast<unsigned int>(waft::PortOf(giver)); };
    if (givers.size() == 1)
    {
      vtkSMPropertyHelper(proxy, input).Set(stageOf(givers[0]), portOf(givers[0]));
      return;
    }
    vtkSMSourceProxy* all = this->Make("filters", "AppendPolyData");
    for (const waft::ChainOutput& giver : givers)
    {
      vtkSMPropertyHelper(all, "Input").Add(stageOf(giver), portOf(giver));
    }
    this->Register(all, input);
    vtkSMPropertyHelper(proxy, input).Set(all, 0);
  }

  vtkSMSourceProxy* Make(const char* group, const char* name)
  {
    this->Held.push_back(vtkSmartPointer<vtkSMProxy>::Take(this->Manager->NewProxy(group, name)));
    return vtkSMSourceProxy::SafeDownCast(this->Held.back());
  }

  void Register(vtkSMSourceProxy* proxy, const char* name)
  {
    proxy->UpdateVTKObjects();
    this->Manager->RegisterProxy(
      "sources", this->Manager->GetUniqueProxyName("sources", name, false).c_str(), proxy);
  }

  vtkSMSourceProxy* Source;
  vtkSMSessionProxyManager* Manager;
  waft::Quality Detail;
  waft::ChainStage Last;
  int Seed;
  bool IsSliced = false; // a window's
  std::map<waft::ChainStage, vtkSMSourceProxy*> Stages;
  std::vector<vtkSmartPointer<vtkSMProxy>> Held;
};

} // namespace

vtkSMMotionAnimationProxy::~vtkSMMotionAnimationProxy() = default;

void vtkSMMotionAnimationProxy::UpdateVTKObjects()
{
  const bool isAsked = this->GetLocation() != 0 && this->TakeRequest();
  this->KeepEditsOfFile();
  this->Superclass::UpdateVTKObjects();
  if (isAsked)
  {
    this->Unfold();
  }
}

void vtkSMMotionAnimationProxy::KeepEditsOfFile()
{
  const auto textOf = [this](const char* property)
  {
    const char* text = vtkSMPropertyHelper(this, property, /*quiet=*/true).GetAsString();
    return std::string(text != nullptr ? text : "");
  };
  const std::string file = textOf("FileName");
  std::string edits = textOf("Edits");
  if (!this->FileBefore.empty() && file != this->FileBefore && edits == this->EditsBefore)
  {
    edits.clear();
    vtkSMPropertyHelper(this, "Edits").Set("");
  }
  this->FileBefore = file;
  this->EditsBefore = edits;
}

// ParaView loads a state's files into a proxy that nobody sees, too.
void vtkSMMotionAnimationProxy::UpdatePipelineInformation()
{
  this->Superclass::UpdatePipelineInformation();
  if (std::exchange(this->IsOfBefore, false))
  {
    vtkWarningMacro("Waft Animation: this state is of an earlier version, in which the source was "
                    "made of its stages: its own properties are taken over, and of what was set on "
                    "a stage the state holds nothing; Unfold makes the stages");
  }
}

void vtkSMMotionAnimationProxy::PostUpdateData(bool usingCache)
{
  this->Superclass::PostUpdateData(usingCache);
  for (const char* reported : { "Complete", "Message" })
  {
    this->UpdatePropertyInformation(this->GetProperty(reported));
  }
}

bool vtkSMMotionAnimationProxy::TakeRequest()
{
  bool isAsked = false;
  for (const char* name : Requests)
  {
    vtkSMPropertyHelper request(this, name, /*quiet=*/true);
    if (request.GetAsInt() != 0)
    {
      isAsked = true;
      request.Set(0);
    }
  }
  return isAsked;
}

void vtkSMMotionAnimationProxy::Unfold()
{
  Unfolding(this).Run();
}

void vtkSMMotionAnimationProxy::CreateSelectionProxies()
{
  if (this->DisableSelectionProxies || this->SelectionProxiesCreated)
  {
    return;
  }
  this->CreateOutputPorts();
  this->SelectionProxiesCreated = true;
  vtkClientServerStream stream;
  for (unsigned int port = 0; port < this->GetNumberOfAlgorithmOutputPorts(); ++port)
  {
    const auto selects = vtkSmartPointer<vtkSMProxy>::Take(
      this->GetSessionProxyManager()->NewProxy("filters", "PVExtractSelection"));
    auto* source = vtkSMSourceProxy::SafeDownCast(selects);
    if (source == nullptr)
    {
      continue;
    }
    source->*(&vtkSMMotionAnimationProxy::DisableSelectionProxies) = true;
    source->SetLocation(this->GetLocation());
    source->*(&vtkSMMotionAnimationProxy::SelectionProxiesCreated) = true;
    source->UpdateVTKObjects();
    this->SetExtractSelectionProxy(port, source);
    stream << vtkClientServerStream::Invoke << SIPROXY(this) << "SetupSelectionProxy"
           << static_cast<int>(port) << SIPROXY(source) << vtkClientServerStream::End;
  }
  this->ExecuteStream(stream);
}

int vtkSMMotionAnimationProxy::LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator)
{
  const int loaded = this->Superclass::LoadXMLState(element, locator);
  // Stages that were shown come back by themselves.
  (void)this->TakeRequest();
  bool isOfNow = false;
  for (unsigned int i = 0; element != nullptr && i < element->GetNumberOfNestedElements(); ++i)
  {
    const std::string name = element->GetNestedElement(i)->GetAttributeOrEmpty("name");
    isOfNow = isOfNow || name == Requests[0];
  }
  this->IsOfBefore = loaded != 0 && !isOfNow;
  return loaded;
}

void vtkSMMotionAnimationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IsOfBefore: " << this->IsOfBefore << "\n";
}
