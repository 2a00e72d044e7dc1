// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/Upstream.h"

#include <vtkAlgorithm.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationExecutivePortKey.h>
#include <vtkInformationExecutivePortVectorKey.h>
#include <vtkInformationVector.h>

#include <algorithm>
#include <set>

namespace waft
{
namespace
{

// A producer and all that is upstream of it.
void AddUpstream(vtkExecutive* producer, std::set<vtkExecutive*>& upstream)
{
  if (producer == nullptr || !upstream.insert(producer).second)
  {
    return;
  }
  for (int port = 0; port < producer->GetNumberOfInputPorts(); ++port)
  {
    vtkInformationVector* inputs = producer->GetInputInformation(port);
    for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
    {
      AddUpstream(ProducerOf(inputs->GetInformationObject(i)), upstream);
    }
  }
}

std::set<vtkExecutive*> UpstreamOf(vtkAlgorithm* stage, vtkInformationVector** inputs)
{
  std::set<vtkExecutive*> upstream;
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      AddUpstream(ProducerOf(inputs[port]->GetInformationObject(i)), upstream);
    }
  }
  return upstream;
}

// Whether a consumer of any output of a producer is one of those that count.
template <typename Test>
bool AnyConsumer(vtkExecutive* producer, const Test& counts)
{
  vtkInformationVector* outputs = producer->GetOutputInformation();
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    vtkExecutive** consumers = vtkExecutive::CONSUMERS()->GetExecutives(output);
    const int count = vtkExecutive::CONSUMERS()->Length(output);
    if (std::any_of(consumers, consumers + count, counts))
    {
      return true;
    }
  }
  return false;
}

} // namespace

vtkExecutive* ProducerOf(vtkInformation* input)
{
  vtkExecutive* producer = nullptr;
  int port = 0;
  vtkExecutive::PRODUCER()->Get(input, producer, port);
  return producer;
}

vtkInformation* ProducedInformation(vtkInformation* input)
{
  vtkExecutive* producer = ProducerOf(input);
  if (producer != nullptr && producer->GetAlgorithm()->IsA("vtkPVPostFilter"))
  {
    // ParaView puts it behind each output of a proxy; it hands data through, but no key of ours.
    return producer->GetInputInformation(0)->GetInformationObject(0);
  }
  return input;
}

bool IsOnlyConsumer(vtkAlgorithm* stage, vtkInformation* input)
{
  vtkExecutive* producer = ProducerOf(input);
  return producer != nullptr && !AnyConsumer(producer, [stage](vtkExecutive* other)
                                             { return other != stage->GetExecutive(); });
}

bool HasCommonUpstream(vtkAlgorithm* stage, vtkInformationVector** inputs)
{
  const std::set<vtkExecutive*> upstream = UpstreamOf(stage, inputs);
  const auto isOther = [&](vtkExecutive* consumer)
  { return consumer != stage->GetExecutive() && upstream.count(consumer) == 0; };
  return std::any_of(upstream.begin(), upstream.end(),
                     [&](vtkExecutive* producer) { return AnyConsumer(producer, isOther); });
}

} // namespace waft
