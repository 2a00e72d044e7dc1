// SPDX-License-Identifier: BSD-3-Clause
// Several MPI processes that are one run of the command.
#pragma once

#include "Base/Communicator.h"
#include "Launch.h"

#include <functional>
#include <memory>

namespace waft::command
{

/// The first does the run, and the others work for it where work can be divided.
class Team
{
public:
  Team();
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  bool IsFirst() const { return this->Own.Rank == 0; }
  /// Of the first, those that serve it; null where it is alone. Ends the process where MPI knows
  /// another number of them.
  Communicator* Ranks();
  /// What another process does, which says nothing; its exit status. begin: once it is one of them.
  int Serve(const std::function<void()>& begin);

private:
  void Join();

  Launch Own;
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace waft::command
