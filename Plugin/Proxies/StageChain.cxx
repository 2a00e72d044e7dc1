// SPDX-License-Identifier: BSD-3-Clause
#include "StageChain.h"

#include <vtkSMInputProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMPropertyIterator.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>

#include <algorithm>

namespace waft
{

std::vector<SourcePort> JoinedTo(vtkSMProxy* consumer, const char* input)
{
  std::vector<SourcePort> ports;
  vtkSMPropertyHelper helper(consumer, input, /*quiet=*/true);
  for (unsigned int i = 0; i < helper.GetNumberOfElements(); ++i)
  {
    if (auto* source = vtkSMSourceProxy::SafeDownCast(helper.GetAsProxy(i)))
    {
      ports.push_back({ source, helper.GetOutputPort(i) });
    }
  }
  return ports;
}

bool LeadsTo(vtkSMProxy* consumer, vtkSMProxy* giver)
{
  if (consumer == giver)
  {
    return true;
  }
  const auto inputs = vtkSmartPointer<vtkSMPropertyIterator>::Take(consumer->NewPropertyIterator());
  for (inputs->Begin(); !inputs->IsAtEnd(); inputs->Next())
  {
    auto* input = vtkSMInputProperty::SafeDownCast(inputs->GetProperty());
    for (unsigned int i = 0; input != nullptr && i < input->GetNumberOfProxies(); ++i)
    {
      if (input->GetProxy(i) != nullptr && LeadsTo(input->GetProxy(i), giver))
      {
        return true;
      }
    }
  }
  return false;
}

StageChain::~StageChain() = default;

void StageChain::Add(const ChainStageTraits& stage)
{
  vtkSMSourceProxy*& proxy = this->Stages[stage.Stage];
  const bool isNew = proxy == nullptr;
  if (isNew)
  {
    proxy = this->Make("filters", stage.Proxy);
  }
  for (const ChainInput& input : stage.Inputs)
  {
    this->Join(proxy, input.Name, GiversOf(input, this->Detail));
  }
  if (isNew)
  {
    this->Prepare(stage, proxy);
    this->Register(proxy, this->FreeName(stage.Name));
  }
  proxy->UpdateVTKObjects();
}

void StageChain::Prepare(const ChainStageTraits& stage, vtkSMSourceProxy* proxy)
{
  for (const auto& [name, value] : SettingsOf(stage.Stage, this->Detail))
  {
    vtkSMPropertyHelper(proxy, name.c_str()).Set(value);
  }
}

void StageChain::Register(vtkSMSourceProxy* proxy, const std::string& name)
{
  proxy->UpdateVTKObjects();
  this->Manager->RegisterProxy("sources", name.c_str(), proxy);
}

std::string StageChain::FreeName(const char* name) const
{
  return this->Manager->GetUniqueProxyName("sources", name, false);
}

vtkSMSourceProxy* StageChain::Make(const char* group, const char* name)
{
  this->Held.push_back(vtkSmartPointer<vtkSMProxy>::Take(this->Manager->NewProxy(group, name)));
  return vtkSMSourceProxy::SafeDownCast(this->Held.back());
}

void StageChain::Join(vtkSMSourceProxy* proxy, const char* input,
                      const std::vector<ChainOutput>& givers)
{
  std::vector<SourcePort> ports;
  for (const ChainOutput& giver : givers)
  {
    if (giver.Stage != ChainStage::Scene)
    {
      ports.push_back({ this->Stages[giver.Stage], static_cast<unsigned int>(PortOf(giver)) });
    }
    else if (const auto found = this->Scene.find(giver.Name); found != this->Scene.end())
    {
      ports.push_back(found->second);
    }
  }
  const std::vector<SourcePort> before = JoinedTo(proxy, input);
  const auto isTaken = [&before](const SourcePort& port)
  { return before.size() == 1 && LeadsTo(before[0].Source, port.Source); };
  if (ports.empty() || (ports.size() > 1 && std::all_of(ports.begin(), ports.end(), isTaken)))
  {
    return;
  }
  if (ports.size() == 1)
  {
    vtkSMPropertyHelper(proxy, input).Set(ports[0].Source, ports[0].Index);
    return;
  }
  vtkSMSourceProxy* all = this->Make("filters", "AppendPolyData");
  for (const SourcePort& port : ports)
  {
    vtkSMPropertyHelper(all, "Input").Add(port.Source, port.Index);
  }
  this->Register(all, this->FreeName(input));
  vtkSMPropertyHelper(proxy, input).Set(all, 0);
}

} // namespace waft
