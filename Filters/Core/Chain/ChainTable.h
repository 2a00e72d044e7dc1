// SPDX-License-Identifier: BSD-3-Clause
// The stages from a scene to bodies that fly: what each takes and from whom, what it gives, and
// which qualities run it. Whoever joins stages (RunChain, the command, ParaView's sources, the
// pages) takes the graph from this table, and their ports are made from it.
#pragma once

#include "Base/OptionFields.h"

#include <string>
#include <utility>
#include <vector>

namespace waft
{

/// How objects come to their marks.
enum class Quality
{
  Preview, // drift in one sampled air on a coarse grid
  Air,     // the same on the full grid
  Full,    // the optimiser from there, in that air, and vortices that explain it
  Paper    // the optimiser from the plan, gas at rest (Shi et al. 2005)
};
inline constexpr Quality Qualities[] = { Quality::Preview, Quality::Air, Quality::Full,
                                         Quality::Paper };

/// "preview", "air", "full", "paper".
const char* ToString(Quality quality);

/// In the order in which they run.
enum class ChainStage
{
  Scene,
  Planner,
  Assimilation,
  Spacetime,
  Rotation,
  VortexFit // tells of the motion, and changes nothing of it
};

/// What a port takes or gives.
enum class PortData
{
  Anything,
  Surface,  // vtkPolyData: one, since blocks would be of several runs
  Merged,   // vtkPolyData: blocks are appended
  Surfaces, // vtkPolyData, or blocks of it, which are handed through as they come
  Image,    // vtkImageData: one
  Blocks,   // vtkMultiBlockDataSet
  Table     // vtkTable
};
/// How many connections an input has.
enum class PortNumber
{
  One,
  Optional,
  Any, // repeatable
  AnyOrNone
};

struct ChainPort
{
  const char* Name;
  PortData Gives;
  /// What it has besides the scene's field data: "points: Time double s; Velocity double*3 m/s;
  /// whole: ...", each array's name, type, components where they are several, and unit where it
  /// has one.
  std::string Arrays;
};

/// An array of an output.
struct ChainArray
{
  std::string Of; // points, cells, rows (of a table) or whole (field data)
  std::string Name;
  std::string Type; // byte, int, float, double or text
  int Components = 1;
  std::string Unit; // "of the kind": as the row's Kind says; empty: none
};

/// An output of a stage.
struct ChainOutput
{
  ChainStage Stage;
  const char* Name;
};

struct ChainInput
{
  const char* Name;
  PortData Takes;
  PortNumber Connections;
  /// Who gives it, the preferred ones first: it takes all of the first list whose stages run.
  /// Empty: nobody, it is the user's own.
  std::vector<std::vector<ChainOutput>> Givers;
};

struct ChainStageTraits
{
  ChainStage Stage;
  const char* Name;     // in ParaView's browser
  const char* Proxy;    // of the server manager
  const char* Word;     // in report.json, messages and Python
  const char* Sentence; // subject first, without its end
  double Share;         // of the time of a run, roughly
  std::vector<Quality> RunsAt;
  std::vector<ChainInput> Inputs;
  std::vector<ChainPort> Outputs; // by port
  std::vector<OptionField> Options;
};

const std::vector<ChainStageTraits>& ChainStages();
const ChainStageTraits& TraitsOf(ChainStage stage);
bool RunsAt(ChainStage stage, Quality quality);

/// What an input takes at a quality; empty where nobody gives it.
std::vector<ChainOutput> GiversOf(const ChainInput& input, Quality quality);
/// The index of an output among its stage's.
int PortOf(const ChainOutput& output);
std::vector<ChainArray> ArraysOf(const ChainPort& port);
/// Class of VTK of what a port gives or takes.
const char* DataTypeOf(PortData data);

/// An output of the one source of a whole flight: some stage's.
struct MotionPortTraits
{
  const char* Name;
  ChainOutput Given;
};
/// By port.
const std::vector<MotionPortTraits>& MotionPorts();

/// Name and value of each option of a stage that is not at its default at a quality.
std::vector<std::pair<std::string, double>> SettingsOf(ChainStage stage, Quality quality);

/// The table as JSON: `stages`, each with `name`, `proxy`, `word`, `sentence`, `share`,
/// `qualities`, `inputs` ({name: [[[stage, port]]]}, as ChainInput has it), `takes` ({name: [class
/// of VTK, whether it is needed]}), `outputs`, `arrays` ({output: [[of, name, type, components,
/// unit]]}), `options`; `motion`: names of MotionPorts;
/// `qualities`; `settings` ({quality: {stage: {option: value}}}, where they are not the defaults).
std::string ChainTableAsJson();

} // namespace waft
