// SPDX-License-Identifier: BSD-3-Clause
#include "Team.h"

#include "Base/SharedWork.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Run/ServeRanks.h"
#include "Messages.h"

#ifdef WAFT_HAS_MPI
#include <vtkMPIController.h>
#include <vtkNew.h>
#endif

#include <sched.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace waft::command
{

struct Team::Internals
{
#ifdef WAFT_HAS_MPI
  vtkNew<vtkMPIController> Controller;
#endif
  std::unique_ptr<ControllerCommunicator> Ranks;
  bool IsServed = false; // others wait
};

Team::Team() : Own(FindLaunch()), Impl(std::make_unique<Internals>()) {}

Team::~Team()
{
  if (this->Impl->IsServed)
  {
    Release(*this->Impl->Ranks);
  }
#ifdef WAFT_HAS_MPI
  if (this->Impl->Ranks)
  {
    this->Impl->Ranks.reset();
    this->Impl->Controller
      ->Finalize(); // else the launcher takes the end of a process for its failure
  }
#endif
}

void Team::Join()
{
  if (this->Own.Binds)
  {
    cpu_set_t all;
    CPU_ZERO(&all);
    for (long core = 0; core < ::sysconf(_SC_NPROCESSORS_CONF); ++core)
    {
      CPU_SET(static_cast<std::size_t>(core), &all);
    }
    ::sched_setaffinity(0, sizeof(all), &all);
  }
  int known = 1;
#ifdef WAFT_HAS_MPI
  ::setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0); // for the threads of others
  const char* folder = std::getenv("TMPDIR");
  if (folder != nullptr && ::access(folder, W_OK | X_OK) != 0)
  {
    ::unsetenv("TMPDIR"); // with which MPI would fail
  }
  int count = 0;
  char** words = nullptr;
  this->Impl->Controller->Initialize(&count, &words, /*initializedExternally=*/0);
  vtkMultiProcessController::SetGlobalController(this->Impl->Controller);
  this->Impl->Ranks = std::make_unique<ControllerCommunicator>(this->Impl->Controller);
  known = this->Impl->Ranks->Size();
#endif
  if (known != this->Own.Size)
  {
    Say("waft: " + std::to_string(this->Own.Size) + " processes were started, of which MPI knows " +
          std::to_string(known) + ": expected the launcher of the MPI that VTK was built with",
        Message::Error);
    std::exit(Failed);
  }
  SetProcessesHere(this->Own.Local);
}

Communicator* Team::Ranks()
{
  if (this->Own.Size == 1)
  {
    return nullptr;
  }
  this->Join();
  this->Impl->IsServed = true;
  return this->Impl->Ranks.get();
}

int Team::Serve(const std::function<void()>& begin)
{
  this->Join();
  begin();
  ServeRanks(*this->Impl->Ranks);
  return AllMet;
}

} // namespace waft::command
