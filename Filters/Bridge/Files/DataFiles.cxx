// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/DataFiles.h"

#include "Bridge/Data/Arrays.h"
#include "Bridge/Files/FileReading.h"
#include "Bridge/Files/InlinedBlocks.h"
#include "Files/DataFileCheck.h"
#include "Files/FileBytes.h"
#include "Files/InlineData.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkCompositeDataIterator.h>
#include <vtkImageData.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLMultiBlockDataReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkZLibDataCompressor.h>

#include <string>

namespace waft
{
namespace
{

template <class Compressor>
vtkSmartPointer<vtkDataCompressor> Tool()
{
  return vtkSmartPointer<Compressor>::New();
}

// What the readers unpack with.
bool UnpackBlock(const std::string& compressor, const std::string& packed, std::string& bytes)
{
  const vtkSmartPointer<vtkDataCompressor> tool =
    compressor == "vtkZLibDataCompressor"  ? Tool<vtkZLibDataCompressor>()
    : compressor == "vtkLZ4DataCompressor" ? Tool<vtkLZ4DataCompressor>()
                                           : Tool<vtkLZMADataCompressor>();
  vtkNew<vtkCallbackCommand> silence;
  tool->AddObserver(vtkCommand::ErrorEvent, silence);
  return compressor == tool->GetClassName() &&
         tool->Uncompress(reinterpret_cast<const unsigned char*>(packed.data()), packed.size(),
                          reinterpret_cast<unsigned char*>(bytes.data()),
                          bytes.size()) == bytes.size();
}

// A file that CheckDataFile has found whole.
template <class Reader, class Data>
Result Read(const std::string& path, Data* data)
{
  FileBytes file;
  WAFT_RETURN_IF_FAILED(file.Open(path));
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  const std::string made = WithInlineData(file.View());
  if (!made.empty())
  {
    reader->ReadFromInputStringOn();
    reader->SetInputString(made);
  }
  WAFT_RETURN_IF_FAILED(RunReader(reader));
  data->ShallowCopy(reader->GetOutputDataObject(0));
  return Result::Ok();
}

template <class Reader, class Data>
Result ReadChecked(const std::string& path, const char* type, Data* data)
{
  WAFT_RETURN_IF_FAILED(CheckDataFile(path, { type }, UnpackBlock));
  return Read<Reader>(path, data);
}

} // namespace

Result ReadPolyDataFile(const std::string& path, vtkPolyData* data)
{
  WAFT_RETURN_IF_FAILED(ReadChecked<vtkXMLPolyDataReader>(path, "PolyData", data));
  return CheckCells(data, "surface");
}

Result ReadImageFile(const std::string& path, vtkImageData* data)
{
  return ReadChecked<vtkXMLImageDataReader>(path, "ImageData", data);
}

Result CheckBlocksFile(const std::string& path)
{
  return CheckDataFile(path, { "vtkMultiBlockDataSet" }, UnpackBlock);
}

Result ReadBlocksFile(const std::string& path, vtkMultiBlockDataSet* data)
{
  WAFT_RETURN_IF_FAILED(CheckBlocksFile(path));
  InlinedBlocks blocks;
  WAFT_RETURN_IF_FAILED(blocks.Make(path));
  WAFT_RETURN_IF_FAILED(Read<vtkXMLMultiBlockDataReader>(blocks.Path(), data));
  const auto leaves = vtkSmartPointer<vtkCompositeDataIterator>::Take(data->NewIterator());
  for (leaves->InitTraversal(); !leaves->IsDoneWithTraversal(); leaves->GoToNextItem())
  {
    auto* surface = vtkPolyData::SafeDownCast(leaves->GetCurrentDataObject());
    if (surface)
    {
      WAFT_RETURN_IF_FAILED(
        CheckCells(surface, "block " + std::to_string(leaves->GetCurrentFlatIndex() - 1)));
    }
  }
  return Result::Ok();
}

} // namespace waft
