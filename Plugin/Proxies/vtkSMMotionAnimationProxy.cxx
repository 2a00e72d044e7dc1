// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMMotionAnimationProxy.h"

#include "StageChain.h"

#include <vtkClientServerStream.h>
#include <vtkObjectFactory.h>
#include <vtkPVXMLElement.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSmartPointer.h>

#include <string>
#include <utility>

vtkStandardNewMacro(vtkSMMotionAnimationProxy);

namespace
{

constexpr const char* Requests[] = { "Unfold", "ShowStages" };

/// The stages that a source runs, set as it is.
class Unfolding : public waft::StageChain
{
public:
  explicit Unfolding(vtkSMSourceProxy* source) :
    StageChain(source->GetSessionProxyManager(),
               static_cast<waft::Quality>(vtkSMPropertyHelper(source, "Quality").GetAsInt())),
    Source(source),
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
      if (stage.Stage == waft::ChainStage::Scene)
      {
        this->Read(stage);
      }
      else if (stage.Stage <= this->Last && waft::RunsAt(stage.Stage, this->Detail))
      {
        this->Add(stage);
      }
    }
  }

private:
  void Read(const waft::ChainStageTraits& stage)
  {
    vtkSMSourceProxy* reader = this->Make("sources", stage.Proxy);
    vtkSMPropertyHelper(reader, "FileName")
      .Set(vtkSMPropertyHelper(this->Source, "FileName").GetAsString());
    this->Register(reader, this->FreeName(stage.Name));
    for (const waft::ChainPort& output : stage.Outputs)
    {
      const int port = waft::PortOf({ stage.Stage, output.Name });
      this->Scene[output.Name] = { reader, static_cast<unsigned int>(port) };
    }
  }

  void Prepare(const waft::ChainStageTraits& stage, vtkSMSourceProxy* proxy) override
  {
    this->StageChain::Prepare(stage, proxy);
    vtkSMPropertyHelper(proxy, "Seed", /*quiet=*/true).Set(this->Seed);
    for (const char* name : { "NumberOfTakes", "Take" })
    {
      vtkSMPropertyHelper(proxy, name, /*quiet=*/true)
        .Set(vtkSMPropertyHelper(this->Source, name).GetAsInt());
    }
  }

  void Register(vtkSMSourceProxy* proxy, const std::string& name) override
  {
    this->StageChain::Register(proxy, name);
    if (this->IsSliced && proxy->GetProperty("WorkInSlices") != nullptr)
    {
      proxy->InvokeCommand("WorkInSlices");
    }
  }

  vtkSMSourceProxy* Source;
  waft::ChainStage Last;
  int Seed;
  bool IsSliced = false; // a window's
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

vtkPVXMLElement* vtkSMMotionAnimationProxy::SaveXMLState(vtkPVXMLElement* root)
{
  if (this->GetLocation() != 0 && this->ObjectsCreated)
  {
    vtkClientServerStream stream;
    stream << vtkClientServerStream::Invoke << VTKOBJECT(this) << "KeepFlight"
           << vtkClientServerStream::End;
    this->ExecuteStream(stream, /*ignore_errors=*/true);
  }
  return this->Superclass::SaveXMLState(root);
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
