// SPDX-License-Identifier: BSD-3-Clause
// The one error contract of Core: a Result, never an exception across a library's boundary.
#pragma once

#include "Base/MessageText.h"

#include <string>

namespace waft
{

/// Whose fault a failure is.
enum class ErrorKind
{
  Input,  // a file, a value, or what was asked for: nothing was done
  Memory, // there is too little of it
  Disk,   // a file could not be written
  Stopped // before there was anything worth keeping
};

/// "input", "memory", "disk", "stopped".
inline const char* ToString(ErrorKind kind)
{
  constexpr const char* words[] = { "input", "memory", "disk", "stopped" };
  return words[static_cast<int>(kind)];
}

/// Success, or a sentence that names the place (file, row, array, object) and what was expected.
class [[nodiscard]] Result
{
public:
  static Result Ok() { return {}; }
  /// The message is made valid UTF-8 of less than 2 kB, whatever it quotes.
  static Result Error(const std::string& message, ErrorKind kind = ErrorKind::Input)
  {
    Result result;
    result.Failed = true;
    result.Fault = kind;
    result.Text = MessageText(message);
    return result;
  }
  /// The caller's Monitor asked to stop; outputs hold the best result so far where that has a
  /// meaning.
  static Result Stopped()
  {
    Result result;
    result.WasStopped = true;
    return result;
  }

  explicit operator bool() const { return !this->Failed; }
  bool IsStopped() const { return this->WasStopped; }
  const std::string& Message() const { return this->Text; }
  /// Of a failure.
  ErrorKind Kind() const { return this->Fault; }

private:
  bool Failed = false;
  bool WasStopped = false;
  ErrorKind Fault = ErrorKind::Input;
  std::string Text;
};

} // namespace waft

/// Returns the Result of a call from the function around it when the call failed.
#define WAFT_RETURN_IF_FAILED(call)                                                                \
  if (::waft::Result waftStep = (call); !waftStep)                                                 \
  {                                                                                                \
    return waftStep;                                                                               \
  }
