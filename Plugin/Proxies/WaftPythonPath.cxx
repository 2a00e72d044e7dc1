// SPDX-License-Identifier: BSD-3-Clause
#include "WaftPythonPath.h"

#include <vtkPythonInterpreter.h>

#include <dlfcn.h>

#include <filesystem>

namespace fs = std::filesystem;

void AddWaftPythonPath()
{
  Dl_info about{};
  if (dladdr(reinterpret_cast<const void*>(&AddWaftPythonPath), &about) == 0 || !about.dli_fname)
  {
    return;
  }
  std::error_code failure;
  const fs::path library = fs::weakly_canonical(about.dli_fname, failure);
  for (fs::path above = library.parent_path(); above.has_relative_path();
       above = above.parent_path())
  {
    const fs::path modules = above / WAFT_PYTHON_DIR;
    if (fs::is_regular_file(modules / "waft" / "__init__.py", failure))
    {
      // The folder of the distribution's own modules must not go before Python's.
      if (above != "/usr")
      {
        vtkPythonInterpreter::PrependPythonPath(modules.c_str());
      }
      return;
    }
  }
}
