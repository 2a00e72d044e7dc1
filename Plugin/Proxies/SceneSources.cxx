// SPDX-License-Identifier: BSD-3-Clause
#include "SceneSources.h"

#include <vtkNew.h>
#include <vtkPVDataInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMInputProperty.h>
#include <vtkSMPropertyIterator.h>
#include <vtkSMProxyIterator.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <utility>

namespace waft
{

namespace
{

/// Stages of the same menus take what is made here.
bool NeedsInput(vtkSMProxy* proxy)
{
  const auto held = vtkSmartPointer<vtkSMPropertyIterator>::Take(proxy->NewPropertyIterator());
  for (held->Begin(); !held->IsAtEnd(); held->Next())
  {
    vtkSMProperty* property = held->GetProperty();
    vtkPVXMLElement* hints = property->GetHints();
    if (vtkSMInputProperty::SafeDownCast(property) != nullptr &&
        (hints == nullptr || hints->FindNestedElementByName("Optional") == nullptr))
    {
      return true;
    }
  }
  return false;
}

/// Those that a hand makes: their place in the menu tells.
bool IsOfScene(vtkSMProxy* proxy)
{
  vtkPVXMLElement* hints = proxy->GetHints();
  vtkPVXMLElement* menu = hints != nullptr ? hints->FindNestedElementByName("ShowInMenu") : nullptr;
  const std::string category = menu != nullptr ? menu->GetAttributeOrEmpty("category") : "";
  return (category == "Waft Scene" || category == "Waft Bodies") && !NeedsInput(proxy);
}

std::string ListOf(const std::vector<SourcePort>& ports)
{
  std::string list;
  for (const SourcePort& port : ports)
  {
    list += (list.empty() ? "" : ", ") + NameOf(port.Source);
  }
  return list;
}

} // namespace

std::string NameOf(vtkSMProxy* source)
{
  const char* name = source->GetSessionProxyManager()->GetProxyName("sources", source);
  return name != nullptr ? name : source->GetXMLName();
}

SceneSources::SceneSources(vtkSMSessionProxyManager* session)
{
  std::vector<vtkSMSourceProxy*> sources;
  vtkNew<vtkSMProxyIterator> every;
  every->SetSessionProxyManager(session);
  every->SetModeToOneGroup();
  for (every->Begin("sources"); !every->IsAtEnd(); every->Next())
  {
    auto* source = vtkSMSourceProxy::SafeDownCast(every->GetProxy());
    if (source != nullptr && IsOfScene(source))
    {
      source->CreateOutputPorts();
      sources.push_back(source);
    }
  }
  // Objects of a file count its shapes from 0: a file is before what was made by hand.
  const auto place = [](vtkSMSourceProxy* source)
  { return std::make_pair(source->GetNumberOfOutputPorts() == 1, source->GetGlobalID()); };
  std::sort(sources.begin(), sources.end(),
            [&](vtkSMSourceProxy* a, vtkSMSourceProxy* b) { return place(a) < place(b); });
  for (vtkSMSourceProxy* source : sources)
  {
    this->Take(source);
  }
}

// A scene file may have nothing for a port.
void SceneSources::Take(vtkSMSourceProxy* source)
{
  const unsigned int count = source->GetNumberOfOutputPorts();
  if (count > 1)
  {
    source->UpdatePipeline();
  }
  for (unsigned int port = 0; port < count; ++port)
  {
    if (count == 1 || source->GetDataInformation(port)->GetNumberOfPoints() > 0)
    {
      this->Ports[source->GetOutputPortName(port)].push_back({ source, port });
    }
  }
}

const std::vector<SourcePort>& SceneSources::All(const std::string& output) const
{
  static const std::vector<SourcePort> none;
  const auto found = this->Ports.find(output);
  return found != this->Ports.end() ? found->second : none;
}

std::string SceneSources::Refusal() const
{
  if (this->All("Objects").empty())
  {
    return "there are no objects: add an Object";
  }
  if (this->All("Constraints").empty())
  {
    return "there are no marks: add a Constraint or a Shape Keyframe";
  }
  std::vector<SourcePort> files;
  for (const SourcePort& objects : this->All("Objects"))
  {
    if (objects.Source->GetNumberOfOutputPorts() > 1)
    {
      files.push_back(objects);
    }
  }
  const std::vector<SourcePort>& winds = this->All("Wind");
  return winds.size() > 1   ? "expected one wind, found " + ListOf(winds)
         : files.size() > 1 ? "expected one scene file, found " + ListOf(files)
                            : "";
}

} // namespace waft
