// SPDX-License-Identifier: BSD-3-Clause
// The programs that are the command: that which has VTK, and the package for Python that was
// installed with it, by the interpreter of the build, whatever the shell has for another.
#pragma once

#include <string>
#include <vector>

namespace waft::command
{

/// SIGINT, SIGTERM and SIGUSR1 (what launchers and batch systems hand on) wait from here on, also
/// for the program that takes the place of this one.
void HoldStops();

/// Why the package is not that of this program; an empty text where it is.
std::string CheckPackage();

// Each takes the place of this process and carries a command line out; returns only where it
// cannot, with the reason.
std::string BecomeOwn(const std::vector<std::string>& arguments);
std::string BecomePython(const std::vector<std::string>& arguments);

/// What a command line says on stdout, of a process of its own; the reason where it cannot be run,
/// else an empty text.
std::string AskPython(const std::vector<std::string>& arguments, std::string& answer);

} // namespace waft::command
