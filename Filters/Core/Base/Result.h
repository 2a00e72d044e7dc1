// SPDX-License-Identifier: BSD-3-Clause
// The one error contract of Core: a Result, never an exception across a library's boundary.
#pragma once

#include "Base/MessageText.h"

#include <string>

namespace waft
{

/// Success, or a sentence that names the place (file, row, array, object) and what was expected.
class [[nodiscard]] Result
{
public:
  static Result Ok() { return {}; }
  /// The message is made valid UTF-8 of less than 2 kB, whatever it quotes.
  static Result Error(const std::string& message)
  {
    Result result;
    result.Failed = true;
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

private:
  bool Failed = false;
  bool WasStopped = false;
  std::string Text;
};

} // namespace waft

/// Returns the Result of a call from the function around it when the call failed.
#define WAFT_RETURN_IF_FAILED(call)                                                                \
  if (::waft::Result waftStep = (call); !waftStep)                                                 \
  {                                                                                                \
    return waftStep;                                                                               \
  }
