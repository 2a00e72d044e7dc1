// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/FileReading.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace waft
{

std::string Extension(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

Result RunReader(vtkAlgorithm* reader)
{
  std::string text;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(&text);
  command->SetCallback(
    [](vtkObject*, unsigned long, void* client, void* message)
    {
      auto* collected = static_cast<std::string*>(client);
      if (message && collected->empty())
      {
        *collected = static_cast<const char*>(message);
      }
    });
  const unsigned long tag = reader->AddObserver(vtkCommand::ErrorEvent, command);
  reader->Update();
  reader->RemoveObserver(tag);
  if (text.empty())
  {
    return Result::Ok();
  }
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
  {
    text.pop_back();
  }
  return Result::Error("expected a file that can be read, found: " + text);
}

} // namespace waft
