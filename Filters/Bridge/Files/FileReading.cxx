// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/FileReading.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkXMLReader.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>

namespace waft
{
namespace
{

// The first message that an event brings; the others are left out.
class FirstMessage
{
public:
  FirstMessage()
  {
    this->Command->SetClientData(&this->Text);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* client, void* message)
      {
        auto* text = static_cast<std::string*>(client);
        if (message && text->empty())
        {
          *text = static_cast<const char*>(message);
        }
      });
  }
  ~FirstMessage() { this->Command->SetCallback(nullptr); }
  FirstMessage(const FirstMessage&) = delete;
  FirstMessage& operator=(const FirstMessage&) = delete;

  vtkCommand* Ear() { return this->Command; }
  void Listen(vtkObject* subject, unsigned long event)
  {
    subject->AddObserver(event, this->Command);
  }

  std::string Text;

private:
  vtkNew<vtkCallbackCommand> Command;
};

} // namespace

std::string Extension(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

std::string PlainMessage(const std::string& message)
{
  constexpr std::size_t most = 500;
  // "ERROR: In FILE, line N\nvtkClass (0xADDRESS): what is wrong"
  std::size_t begin = message.find("): ");
  const bool isFramed = begin != std::string::npos && message.rfind(" (0x", begin) < begin;
  begin = isFramed ? begin + 3 : 0;
  std::string plain;
  for (std::size_t i = begin; i < message.size() && plain.size() < most; ++i)
  {
    const char c = message[i];
    const bool isBlank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!isBlank || (!plain.empty() && plain.back() != ' '))
    {
      plain += isBlank ? ' ' : c > ' ' && c <= '~' ? c : '?';
    }
  }
  while (!plain.empty() && plain.back() == ' ')
  {
    plain.pop_back();
  }
  return plain;
}

Result RunReader(vtkAlgorithm* reader, ReaderWarnings warnings)
{
  FirstMessage errors;
  FirstMessage warned;
  for (vtkObject* subject :
       { static_cast<vtkObject*>(reader), static_cast<vtkObject*>(reader->GetExecutive()) })
  {
    errors.Listen(subject, vtkCommand::ErrorEvent);
    warned.Listen(subject, vtkCommand::WarningEvent);
  }
  auto* xml = vtkXMLReader::SafeDownCast(reader);
  if (xml)
  {
    xml->SetReaderErrorObserver(errors.Ear());
    xml->SetParserErrorObserver(errors.Ear());
  }
  try
  {
    reader->Update();
  }
  catch (const std::exception& error)
  {
    errors.Text = errors.Text.empty() ? error.what() : errors.Text;
  }
  for (vtkObject* subject :
       { static_cast<vtkObject*>(reader), static_cast<vtkObject*>(reader->GetExecutive()) })
  {
    subject->RemoveObserver(errors.Ear());
    subject->RemoveObserver(warned.Ear());
  }
  if (xml)
  {
    xml->SetReaderErrorObserver(nullptr);
    xml->SetParserErrorObserver(nullptr);
  }
  if (warnings == ReaderWarnings::AreErrors && errors.Text.empty())
  {
    errors.Text = warned.Text;
  }
  return errors.Text.empty()
           ? Result::Ok()
           : Result::Error("expected a file that can be read, found: " + PlainMessage(errors.Text));
}

} // namespace waft
