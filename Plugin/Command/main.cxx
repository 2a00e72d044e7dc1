// SPDX-License-Identifier: BSD-3-Clause
// The command `waft`. Stops wait from its first step on, whatever then takes its place: the program
// that flies, checks and makes databases with VTK (Own.cxx), or Python for all else.
#include "Bridge/Run/BuildName.h"
#include "Launch.h"
#include "Programs.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace
{

using namespace waft::command;

/// What is closed of stdin, stdout and stderr would be taken by the next file that is opened.
void FillGaps()
{
  struct stat about = {};
  for (int number = 0; number < 3; ++number)
  {
    if (::fstat(number, &about) != 0)
    {
      (void)!::open("/dev/null", O_RDONLY); // takes the lowest number that is free
    }
  }
}

bool IsOwn(const std::string& command)
{
  return command == "synthesize" || command == "check" || command == "database" ||
         command == "--describe-commands";
}

} // namespace

int main(int count, char** words)
{
  HoldStops();
  FillGaps();
  const std::vector<std::string> arguments(words + (count > 0 ? 1 : 0), words + count);
  const std::string command = arguments.empty() ? "" : arguments.front();
  std::array<char, 4096> folder{};
  const bool isGone = ::getcwd(folder.data(), folder.size()) == nullptr && errno == ENOENT;
  std::string lack = isGone
                       ? "the working folder is gone: expected to be called in one that is there"
                       : CheckPackage();
  if (!IsOwn(command) && FindLaunch().Rank != 0) // it has nothing to divide
  {
    return 0;
  }
  if (lack.empty() && command == "--version" && arguments.size() == 1)
  {
    if (std::printf("waft %s\n", waft::WaftVersion) > 0 && std::fflush(stdout) == 0)
    {
      return 0;
    }
    lack = std::string("stdout: could not be written: ") + std::strerror(errno);
  }
  if (lack.empty())
  {
    lack = IsOwn(command) ? BecomeOwn(arguments) : BecomePython(arguments);
  }
  std::fprintf(stderr, "waft: %s\n", lack.c_str());
  return 1;
}
