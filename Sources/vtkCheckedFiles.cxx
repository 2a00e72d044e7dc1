// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCheckedFiles.h"

#include "Bridge/Data/ShapeData.h"
#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/DataWriting.h"
#include "Bridge/Files/PictureFiles.h"
#include "Bridge/Pipeline/StageExecution.h"

#include <vtkCollection.h>
#include <vtkDataObject.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <vector>

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

std::string vtkCheckedFiles::WriteTogether(vtkStringArray* paths, vtkCollection* data,
                                           bool packsWell)
{
  const auto count = static_cast<std::size_t>(paths->GetNumberOfValues());
  std::vector<vtkDataObject*> each(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    each[i] = vtkDataObject::SafeDownCast(data->GetItemAsObject(static_cast<int>(i)));
  }
  waft::DataFileForm form;
  form.PacksWell = packsWell;
  std::vector<std::string> lacks(count);
  waft::SmpFor()(count,
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t i = begin; i < end; ++i)
                   {
                     lacks[i] = each[i] == nullptr
                                  ? "expected data, found none"
                                  : waft::WriteDataFile(paths->GetValue(static_cast<vtkIdType>(i)),
                                                        each[i], form)
                                      .Message();
                   }
                 });
  const auto found =
    std::find_if(lacks.begin(), lacks.end(), [](const std::string& lack) { return !lack.empty(); });
  return found == lacks.end() ? std::string()
                              : std::string(paths->GetValue(found - lacks.begin())) +
                                  ": could not be written: " + *found;
}

int vtkCheckedFiles::GetNumberOfThreads()
{
  waft::SmpFor(); // chooses the backend
  return vtkSMPTools::GetEstimatedNumberOfThreads() * waft::ProcessesHere();
}

std::string vtkCheckedFiles::WriteRounded(const std::string& path, vtkDataObject* data,
                                          const std::string& exact)
{
  waft::DataFileForm form;
  form.IsRounded = true;
  std::istringstream names(exact);
  for (std::string name; names >> name;)
  {
    form.Exact.insert(name);
  }
  return waft::WriteDataFile(path, data, form).Message();
}

std::string vtkCheckedFiles::CheckBlocks(const std::string& path)
{
  return waft::CheckBlocksFile(path).Message();
}
