// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML files with their values within the elements. VTK 9.1 cannot read values that follow
// the elements ("appended") with Expat 2.6, nor with the fixes of Expat 2.5 that Debian 12 has.
#pragma once

#include <string>
#include <string_view>

namespace waft
{

/// The text of a file that CheckDataFile has found whole, its appended values put into the elements
/// that they belong to, in base64. Empty: none are appended.
std::string WithInlineData(std::string_view text);

} // namespace waft
