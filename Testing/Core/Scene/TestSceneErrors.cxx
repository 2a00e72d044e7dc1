// SPDX-License-Identifier: BSD-3-Clause
// Every message names the place, what was expected and what was found.
#include "Base/Random.h"
#include "TestAssets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

using namespace waft;

namespace
{

struct Bad
{
  const char* Fields; // of a scene that has one leaf, object 0
  const char* Message;
};

std::string Whole(const std::string& fields)
{
  return R"({"waft": 1, "shapes": {"leaf": {"builtin": "leaf"}},
    "objects": [{"shape": "leaf", "position": [0, 0, 3]}])" +
         std::string(fields.empty() ? "" : ", ") + fields + "}";
}

} // namespace

TEST(SceneErrors, NameThePlace)
{
  const Bad cases[] = {
    { R"("wind": [])", "/wind: expected one of the fields waft, " },
    { R"("time": {"frames": 1})", "/time/frames: expected a number of frames (an integer from 2" },
    { R"("time": {"frames": 10.5})", "/time/frames: expected a number of frames" },
    { R"("time": {"framesPerSecond": 0})",
      "/time/framesPerSecond: expected a number above 0, found 0" },
    { R"("time": 3)", "/time: expected an object, found 3" },
    { R"("title": 3)", "/title: expected a text, found 3" },
    { R"("seed": -1)", "/seed: expected a seed" },
    { R"("domain": {"min": [0, 0, 0], "max": [1, 0, 1]})", "/domain: expected a volume" },
    { R"("domain": {"min": [0, 0]})", "/domain/min: expected a vector [x, y, z], found [0,0]" },
    { R"("domain": {"min": [0, "a", 0]})", "/domain/min/1: expected a finite number, found \"a\"" },
    { R"("ground": {"enabled": 1})", "/ground/enabled: expected true or false, found 1" },
    { R"("air": {"density": -1})", "/air/density: expected a number above 0, found -1" },
    { R"("obstacles": [{"kind": "cone"}])",
      "/obstacles/0/kind: expected box, sphere, cylinder or mesh" },
    { R"("obstacles": [{"kind": "box", "min": [0, 0, 0], "max": [1, 1, 0]}])",
      "/obstacles/0/max: expected a corner" },
    { R"("obstacles": [{"kind": "sphere", "center": [0, 0, 0]}])",
      "/obstacles/0/radius: expected a radius in metres, found nothing" },
    { R"("obstacles": [{"kind": "sphere", "center": [0, 0, 0], "radius": -2}])",
      "/obstacles/0/radius: expected a number above 0, found -2" },
    { R"("obstacles": [{"kind": "mesh", "file": "nowhere.ply"}])",
      "/obstacles/0/file: expected a file that exists, found none at" },
    { R"("obstacles": [{"kind": "box", "min": [0, 0, 0], "max": [1, 1, 1], "id": 1},
         {"kind": "box", "min": [0, 0, 0], "max": [1, 1, 1]}])",
      "/obstacles/1: expected an id of its own, found 1" },
    { R"("obstacles": [{"kind": "box", "min": [0, 0, 0], "max": [1, 1, 1], "motion":
         [{"frame": 3, "position": [0, 0, 0]}, {"frame": 3, "position": [0, 0, 0]}]}])",
      "/obstacles/0/motion/1/frame: expected a frame after 3, found 3" },
    { R"("winds": [{"direction": [0, 0, 0]}])",
      "/winds/0/direction: expected a direction that is not zero" },
    { R"("winds": [{"direction": [1, 0, 0]}])", "/winds/0/strength: expected a strength" },
    { R"("winds": [{"file": "LICENSE"}])", "/winds/0/file: expected a .vti, .pvd or .vdb file" },
    { R"("winds": [{"file": "a.vti", "strength": 2}])",
      "/winds/0/strength: expected one of the fields file" },
    { R"("vortices": [{"p1": [0, 0, 0], "p2": [0, 0, 0]}])",
      "/vortices/0/p2: expected a pole apart" },
    { R"("constraints": {})", "/constraints: expected a list of constraints, found {}" },
    { R"("constraints": [{}])", "/constraints/0/kind: expected position, velocity" },
    { R"("constraints": [{"kind": "jump"}])",
      "/constraints/0/kind: expected position, velocity, acceleration, orientation, rest, path or "
      "keyframe, found \"jump\"" },
    { R"("constraints": [{"kind": "position", "frame": 3}])",
      "/constraints/0/object: expected the id of an object, found nothing" },
    { R"("constraints": [{"kind": "position", "object": 1, "frame": 3, "value": [0, 0, 0]}])",
      "/constraints/0/object: expected the id of an object or -1 for any (an integer from -1 to "
      "0), found 1" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9}, "value": [0, 0, 0]}])",
      "/constraints/0/frame/to: expected the last frame of the window, found nothing" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9, "to": 300},
         "value": [0, 0, 0]}])",
      "/constraints/0/frame/to: expected a frame not before `from` (an integer from 9 to 299)" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9, "to": 8},
         "value": [0, 0, 0]}])",
      "/constraints/0/frame/to: expected a frame not before `from` (an integer from 9 to 299)" },
    { R"("constraints": [{"kind": "rest", "object": 0, "frame": {"from": 9, "to": 80}, "until": 109,
         "value": [0, 0, 0]}])",
      "/constraints/0/until: expected a frame at least one second after the last arrival (an "
      "integer from 110 to 299), found 109" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "order": "random",
         "value": [0, 0, 0]}])",
      "/constraints/0/order: expected `order` only where `frame` is a window {`from`, `to`}" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9, "to": 80},
         "spread": "ease-in", "value": [0, 0, 0]}])",
      "/constraints/0/spread: expected `spread` only with an `order` other than air" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9, "to": 80},
         "order": "random", "spread": "linear", "value": [0, 0, 0]}])",
      "/constraints/0/spread: expected even, ease-in or ease-out, found \"linear\"" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9, "to": 80},
         "order": "sideways", "value": [0, 0, 0]}])",
      "/constraints/0/order: expected air, left-to-right, right-to-left" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9, "to": 80},
         "order": "letters", "value": [0, 0, 0]}])",
      "/constraints/0/order: expected an order by letters only of targets that are a text" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9, "to": 80},
         "order": [0, 1], "value": [0, 0, 0]}])",
      "/constraints/0/order: expected 1 ranks, one a target, found 2" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9, "to": 80},
         "order": [1], "value": [0, 0, 0]}])",
      "/constraints/0/order/0: expected a rank below the number of targets (an integer from 0 to" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": {"from": 9, "to": 80},
         "order": {"direction": [0, 0, 0]}, "value": [0, 0, 0]}])",
      "/constraints/0/order/direction: expected a direction that is not zero" },
    { R"("constraints": [{"kind": "rest", "object": 0, "frame": 9, "on": 3, "value": [0, 0, 0]}])",
      "/constraints/0/on: expected the id of an obstacle of the list, found 3" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "drift": true, "value": [0, 0, 0]}])",
      "/constraints/0/drift: expected `drift` only with `hold`" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "hold": 5, "holdRadius": 0.1, "value": [0, 0, 0]}])",
      "/constraints/0/holdRadius: expected `holdRadius` only with `drift`" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "hold": 300, "value": [0, 0, 0]}])",
      "/constraints/0/hold: expected a number of frames of the scene (an integer from 0 to 299)" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "hold": 3, "radius": 0.1,
         "value": [0, 0, 0]}])",
      "/constraints/0/hold: expected `hold` only with radius 0" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "hold": 3, "velocity": "rest",
         "targets": {"points": [[0, 0, 0]]}}])",
      "/constraints/0/hold: expected `hold` only where objects do not rest" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "hold": 3, "velocity": [1, 0, 0],
         "targets": {"points": [[0, 0, 0]]}}])",
      "/constraints/0/velocity: expected no velocity with `hold`" },
    { R"("air": {"breeze": [0.1, 0, 0]})",
      "/air/breeze: expected 0 along x, whose sides are closed, found 0.1" },
    { R"("domain": {"open": ["x", "top"]}, "air": {"breeze": [0.1, 0, 1]})",
      "/air/breeze: expected 0 along z, as the floor is closed, found 1" },
    { R"("air": {"breeze": "strong"})", "/air/breeze: expected a vector [x, y, z] or \"none\"" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "value": [0, 0, 1],
         "leave": {"frame": 20, "place": [0, 0, 9]}}])",
      "/constraints/0/leave/place: expected a place in the volume, found [0,0,9]" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "value": [0, 0, 1],
         "leave": {"frame": 20, "place": [0, 0, 1], "direction": [0, 0, 1]}}])",
      "/constraints/0/leave/place: expected either `side`, `direction` or `place`" },
    { R"("domain": {"open": ["z"]})", "/domain/open/0: expected x, y or top, found \"z\"" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "value": [0, 0, 2],
         "leave": {"frame": 8}}])",
      "/constraints/0/leave/frame: expected a frame not before the last arrival" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "value": [0, 0, 2],
         "leave": {"frame": 20, "side": "right"}}])",
      "/constraints/0/leave: expected a way out by a side that is open (/domain/open), found x "
      "closed" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "value": [0, 0, 2],
         "leave": {"frame": 20, "side": "below"}}])",
      "/constraints/0/leave/side: expected left, right, front, back or top" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "value": [0, 0, 2],
         "leave": {"frame": 20, "side": "top", "direction": [0, 0, 1]}}])",
      "/constraints/0/leave/direction: expected either `side` or `direction`" },
    { R"("winds": [{"kind": "storm", "direction": [1, 0, 0], "speed": 1, "strength": 1}])",
      "/winds/0/kind: expected front" },
    { R"("winds": [{"kind": "front", "direction": [0, 0, 0], "speed": 1, "strength": 1}])",
      "/winds/0/direction: expected a direction that is not zero" },
    { R"("constraints": [{"kind": "velocity", "object": 0, "frame": {"from": 9, "to": 80},
         "value": [0, 0, 0]}])",
      "/constraints/0/frame: expected a frame of the scene" },
    { R"("constraints": [{"kind": "velocity", "object": -1, "frame": 3, "value": [0, 0, 0]}])",
      "/constraints/0/object: expected the id of an object (an integer from 0 to 0), found -1" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 300, "value": [0, 0, 0]}])",
      "/constraints/0/frame: expected a frame of the scene (an integer from 0 to 299), found 300" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": -1, "value": [0, 0, 0]}])",
      "/constraints/0/frame: expected a frame" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 1, "value": [0, 0, 0], "radius": -0.1}])",
      "/constraints/0/radius: expected a number of at least 0" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 1, "value": [0, 0, 0], "until": 3}])",
      "/constraints/0/until: expected one of the fields kind, object" },
    { R"("constraints": [{"kind": "rest", "object": 0, "frame": 9, "value": [0, 0, 0],
        "faceUp": "left"}])",
      "/constraints/0/faceUp: expected any, up or down" },
    { R"("constraints": [{"kind": "position", "object": 0, "frame": 9, "value": [0, 0, 0],
        "facing": {"direction": [0, 0, 0]}}])",
      "/constraints/0/facing/direction: expected a direction that is not zero" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {"points": [[0, 0, 1]]},
        "velocity": "rest", "facing": {"direction": [0, 0, 1]}}])",
      "/constraints/0/facing: expected `facing` only where objects do not rest" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {"points": [[0, 0, 1]]},
        "faceUp": "up"}])",
      "/constraints/0/faceUp: expected `faceUp` only with" },
    { R"("constraints": [{"kind": "rest", "object": 0, "frame": 9, "until": 3, "value": [0, 0, 0]}])",
      "/constraints/0/until: expected a frame not before `frame`" },
    { R"("constraints": [{"kind": "orientation", "object": 0, "frame": 9, "value": [0, 0, 0, 0]}])",
      "/constraints/0/value: expected a quaternion" },
    { R"("constraints": [{"kind": "path", "object": 0, "firstFrame": 299, "points": [[0, 0, 0], [0, 0, 0]]}])",
      "/constraints/0/points: expected 1 to 1 points" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {"points": [[0, 0, 0], [0, 0, 1]]}}])",
      "/constraints/0/targets: expected at most 1 targets" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {"points": [[0, 0]]}}])",
      "/constraints/0/targets/points/0: expected a vector" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {}}])",
      "/constraints/0/targets: expected targets with one of" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "objects": [0, 0], "targets": {"points": []}}])",
      "/constraints/0/objects/1: expected an id that is not in the list" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "assign": "best", "targets": {"points": []}}])",
      "/constraints/0/assign: expected optimal or inOrder, found \"best\"" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "velocity": "fast", "targets": {"points": []}}])",
      "/constraints/0/velocity: expected a vector" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {"text": "A", "origin": [0, 0, 0]}}])",
      "/constraints/0/targets/width: expected a width in metres, found nothing" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {"text": "A", "origin": [0, 0, 0], "width": 1, "u": [0, 1, 0]}}])",
      "/constraints/0/targets: expected directions `u` and `v` that are not parallel" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {"text": "", "origin": [0, 0, 0], "width": 1}}])",
      "/constraints/0/targets/text: expected a text of 1 to 1000 characters" },
    { R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {"image": "LICENSE", "origin": [0, 0, 0], "width": 1, "classes": {"red": [1, 0, 0]}}}])",
      "/constraints/0/targets/classes/red: expected the class of a shape" },
  };
  for (const Bad& bad : cases)
  {
    const std::string message = ErrorOf(Whole(bad.Fields));
    EXPECT_EQ(message.find(std::string("test.json: ") + bad.Message), 0u)
      << bad.Fields << "\n  " << message;
  }
}

