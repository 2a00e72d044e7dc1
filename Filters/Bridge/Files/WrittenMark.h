// SPDX-License-Identifier: BSD-3-Clause
// How a writer knows its own files again, so that it replaces no others.
#pragma once

#include <string>

namespace waft
{

/// A comment to put at the end of an XML file of these bytes, with a digest of them.
std::string WrittenMark(const std::string& bytes);

/// Whether a file ends with the mark of what it has before that: nobody changed it since.
bool IsMarkedAsWritten(const std::string& path);

} // namespace waft
