// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/BlocksFile.h"

#include "Base/AtomicFile.h"
#include "Bridge/Files/DataWriting.h"
#include "Bridge/Files/SeriesFiles.h"

#include <vtkCompositeDataSet.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkXMLPolyDataWriter.h>

#include <filesystem>
#include <regex>

namespace waft
{

Result WriteBlocksFile(const std::string& path, vtkMultiBlockDataSet* data)
{
  // VTK's own writer of blocks ends the process where the disk is full; its head and field data are
  // those of a surface without any.
  vtkNew<vtkPolyData> bare;
  bare->SetFieldData(data->GetFieldData());
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(bare);
  writer->SetDataModeToBinary();
  writer->SetCompressionLevel(1); // as of all others
  writer->WriteToOutputStringOn();
  writer->Write();
  const std::string text = writer->GetOutputString();
  std::string head = text.substr(0, text.find("<PolyData>"));
  // Before version 1.0 blocks were named otherwise.
  head = std::regex_replace(head, std::regex("type=\"PolyData\" version=\"[^\"]*\""),
                            "type=\"vtkMultiBlockDataSet\" version=\"1.0\"");
  const std::size_t begin = text.find("<FieldData>");
  const std::string end = "</FieldData>";
  const std::string fields =
    begin == std::string::npos ? "" : text.substr(begin, text.find(end) + end.size() - begin);
  const std::filesystem::path place(path);
  std::filesystem::path folder = place;
  folder.replace_extension();
  std::error_code wrong;
  std::filesystem::create_directories(folder, wrong);
  if (wrong)
  {
    return Result::Error(folder.string() + ": could not be made: " + wrong.message());
  }
  std::string entries;
  const std::string stem = folder.filename().string();
  for (unsigned int index = 0; index < data->GetNumberOfBlocks(); ++index)
  {
    vtkDataObject* block = data->GetBlock(index);
    if (block == nullptr)
    {
      continue;
    }
    const std::string file = stem + "/" + stem + "_" + std::to_string(index) +
                             (vtkTable::SafeDownCast(block) != nullptr ? ".vtt" : ".vtp");
    const std::string own = (place.parent_path() / file).string();
    const Result written = WriteDataFile(own, block, {});
    if (!written)
    {
      return Result::Error(own + ": could not be written: " + written.Message());
    }
    const bool isNamed = data->HasMetaData(index) != 0 &&
                         data->GetMetaData(index)->Has(vtkCompositeDataSet::NAME()) != 0;
    const char* name = isNamed ? data->GetMetaData(index)->Get(vtkCompositeDataSet::NAME()) : "";
    entries += "    <DataSet index=\"" + std::to_string(index) + "\"" +
               (*name != '\0' ? " name=" + QuotedXml(name) : "") + " file=" + QuotedXml(file) +
               "/>\n";
  }
  return WriteWholeFile(path, head + "<vtkMultiBlockDataSet>\n" + entries +
                                "  </vtkMultiBlockDataSet>\n" + fields + "\n</VTKFile>\n");
}

} // namespace waft