TEST(SceneErrors, NameTheRelease)
{
  const Bad cases[] = {
    { R"("position": [0, 0, 3], "release": 300)",
      "/objects/1/release: expected a frame of the scene (an integer from 0 to 299), found 300" },
    { R"("position": [0, 0, 3], "on": 3)",
      "/objects/1/on: expected the id of an obstacle of the list, found 3" },
    { R"("position": [0, 0, 3], "release": {"from": 3})",
      "/objects/1/release: expected either `to` or `rate` beside `from`" },
    { R"("position": [0, 0, 3],
         "release": {"from": 3, "to": 9, "rate": 1})",
      "/objects/1/release: expected either `to` or `rate` beside `from`" },
    { R"("position": [0, 0, 3], "release": {"from": 3, "to": 2})",
      "/objects/1/release/to: expected a frame not before `from` (an integer from 3 to 299)" },
    { R"("positions": [[0, 0, 3], [1, 0, 3]],
         "release": {"from": 290, "rate": 1})",
      "/objects/1/release/rate: expected a rate by which all 2 are released by frame 299" },
    { R"("position": [0, 0, 3], "release": 9, "order": "inward")",
      "/objects/1/order: expected `order` only where `release` is a window" },
    { R"("position": [0, 0, 3], "release": {"from": 3, "rate": 9},
         "spread": "ease-in")",
      "/objects/1/spread: expected `spread` only where `release` is a window" },
    { R"("position": [0, 0, 3], "release": {"from": 3, "to": 9},
         "order": "letters")",
      "/objects/1/order: expected an order by letters only of targets that are a text" },
  };
  for (const Bad& bad : cases)
  {
    std::string whole = Whole("");
    const std::string added = std::string(R"(, {"shape": "leaf", )") + bad.Fields + "}]";
    whole.replace(whole.rfind(']'), 1, added);
    const std::string message = ErrorOf(whole);
    EXPECT_EQ(message.find(std::string("test.json: ") + bad.Message), 0u)
      << bad.Fields << "\n  " << message;
  }
}

