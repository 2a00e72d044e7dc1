// SPDX-License-Identifier: BSD-3-Clause
#include "Commands.h"

#include "Chain/ChainOptions.h"
#include "Scene/SceneNode.h"
#include "Settings.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <utility>

namespace waft::command
{
namespace
{

constexpr const char* Description =
  "Motion of light things in air that goes where you say and moves like things carried by one air.";
constexpr const char* Exit =
  "exit status: 0 all constraints met; 2 malformed input or usage, nothing computed; 3 some "
  "constraint could not\nbe met (named in constraints.csv and below), all others are; 4 stopped "
  "early, best so far written; 1 anything else";
constexpr const char* CheckExit =
  "exit status: 0 nothing stands against it, though some may be hard; 2 malformed scene or usage; "
  "3 "
  "some constraint\ncannot be met, by itself or beside another; 1 anything else";
constexpr const char* DatabaseExit =
  "exit status: 0 done; 2 malformed usage, nothing computed; 4 stopped early, the database of "
  "the\nsimulations that are whole written (nothing when there is none); 1 anything else. "
  "FILE.coverage.csv tells what\neach simulation added";

/// Every command, and what it is for.
const std::vector<std::pair<const char*, const char*>> Sentences = {
  { "synthesize", "a scene file to an animation" },
  { "takes", "many variations of a scene, and a table of them" },
  { "new", "a first scene, to change by hand" },
  { "check", "what of a scene cannot be, and what will be hard" },
  { "info", "what a result or a scene holds, and whether a result can be gone on with" },
  { "database", "a motion database from simulations of smoke" },
  { "render", "pictures and a movie of a result" },
  { "page", "a result as one page for a browser, DIR/page.html" },
  { "export", "a result with its surroundings for other programs, DIR/scene.glb and the like" },
  { "blender-addon", "the add-on for Blender as a zip file, to install there" },
  { "measure", "how good a motion is, from the files of results alone" },
  { "clean", "give back room: what runs keep for later ones, or what a result does without" },
  { "demo", "the embedded scenes, start to finish, with pictures" }
};

/// What a number may be.
struct Numbers
{
  double Low, High;
  bool IsWhole, IsAbove; // above: Low itself is none
  std::string Expected() const
  {
    if (this->High > 1e99)
    {
      return "a positive number";
    }
    const auto text = [](double value) { return NumberText(value, 10); };
    return this->IsWhole   ? "a whole number from " + text(this->Low) + " to " + text(this->High)
           : this->IsAbove ? "a number above " + text(this->Low) + ", at most " + text(this->High)
                           : "a number from " + text(this->Low) + " to " + text(this->High);
  }
  bool Read(const std::string& text, double& value) const
  {
    char* end = nullptr;
    value = std::strtod(text.c_str(), &end);
    return !text.empty() && end == text.c_str() + text.size() && std::isfinite(value) &&
           text.find_first_of("xXpP") == std::string::npos && value >= this->Low &&
           value <= this->High && !(this->IsAbove && value == this->Low) &&
           (!this->IsWhole || (text.find_first_of(".eE") == std::string::npos));
  }
};

const Numbers SeedNumbers{ 0, 2147483647, true, false };
const Numbers ThreadNumbers{ 1, 1024, true, false };

std::string Unexpected(const std::string& expected, const std::string& text)
{
  return "expected " + expected + ", found '" + Line(Shortened(text, 100)) + "'";
}

/// What an option takes; the empty text where it does.
using Check = std::function<std::string(const std::string&)>;

Check Number(const Numbers& numbers)
{
  return [numbers](const std::string& text)
  {
    double value = 0.0;
    return numbers.Read(text, value) ? std::string() : Unexpected(numbers.Expected(), text);
  };
}

std::string CheckPath(const std::string& text)
{
  bool isRight =
    !text.empty() && text.size() < 4096 && Line(text).find("\\udc") == std::string::npos;
  for (std::size_t at = 0; isRight && at < text.size();)
  {
    const std::size_t end = std::min(text.find('/', at), text.size());
    isRight = end - at < 256;
    at = end + 1;
  }
  return isRight ? "" : Unexpected("a path in UTF-8 of 1 to 4095 letters, 255 in each name", text);
}

std::string QualityOf(const std::string& word)
{
  return word == "assimilated" ? "air" : word; // what it was called before
}

std::vector<std::string> QualityNames()
{
  std::vector<std::string> names;
  for (const Quality quality : Qualities)
  {
    names.emplace_back(ToString(quality));
  }
  return names;
}

std::string Listed(const std::vector<std::string>& names)
{
  std::string text;
  for (const std::string& name : names)
  {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

std::string CheckQuality(const std::string& text)
{
  const std::vector<std::string> names = QualityNames();
  return std::find(names.begin(), names.end(), QualityOf(text)) != names.end()
           ? ""
           : Unexpected("one of " + Listed(names), text);
}

std::vector<std::string> Parts(const std::string& text)
{
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();)
  {
    const std::size_t end = std::min(text.find(',', at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

std::string CheckKept(const std::string& text)
{
  std::set<std::string> found;
  bool isRight = true;
  for (const std::string& part : Parts(text))
  {
    isRight = isRight && (part == "air" || part == "state") && found.insert(part).second;
  }
  return isRight ? "" : Unexpected("names of air and state with commas between", text);
}

/// Options of Core as they are said once.
struct Stated
{
  std::string Sentence;
  double Default = 0.0;
  Numbers Values;
};

template <class... Options>
Stated StatedOf(const std::string& name, bool isWhole)
{
  Stated stated;
  const auto visitOne = [&](const auto& defaults)
  {
    std::decay_t<decltype(defaults)>::Visit(
      [&](const OptionField& field, const auto& value)
      {
        if (name == field.Name)
        {
          if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
          {
            stated.Default = static_cast<double>(value);
          }
          const bool isUnset = *field.Unset != '\0';
          std::string text = field.Sentence;
          text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
          text.erase(text.find_last_not_of('.') + 1);
          stated.Sentence =
            text + " (default: " + (isUnset ? field.Unset : NumberText(stated.Default, 10)) + ")";
          stated.Values = { field.Range.Low + (isUnset && isWhole ? 1.0 : 0.0), field.Range.High,
                            isWhole, isUnset && !isWhole };
        }
      },
      defaults);
  };
  (visitOne(Options()), ...);
  return stated;
}

/// The parser, and where it puts what it reads.
class Parser
{
public:
  explicit Parser(CommandLine& line) : Line(line), Main(Description, "waft")
  {
    this->Main.require_subcommand(1);
    this->AddSynthesize();
    this->AddCheck();
    this->AddDatabase();
  }

  CLI::App& App() { return this->Main; }
  /// Of --quality and --preview the last counts: values are taken in the order of the table.
  void TakeQuality(const CLI::App& command)
  {
    for (const CLI::Option* option : command.parse_order())
    {
      this->Line.QualityName = option == this->Preview   ? "preview"
                               : option == this->Quality ? QualityOf(option->results().back())
                                                         : this->Line.QualityName;
    }
  }
  CLI::App* CommandOf(const std::string& name)
  {
    const auto found = this->Own.find(name);
    return found == this->Own.end() ? nullptr : found->second;
  }
  std::string FieldOf(const CLI::Option* option) const
  {
    const auto found = this->Fields.find(option);
    return found == this->Fields.end() ? "" : found->second;
  }
  const std::vector<std::string>* ChoicesOf(const CLI::Option* option) const
  {
    const auto found = this->Choices.find(option);
    return found == this->Choices.end() ? nullptr : &found->second;
  }

private:
  CLI::App& Add(const char* name, const char* epilog)
  {
    const auto sentence =
      std::find_if(Sentences.begin(), Sentences.end(),
                   [name](const auto& one) { return std::string(one.first) == name; });
    CLI::App* command = this->Main.add_subcommand(name, sentence->second);
    command->footer(epilog);
    this->Own[name] = command;
    return *command;
  }

  /// An option with a value, of which the last counts.
  CLI::Option* Value(CLI::App& command, const std::string& flags, const std::string& value,
                     const std::string& help, const Check& check,
                     const std::function<void(const std::string&)>& take,
                     const std::string& field = "")
  {
    CLI::Option* option = command.add_option_function<std::string>(
      flags, [take](const std::string& text) { take(text); }, help);
    option->type_name(value)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    option->check([check](const std::string& text) { return check(text); }, "");
    this->Fields[option] = field;
    return option;
  }
  CLI::Option* Flag(CLI::App& command, const std::string& flags, const std::string& help,
                    const std::function<void()>& take, const std::string& field = "")
  {
    CLI::Option* option = command.add_flag_callback(flags, take, help);
    option->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)->disable_flag_override();
    this->Fields[option] = field;
    return option;
  }
  void Common(CLI::App& command, bool answers)
  {
    if (answers)
    {
      this->Flag(command, "--json", "the answer as one JSON document on stdout, all else on stderr",
                 [this] { this->Line.IsJson = true; });
    }
    CLI::Option_group* loudness = command.add_option_group("loudness", "");
    loudness->require_option(0, 1);
    loudness->set_help_flag();
    this->Flag(*loudness, "-q,--quiet", "say nothing but errors, warnings and what is not met",
               [this] { this->Line.Shown = Loudness::Quiet; });
    this->Flag(*loudness, "-v,--verbose", "say what each stage does, too",
               [this] { this->Line.Shown = Loudness::Verbose; });
    this->Value(command, "--log", "FILE",
                "every message with its time in FILE, also those that are not shown; an older log "
                "makes room, any other file stays",
                CheckPath, [this](const std::string& text) { this->Line.Log = text; });
  }
  void Scene(CLI::App& command)
  {
    this
      ->Value(command, "scene", "SCENE", "scene file, *.waft.json", CheckPath,
              [this](const std::string& text) { this->Line.Flight.Scene = text; })
      ->required();
  }
  void DatabaseFile(CLI::App& command)
  {
    this->Value(
      command, "--database", "FILE", "motion database, .vtm (default: the embedded one)", CheckPath,
      [this](const std::string& text) { this->Line.Flight.Database = text; }, "database");
  }
  void Threads(CLI::App& command)
  {
    this->Value(
      command, "--threads", "THREADS", "default: all cores; the result is the same",
      Number(ThreadNumbers),
      [this](const std::string& text) { this->Line.Threads = std::atoi(text.c_str()); }, "threads");
  }

  void AddSynthesize();
  void AddCheck();
  void AddDatabase();

  CommandLine& Line;
  CLI::App Main;
  std::map<std::string, CLI::App*> Own;
  CLI::Option *Quality = nullptr, *Preview = nullptr;
  std::map<const CLI::Option*, std::string> Fields;
  std::map<const CLI::Option*, std::vector<std::string>> Choices;
};

void Parser::AddSynthesize()
{
  CLI::App& make = this->Add("synthesize", Exit);
  FlightRequest& flight = this->Line.Flight;
  this->Scene(make);
  this->Value(make, "-o,--output", "DIR", "folder for the results", CheckPath,
              [&flight](const std::string& text) { flight.Output = text; });
  this->DatabaseFile(make);
  const Stated seed = StatedOf<FlightOptions>("Seed", true);
  this->Value(
    make, "--seed", "SEED", seed.Sentence, Number(seed.Values),
    [&flight](const std::string& text) { flight.Options.Seed = std::atoll(text.c_str()); }, "seed");
  this->Threads(make);
  this->Value(
    make, "--time-limit", "S", "seconds; the best so far is written",
    Number({ 0, 1e300, false, true }),
    [this](const std::string& text) { this->Line.TimeLimit = std::strtod(text.c_str(), nullptr); },
    "time_limit");
  const Stated room = StatedOf<SpacetimeOptions>("MemoryLimit", false);
  this->Value(
    make, "--memory-limit", "MB", "of the optimiser: " + room.Sentence, Number(room.Values),
    [&flight](const std::string& text)
    { flight.Options.Optimiser.MemoryLimit = std::strtod(text.c_str(), nullptr); },
    "memory_limit");
  this->Quality = this->Value(
    make, "--quality", "{" + CLI::detail::join(QualityNames(), ",") + "}",
    "how objects come to their marks: " + Listed(QualityNames()) +
      " (default full); air was called assimilated before, which names it still",
    CheckQuality, [](const std::string&) {}, "quality"); // TakeQuality does
  this->Choices[this->Quality] = QualityNames();
  this->Preview = this->Flag(
    make, "--preview", "quality preview: coarse, for a quick look", [] {}, "preview");
  this->Flag(
    make, "--resume",
    "go on from what an earlier run of the same inputs left in the output, to the same "
    "motion as if it had not been stopped",
    [&flight] { flight.Resumes = true; }, "resume");
  this->Value(
    make, "--edit-of", "DIR",
    "a finished run of the scene before some rows changed: the same air, only what changed "
    "drifts again",
    CheckPath, [&flight](const std::string& text) { flight.EditOf = text; }, "edit_of");
  this->Flag(
    make, "--meshes", "also meshes.pvd: all meshes posed, a file a frame",
    [&flight] { flight.HasMeshes = true; }, "meshes");
  this->Flag(
    make, "--particles", "also particles.pvd: the optimiser's gas and objects, a file a frame",
    [&flight] { flight.HasParticles = true; }, "particles");
  this->Value(
    make, "--keep", "K,K",
    "what to write in full: air (every frame of air.pvd and air_wind.pvd), state (what "
    "edits go on from, otherwise kept in the user's store)",
    CheckKept,
    [&flight](const std::string& text)
    {
      const std::vector<std::string> parts = Parts(text);
      flight.KeepsAir = std::count(parts.begin(), parts.end(), "air") > 0;
      flight.KeepsState = std::count(parts.begin(), parts.end(), "state") > 0;
    },
    "keep");
  this->Flag(make, "--no-csv",
             "without poses.csv; poses.vtp and animation.glb hold the same motion",
             [&flight] { flight.HasCsv = false; });
  this->Flag(make, "--watch",
             "fly at preview quality, and again whenever the scene file or a file that it names is "
             "saved, until stopped; DIR/page.html, open in a browser, follows",
             [this] { this->Line.IsWatched = true; });
  CLI::Option* progress = this->Value(
    make, "--progress", "{line,json}",
    "line: on a terminal; json: each message as a line of JSON on stdout, {\"fraction\", \"text\"}",
    [](const std::string& text)
    { return text == "line" || text == "json" ? std::string() : Unexpected("line or json", text); },
    [this](const std::string& text) { this->Line.TellsJson = text == "json"; });
  this->Choices[progress] = { "line", "json" };
  this->Common(make, true);
}

void Parser::AddCheck()
{
  CLI::App& look = this->Add("check", CheckExit);
  this->Scene(look);
  this->DatabaseFile(look);
  this->Common(look, true);
}

void Parser::AddDatabase()
{
  CLI::App& base = this->Add("database", DatabaseExit);
  DatabaseOptions& made = this->Line.Made;
  this
    ->Value(base, "-o,--output", "FILE.vtm", "file for the database", CheckPath,
            [this](const std::string& text) { this->Line.Database = text; })
    ->required();
  const auto add = [&](const std::string& flag, const char* name, const std::string& value,
                       const std::string& help, auto& member)
  {
    constexpr bool isWhole = std::is_integral_v<std::decay_t<decltype(member)>>;
    const Stated stated = StatedOf<DatabaseOptions>(name, isWhole);
    this->Value(
      base, flag, value, help + "default " + NumberText(stated.Default, 10), Number(stated.Values),
      [&member](const std::string& text) {
        member = static_cast<std::decay_t<decltype(member)>>(std::strtod(text.c_str(), nullptr));
      });
  };
  add("--simulations", "NumberOfSimulations", "SIMULATIONS", "", made.NumberOfSimulations);
  add("--frames", "NumberOfFrames", "FRAMES", "frames of each, ", made.NumberOfFrames);
  add("--resolution", "Resolution", "RESOLUTION", "cells along a side, ", made.Resolution);
  this->Value(base, "--seed", "SEED",
              "of the first simulation, default " + NumberText(static_cast<double>(made.Seed), 10),
              Number(SeedNumbers),
              [&made](const std::string& text)
              { made.Seed = static_cast<decltype(made.Seed)>(std::atoll(text.c_str())); });
  this->Threads(base);
  this
    ->Value(
      base, "--until-covered", "[SHARE]",
      "stop when less than this share of a simulation's segments is new (without a number "
      "0.05); --simulations is then the most",
      [](const std::string& text)
      {
        double value = 0.0;
        return text.empty() || Numbers{ 0, 1, false, true }.Read(text, value)
                 ? std::string()
                 : Unexpected("a share above 0, at most 1", text);
      },
      [&made](const std::string& text)
      { made.StopBelow = text.empty() ? 0.05 : std::strtod(text.c_str(), nullptr); })
    ->expected(0, 1);
  add("--coverage-tolerance", "CoverageTolerance", "SHARE",
      "a segment is new when it is farther from all before than this share of the rms chord, ",
      made.CoverageTolerance);
  this->Value(base, "--time-limit", "S", "seconds; the simulations that are whole are used",
              Number({ 0, 1e300, false, true }),
              [this](const std::string& text)
              { this->Line.TimeLimit = std::strtod(text.c_str(), nullptr); });
  this->Flag(base, "--resume", "go on from what a stopped run left beside FILE",
             [this] { this->Line.Resumes = true; });
  this->Common(base, false);
}

std::vector<const CLI::Option*> OptionsOf(const CLI::App& command)
{
  std::vector<const CLI::Option*> options = command.get_options();
  for (const CLI::App* group :
       command.get_subcommands([](const CLI::App* one) { return one->get_name().empty(); }))
  {
    const auto own = OptionsOf(*group);
    options.insert(options.end(), own.begin(), own.end());
  }
  return options;
}

std::vector<std::string> FlagsOf(const CLI::Option& option)
{
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames())
  {
    names.push_back("-" + name);
  }
  for (const std::string& name : option.get_lnames())
  {
    names.push_back("--" + name);
  }
  return names;
}

bool TakesValue(const CLI::Option& option)
{
  return option.get_expected_max() > 0 && !option.get_type_name().empty();
}

/// Words with spaces between, in lines of at most 110 letters.
std::vector<std::string> Wrapped(const std::vector<std::string>& words, std::size_t indent)
{
  constexpr std::size_t widest = 110;
  std::vector<std::string> lines = { "" };
  for (const std::string& word : words)
  {
    std::string& last = lines.back();
    const std::size_t width = (lines.size() == 1 ? indent : 0) + last.size();
    if (width + word.size() + 1 > widest)
    {
      lines.push_back(std::string(indent, ' ') + word);
    }
    else
    {
      last += (last.empty() ? "" : " ") + word;
    }
  }
  return lines;
}

std::vector<std::string> Usage(const CLI::App& command)
{
  std::vector<std::string> words, places;
  for (const CLI::Option* option : OptionsOf(command))
  {
    const std::vector<std::string> flags = FlagsOf(*option);
    const std::string own = (flags.empty() ? "" : flags.front()) +
                            (TakesValue(*option) ? " " + option->get_type_name() : "");
    if (option->get_positional())
    {
      places.push_back(option->get_name(true));
    }
    else
    {
      words.push_back(option->get_required() ? own : "[" + own + "]");
    }
  }
  words.insert(words.end(), places.begin(), places.end());
  const std::string head = "usage: waft " + command.get_name() + " ";
  std::vector<std::string> lines = Wrapped(words, head.size());
  lines.front().insert(0, head);
  return lines;
}

std::string Help(const CLI::App& command)
{
  std::string text;
  const auto add = [&text](const std::vector<std::string>& lines)
  {
    for (const std::string& line : lines)
    {
      text += line + "\n";
    }
  };
  add(Usage(command));
  text += "\n" + command.get_description() + "\n\n";
  constexpr std::size_t column = 26;
  for (const CLI::Option* option : OptionsOf(command))
  {
    std::string own =
      "  " + (option->get_positional() ? option->get_name(true) : Listed(FlagsOf(*option)));
    own += !option->get_positional() && TakesValue(*option) ? " " + option->get_type_name() : "";
    text += own + (own.size() + 2 > column ? "\n" + std::string(column, ' ')
                                           : std::string(column - own.size(), ' '));
    add(Wrapped(CLI::detail::split(option->get_description(), ' '), column));
  }
  return text + "\n" + command.get_footer();
}

int Refuse(const CLI::App& command, const std::string& words)
{
  for (const std::string& line : Usage(command))
  {
    Say(line, Message::Error);
  }
  Say("waft " + command.get_name() + ": error: " + Shortened(words), Message::Error);
  return Malformed;
}

} // namespace

CommandLine Parse(const std::vector<std::string>& arguments, int& status)
{
  CommandLine line;
  Parser parser(line);
  const CLI::App& command = *parser.CommandOf(arguments.front());
  status = -1;
  line.Name = command.get_name();
  try
  {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
    parser.App().parse(reversed);
    parser.TakeQuality(command);
  }
  catch (const CLI::CallForHelp&)
  {
    Tell(Help(command));
    status = AllMet;
    return line;
  }
  catch (const CLI::ParseError& error)
  {
    status = Refuse(command, error.what());
    return line;
  }
  if (line.IsWatched && (line.TimeLimit > 0.0 || line.Flight.Resumes))
  {
    status = Refuse(command, "--watch: expected neither --time-limit nor --resume with it");
  }
  if (line.IsJson && (line.IsWatched || line.TellsJson))
  {
    status = Refuse(command, "--json: expected neither --watch nor --progress json with it, which "
                             "say more than one thing on stdout");
  }
  return line;
}

Result Settle(CommandLine& line)
{
  if (line.Name != "synthesize")
  {
    return Result::Ok();
  }
  WAFT_RETURN_IF_FAILED(
    ApplySettings({ { "threads", true, line.Threads == 0, Number(ThreadNumbers),
                      [&](const std::string& text)
                      {
                        line.Threads = std::atoi(text.c_str());
                        return text;
                      } },
                    { "quality", false, line.QualityName.empty(), CheckQuality,
                      [&](const std::string& text) { return line.QualityName = QualityOf(text); } },
                    { "output", false, line.Flight.Output.empty(), CheckPath,
                      [&](const std::string& text) { return line.Flight.Output = text; } } },
                  line.Flight.Defaults));
  if (line.Flight.Output.empty())
  {
    return Result::Error("expected --output DIR, the variable WAFT_OUTPUT, or output in "
                         "~/.config/waft.toml");
  }
  const std::string word = line.IsWatched             ? "preview"
                           : line.QualityName.empty() ? "full"
                                                      : line.QualityName;
  ChainOptions& options = line.Flight.Options;
  const ChainOptions given = options;
  for (const Quality quality : Qualities)
  {
    options = word == ToString(quality) ? ChainOptions::At(quality) : options;
  }
  options.Seed = given.Seed;
  options.Optimiser.MemoryLimit = given.Optimiser.MemoryLimit;
  options.TimeLimit = line.TimeLimit;
  if (line.Flight.HasParticles && !RunsAt(ChainStage::Spacetime, options.Detail))
  {
    return Result::Error(
      "particles: expected quality full or paper, whose optimiser has particles, "
      "found " +
      word);
  }
  return Result::Ok();
}

std::string DescribeCommands()
{
  CommandLine line;
  Parser parser(line);
  SceneJson told = { { "description", Description }, { "exit", Exit } };
  for (const auto& [name, sentence] : Sentences)
  {
    told["commands"][name] = sentence;
    const CLI::App* command = parser.CommandOf(name);
    if (command == nullptr)
    {
      continue;
    }
    SceneJson& own = told["own"][name];
    own["epilog"] = command->get_footer();
    for (const CLI::Option* option : OptionsOf(*command))
    {
      if (option->get_name() == "--help")
      {
        continue;
      }
      const std::vector<std::string>* choices = parser.ChoicesOf(option);
      own["options"].push_back(
        { { "name",
            option->get_positional() ? option->get_name(true) : option->get_lnames().front() },
          { "flags", FlagsOf(*option) },
          { "value", TakesValue(*option) ? SceneJson(option->get_type_name()) : SceneJson() },
          { "help", option->get_description() },
          { "choices", choices != nullptr ? SceneJson(*choices) : SceneJson() },
          { "isNeeded", option->get_required() },
          { "field", parser.FieldOf(option) } });
    }
  }
  return told.dump(1);
}

} // namespace waft::command
