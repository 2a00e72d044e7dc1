// SPDX-License-Identifier: BSD-3-Clause
// How a writer knows its own files again, so that it replaces no others.
#pragma once

#include <string>

namespace waft
{

/// A comment to put at the end of an XML file of these bytes, with a digest of them.
std::string WrittenMark(const std::string& bytes);

/// The bytes of a PNG file with a text in it, with a digest of the others.
std::string MarkedPng(const std::string& png);

/// Whether a file has the mark of all else in it: nobody changed it since it was written.
bool IsMarkedAsWritten(const std::string& path);

} // namespace waft
