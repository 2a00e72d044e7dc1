// SPDX-License-Identifier: BSD-3-Clause
// Prints the table of the chain: its stages, who gives what to whom, and which qualities run them.
#include "Chain/ChainTable.h"

#include <iostream>

int main()
{
  std::cout << waft::ChainTableAsJson();
  return 0;
}
