// SPDX-License-Identifier: BSD-3-Clause
#include "Act.h"

#include "Bridge/Files/EmbeddedDatabase.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Run/FlyScene.h"
#include "Bridge/Run/MakeDatabase.h"
#include "Chain/ChainScene.h"
#include "Chain/JudgeScene.h"
#include "Programs.h"
#include "Stops.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace waft::command
{
namespace
{

constexpr const char* Rows = "row N is entry N of `constraints` in the scene file, counted from 0; "
                             "target N is the Nth of its places";

SceneJson NumberOrNull(int number)
{
  return number >= 0 ? SceneJson(number) : SceneJson();
}

std::string Fixed(const char* form, double value)
{
  char text[40];
  std::snprintf(text, sizeof(text), form, value);
  return text;
}

/// Warnings, constraints that are not met, and a line of figures.
void ReportFlight(const FlightRequest& request, const Flight& flight)
{
  for (const std::string& warning : flight.Record.Warnings)
  {
    Warn(warning);
  }
  std::size_t met = 0, all = 0;
  for (const JoinedRow& row : flight.Made.Report)
  {
    if (row.Target == OfNoRow)
    {
      continue;
    }
    ++all;
    if (row.Status == ConstraintStatus::Met)
    {
      ++met;
      continue;
    }
    Say("waft: row " + std::to_string(row.Row) + " target " + std::to_string(row.Target) +
          " (object " + std::to_string(row.ObjectId) + ", frame " + std::to_string(row.Frame) +
          ", " + ToString(row.Kind) + "): " + ToString(row.Status) + ": " + row.Message,
        Message::Warning);
  }
  if (met < all)
  {
    Say(std::string("waft: ") + Rows, Message::Warning);
  }
  std::string missing;
  for (const std::string& name : flight.Record.LeftOut(request, flight.Made))
  {
    missing += (missing.empty() ? "" : ", ") + name;
  }
  if (!missing.empty())
  {
    Say("waft: stopped: without " + missing + "; --resume goes on and writes all");
  }
  std::string seconds =
    std::string(TraitsOf(ChainStage::Scene).Word) + Fixed(" %.1f s", flight.Record.Reading.Seconds);
  for (const auto& [stage, effort] : flight.Made.Efforts)
  {
    seconds += std::string(", ") + TraitsOf(stage).Word + Fixed(" %.1f s", effort.Seconds);
    Say(std::string("waft: ") + TraitsOf(stage).Word + Fixed(": %.1f s, ", effort.Seconds) +
          Fixed("%.1f s of processor time, ", effort.Processor) + Fixed("%.0f MB", effort.PeakMB),
        Message::Detail);
  }
  Say(request.Output + ": " + std::to_string(met) + " of " + std::to_string(all) +
      " constraints met (" + seconds + ")");
}

} // namespace

Result Synthesize(const CommandLine& line, Communicator* ranks, int& status, SceneJson& answer)
{
  const SceneJson defaults = SceneJson::parse(line.Flight.Defaults, nullptr, false);
  for (const auto& [name, taken] : defaults.items())
  {
    const SceneJson& value = taken["value"];
    Say("waft: " + name + " " + (value.is_string() ? value.get<std::string>() : value.dump()) +
        ", by " + taken["from"].get<std::string>());
  }
  Flight flight;
  ShownProgress progress(line.TellsJson);
  const Result flown = FlyScene(line.Flight, ranks, progress, flight);
  WAFT_RETURN_IF_FAILED(flown);
  progress.Report(1.0, flight.Record.IsStopped ? "stopped early" : "done");
  ReportFlight(line.Flight, flight);
  status = flight.Record.IsStopped ? StoppedEarly : flight.IsMet() ? AllMet : NotAllMet;
  if (line.IsJson)
  {
    std::string told;
    const std::string lack = AskPython({ "info", "--json", "--", line.Flight.Output }, told);
    if (!lack.empty())
    {
      return Result::Error(lack, ErrorKind::Disk);
    }
    const SceneJson document = SceneJson::parse(told, nullptr, false);
    answer["result"] =
      document.is_object() && document.contains("result") ? document["result"] : SceneJson();
  }
  return Result::Ok();
}

Result CheckScene(const CommandLine& line, int& status, SceneJson& answer)
{
  const std::string& file = line.Flight.Scene;
  const std::string& database = line.Flight.Database;
  WAFT_RETURN_IF_FAILED(CheckSceneFile(file));
  WAFT_RETURN_IF_FAILED(database.empty() ? Result::Ok() : CheckDatabase(database));
  Scene scene;
  SceneWind wind;
  MotionDatabase motions;
  WAFT_RETURN_IF_FAILED(ReadSceneAndWind(file, VtkSceneAssets(), scene, wind));
  WAFT_RETURN_IF_FAILED(database.empty() ? ReadEmbeddedDatabase(motions)
                                         : ReadDatabaseFile(database, motions));
  SceneJudgement judgement;
  const Result judged = JudgeScene(scene, motions, SmpFor(), judgement);
  if (!judged)
  {
    return Result::Error(file + ": " + judged.Message(), judged.Kind());
  }
  const auto say = [&](const std::string& text)
  {
    if (!line.IsJson)
    {
      Tell(Line(text));
    }
    Say(text, Message::Record);
  };
  bool namesRow = false;
  for (const std::string& text : judgement.Lines())
  {
    say("waft: " + text);
    const std::size_t at = text.find("row ");
    namesRow = namesRow || (at != std::string::npos && at + 4 < text.size() &&
                            std::string("0123456789").find(text[at + 4]) != std::string::npos);
  }
  if (namesRow)
  {
    say(std::string("waft: ") + Rows);
  }
  const std::size_t impossible = judgement.NumberOfImpossible();
  say("waft: " + file + ": " + std::to_string(judgement.NumberOfObjects) + " objects, " +
      std::to_string(judgement.Report.size()) + " constraints, " + std::to_string(impossible) +
      " of them cannot be met, " + std::to_string(judgement.Findings.size() - impossible) +
      " remarks on what will be hard");
  answer["scene"] = file;
  answer["objects"] = judgement.NumberOfObjects;
  answer["constraints"] = judgement.Report.size();
  answer["findings"] = SceneJson::array();
  for (const Finding& one : judgement.Findings)
  {
    answer["findings"].push_back(
      { { "possible", one.IsPossible },
        { "kind", one.Kind },
        { "text", one.Text },
        { "object", NumberOrNull(one.ObjectId) },
        { "frame", NumberOrNull(one.Frame) },
        { "row", NumberOrNull(one.Row) },
        { "target", NumberOrNull(one.Target) },
        { "place", one.Place ? SceneJson{ one.Place->x(), one.Place->y(), one.Place->z() }
                             : SceneJson() } });
  }
  status = impossible > 0 ? NotAllMet : AllMet;
  return Result::Ok();
}

Result MakeDatabase(const CommandLine& line, Communicator* ranks, int& status)
{
  std::vector<CoveragePoint> coverage;
  bool isStopped = false;
  ShownProgress progress(false);
  progress.Keep(); // it looks whether to stop from its first step on
  progress.LimitTime(line.TimeLimit);
  WAFT_RETURN_IF_FAILED(
    MakeDatabaseFile(line.Database, line.Made, line.Resumes, ranks, progress, coverage, isStopped));
  Say(line.Database + ": " + std::to_string(coverage.size() + 1) + " simulations" +
      (coverage.empty() ? std::string()
                        : ", " + Fixed("%.1f", 100.0 * coverage.back().NewShare) +
                            " % of the last one's segments are new"));
  if (isStopped)
  {
    Say("stopped early; --resume goes on");
  }
  status = isStopped ? StoppedEarly : AllMet;
  return Result::Ok();
}

} // namespace waft::command
