// SPDX-License-Identifier: BSD-3-Clause
// What the command says while it works: how much of it is shown, and the log that has all of it.
#pragma once

#include "Base/Result.h"

#include <string>
#include <vector>

namespace waft::command
{

/// Exit statuses.
enum Status
{
  AllMet = 0,
  Failed = 1,
  Malformed = 2,
  NotAllMet = 3,
  StoppedEarly = 4
};
Status StatusOf(ErrorKind kind);

enum class Loudness
{
  Quiet,
  Normal,
  Verbose
};

enum class Message
{
  Error,
  Warning,
  Note,
  Detail, // is shown where more is asked for
  Record  // stands in the log alone
};

/// A text as one line that looks like what it is: what cannot be seen is written as an escape, such
/// as \n or \u202e, and a byte that is no UTF-8 as \udc80 to \udcff.
std::string Line(const std::string& text);
/// A text without its middle where it is longer than most bytes.
std::string Shortened(const std::string& text, std::size_t most = 1800);

void SetLoudness(Loudness loudness);
bool IsQuiet();
/// A line on stderr, and in the log. The work matters more than what is said of it: what cannot be
/// written is lost.
void Say(const std::string& text, Message kind = Message::Note);
void Warn(const std::string& text);
/// A line on stdout, and in the log.
void Tell(const std::string& text);
/// False where something of stdout is lost, which was said; unless nobody reads it any more.
bool IsTold();
bool IsRead();

/// Begins a log: a line that names the version and the command line. One that is whole by its
/// digest makes room; fails where anything else is there.
Result BeginLog(const std::string& path, const std::vector<std::string>& arguments);
/// The exit status, and the digest of the log.
void EndLog(int status);

} // namespace waft::command
