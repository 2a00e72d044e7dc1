// SPDX-License-Identifier: BSD-3-Clause
#include "JsonFiles.h"

#include "Scene/SameSceneFields.h"

#include <fstream>

namespace
{

nlohmann::json JsonOf(const std::string& file)
{
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

} // namespace

std::string JsonAt(const std::string& file, const std::string& pointer)
{
  return JsonOf(file).at(nlohmann::json::json_pointer(pointer)).dump();
}

void ExpectSameFields(const std::string& authored, const std::string& folder,
                      const std::string& written, const std::string& folderOfWritten)
{
  waft::test::ExpectSameFields(JsonOf(authored), folder, JsonOf(written), folderOfWritten);
}
