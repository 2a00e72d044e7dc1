// SPDX-License-Identifier: BSD-3-Clause
// What launchers (mpiexec, srun) say of the processes that they start.
#pragma once

namespace waft::command
{

struct Launch
{
  int Rank = 0, Size = 1;
  int Local = 1;      // of them on this machine
  bool Binds = false; // to some of its cores, by habit and nobody's wish
};
/// Of this process.
Launch FindLaunch();

/// How many threads this process has by default: its machine's cores over the processes there; 0
/// where it is alone: all.
int ThreadsHere();

/// This process is alone from here on, and so are those that it starts.
void LeaveLauncher();

} // namespace waft::command
