// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCheckedFiles.h"

#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/PictureFiles.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkCheckedFiles);

std::string vtkCheckedFiles::ReadSurface(const std::string& path, vtkPolyData* data)
{
  return waft::ReadPolyDataFile(path, data).Message();
}

std::string vtkCheckedFiles::ReadBlocks(const std::string& path, vtkMultiBlockDataSet* data)
{
  return waft::ReadBlocksFile(path, data).Message();
}

std::string vtkCheckedFiles::ReadImage(const std::string& path, vtkImageData* data)
{
  return waft::ReadImageFile(path, data).Message();
}

std::string vtkCheckedFiles::ReadPicture(const std::string& path, vtkImageData* data)
{
  return waft::ReadPictureFile(path, data).Message();
}

std::string vtkCheckedFiles::CheckBlocks(const std::string& path)
{
  return waft::CheckBlocksFile(path).Message();
}
