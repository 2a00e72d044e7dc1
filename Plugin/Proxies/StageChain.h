// SPDX-License-Identifier: BSD-3-Clause
// The stages of a flight as proxies of ParaView.
#pragma once

#include "Chain/ChainTable.h"

#include <vtkSmartPointer.h>

#include <map>
#include <string>
#include <vector>

class vtkSMProxy;
class vtkSMSessionProxyManager;
class vtkSMSourceProxy;

namespace waft
{

struct SourcePort
{
  vtkSMSourceProxy* Source = nullptr;
  unsigned int Index = 0;
};

/// What an input of a proxy is joined to now, one of each connection.
std::vector<SourcePort> JoinedTo(vtkSMProxy* consumer, const char* input);
/// Whether a proxy is another, or takes from it, be it through others.
bool LeadsTo(vtkSMProxy* consumer, vtkSMProxy* giver);

/// Makes the stages of a quality and joins them as the table of the chain has it. Stages that are
/// there already are joined anew.
class StageChain
{
public:
  StageChain(vtkSMSessionProxyManager* manager, Quality detail) : Manager(manager), Detail(detail)
  {
  }
  virtual ~StageChain();

  void Add(const ChainStageTraits& stage);

protected:
  /// A stage is set for its quality; before it is registered.
  virtual void Prepare(const ChainStageTraits& stage, vtkSMSourceProxy* proxy);
  virtual void Register(vtkSMSourceProxy* proxy, const std::string& name);
  vtkSMSourceProxy* Make(const char* group, const char* name);
  std::string FreeName(const char* name) const;

  vtkSMSessionProxyManager* Manager;
  Quality Detail;
  std::map<std::string, SourcePort>
    Scene; // by the names of the table; what is not there is left out
  std::map<ChainStage, vtkSMSourceProxy*> Stages;

private:
  void Join(vtkSMSourceProxy* proxy, const char* input, const std::vector<ChainOutput>& givers);

  std::vector<vtkSmartPointer<vtkSMProxy>> Held;
};

} // namespace waft