TEST(SceneErrors, OfATextThatIsTooLong)
{
  const auto errorOf = [](int length)
  {
    std::string text;
    for (int i = 0; i < length; ++i)
    {
      text += "\u00e4"; // two bytes
    }
    return ErrorOf(Whole(
      R"("constraints": [{"kind": "keyframe", "frame": 9, "targets": {"origin": [0, 0, 0], "text": ")" +
      text + R"("}}])"));
  };
  const std::string message = "/text: expected a text of 1 to 1000 characters";
  EXPECT_EQ(errorOf(1000).find(message), std::string::npos);
  EXPECT_NE(errorOf(1001).find(message), std::string::npos);
}

TEST(SceneErrors, OfShapesAndObjects)
{
  const auto shape = [](const std::string& fields)
  { return ErrorOf(R"({"waft": 1, "shapes": {"a/b": {)" + fields + "}}}"); };
  EXPECT_EQ(shape(R"("builtin": "spoon")").find("test.json: /shapes/a~1b/builtin: expected a "),
            0u);
  EXPECT_EQ(shape(R"("size": 1)").find("test.json: /shapes/a~1b: expected either `builtin` or"),
            0u);
  EXPECT_EQ(shape(R"("builtin": "leaf", "size": 0)"),
            "test.json: /shapes/a~1b/size: expected a number above 0, found 0");
  EXPECT_EQ(shape(R"("builtin": "leaf", "color": [0, 2, 0])").find("test.json: /shapes/a~1b/color"),
            0u);
  EXPECT_NE(shape(R"("mesh": "no.ply")").find("/mesh: expected a file that exists"),
            std::string::npos);
  const auto object = [](const std::string& fields)
  {
    return ErrorOf(R"({"waft": 1, "shapes": {"leaf": {"builtin": "leaf"}}, "objects": [{)" +
                   fields + "}]}");
  };
  EXPECT_EQ(object(R"("shape": "feather", "position": [0, 0, 1])"),
            "test.json: /objects/0/shape: expected the name of a shape (leaf), found \"feather\"");
  EXPECT_EQ(object(R"("shape": "leaf")"),
            "test.json: /objects/0/position: expected a point [x, y, z], found nothing");
  EXPECT_EQ(object(R"("shape": "leaf", "count": 3)").find("test.json: /objects/0/region"), 0u);
  EXPECT_EQ(
    object(R"("shape": "leaf", "count": 0, "region": {})").find("test.json: /objects/0/count"), 0u);
  EXPECT_NE(object(R"("shape": "leaf", "count": 3, "region": {"min": [5, 5, 5], "max": [6, 6, 6]})")
              .find("/objects/0/region: expected room for 3 objects"),
            std::string::npos);
  EXPECT_NE(object(R"("shape": "leaf", "count": 3, "positions": [])")
              .find("/objects/0/positions: expected one of the fields shape, count, region"),
            std::string::npos);
}

