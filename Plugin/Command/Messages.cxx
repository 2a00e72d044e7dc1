// SPDX-License-Identifier: BSD-3-Clause
#include "Messages.h"

#include "Base/AtomicFile.h"
#include "Base/Characters.h"
#include "Bridge/Run/BuildName.h"
#include "Bridge/Run/FolderBelow.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>

namespace waft::command
{
namespace
{

struct Voice
{
  Loudness Shown = Loudness::Normal;
  Descriptor Log;
  std::mutex Speaking;
  bool IsUntold = false, IsUnread = false; // something of stdout is lost; nobody reads it
};

Voice& TheVoice()
{
  static Voice voice;
  return voice;
}

/// Writes all of it; errno where it cannot.
int WriteAll(int file, const std::string& text)
{
  for (std::size_t at = 0; at < text.size();)
  {
    const ssize_t written = ::write(file, text.data() + at, text.size() - at);
    if (written < 0 && errno != EINTR)
    {
      return errno;
    }
    at += written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  return 0;
}

std::string Escape(const char* form, unsigned long code)
{
  char text[16];
  std::snprintf(text, sizeof(text), form, code);
  return text;
}

/// Besides controls, what ends a line or is no letter at all.
bool IsUnseen(char32_t code)
{
  return IsControl(code) || code == 0x2028 || code == 0x2029 || code == 0xfeff ||
         (code >= 0xfff9 && code <= 0xfffb);
}

std::string Now()
{
  const auto now = std::chrono::system_clock::now();
  const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
  const auto rest = std::chrono::duration_cast<std::chrono::milliseconds>(
    now - std::chrono::system_clock::from_time_t(seconds));
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char text[64];
  const std::size_t size = std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%S", &utc);
  std::snprintf(text + size, sizeof(text) - size, ".%03dZ", static_cast<int>(rest.count()));
  return text;
}

/// The last line of a text that Waft wrote.
std::string MarkOf(const std::string& text)
{
  return "written by waft, " + Sha256(text) + "\n";
}

bool IsMarked(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  const std::string all(std::istreambuf_iterator<char>(stream), {});
  const std::size_t size = MarkOf("").size();
  return all.size() > size &&
         all.compare(all.size() - size, size, MarkOf(all.substr(0, all.size() - size))) == 0;
}

/// An argument as a shell takes it.
std::string Quoted(const std::string& text)
{
  constexpr const char* plain =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789@%+=:,./-_";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos)
  {
    return text;
  }
  std::string quoted = "'";
  for (const char letter : text)
  {
    quoted += letter == '\'' ? "'\"'\"'" : std::string(1, letter);
  }
  return quoted + "'";
}

void Emit(Voice& voice, const std::string& line, Message kind)
{
  constexpr Loudness shown[] = { Loudness::Quiet, Loudness::Quiet, Loudness::Normal,
                                 Loudness::Verbose };
  constexpr const char* words[] = { "error  ", "warning", "note   ", "detail ", "record " };
  const auto number = static_cast<std::size_t>(kind);
  if (kind != Message::Record && voice.Shown >= shown[number])
  {
    WriteAll(STDERR_FILENO, line + "\n");
  }
  if (!voice.Log.IsOpen())
  {
    return;
  }
  const int failed = WriteAll(voice.Log.Get(), Now() + " " + words[number] + " " + line + "\n");
  if (failed != 0)
  {
    voice.Log.Close();
    Emit(voice,
         std::string("waft: warning: nothing more is written to the log: ") + std::strerror(failed),
         Message::Warning);
  }
}

} // namespace

Status StatusOf(ErrorKind kind)
{
  return kind == ErrorKind::Input ? Malformed : kind == ErrorKind::Stopped ? StoppedEarly : Failed;
}

std::string Line(const std::string& text)
{
  std::string line;
  for (std::size_t at = 0; at < text.size();)
  {
    const auto [code, size] = CharacterAt(text, at);
    if (size == 0)
    {
      line += Escape("\\udc%02lx", static_cast<unsigned char>(text[at]));
    }
    else if (code == '\n' || code == '\r' || code == '\t')
    {
      line += code == '\n' ? "\\n" : code == '\r' ? "\\r" : "\\t";
    }
    else if (IsUnseen(code))
    {
      line += Escape(code < 0x100 ? "\\x%02lx" : "\\u%04lx", code);
    }
    else
    {
      line += text.substr(at, size);
    }
    at += size == 0 ? 1 : size;
  }
  return line;
}

std::string Shortened(const std::string& text, std::size_t most)
{
  return text.size() <= most
           ? text
           : text.substr(0, most / 2) + " ... " + text.substr(text.size() - most / 2);
}

void SetLoudness(Loudness loudness)
{
  TheVoice().Shown = loudness;
}

bool IsQuiet()
{
  return TheVoice().Shown == Loudness::Quiet;
}

void Say(const std::string& text, Message kind)
{
  Voice& voice = TheVoice();
  const std::lock_guard<std::mutex> lock(voice.Speaking);
  Emit(voice, Line(text), kind);
}

void Warn(const std::string& text)
{
  Say("waft: warning: " + text, Message::Warning);
}

void Tell(const std::string& text)
{
  Voice& voice = TheVoice();
  const std::lock_guard<std::mutex> lock(voice.Speaking);
  const int failed = WriteAll(STDOUT_FILENO, text + "\n");
  if (failed != 0 && !voice.IsUntold)
  {
    voice.IsUntold = true;
    voice.IsUnread = failed == EPIPE;
    if (voice.IsUnread)
    {
      return;
    }
    Emit(voice, std::string("waft: stdout: could not be written: ") + std::strerror(failed),
         Message::Error);
  }
}

bool IsTold()
{
  return !TheVoice().IsUntold;
}

bool IsRead()
{
  return !TheVoice().IsUnread;
}

Result BeginLog(const std::string& path, const std::vector<std::string>& arguments)
{
  namespace fs = std::filesystem;
  std::error_code failure;
  const fs::path folder = fs::absolute(path, failure).parent_path();
  if (!fs::is_directory(folder, failure))
  {
    return Result::Error(path + ": expected a folder that is there");
  }
  const fs::file_status found = fs::symlink_status(path, failure);
  if (fs::is_directory(fs::status(path, failure)))
  {
    return Result::Error(path + ": expected the name of a file, found a folder");
  }
  if (fs::exists(found) && (!fs::is_regular_file(found) || !IsMarked(path)))
  {
    return Result::Error(path + ": Waft did not write it, or it was changed since, and stays as it "
                                "is: choose another name");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
  {
    return Result::Error(folder.string() + ": expected a folder that may be written in");
  }
  std::string words;
  for (const std::string& argument : arguments)
  {
    words += " " + Quoted(argument);
  }
  const Result written = WriteWholeFile(path, std::string("waft ") + WaftVersion + ": waft" +
                                                Shortened(Line(words)) + "\n");
  TheVoice().Log = Descriptor(::open(path.c_str(), O_RDWR | O_APPEND | O_NOFOLLOW | O_CLOEXEC));
  return !written || TheVoice().Log.IsOpen()
           ? written
           : Result::Error(path + ": could not be written: " + std::strerror(errno),
                           ErrorKind::Disk);
}

void EndLog(int status)
{
  Voice& voice = TheVoice();
  if (!voice.Log.IsOpen())
  {
    return;
  }
  Say("waft: ends with status " + std::to_string(status), Message::Record);
  const std::lock_guard<std::mutex> lock(voice.Speaking);
  std::string all;
  std::array<char, 65536> piece{};
  for (ssize_t size = 1; size > 0;)
  {
    size = ::pread(voice.Log.Get(), piece.data(), piece.size(), static_cast<off_t>(all.size()));
    all.append(piece.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  }
  WriteAll(voice.Log.Get(), MarkOf(all));
  voice.Log.Close();
}

} // namespace waft::command
