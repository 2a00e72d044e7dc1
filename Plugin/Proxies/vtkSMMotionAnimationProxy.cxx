// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMMotionAnimationProxy.h"

#include <vtkObjectFactory.h>
#include <vtkPVXMLElement.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>

#include <algorithm>
#include <iterator>

vtkStandardNewMacro(vtkSMMotionAnimationProxy);

namespace
{

// The browser wants those that give before those that take.
constexpr const char* Stages[] = { "Scene",        "Planner",   "Vortices",
                                   "Assimilation", "Spacetime", "Rotation" };

// An output of a stage; none where nothing is to be joined.
struct Source
{
  vtkSMProxy* Stage = nullptr;
  unsigned int Port = 0;
};

void Join(vtkSMProxy* stage, const char* input, const Source& source)
{
  vtkSMPropertyHelper property(stage, input);
  if (source.Stage == nullptr)
  {
    property.RemoveAllValues();
    return;
  }
  property.Set(source.Stage, source.Port);
  property.SetNumberOfElements(1);
}

} // namespace

vtkSMMotionAnimationProxy::~vtkSMMotionAnimationProxy() = default;

void vtkSMMotionAnimationProxy::CreateVTKObjects()
{
  this->Superclass::CreateVTKObjects();
  // Its stages count as its producers, and ParaView's time keeper takes no times from the producers
  // of what tells times itself, which it knows by their parent: this source.
  for (const char* name : Stages)
  {
    this->RemoveProducer(nullptr, this->GetProxy(name));
  }
}

void vtkSMMotionAnimationProxy::UpdateVTKObjects()
{
  vtkSMProxy* scene = this->GetProxy("Scene");
  if (scene != nullptr && this->GetLocation() != 0)
  {
    const std::array<int, 2> wanted{ vtkSMPropertyHelper(this, "Quality").GetAsInt(),
                                     vtkSMPropertyHelper(this, "StopAfter").GetAsInt() };
    if (wanted != this->Arranged && this->AreInRange(wanted[0], wanted[1]))
    {
      const bool isPreview = wanted[0] == PREVIEW;
      if (this->Arranged[0] < 0 || isPreview != (this->Arranged[0] == PREVIEW))
      {
        this->SetDetail(isPreview);
      }
      this->Arrange(wanted[0], wanted[1]);
      this->Arranged = wanted;
    }
    this->SetSeed(vtkSMPropertyHelper(this, "Seed").GetAsInt());
    this->SetSlice(vtkSMPropertyHelper(this, "Slice").GetAsDouble());
  }
  this->Superclass::UpdateVTKObjects();
  if (scene != nullptr && this->GetLocation() != 0)
  {
    this->ShowStages(vtkSMPropertyHelper(this, "ShowStages").GetAsInt() != 0);
  }
}

void vtkSMMotionAnimationProxy::UpdatePropertyInformation(vtkSMProperty* property)
{
  vtkSMProxy* owner = property != nullptr ? property->GetParent() : nullptr;
  if (owner != nullptr && owner != this)
  {
    owner->UpdatePropertyInformation(property);
    return;
  }
  this->Superclass::UpdatePropertyInformation(property);
}

void vtkSMMotionAnimationProxy::PostUpdateData(bool usingCache)
{
  this->Superclass::PostUpdateData(usingCache);
  for (const char* told : { "Complete", "Message" })
  {
    this->UpdatePropertyInformation(this->GetProperty(told));
  }
}

bool vtkSMMotionAnimationProxy::AreInRange(int quality, int stop)
{
  const bool isQuality = quality >= PREVIEW && quality <= PAPER;
  const bool isStop = stop >= AFTER_SCENE && stop <= AFTER_ALL;
  if (!isQuality)
  {
    vtkErrorMacro("Quality: expected 0 (Preview) to " << PAPER << " (Paper), found " << quality);
  }
  if (!isStop)
  {
    vtkErrorMacro("StopAfter: expected 0 (Scene) to " << AFTER_ALL << " (Rotation), found "
                                                      << stop);
  }
  return isQuality && isStop;
}

