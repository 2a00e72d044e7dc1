// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/Ranks.h"

#include <vtkDataObject.h>
#ifdef WAFT_HAS_MPI
#include <vtkMPIController.h>
#endif
#include <vtkMultiProcessController.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace waft
{
namespace
{

constexpr int Tag = 58713; // of messages, not used by VTK or ParaView

#ifdef WAFT_HAS_MPI
/// Returns when there is something to receive. MPI's own waiting would take a core, which is a
/// thread's of another rank.
void Await(vtkMPIController* controller, int from)
{
  using namespace std::chrono_literals;
  constexpr int glances = 1000; // some hundreds of microseconds
  constexpr std::chrono::microseconds longest = 2ms;
  std::chrono::microseconds pause = 20us;
  int isThere = 0;
  for (int k = 0; controller->Iprobe(from, Tag, &isThere, nullptr) && !isThere; ++k)
  {
    if (k > glances)
    {
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, longest);
    }
  }
}
#endif

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
#ifdef WAFT_HAS_MPI
    if (auto* mpi = vtkMPIController::SafeDownCast(this->Controller))
    {
      Await(mpi, other);
    }
#endif
    this->Controller->Receive(static_cast<char*>(received), static_cast<vtkIdType>(receivedSize),
                              other, Tag);
  }
  if (this->Rank() > other)
  {
    send();
  }
}

bool ControllerCommunicator::HasMessage(int from)
{
  int isThere = 0;
#ifdef WAFT_HAS_MPI
  if (auto* mpi = vtkMPIController::SafeDownCast(this->Controller))
  {
    mpi->Iprobe(from, Tag, &isThere, nullptr);
  }
#else
  (void)from;
#endif
  return isThere != 0;
}

int ItemsAtOnce()
{
  return std::clamp(vtkSMPTools::GetEstimatedNumberOfThreads(), 1, 32);
}

bool IsWithFirstRank(vtkDataObject* data)
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  return controller != nullptr && controller->GetLocalProcessId() > 0 && data != nullptr &&
         data->GetNumberOfElements(vtkDataObject::POINT) == 0;
}

} // namespace waft
