// SPDX-License-Identifier: BSD-3-Clause
// What stands in a scene file. A field that is new begins with its line here; the schema, the page
// and the Python package have it from here.
#include "Scene/FacingOptions.h"
#include "Scene/SceneFields.h"
#include "Scene/Solids.h"

namespace waft
{

namespace
{

using namespace limits;
using Fields = std::vector<SceneField>;
using Value = SceneValue;

constexpr Range Version = { 1, 1 };
constexpr Range IdOrAny = { -1, Id.High };
constexpr Range Fraction = UpTo(1);
constexpr Range Several = { 1, SceneLists::Objects };

SceneField Kind(const char* kind)
{
  return SceneField("kind", Value::Word).Among({ kind }).Required();
}

SceneField ObjectId()
{
  return SceneField("object", Value::Whole, Id).Required();
}

SceneField ObjectOrAny()
{
  return SceneField("object", Value::Whole, IdOrAny, "-1: any object").Required();
}

SceneField FrameOf(const char* name, const char* sentence = "below the number of frames")
{
  return SceneField(name, Value::Whole, Frame, sentence);
}

/// Who goes or comes when, of several in a window.
SceneField Ordered(const char* sentence, const std::vector<std::string>& more = {})
{
  std::vector<std::string> words{ "left-to-right", "right-to-left", "top-down", "bottom-up",
                                  "outward",       "inward",        "random" };
  words.insert(words.end(), more.begin(), more.end());
  return SceneField("order", Value::Word, UpTo(SceneLists::Objects), sentence)
    .Among(std::move(words))
    .Of("orderDirection")
    .OrList(SceneLists::Objects);
}

SceneField SpreadOver(const char* sentence)
{
  return SceneField("spread", Value::Word, sentence)
    .Among({ "even", "ease-in", "ease-out" })
    .Or("\"even\"");
}

/// When a position is met; and how those of a window are spread over it.
Fields Times()
{
  return {
    FrameOf("frame",
            "below the number of frames, or a window in which each object comes at a frame "
            "of its own")
      .Of("window")
      .Required(),
    Ordered("of a window, who comes when: at the frames of least control, or one after another; "
            "a list gives each target's rank from 0",
            { "air", "letters", "words", "lines" })
      .Or("\"air\""),
    SpreadOver("of an order other than air, over the window"),
  };
}

/// How long what comes stays, and how.
Fields Hold(const char* sentence)
{
  return { SceneField("hold", Value::Whole, Frame, sentence).Or("0"),
           SceneField(
             "drift", Value::Flag,
             "of a hold: all drift as one form, by a translation, a turn and a little strain")
             .Or("false"),
           { "holdRadius", Value::Number, Distance,
             "m, in which each is of its place in a form that drifts; default: its length" } };
}

SceneField Leave()
{
  return SceneField("leave", Value::Part, "how it goes out of the shot after that").Of("leave");
}

SceneField Radius(const Range& range, const char* unit)
{
  return SceneField("radius", Value::Number, range, unit).Or("0");
}

SceneField Facing(const char* sentence = "")
{
  return SceneField("facing", Value::Part, sentence).Of("facing");
}

SceneField FaceUp(const char* sentence)
{
  return SceneField("faceUp", Value::Word, sentence).Among({ "any", "up", "down" }).Or("\"any\"");
}

SceneField UpOf(const char* sentence)
{
  return SceneField("up", Value::Word, sentence).Among({ "y", "z" });
}

Fields operator+(Fields first, const Fields& rest)
{
  first.insert(first.end(), rest.begin(), rest.end());
  return first;
}

SceneField ShapeOf()
{
  return SceneField("shape", Value::Name, "name of a shape").Required();
}

/// Of objects, however many an entry has.
SceneField On(const char* sentence)
{
  return SceneField("on", Value::Whole, Id, sentence);
}

Fields OfObjects()
{
  return {
    FrameOf("release",
            "until which it hangs still at its start, in the pose given, else by its longest side; "
            "or each of several at a frame of its own")
      .Of("releases")
      .Or("0"),
    SceneField("appears", Value::Flag,
               "it is not in the shot before its release, and begins in flight there")
      .Or("false"),
    Leave(),
    On("id of an obstacle that places are relative to, at its reference point at frame 0; it goes "
       "along until its release"),
    Ordered("of several releases, who goes when").Or("\"random\""),
    SpreadOver("of releases, over the window"),
    { "velocity", Value::Vector, Velocity, "m/s, exact; default: as the air at its start" },
    { "orientation", Value::Quaternion, Direction,
      "body to world, made unit; default: as in flight, by the seed" },
    { "angularVelocity", Value::Vector, Spin,
      "rad/s, world; default: 0 where an orientation is given, else as in flight" },
    { "mass", Value::Number, Mass, "kg; default: the shape's" },
    { "settlingSpeed", Value::Number, UpTo(Speed.High), "m/s; default: the shape's" },
    { "clearanceRadius", Value::Number, Distance, "m; default: half the shape's largest extent" },
    { "restHeight", Value::Number, Distance,
      "of the centre above a plane, m; default: the shape's" },
    { "class", Value::Name, "default: the shape's; empty: none" },
  };
}

SceneField Corner(const char* name, const char* sentence)
{
  return SceneField(name, Value::Vector, Coordinate, sentence).Required();
}

/// Where a text, a picture or a mesh asks for bodies.
Fields Laid(const char* width, bool needsWidth)
{
  SceneField wide("width", Value::Number, Length, width);
  wide.IsRequired = needsWidth;
  return {
    Corner("origin", "centre, m"),
    SceneField("u", Value::Vector, Direction, "direction of the width, made unit").Or("[1, 0, 0]"),
    SceneField("v", Value::Vector, Direction, "direction of the height, made unit").Or("[0, 1, 0]"),
    wide,
    { "count", Value::Whole, Several, "default: the number of objects" },
  };
}

/// Of obstacles of all kinds.
Fields OfObstacles()
{
  return {
    { "id", Value::Whole, Id, "default: the place in the list" },
    SceneField("motion", Value::Part,
               "where the reference point (middle, center, base or position) is at these frames, m")
      .Of("motionKey")
      .List(SceneLists::Keys),
  };
}

Fields OfRow(const char* kind, const SceneField& object, const SceneField& value)
{
  return { Kind(kind), object, FrameOf("frame").Required(), value };
}

SceneField OnThen()
{
  return On("id of an obstacle that places are relative to, at its reference point at the frame, "
            "and go along with; of a rest the one that it lies on");
}

Fields OfPlacedRow(const char* kind)
{
  return Fields{ Kind(kind), ObjectOrAny() } + Times() + Fields{ OnThen() };
}

SceneField Asked(Value holds, const Range& range, const char* sentence)
{
  return SceneField("value", holds, range, sentence).Required();
}

/// The duration and the middle of what blows for a while.
Fields ForAWhile()
{
  return {
    SceneField("centerTime", Value::Number, Time, "s").Required(),
    SceneField("duration", Value::Number, Duration, "s, standard deviation").Required(),
  };
}

std::vector<SceneFieldTable> SceneTables()
{
  return {
    { "scene",
      { SceneField("waft", Value::Whole, Version).Required(),
        { "title", Value::Name },
        SceneField("seed", Value::Whole, Seed, "of everything random in the scene").Or("1"),
        SceneField("time", Value::Part).Of("time"),
        SceneField("domain", Value::Part).Of("domain"),
        SceneField("ground", Value::Part).Of("ground"),
        SceneField("shapes", Value::Part).Of("shape").Named(SceneLists::Shapes),
        SceneField("objects", Value::Part, "at most 20000 objects in all")
          .Of("object")
          .List(SceneLists::Entries),
        SceneField("constraints", Value::Part, "at most 100000 points and targets in all")
          .Of("constraint")
          .List(SceneLists::Entries),
        SceneField("obstacles", Value::Part).Of("obstacle").List(SceneLists::Obstacles),
        SceneField("winds", Value::Part).Of("wind").List(SceneLists::Winds),
        SceneField("vortices", Value::Part).Of("vortex").List(SceneLists::Vortices),
        SceneField("air", Value::Part).Of("air") } },
    { "time",
      { SceneField("frames", Value::Whole, Frames).Or("300"),
        SceneField("framesPerSecond", Value::Number, FramesPerSecond, "1/s").Or("30"),
        SceneField("loop", Value::Flag,
                   "the step from the last frame to the first is a step like any")
          .Or("false") } },
    { "domain",
      { SceneField("min", Value::Vector, Coordinate, "lowest corner of the volume, m")
          .Or("[-2, -2, 0]"),
        SceneField("max", Value::Vector, Coordinate, "highest corner of the volume, m")
          .Or("[2, 2, 4]"),
        SceneField("open", Value::Word,
                   "sides that bodies and air pass: both ends of x, of y; the top")
          .Among({ "x", "y", "top" })
          .List(3)
          .Or("[]") } },
    { "ground",
      { { "height", Value::Number, Coordinate, "m; default: the volume's floor" },
        SceneField("enabled", Value::Flag).Or("true") },
      "a closed slab below its height; an obstacle" },
    { "air",
      { SceneField("density", Value::Number, Density, "kg/m^3").Or("1.2"),
        SceneField("breeze", Value::Vector, Velocity, "m/s, mean flow along x and y that are open")
          .Among({ "none" })
          .Or("\"none\"") } },
  };
}

std::vector<SceneFieldTable> ObjectTables()
{
  return {
    { "shape",
      { SceneField("builtin", Value::Word, "this or a mesh")
          .Among({ "leaf", "maple", "oak", "willow", "aspen", "feather", "down", "petal", "bubble",
                   "disc" }),
        { "mesh", Value::File,
          ".vtp, .obj, .ply, .stl or .glb file, or a photograph (.png, .jpg, .tif, .bmp)" },
        SceneField(
          "align", Value::Flag,
          "of a mesh; false: it stands on its body axes already, and is taken without `size`")
          .Or("true"),
        { "texture", Value::File, "picture file; default: the builtin's or the mesh's own" },
        { "size", Value::Number, Length, "largest extent, m" },
        { "areaDensity", Value::Number, AreaDensity, "kg/m^2" },
        { "thickness", Value::Number, Length, "m" },
        { "dragCoefficient", Value::Number, Coefficient, "of the face" },
        { "settlingSpeed", Value::Number, Speed, "m/s" },
        { "color", Value::Color, Fraction, "red, green, blue" },
        { "class", Value::Name, "a name that targets of a picture may ask for" } } },
    { "singleObject",
      Fields{ ShapeOf(),
              Corner("position", "m"),
              { "id", Value::Whole, Id, "default: the place in the expanded list" } } +
        OfObjects(),
      "one object" },
    { "objectsInRegion",
      Fields{ ShapeOf(), SceneField("count", Value::Whole, Several).Required(),
              SceneField("region", Value::Part).Of("region").Required(),
              SceneField("seed", Value::Whole, Seed, "default: the scene's") } +
        OfObjects(),
      "several objects, spread" },
    { "objectsAtPositions",
      Fields{ ShapeOf(), Corner("positions", "m").List(SceneLists::Objects) } + OfObjects(),
      "several objects, given" },
    { "releases",
      { FrameOf("from", "the first release").Required(),
        FrameOf("to", "the last one, not before `from`; this or `rate`"),
        SceneField("rate", Value::Number, Coefficient, "objects a second") } },
    { "region", { Corner("min", "lowest corner, m"), Corner("max", "highest corner, m") } },
  };
}

std::vector<SceneFieldTable> ConstraintTables()
{
  return {
    { "positionConstraint", OfPlacedRow("position") +
                              Fields{ Asked(Value::Vector, Coordinate, "m") } +
                              Hold("frames for which it stays there, still") +
                              Fields{ Leave(), Radius(Distance, "m; 0: exact"), Facing() } },
    { "window",
      { FrameOf("from", "the first frame of the window").Required(),
        FrameOf("to", "the last one, not before `from`").Required() } },
    { "orderDirection",
      { SceneField("direction", Value::Vector, Direction, "not zero").Required() },
      "one after another along a direction" },
    { "leave",
      Fields{
        FrameOf("frame", "at which it goes, or a window in which each goes at a frame of its own")
          .Of("window")
          .Required(),
        SceneField("side", Value::Word,
                   "an open one, by which it goes out; seen from the front, -y")
          .Among({ "left", "right", "front", "back", "top" }),
        SceneField("direction", Value::Vector, Direction,
                   "not zero, in the place of a side; without either it goes where it is"),
        SceneField("place", Value::Vector, Coordinate,
                   "m, in the place of a side: it goes there, and is gone"),
        Ordered("who goes when", { "letters", "words", "lines" }).Or("\"random\""),
        SpreadOver("over the window"),
        SceneField("share", Value::Number, UpTo(1.0), "of the objects that go, by chance").Or("1"),
        SceneField("fade", Value::Whole, Frame, "frames in which it fades where it is").Or("0") } },
    { "facing",
      { SceneField("direction", Value::Vector, Direction, "not zero, made unit").Required(),
        SceneField("tolerance", Value::Number, FacingTolerances, "rad").Or("0.35") },
      "a cone about a direction that the body's normal (its z axis) is in at the frame" },
    { "restConstraint",
      OfPlacedRow("rest") +
        Fields{ FrameOf("until", "default: the last frame"),
                Asked(Value::Vector, Coordinate, "a point above the surface to rest on, m"),
                Leave(), FaceUp("the side that looks up (up: its z axis)") } },
    { "velocityConstraint", OfRow("velocity", ObjectId(), Asked(Value::Vector, Velocity, "m/s")) +
                              Fields{ Radius(Distance, "m/s; 0: exact") } },
    { "accelerationConstraint",
      OfRow("acceleration", ObjectId(), Asked(Value::Vector, Acceleration, "m/s^2")) +
        Fields{ Radius(Distance, "m/s^2; 0: exact") } },
    { "orientationConstraint",
      OfRow("orientation", ObjectId(),
            Asked(Value::Quaternion, Direction, "body to world, made unit")) +
        Fields{ Radius(Distance, "rad; 0: exact") } },
    { "pathConstraint",
      { Kind("path"), ObjectId(), FrameOf("firstFrame").Required(),
        Corner("points", "one a frame, m").List(SceneLists::Rows, 1),
        Radius(Distance, "m; 0: exact") } },
    { "keyframeConstraint",
      Fields{ Kind("keyframe") } + Times() +
        Fields{
          OnThen(), SceneField("targets", Value::Part).Of("targets").Required(),
          SceneField("objects", Value::Whole, IdOrAny,
                     "default: all; -1 (any other) only with assign inOrder")
            .List(SceneLists::Objects),
          SceneField("assign", Value::Word).Among({ "optimal", "inOrder" }).Or("\"optimal\""),
          SceneField("velocity", Value::Vector, Velocity, "m/s; rest: the bodies lie from then on")
            .Among({ "none", "rest" })
            .Or("\"none\""),
          FrameOf("until", "of rest; default: the last frame") } +
        Hold("frames for which all stay there, still, once the last has come; not of rest") +
        Fields{ Leave(), Radius(Distance, "m; 0: exact"), Facing("not of rest"),
                FaceUp("of rest: the side that looks up (up: its z axis)") } },
  };
}

std::vector<SceneFieldTable> TargetTables()
{
  return {
    { "pointTargets",
      { Corner("points", "m").List(SceneLists::Objects),
        SceneField("classes", Value::Name, "one a point; empty: any").List(SceneLists::Objects) } },
    { "textTargets",
      Fields{ SceneField("text", Value::Lines).Letters(1000).Required(),
              SceneField("font", Value::Font, "sans, serif, mono or a font file").Or("\"sans\"") } +
        Laid("m", true) },
    { "imageTargets",
      Fields{ SceneField("image", Value::File, "picture file").Required() } + Laid("m", true) +
        Fields{ SceneField("classes", Value::Color, Fraction, "the colour of each class")
                  .Named(SceneLists::Colors) } },
    { "meshTargets", Fields{ SceneField("mesh", Value::File, "surface file").Required() } +
                       Laid("m; default: the file's own", false) },
  };
}

std::vector<SceneFieldTable> ObstacleTables()
{
  std::vector<SceneFieldTable> tables;
  for (const SolidKind& solid : SolidKinds())
  {
    tables.push_back({ std::string(solid.Word) + "Obstacle",
                       Fields{ Kind(solid.Word) } + solid.Fields + OfObstacles() });
  }
  tables.push_back(
    { "meshObstacle",
      Fields{ Kind("mesh"),
              SceneField("file", Value::File, "closed surface, .vtp, .obj, .ply, .stl or .glb")
                .Required(),
              SceneField("position", Value::Vector, Coordinate, "m").Or("[0, 0, 0]"),
              SceneField("scale", Value::Number, Coefficient).Or("1"),
              UpOf("which axis of the file is up; default z; not of a .glb, whose y axis is up by "
                   "its format") } +
        OfObstacles() });
  tables.push_back({ "motionKey", { FrameOf("frame").Required(), Corner("position", "m") } });
  return tables;
}

std::vector<SceneFieldTable> AirTables()
{
  return {
    { "windFile",
      { SceneField("file", Value::File,
                   "series with Wind [m/s^2] or Velocity [m/s]: .vti, .pvd or .vdb")
          .Among({ "vti", "pvd", "vdb" })
          .Required(),
        SceneField("array", Value::Name,
                   "name of the field in the file; default: Wind, Velocity, vel, U or v; all but "
                   "Wind are velocities")
          .Letters(1000),
        UpOf("which axis of the file is up; default z"),
        FrameOf("firstFrame",
                "frame of the file's first field; default: as the file or its name says"),
        SceneField("scale", Value::Number, Coefficient, "factor of the values").Or("1") } },
    { "windFront",
      { Kind("front"),
        SceneField("direction", Value::Vector, Direction, "made unit").Required(),
        SceneField("speed", Value::Number, Coefficient, "m/s, of its edge").Required(),
        SceneField("strength", Value::Number, Acceleration, "m/s^2 behind the edge").Required(),
        SceneField("width", Value::Number, Length, "m, along the direction, that it blows over")
          .Or("1"),
        FrameOf("startFrame", "at which its edge is at `origin`").Or("0"),
        { "origin", Value::Vector, Coordinate,
          "m; default: the corner of the volume where it comes in" } },
      "a gust whose edge travels" },
    { "analyticWind",
      Fields{ SceneField("direction", Value::Vector, Direction, "made unit").Required(),
              SceneField("strength", Value::Number, Acceleration, "m/s^2 at the center").Required(),
              Corner("center", "m"), SceneField("radius", Value::Number, Length, "m").Required() } +
        ForAWhile() },
    { "vortex",
      Fields{ Corner("p1", "pole, m"), Corner("p2", "pole, m"),
              SceneField("strength", Value::Number, VortexStrength, "m^2/s^2").Required() } +
        ForAWhile() + Fields{ SceneField("coreRadius", Value::Number, Length, "m").Required() } },
  };
}

} // namespace

const std::vector<SceneFieldTable>& SceneFieldTables()
{
  static const std::vector<SceneFieldTable> tables = []
  {
    std::vector<SceneFieldTable> all;
    for (const auto& some : { SceneTables(), ObjectTables(), ConstraintTables(), TargetTables(),
                              ObstacleTables(), AirTables() })
    {
      all.insert(all.end(), some.begin(), some.end());
    }
    return all;
  }();
  return tables;
}

} // namespace waft