TEST(SceneErrors, OfTheFormatItself)
{
  EXPECT_EQ(ErrorOf("{}"), "test.json: /waft: expected the format's version 1, found nothing");
  EXPECT_EQ(ErrorOf(R"({"waft": 2})").find("test.json: /waft: expected the format's version 1"),
            0u);
  EXPECT_EQ(ErrorOf("[]"), "test.json: /: expected an object, found []");
  EXPECT_EQ(
    ErrorOf("{\"waft\": 1,\n  \"seed\": }").find("test.json: line 2, column 11: expected JSON, "),
    0u)
    << ErrorOf("{\"waft\": 1,\n  \"seed\": }");
  EXPECT_EQ(ErrorOf("").find("test.json: line 1, column 1: expected JSON"), 0u) << ErrorOf("");
  EXPECT_EQ(ErrorOf("{\"waft\": 1,\n \"air\": {\"density\": 1e999}}"),
            "test.json: line 2, column 21: expected a finite number, found 1e999");
  EXPECT_EQ(ErrorOf(R"({"waft": 1, "air": {"density": NaN}})").find("test.json: line 1, column"),
            0u);
}

TEST(SceneErrors, OfFieldsThatStandTwice)
{
  EXPECT_EQ(ErrorOf(R"({"waft": 1, "time": {"frames": 30, "frames": 60}})"),
            "test.json: /time/frames: expected every field of an object once, found \"frames\" "
            "twice");
  EXPECT_EQ(ErrorOf(R"({"waft": 1, "objects": [{}, [1, {"a/b": [{}], "a/b": 2}]]})"),
            "test.json: /objects/1/1/a~1b: expected every field of an object once, found \"a/b\" "
            "twice");
}

