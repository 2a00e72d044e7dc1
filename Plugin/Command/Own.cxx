// SPDX-License-Identifier: BSD-3-Clause
// What the command carries out by itself, with VTK: flights, checks and databases.
#include "Act.h"
#include "Bridge/Run/BuildName.h"
#include "Commands.h"
#include "Messages.h"
#include "Programs.h"
#include "Stops.h"
#include "Team.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <climits>
#include <csignal>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace
{

using namespace waft::command;

// What a field gives back is kept for the next one: to have it from the system anew, page by page,
// took an eighth of a flight's time.
void KeepMemory()
{
#ifdef __GLIBC__
  if (mallopt(M_MMAP_THRESHOLD, 32 << 20) != 0) // the most that it takes
  {
    mallopt(M_TRIM_THRESHOLD, INT_MAX);
  }
#endif
}

void Answer(const CommandLine& line, int status, const waft::SceneJson& answer)
{
  if (line.IsJson)
  {
    waft::SceneJson document = { { "waft", waft::WaftVersion },
                                 { "command", line.Name },
                                 { "status", status } };
    document.update(answer);
    Tell(document.dump(2, ' ', true, waft::SceneJson::error_handler_t::replace));
  }
}

int GiveUp(const CommandLine& line, const std::string& words, int status)
{
  Say("waft: " + Shortened(words), Message::Error);
  Answer(line, status, { { "error", Line(Shortened(words)) } });
  return status;
}

void SetThreads(int given)
{
  const int threads = given > 0 ? given : ThreadsHere();
  vtkSMPTools::SetBackend(threads != 1 ? "STDThread" : "Sequential");
  vtkSMPTools::Initialize(threads);
}

waft::Result Act(const CommandLine& line, waft::Communicator* ranks, int& status,
                 waft::SceneJson& answer)
{
  try
  {
    return line.Name == "synthesize" ? Synthesize(line, ranks, status, answer)
           : line.Name == "check"    ? CheckScene(line, status, answer)
                                     : MakeDatabase(line, ranks, status);
  }
  catch (const std::bad_alloc&)
  {
    return waft::Result::Error("too little memory", waft::ErrorKind::Memory);
  }
  catch (const std::length_error&) // of a container, beyond any memory
  {
    return waft::Result::Error("expected an input that fits into memory, found one beyond any");
  }
}

int CarryOut(CommandLine& line, waft::Communicator* ranks)
{
  SetThreads(line.Threads);
  const auto end = [&line](const std::string& words)
  {
    GiveUp(line, words, StoppedEarly);
    EndLog(StoppedEarly);
  };
  const bool checks = line.Name == "check";
  EndStopsBy(checks ? "stopped: a check writes nothing"
             : line.Name == "synthesize"
               ? "stopped before the paths were planned: nothing was written"
               : "",
             checks ? 0.0 : line.TimeLimit, end);
  int status = AllMet;
  waft::SceneJson answer = waft::SceneJson::object();
  const waft::Result done = Act(line, ranks, status, answer);
  EndStopsBy("", 0.0, {});
  if (!done)
  {
    return GiveUp(line, done.Message(), StatusOf(done.Kind()));
  }
  Answer(line, status, answer);
  return status;
}

/// Flights are this program's again, each with the command line but for --watch.
int Watch(const CommandLine& line, const std::vector<std::string>& arguments)
{
  std::vector<std::string> watch = { "watch", line.Flight.Scene, line.Flight.Output };
  std::copy_if(arguments.begin() + 1, arguments.end(), std::back_inserter(watch),
               [](const std::string& argument) { return argument != "--watch"; });
  Say("waft: " + BecomePython(watch), Message::Error);
  return Failed;
}

int RunOwn(const std::vector<std::string>& arguments, Team& team)
{
  int status = -1;
  CommandLine line = Parse(arguments, status);
  if (status >= 0)
  {
    return status;
  }
  SetLoudness(line.Shown);
  const waft::Result logged =
    line.Log.empty() || line.IsWatched ? waft::Result::Ok() : BeginLog(line.Log, arguments);
  if (!logged)
  {
    return GiveUp(line, logged.Message(), StatusOf(logged.Kind()));
  }
  const waft::Result settled = Settle(line);
  if (settled && line.IsWatched)
  {
    return Watch(line, arguments);
  }
  status = settled ? CarryOut(line, team.Ranks())
                   : GiveUp(line, settled.Message(), StatusOf(settled.Kind()));
  EndLog(status);
  return status;
}

int Run(const std::vector<std::string>& arguments)
{
  if (arguments ==
      std::vector<std::string>{ "--describe-commands" }) // for the package, when it is built
  {
    Tell(DescribeCommands());
    return AllMet;
  }
  Team team;
  if (team.IsFirst())
  {
    return RunOwn(arguments, team);
  }
  int status = -1;
  const CommandLine line = Parse(arguments, status);
  return status >= 0 ? AllMet // the first says what is wrong
                     : team.Serve([&line] { SetThreads(line.Threads); });
}

} // namespace

int main(int count, char** words)
{
  KeepMemory();
  std::signal(SIGPIPE, SIG_IGN); // whoever stops to read what is said does not end the work
  std::signal(SIGXFSZ, SIG_IGN); // it is told of as a full disk is
  EndStopsBy("stopped before anything was begun", 0.0,
             [](const std::string& said) { Say("waft: " + said, Message::Error); });
  const int status = Run({ words + std::min(count, 1), words + count });
  if (!IsTold())
  {
    if (!IsRead()) // as other programs end then
    {
      std::signal(SIGPIPE, SIG_DFL);
      ::raise(SIGPIPE);
    }
    return Failed;
  }
  return status;
}