void vtkSMMotionAnimationProxy::Arrange(int quality, int stop)
{
  vtkSMProxy* planner = this->GetProxy("Planner");
  vtkSMProxy* assimilation = this->GetProxy("Assimilation");
  vtkSMProxy* spacetime = this->GetProxy("Spacetime");
  vtkSMProxy* rotation = this->GetProxy("Rotation");
  const bool draws = quality != PAPER && stop >= AFTER_ASSIMILATION;
  const bool optimises = (quality == FULL || quality == PAPER) && stop >= AFTER_OPTIMISATION;
  vtkSMPropertyHelper(planner, "Active").Set(stop >= AFTER_PLAN);
  vtkSMPropertyHelper(assimilation, "Active").Set(draws);
  vtkSMPropertyHelper(spacetime, "Active").Set(optimises);
  vtkSMPropertyHelper(rotation, "Active").Set(stop >= AFTER_ALL);

  const Source tracks = draws ? Source{ assimilation, 0 } : Source{ planner, 0 };
  const Source rows{ draws ? assimilation : planner, 3 };
  const Source air = draws ? Source{ assimilation, 1 } : Source{};
  Join(spacetime, "Tracks", tracks);
  Join(spacetime, "Constraints", rows);
  Join(spacetime, "Air", air);
  Join(spacetime, "Vortices",
       draws ? Source{ assimilation, 2 } : Source{ this->GetProxy("Vortices"), 0 });
  Join(rotation, "Tracks", optimises ? Source{ spacetime, 0 } : tracks);
  Join(rotation, "Constraints", rows);
  Join(rotation, "Air", air);
}

void vtkSMMotionAnimationProxy::SetDetail(bool isPreview)
{
  vtkSMProxy* assimilation = this->GetProxy("Assimilation");
  vtkPVXMLElement* hints = assimilation->GetHints();
  vtkPVXMLElement* preview = hints != nullptr ? hints->FindNestedElementByName("Preview") : nullptr;
  for (unsigned int i = 0; preview != nullptr && i < preview->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* value = preview->GetNestedElement(i);
    const char* name = value->GetAttributeOrEmpty("name");
    int number = 0;
    if (isPreview && value->GetScalarAttribute("value", &number) != 0)
    {
      vtkSMPropertyHelper(assimilation, name).Set(number);
    }
    else if (vtkSMProperty* property = assimilation->GetProperty(name))
    {
      property->ResetToXMLDefaults();
    }
  }
}

void vtkSMMotionAnimationProxy::SetSeed(int seed)
{
  if (seed < 0)
  {
    auto* scene = vtkSMSourceProxy::SafeDownCast(this->GetProxy("Scene"));
    scene->UpdateVTKObjects();
    scene->UpdatePipelineInformation();
    seed = vtkSMPropertyHelper(scene, "SceneSeed").GetAsInt();
  }
  for (const char* stage : { "Planner", "Assimilation", "Rotation" })
  {
    vtkSMPropertyHelper(this->GetProxy(stage), "Seed").Set(seed);
  }
}

void vtkSMMotionAnimationProxy::SetSlice(double seconds)
{
  for (const char* stage : Stages)
  {
    vtkSMPropertyHelper(this->GetProxy(stage), "Slice", /*quiet=*/true).Set(seconds);
  }
}

// An undo, or a redo, has put them there or away already, beside the property: another registration
// would be a change of its own, after which nothing is left to redo.
void vtkSMMotionAnimationProxy::ShowStages(bool shown)
{
  vtkSMSessionProxyManager* manager = this->GetSessionProxyManager();
  const auto stands = [&](const char* name)
  { return manager->IsProxyInGroup(this->GetProxy(name), "sources") != nullptr; };
  if (shown && !this->AreShown)
  {
    for (const char* name : Stages)
    {
      if (!stands(name))
      {
        manager->RegisterProxy("sources", name, this->GetProxy(name));
      }
    }
  }
  else if (!shown && this->AreShown)
  {
    std::for_each(std::rbegin(Stages), std::rend(Stages),
                  [&](const char* name)
                  {
                    if (stands(name))
                    {
                      manager->UnRegisterProxy(this->GetProxy(name));
                    }
                  });
  }
  this->AreShown = shown;
}

void vtkSMMotionAnimationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Quality: " << this->Arranged[0] << "\n";
  os << indent << "StopAfter: " << this->Arranged[1] << "\n";
  os << indent << "AreShown: " << this->AreShown << "\n";
}
