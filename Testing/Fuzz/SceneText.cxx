// SPDX-License-Identifier: BSD-3-Clause
// The reader of scenes: any text is a scene, or refused with the name of its file in front.
#include "Fuzz.h"

#include "Scene/TestAssets.h"

#include <cstdlib>

using namespace waft;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  Scene scene;
  const Result result = ParseScene(text, "scene", ".", TestAssets(), scene);
  if (!result && (result.Message().rfind("scene: ", 0) != 0 || result.Message().size() > 2048))
  {
    std::abort();
  }
  return 0;
}
