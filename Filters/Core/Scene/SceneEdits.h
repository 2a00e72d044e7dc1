// SPDX-License-Identifier: BSD-3-Clause
// Changes of a scene file by hand: of its text, so that all that they do not name stays as it was
// written.
#pragma once

#include "Base/Result.h"

#include <string>

namespace waft
{

/// The bytes of a scene file, of which there are not too many. Fails as ReadScene does.
Result ReadSceneText(const std::string& file, std::string& text);

/// Applies a JSON Patch (RFC 6902; of its operations add, replace and remove), or nothing where
/// `edits` is empty, to the text of a scene. Order, blanks and comments of the rest are kept, and
/// what is added to a list or an object stands as its neighbours do. `name` stands in messages. A
/// failure, `NAME: Edits: /0/path: expected what, found what`, leaves the text as it was.
Result EditSceneText(const std::string& edits, const std::string& name, std::string& text);

/// What of a scene has places that can be moved: marks, starts and regions, targets, obstacles that
/// stand still, vortices and winds. A JSON object with the volume (`min`, `max`), `frames`,
/// `framesPerSecond`, the highest id of an object (`lastObject`), whether there is a list of
/// constraints (`hasConstraints`), and `handles`, a list of
///
///   {"kind": "mark", "object": 0, "frame": 95, "place": [x, y, z],
///    "moves": {"/constraints/0/value": [x, y, z]}}
///
/// of which `moves` are the points that go along, by JSON pointers. kind: start, region (many
/// starts), mark, rest, target (one of a list), targets (the middle of many), obstacle, vortex,
/// wind; after a region, a box, a cylinder and a vortex two more that say how large it is: corner
/// of region, corner of obstacle, end of obstacle, end of vortex. Corners have `least` and `most`,
/// the box that they may be moved in; all others may be moved in the volume. `object` is -1 where
/// it is any or none, `frame` is -1 where it is at all frames. The text is one that ParseScene
/// takes.
Result DescribeHandles(const std::string& text, const std::string& name, std::string& handles);

} // namespace waft
