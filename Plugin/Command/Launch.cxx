// SPDX-License-Identifier: BSD-3-Clause
#include "Launch.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace waft::command
{
namespace
{

struct LauncherNames
{
  const char *Rank, *Size,
    *Local;   // this process' number, how many there are, how many on this machine
  bool Binds; // to some of its cores, by habit and nobody's wish
};
constexpr LauncherNames Launchers[] = {
  { "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_SIZE", true },
  { "PMIX_RANK", "SLURM_STEP_NUM_TASKS", "SLURM_STEP_TASKS_PER_NODE", false }
};

std::optional<int> NumberIn(const char* name)
{
  const char* text = std::getenv(name);
  char* end = nullptr;
  const long number = text != nullptr ? std::strtol(text, &end, 10) : 0;
  return text != nullptr && end != text ? std::optional<int>(static_cast<int>(number))
                                        : std::nullopt;
}

} // namespace

Launch FindLaunch()
{
  for (const LauncherNames& names : Launchers)
  {
    const auto rank = NumberIn(names.Rank), size = NumberIn(names.Size),
               local = NumberIn(names.Local);
    if (rank && size && local)
    {
      return *size > 1 ? Launch{ *rank, *size, std::max(*local, 1), names.Binds } : Launch();
    }
  }
  return {};
}

int ThreadsHere()
{
  const Launch found = FindLaunch();
  if (found.Size == 1)
  {
    return 0;
  }
  const auto given = NumberIn("SLURM_CPUS_PER_TASK");
  cpu_set_t own;
  ::sched_getaffinity(0, sizeof(own), &own);
  return given ? *given : std::max(1, CPU_COUNT(&own) / found.Local);
}

void LeaveLauncher()
{
  std::vector<std::string> names;
  for (char** entry = environ; *entry != nullptr; ++entry)
  {
    const std::string name(*entry, std::string(*entry).find('='));
    for (const char* head : { "OMPI_", "PMIX_", "PMI_", "ORTE_", "PRTE_" })
    {
      if (name.compare(0, std::string(head).size(), head) == 0)
      {
        names.push_back(name);
      }
    }
  }
  for (const std::string& name : names)
  {
    ::unsetenv(name.c_str());
  }
}

} // namespace waft::command
