// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/Ranks.h"

#include <vtkDataObject.h>
#include <vtkMultiProcessController.h>

namespace waft
{
namespace
{

constexpr int Tag = 58713; // of messages, not used by VTK or ParaView

} // namespace

int ControllerCommunicator::Rank() const
{
  return this->Controller != nullptr ? this->Controller->GetLocalProcessId() : 0;
}

int ControllerCommunicator::Size() const
{
  return this->Controller != nullptr ? this->Controller->GetNumberOfProcesses() : 1;
}

// Sending may wait until the other receives: the lower rank sends first.
void ControllerCommunicator::SendReceive(int other, const void* sent, std::size_t sentSize,
                                         void* received, std::size_t receivedSize)
{
  const auto send = [&]
  {
    if (sentSize > 0)
    {
      this->Controller->Send(static_cast<const char*>(sent), static_cast<vtkIdType>(sentSize),
                             other, Tag);
    }
  };
  if (this->Rank() < other)
  {
    send();
  }
  if (receivedSize > 0)
  {
    this->Controller->Receive(static_cast<char*>(received), static_cast<vtkIdType>(receivedSize),
                              other, Tag);
  }
  if (this->Rank() > other)
  {
    send();
  }
}

bool IsWithFirstRank(vtkDataObject* data)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller != nullptr && controller->GetLocalProcessId() > 0 && data != nullptr &&
         data->GetNumberOfElements(vtkDataObject::POINT) == 0;
}

} // namespace waft
