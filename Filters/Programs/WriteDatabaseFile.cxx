// SPDX-License-Identifier: BSD-3-Clause
// Writes a motion database of VTK's format as the file that Core reads.
//
//   WaftWriteDatabaseFile IN.vtm OUT.motions
#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Files/DataFiles.h"
#include "Trajectory/DatabaseFile.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <iostream>

using namespace waft;

namespace
{

Result Convert(const std::string& from, const std::string& to)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  MotionDatabase database;
  Result read = ReadBlocksFile(from, blocks);
  read = read ? DatabaseFromMultiBlock(blocks, database) : read;
  return read ? WriteDatabase(to, database) : Result::Error(from + ": " + read.Message());
}

} // namespace

int main(int count, char** words)
{
  if (count != 3)
  {
    std::cerr << "usage: " << words[0] << " IN.vtm OUT.motions\n";
    return 2;
  }
  const Result result = Convert(words[1], words[2]);
  if (!result)
  {
    std::cerr << result.Message() << "\n";
  }
  return result ? 0 : 1;
}
