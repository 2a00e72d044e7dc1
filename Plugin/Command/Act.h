// SPDX-License-Identifier: BSD-3-Clause
// What each command does; its exit status, all else that is said of it being said.
#pragma once

#include "Base/Communicator.h"
#include "Base/Result.h"
#include "Commands.h"
#include "Scene/SceneNode.h"

namespace waft::command
{

/// answer: what the JSON document has of it. A failure's Kind is the exit status.
Result Synthesize(const CommandLine& line, Communicator* ranks, int& status, SceneJson& answer);
Result CheckScene(const CommandLine& line, int& status, SceneJson& answer);
Result MakeDatabase(const CommandLine& line, Communicator* ranks, int& status);

} // namespace waft::command