TEST(SceneErrors, AreReadableWhateverTheyQuote)
{
  for (const std::string& quoted : { std::string("\xFF\xFE"), std::string(100000, 'x') })
  {
    for (const std::string& text :
         { "{\"waft\": \"" + quoted + "\"}", "{\"" + quoted + "\": 1}", "{" + quoted,
           R"({"waft": 1, "shapes": {")" + quoted + R"(": {}}})",
           R"({"waft": 1, "shapes": {"a": {"mesh": ")" + quoted + R"("}}})" })
    {
      const std::string message = ErrorOf(text);
      EXPECT_EQ(message.find("test.json: "), 0u);
      EXPECT_LT(message.size(), 2000u);
      EXPECT_EQ(message.find('\xFF'), std::string::npos);
    }
  }
}

TEST(SceneErrors, OfNamesThatNoFileCanHold)
{
  const auto errorOfTitle = [](const std::string& title)
  { return ErrorOf(R"({"waft": 1, "title": ")" + title + "\"}"); };
  const std::string lack =
    " without control characters and marks that turn the direction of writing, found ";
  for (const char* control : { "0000", "0001", "000a", "001b", "007f", "0085", "009f", "061c",
                               "200e", "200f", "202a", "202e", "2066", "2069", "fffe", "ffff" })
  {
    std::string upper = control;
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    EXPECT_EQ(errorOfTitle(std::string("a\\u") + control + "b"),
              "test.json: /title: expected a text" + lack + "U+" + upper);
    const std::string shape = ErrorOf(std::string(R"({"waft": 1, "shapes": {"a\u)") + control +
                                      R"(b": {"builtin": "leaf"}}})");
    EXPECT_EQ(shape.find("test.json: /shapes/a"), 0u) << shape;
    EXPECT_NE(shape.find("b: expected a name" + lack + "U+" + upper), std::string::npos) << shape;
  }
  for (const char* good : { "\u05e9\u05dc\u05d5\u05dd", "Bl\u00e4tter \u2618",
                            "a\u200d\u200b\ufffd", "\U0001f342\ufe0f", "a\u00a0b" })
  {
    EXPECT_EQ(Parsed(std::string(R"({"waft": 1, "title": ")") + good + "\"}").Title, good);
  }
}

