// SPDX-License-Identifier: BSD-3-Clause
// Parameters as text, for what a data set says about its making.
#pragma once

#include <locale>
#include <sstream>
#include <string>

namespace waft
{

/// Values with a blank between them; numbers with 17 significant digits, in the same form under
/// every user's language.
template <class... Values>
std::string ParameterText(const Values&... values)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  const char* gap = "";
  ((text << gap << values, gap = " "), ...);
  return text.str();
}

} // namespace waft
