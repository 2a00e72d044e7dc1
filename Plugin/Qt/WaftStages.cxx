// SPDX-License-Identifier: BSD-3-Clause
#include "WaftStages.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

#include <algorithm>

namespace waft
{

namespace
{

/// An information of a stage as it is now.
vtkSMPropertyHelper Ask(vtkSMProxy* stage, const char* name)
{
  stage->UpdatePropertyInformation(stage->GetProperty(name));
  return { stage, name };
}

enum WorkState // of vtkSlicedPolyDataAlgorithm
{
  NoWork,
  Held,
  Beside,
  Arrived
};

bool LeadsTo(vtkSMProxy* consumer, vtkSMProxy* giver)
{
  if (consumer == giver)
  {
    return true;
  }
  for (unsigned int i = 0; i < consumer->GetNumberOfProducers(); ++i)
  {
    if (LeadsTo(consumer->GetProducerProxy(i), giver))
    {
      return true;
    }
  }
  return false;
}

} // namespace

bool WorksInSlices(vtkSMProxy* source)
{
  return source->GetProperty("WorkInSlices") != nullptr;
}

bool IsComplete(vtkSMProxy* source)
{
  return Ask(source, "Complete").GetAsInt() != 0;
}

std::vector<pqPipelineSource*> RelatedTo(vtkSMProxy* source)
{
  std::vector<pqPipelineSource*> related;
  const auto model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* one : model->findItems<pqPipelineSource*>())
  {
    if (source != nullptr && (LeadsTo(source, one->getProxy()) || LeadsTo(one->getProxy(), source)))
    {
      related.push_back(one);
    }
  }
  return related;
}

bool WantsNewAir(vtkSMProxy* source)
{
  return source->GetProperty("WantsNewAir") != nullptr &&
         Ask(source, "WantsNewAir").GetAsInt() != 0;
}

Stages UnfinishedStages()
{
  Stages unfinished;
  const auto model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (WorksInSlices(source->getProxy()) && !IsComplete(source->getProxy()))
    {
      unfinished.emplace_back(source);
    }
  }
  return unfinished;
}

void WorkInSlices(vtkSMProxy* source)
{
  if (WorksInSlices(source))
  {
    source->InvokeCommand("WorkInSlices");
  }
}

void LetGo(vtkSMProxy* source)
{
  if (WorksInSlices(source))
  {
    source->InvokeCommand("LetGo");
  }
}

WorkOfStages WorkOf(const Stages& stages, std::size_t begun)
{
  WorkOfStages all;
  int works = 0; // the others wait for these
  for (pqPipelineSource* source : stages)
  {
    vtkSMProxy* stage = source->getProxy();
    const int state = Ask(stage, "WorkState").GetAsInt();
    if (state == NoWork)
    {
      continue;
    }
    all.IsBeside = all.IsBeside || state == Beside;
    all.IsHeld = all.IsHeld || state == Held;
    all.HasArrived = all.HasArrived || state == Arrived;
    const double left = Ask(stage, "SecondsLeft").GetAsDouble();
    const bool isKnown = left >= 0.0 && (works == 0 || all.SecondsLeft >= 0.0);
    all.SecondsLeft = isKnown ? std::max(left, all.SecondsLeft) : -1.0;
    all.Done += Ask(stage, "WorkDone").GetAsDouble();
    if (works++ == 0)
    {
      all.Message = QString::fromUtf8(Ask(stage, "Message").GetAsString());
    }
  }
  const std::size_t count = std::max({ begun, stages.size(), std::size_t(1) });
  all.Done = (all.Done + static_cast<double>(count - stages.size())) / static_cast<double>(count);
  return all;
}

void HoldWork(const Stages& stages)
{
  for (const QPointer<pqPipelineSource>& source : stages)
  {
    if (source)
    {
      source->getProxy()->InvokeCommand("Hold");
    }
  }
}

void UpdateStages(const Stages& stages, double time)
{
  for (pqPipelineSource* source : stages)
  {
    source->getProxy()->InvokeCommand("GoOn");
    source->getProxy()->MarkModified(source->getProxy());
  }
  for (const QPointer<pqPipelineSource>& source : stages)
  {
    if (source)
    {
      vtkSMSourceProxy::SafeDownCast(source->getProxy())->UpdatePipeline(time);
    }
  }
}

} // namespace waft
