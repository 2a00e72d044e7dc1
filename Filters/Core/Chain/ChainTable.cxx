// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/ChainTable.h"

#include "Chain/ChainOptions.h"
#include "Chain/PortArrays.h"
#include "Scene/SceneFileOptions.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>

namespace waft
{
namespace
{

template <class... Options>
std::vector<OptionField> FieldsOf()
{
  std::vector<OptionField> fields;
  const auto add = [&fields](const OptionField& field) { fields.push_back(field); };
  (Options::Visit(add), ...);
  return fields;
}

std::vector<ChainStageTraits> MakeStages()
{
  const PortArrays arrays;
  constexpr ChainStage scene = ChainStage::Scene;
  constexpr ChainStage planner = ChainStage::Planner;
  constexpr ChainStage air = ChainStage::Assimilation;
  constexpr ChainStage optimiser = ChainStage::Spacetime;
  const std::vector<Quality> all(std::begin(Qualities), std::end(Qualities));
  constexpr PortData surface = PortData::Surface, merged = PortData::Merged;
  constexpr PortData image = PortData::Image, blocks = PortData::Blocks, table = PortData::Table;
  constexpr PortNumber one = PortNumber::One, optional = PortNumber::Optional;
  const ChainInput objects{ "Objects", merged, one, { { { scene, "Objects" } } } };
  const ChainInput obstacles{
    "Obstacles", PortData::Surfaces, optional, { { { scene, "Obstacles" } } }
  };
  const ChainInput wind{ "Wind", image, optional, { { { scene, "Wind" } } } };
  const auto shapes = [&](PortNumber number) {
    return ChainInput{ "Shapes", blocks, number, { { { scene, "Shapes" } } } };
  };
  const ChainInput airs{ "Air", image, optional, { { { air, "Air" } } } };
  const auto rows = [&](PortNumber number)
  {
    return ChainInput{
      "Constraints", merged, number, { { { air, "Constraints" } }, { { planner, "Constraints" } } }
    };
  };
  return {
    { scene,
      "Scene",
      "MotionSceneReader",
      "reader",
      "A scene file is read",
      1,
      all,
      {},
      { { "Objects", merged, arrays.Objects },
        { "Constraints", merged, arrays.Constraints },
        { "Obstacles", merged, arrays.Obstacles },
        { "Shapes", blocks, arrays.Shapes },
        { "Vortices", merged, arrays.Vortices },
        { "Wind", image, arrays.Wind } },
      FieldsOf<SceneReadOptions>() },
    { planner,
      "Planner",
      "StylisticPlannerFilter",
      "planner",
      "Paths are planned from mark to mark out of the motion database",
      6,
      all,
      { { "Database", blocks, optional, {} },
        objects,
        { "Constraints", merged, one, { { { scene, "Constraints" } } } },
        obstacles,
        { "Guides", merged, optional, {} } },
      { { "Tracks", merged, arrays.Planned },
        { "Trees", merged, arrays.Trees },
        { "Report", table, arrays.PlannedReport },
        { "Constraints", merged, arrays.Constraints },
        { "Vortices", merged, arrays.Vortices },
        { "Takes", table, arrays.Takes },
        { "Flights", table, arrays.Flights },
        { "ObjectReport", table, arrays.ObjectReport } },
      FieldsOf<PlanOptions, TakeOptions>() },
    { air,
      "Assimilation",
      "AirAssimilationFilter",
      "assimilation",
      "One air is drawn in which all objects drift to their marks with the least control",
      45,
      { Quality::Preview, Quality::Air, Quality::Full },
      { { "Tracks", surface, one, { { { planner, "Tracks" } } } },
        objects,
        { "Constraints", merged, one, { { { planner, "Constraints" } } } },
        obstacles,
        wind,
        { "Vortices", merged, optional, { { { scene, "Vortices" } } } },
        shapes(optional) },
      { { "Tracks", merged, arrays.Drifted },
        { "Air", image, arrays.Air },
        { "Vortices", merged, arrays.Vortices },
        { "Constraints", merged, arrays.Constraints },
        { "Report", table, arrays.Report },
        { "Rounds", table, arrays.Rounds } },
      FieldsOf<AssimilationOptions, TurningOptions>() },
    { optimiser,
      "Spacetime",
      "SPHSpacetimeFilter",
      "spacetime",
      "All frames of gas and objects are solved at once, from the air or from the plan",
      45,
      { Quality::Full, Quality::Paper },
      { { "Tracks", surface, one, { { { air, "Tracks" } }, { { planner, "Tracks" } } } },
        objects,
        rows(one),
        obstacles,
        { "Vortices",
          merged,
          optional,
          { { { air, "Vortices" } }, { { scene, "Vortices" }, { planner, "Vortices" } } } },
        wind,
        airs },
      { { "Tracks", merged, arrays.Optimised },
        { "Particles", merged, arrays.Particles },
        { "Vortices", merged, arrays.Vortices },
        { "Wind", image, arrays.Wind },
        { "Convergence", table, arrays.Convergence },
        { "Report", table, arrays.Report } },
      FieldsOf<SpacetimeOptions>() },
    { ChainStage::Rotation,
      "Rotation",
      "RotationRefineFilter",
      "rotation",
      "Bodies are turned by the air along their paths, and laid on surfaces",
      2,
      all,
      { { "Tracks",
          surface,
          one,
          { { { optimiser, "Tracks" } }, { { air, "Tracks" } }, { { planner, "Tracks" } } } },
        objects,
        shapes(one),
        obstacles,
        wind,
        rows(optional),
        airs },
      { { "Meshes", merged, arrays.Meshes },
        { "Poses", merged, arrays.Poses },
        { "Report", table, arrays.Report } },
      FieldsOf<RotationOptions>() },
    { ChainStage::VortexFit,
      "VortexFit",
      "VortexFitFilter",
      "fit",
      "Vortices are fitted to how the air turns about the paths",
      1,
      { Quality::Full },
      { { "Input", surface, one, { { { optimiser, "Tracks" } } } },
        { "Vortices", merged, optional, {} } },
      { { "Vortices", merged, arrays.FittedVortices }, { "Tracks", merged, arrays.Explained } },
      FieldsOf<VortexFitOptions>() },
  };
}

/// Fields whose values differ from the defaults.
template <class Options>
std::vector<std::pair<std::string, double>> Changed(const Options& options)
{
  std::vector<std::pair<std::string, double>> changed;
  const Options defaults;
  const auto look = [&changed](const OptionField& field, const auto& value, const auto& usual)
  {
    if (NumbersOf(value) != NumbersOf(usual))
    {
      changed.emplace_back(field.Name, NumbersOf(value).front());
    }
  };
  Options::Visit(look, options, defaults);
  return changed;
}

nlohmann::ordered_json InputsAsJson(const ChainStageTraits& stage)
{
  nlohmann::ordered_json inputs = nlohmann::ordered_json::object();
  for (const ChainInput& input : stage.Inputs)
  {
    nlohmann::ordered_json& all = inputs[input.Name] = nlohmann::ordered_json::array();
    for (const std::vector<ChainOutput>& givers : input.Givers)
    {
      nlohmann::ordered_json& together = all.emplace_back(nlohmann::ordered_json::array());
      for (const ChainOutput& output : givers)
      {
        together.push_back({ TraitsOf(output.Stage).Name, PortOf(output) });
      }
    }
  }
  return inputs;
}

} // namespace

const char* ToString(Quality quality)
{
  switch (quality)
  {
    case Quality::Preview:
      return "preview";
    case Quality::Air:
      return "air";
    case Quality::Full:
      return "full";
    case Quality::Paper:
      return "paper";
  }
  return "";
}

const std::vector<ChainStageTraits>& ChainStages()
{
  static const std::vector<ChainStageTraits> stages = MakeStages();
  return stages;
}

const ChainStageTraits& TraitsOf(ChainStage stage)
{
  return ChainStages()[static_cast<std::size_t>(stage)];
}

bool RunsAt(ChainStage stage, Quality quality)
{
  const std::vector<Quality>& qualities = TraitsOf(stage).RunsAt;
  return std::find(qualities.begin(), qualities.end(), quality) != qualities.end();
}

std::vector<ChainOutput> GiversOf(const ChainInput& input, Quality quality)
{
  const auto run = [quality](const std::vector<ChainOutput>& givers)
  {
    return std::all_of(givers.begin(), givers.end(),
                       [quality](const ChainOutput& one) { return RunsAt(one.Stage, quality); });
  };
  const auto first = std::find_if(input.Givers.begin(), input.Givers.end(), run);
  return first != input.Givers.end() ? *first : std::vector<ChainOutput>();
}

int PortOf(const ChainOutput& output)
{
  const std::vector<ChainPort>& ports = TraitsOf(output.Stage).Outputs;
  const auto found = std::find_if(ports.begin(), ports.end(),
                                  [&output](const ChainPort& port)
                                  { return std::strcmp(port.Name, output.Name) == 0; });
  return static_cast<int>(found - ports.begin());
}

std::vector<ChainArray> ArraysOf(const ChainPort& port)
{
  std::vector<ChainArray> arrays;
  std::istringstream entries(port.Arrays);
  std::string of;
  for (std::string entry; std::getline(entries >> std::ws, entry, ';');)
  {
    if (const std::size_t colon = entry.find(": "); colon != std::string::npos)
    {
      of = entry.substr(0, colon);
      entry.erase(0, colon + 2);
    }
    ChainArray array;
    array.Of = of;
    std::istringstream words(entry);
    words >> array.Name >> array.Type;
    std::getline(words >> std::ws, array.Unit);
    if (const std::size_t star = array.Type.find('*'); star != std::string::npos)
    {
      array.Components = std::stoi(array.Type.substr(star + 1));
      array.Type.erase(star);
    }
    arrays.push_back(array);
  }
  return arrays;
}

const char* DataTypeOf(PortData data)
{
  switch (data)
  {
    case PortData::Anything:
      return "vtkDataObject";
    case PortData::Surface:
    case PortData::Merged:
    case PortData::Surfaces:
      return "vtkPolyData";
    case PortData::Image:
      return "vtkImageData";
    case PortData::Blocks:
      return "vtkMultiBlockDataSet";
    case PortData::Table:
      return "vtkTable";
  }
  return "";
}

const std::vector<MotionPortTraits>& MotionPorts()
{
  using Stage = ChainStage;
  static const std::vector<MotionPortTraits> ports = {
    { "Meshes", { Stage::Rotation, "Meshes" } },
    { "Poses", { Stage::Rotation, "Poses" } },
    { "Obstacles", { Stage::Scene, "Obstacles" } },
    { "Objects", { Stage::Scene, "Objects" } },
    { "Marks", { Stage::Planner, "Constraints" } },
    { "PlannedTracks", { Stage::Planner, "Tracks" } },
    { "Trees", { Stage::Planner, "Trees" } },
    { "PlannedReport", { Stage::Planner, "Report" } },
    { "AssimilatedTracks", { Stage::Assimilation, "Tracks" } },
    { "Air", { Stage::Assimilation, "Air" } },
    { "Vortices", { Stage::Assimilation, "Vortices" } },
    { "AssimilatedReport", { Stage::Assimilation, "Report" } },
    { "Rounds", { Stage::Assimilation, "Rounds" } },
    { "OptimisedTracks", { Stage::Spacetime, "Tracks" } },
    { "Gas", { Stage::Spacetime, "Particles" } },
    { "Wind", { Stage::Spacetime, "Wind" } },
    { "Convergence", { Stage::Spacetime, "Convergence" } },
    { "OptimisedReport", { Stage::Spacetime, "Report" } },
    { "TurnedReport", { Stage::Rotation, "Report" } },
    { "FittedVortices", { Stage::VortexFit, "Vortices" } },
  };
  return ports;
}

std::vector<std::pair<std::string, double>> SettingsOf(ChainStage stage, Quality quality)
{
  const ChainOptions options = ChainOptions::At(quality);
  switch (stage)
  {
    case ChainStage::Scene:
      break;
    case ChainStage::Planner:
      return Changed(options.Plan);
    case ChainStage::Assimilation:
      return Changed(options.Air);
    case ChainStage::Spacetime:
      return Changed(options.Optimiser);
    case ChainStage::Rotation:
      return Changed(options.Rotation);
    case ChainStage::VortexFit:
      return Changed(options.Fit);
  }
  return {};
}

std::string ChainTableAsJson()
{
  nlohmann::ordered_json table;
  for (const ChainStageTraits& stage : ChainStages())
  {
    nlohmann::ordered_json one;
    one["name"] = stage.Name;
    one["proxy"] = stage.Proxy;
    one["word"] = stage.Word;
    one["sentence"] = stage.Sentence;
    one["share"] = stage.Share;
    for (const Quality quality : stage.RunsAt)
    {
      one["qualities"].push_back(ToString(quality));
    }
    one["inputs"] = InputsAsJson(stage);
    for (const ChainInput& input : stage.Inputs)
    {
      const bool isNeeded =
        input.Connections == PortNumber::One || input.Connections == PortNumber::Any;
      one["takes"][input.Name] = { DataTypeOf(input.Takes), isNeeded };
    }
    for (const ChainPort& port : stage.Outputs)
    {
      one["outputs"].push_back(port.Name);
      for (const ChainArray& array : ArraysOf(port))
      {
        one["arrays"][port.Name].push_back(
          { array.Of, array.Name, array.Type, array.Components, array.Unit });
      }
    }
    for (const OptionField& field : stage.Options)
    {
      one["options"].push_back(field.Name);
    }
    table["stages"].push_back(one);
  }
  for (const MotionPortTraits& port : MotionPorts())
  {
    table["motion"].push_back(port.Name);
  }
  for (const Quality quality : Qualities)
  {
    table["qualities"].push_back(ToString(quality));
    nlohmann::ordered_json& settings = table["settings"][ToString(quality)];
    settings = nlohmann::ordered_json::object();
    for (const ChainStageTraits& stage : ChainStages())
    {
      for (const auto& [name, value] : SettingsOf(stage.Stage, quality))
      {
        nlohmann::ordered_json& setting = settings[stage.Name][name];
        setting = value;
        if (value == std::floor(value))
        {
          setting = static_cast<std::int64_t>(value);
        }
      }
    }
  }
  return table.dump(2) + "\n";
}

} // namespace waft