TEST(SceneErrors, KeepWhatWasExpectedOfALongName)
{
  const std::string message = ErrorOf("{\"" + std::string(1000000, 'n') + "\": 1}");
  EXPECT_NE(message.find("nnn...: expected one of the fields waft, title"), std::string::npos);
  EXPECT_NE(message.find("found the unknown field \"nnn"), std::string::npos);
}

TEST(SceneErrors, OfWhatLibrariesThrow)
{
  class Failing : public TestAssets
  {
    Result LoadMesh(const std::string&, TriangleMesh&) const override { throw std::bad_alloc(); }
  };
  Scene scene;
  const Result result =
    ParseScene(R"({"waft": 1, "obstacles": [{"kind": "mesh", "file": "LICENSE"}]})", "test.json",
               WAFT_SOURCE_DIR, Failing(), scene);
  EXPECT_EQ(result.Message().find("test.json: /obstacles/0/file: "), 0u) << result.Message();
}

TEST(SceneErrors, OfWhatFollowsFromSeveralNumbers)
{
  EXPECT_EQ(ErrorOf(R"({"waft": 1, "shapes": {"a": {"builtin": "leaf", "size": 1e5,
                                                     "areaDensity": 1e5}}})")
              .find("test.json: /shapes/a: expected a surface and an areaDensity whose product"),
            0u);
  EXPECT_EQ(ErrorOf(R"({"waft": 1, "domain": {"min": [0, 0, 0], "max": [1, 1, 1e-4]}})")
              .find("test.json: /domain: expected a volume of sides from 0.001 m on, the longest "
                    "at most 1000 times the shortest"),
            0u);
  EXPECT_EQ(ErrorOf(R"({"waft": 1, "domain": {"min": [0, 0, 0], "max": [2000, 1, 1]}})")
              .find("test.json: /domain: expected a volume of sides"),
            0u);
}

