// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCheckedFiles.h"

#include "Bridge/Data/ShapeData.h"
#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/DataWriting.h"
#include "Bridge/Files/PictureFiles.h"
#include "Bridge/Run/MakeDatabase.h"

#include <vtkDataObject.h>
#include <vtkObjectFactory.h>

#include <cstddef>

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

std::string vtkCheckedFiles::ReadSkin(vtkFieldData* fields, int shape, vtkImageData* data)
{
  return waft::ReadPng(waft::SkinOf(fields, static_cast<std::size_t>(shape)), data).Message();
}

std::string vtkCheckedFiles::Write(const std::string& path, vtkDataObject* data, bool packsWell)
{
  waft::DataFileForm form;
  form.PacksWell = packsWell;
  return waft::WriteDataFile(path, data, form).Message();
}

std::string vtkCheckedFiles::CheckDatabase(const std::string& path)
{
  return waft::CheckDatabase(path).Message();
}
