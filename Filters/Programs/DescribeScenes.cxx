// SPDX-License-Identifier: BSD-3-Clause
// Prints the JSON schema of scene files.
#include "Scene/SceneSchema.h"

#include <iostream>

int main()
{
  std::cout << waft::SceneSchemaText();
  return 0;
}