TEST(SceneErrors, WarnOfObstaclesThatAreNeverInTheVolume)
{
  const auto warnings = [](const std::string& obstacle)
  {
    Scene scene;
    EXPECT_TRUE(ParseScene(R"({"waft": 1, "obstacles": [)" + obstacle + "]}", "test.json", "",
                           TestAssets(), scene));
    return scene.Warnings;
  };
  const char* outside = R"({"kind": "sphere", "center": [0, 0, -5], "radius": 1)";
  ASSERT_EQ(warnings(std::string(outside) + "}").size(), 1u);
  EXPECT_EQ(warnings(std::string(outside) + "}")[0],
            "test.json: /obstacles/0: the obstacle is outside the volume at all frames");
  EXPECT_TRUE(warnings(std::string(outside) + R"(, "motion": [{"frame": 0, "position": [0, 0, -5]},
                                                   {"frame": 9, "position": [0, 0, 1]}]})")
                .empty());
}

TEST(SceneErrors, SurviveDeepNestingAndDamagedText)
{
  const std::string deep(200000, '[');
  EXPECT_FALSE(ErrorOf(deep).empty());
  EXPECT_NE(ErrorOf(R"({"waft": 1, "objects": [[)" + deep + std::string(200002, ']') + "}")
              .find("/objects/0: expected an object, found a list of 1"),
            std::string::npos);
  std::ifstream stream(std::string(WAFT_SOURCE_DIR) + "/Data/Scenes/leaves-letters.waft.json");
  std::stringstream whole;
  whole << stream.rdbuf();
  Random random(6);
  int refused = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    std::string text = whole.str();
    for (int change = 0; change < 3; ++change)
    {
      const auto at = random.Index(static_cast<std::uint32_t>(text.size()));
      text[at] = static_cast<char>(random.Index(256));
    }
    Scene scene;
    const Result result =
      ParseScene(text, "t", std::string(WAFT_SOURCE_DIR) + "/Data/Scenes", TestAssets(), scene);
    refused += !result;
    EXPECT_TRUE(result || result.Message().rfind("t: ", 0) == 0) << result.Message();
  }
  EXPECT_GT(refused, 100);
}

TEST(SceneErrors, OfMissingFiles)
{
  Scene scene;
  const Result result = ReadScene("/nowhere/scene.waft.json", TestAssets(), scene);
  EXPECT_FALSE(result);
  EXPECT_EQ(result.Message(),
            "/nowhere/scene.waft.json: expected a scene file, found no such file");
  EXPECT_FALSE(ReadScene(WAFT_SOURCE_DIR, TestAssets(), scene)) << "a folder";
}
