// SPDX-License-Identifier: BSD-3-Clause
// Where Python finds the package waft.
#ifndef WaftPythonPath_h
#define WaftPythonPath_h

#include "vtkWaftProxiesModule.h"

/// When the plugin is loaded: puts the folder of the package waft that was installed with it on
/// Python's path, so that `import waft` works in ParaView's programs without a variable. It does
/// nothing where that folder is on the path of every Python, or where the package was not
/// installed.
VTKWAFTPROXIES_EXPORT void AddWaftPythonPath();

#endif
