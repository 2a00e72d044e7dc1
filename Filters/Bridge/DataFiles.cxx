// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/DataFiles.h"

#include "Bridge/FileReading.h"
#include "Files/DataFileCheck.h"

#include <vtkCellArray.h>
#include <vtkCompositeDataIterator.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPolyDataReader.h>

namespace waft
{
namespace
{

template <class Reader, class Data>
Result ReadChecked(const std::string& path, const char* type, Data* data)
{
  WAFT_RETURN_IF_FAILED(CheckDataFile(path, { type }));
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  WAFT_RETURN_IF_FAILED(RunReader(reader));
  data->ShallowCopy(reader->GetOutputDataObject(0));
  return Result::Ok();
}

} // namespace

Result CheckCellPoints(vtkPolyData* data)
{
  const vtkIdType points = data->GetNumberOfPoints();
  vtkNew<vtkIdList> ids;
  for (vtkCellArray* cells :
       { data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips() })
  {
    for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
    {
      cells->GetCellAtId(cell, ids);
      for (const vtkIdType id : *ids)
      {
        if (id < 0 || id >= points)
        {
          return Result::Error("cell " + std::to_string(cell) + ": expected indices of " +
                               std::to_string(points) + " points, found " + std::to_string(id));
        }
      }
    }
  }
  return Result::Ok();
}

Result ReadPolyDataFile(const std::string& path, vtkPolyData* data)
{
  WAFT_RETURN_IF_FAILED(ReadChecked<vtkXMLPolyDataReader>(path, "PolyData", data));
  return CheckCellPoints(data);
}

Result ReadImageFile(const std::string& path, vtkImageData* data)
{
  return ReadChecked<vtkXMLImageDataReader>(path, "ImageData", data);
}

Result ReadBlocksFile(const std::string& path, vtkMultiBlockDataSet* data)
{
  WAFT_RETURN_IF_FAILED(
    ReadChecked<vtkXMLMultiBlockDataReader>(path, "vtkMultiBlockDataSet", data));
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(data->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    auto* surface = vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject());
    const Result checked = surface ? CheckCellPoints(surface) : Result::Ok();
    if (!checked)
    {
      return Result::Error("block " + std::to_string(leaves->GetCurrentFlatIndex() - 1) + ": " +
                           checked.Message());
    }
  }
  return Result::Ok();
}

} // namespace waft
