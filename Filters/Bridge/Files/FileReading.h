// SPDX-License-Identifier: BSD-3-Clause
// Running VTK's readers of files.
#pragma once

#include "Base/Result.h"

#include <string>

class vtkAlgorithm;

namespace waft
{

/// The extension in small letters with its dot.
std::string Extension(const std::string& path);

/// A message of VTK on one line: without its place in VTK's code and addresses, printable, of at
/// most 500 bytes.
std::string PlainMessage(const std::string& message);

enum class ReaderWarnings
{
  AreLeftOut,
  AreErrors // of a reader that makes up what is missing, and warns
};

/// Updates a reader; its error text, or that of its executive, parser or an exception, becomes the
/// message instead of going to the console. Warnings do not go there, either.
Result RunReader(vtkAlgorithm* reader, ReaderWarnings warnings = ReaderWarnings::AreLeftOut);

} // namespace waft
