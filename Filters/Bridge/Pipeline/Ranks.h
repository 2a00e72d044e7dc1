// SPDX-License-Identifier: BSD-3-Clause
// The ranks of a vtkMultiProcessController as Core sees them.
#pragma once

#include "Base/Communicator.h"

class vtkDataObject;
class vtkMultiProcessController;

namespace waft
{

/// Ranks of a controller; one rank where it is null. A rank that waits sleeps.
class ControllerCommunicator : public Communicator
{
public:
  explicit ControllerCommunicator(vtkMultiProcessController* controller) : Controller(controller) {}
  int Rank() const override;
  int Size() const override;
  void SendReceive(int other, const void* sent, std::size_t sentSize, void* received,
                   std::size_t receivedSize) override;
  bool HasMessage(int from) override;

private:
  vtkMultiProcessController* Controller;
};

/// Items of shared work that this process has at once: a thread each, while their memory is
/// bounded.
int ItemsAtOnce();

/// True on a rank but the first of the global controller when the data of a scene came in empty:
/// they are with the first rank, and here is nothing to do.
bool IsWithFirstRank(vtkDataObject* data);

} // namespace waft
