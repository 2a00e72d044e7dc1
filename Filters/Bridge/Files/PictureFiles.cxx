// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/PictureFiles.h"

#include "Bridge/Files/FileReading.h"
#include "Files/FileBytes.h"
#include "Files/PictureFile.h"
#include "Files/PngFile.h"

#include <vtkBMPReader.h>
#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkTIFFReader.h>

namespace waft
{
namespace
{

// The last that is read, unless the reader had something to say.
Result Run(vtkImageReader2* reader, vtkImageData* image)
{
  WAFT_RETURN_IF_FAILED(RunReader(reader, ReaderWarnings::AreErrors));
  image->ShallowCopy(reader->GetOutput());
  return Result::Ok();
}

Result RunBytes(vtkImageReader2* reader, std::string_view bytes, vtkImageData* image)
{
  reader->SetMemoryBuffer(bytes.data());
  reader->SetMemoryBufferLength(static_cast<vtkIdType>(bytes.size()));
  return Run(reader, image);
}

Result RunFile(vtkImageReader2* reader, const std::string& path, vtkImageData* image)
{
  reader->SetFileName(path.c_str());
  return Run(reader, image);
}

} // namespace

bool IsPictureName(const std::string& path)
{
  const std::string extension = Extension(path);
  for (const char* known : { ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp" })
  {
    if (extension == known)
    {
      return true;
    }
  }
  return false;
}

Result ReadPictureFile(const std::string& path, vtkImageData* image)
{
  const std::string extension = Extension(path);
  if (!IsPictureName(path))
  {
    return Result::Error("expected a .png, .jpg, .jpeg, .tif, .tiff or .bmp picture, found " +
                         Quoted(extension));
  }
  FileBytes file;
  WAFT_RETURN_IF_FAILED(file.Open(path));
  if (extension == ".png")
  {
    std::string sound;
    WAFT_RETURN_IF_FAILED(SoundPng(file.View(), sound));
    return RunBytes(vtkNew<vtkPNGReader>(), sound, image);
  }
  if (extension == ".jpg" || extension == ".jpeg")
  {
    WAFT_RETURN_IF_FAILED(CheckJpeg(file.View()));
    // Of bytes in memory its library says on the console that they end.
    return RunFile(vtkNew<vtkJPEGReader>(), path, image);
  }
  if (extension == ".bmp")
  {
    WAFT_RETURN_IF_FAILED(CheckBmp(file.View()));
    return RunFile(vtkNew<vtkBMPReader>(), path, image);
  }
  WAFT_RETURN_IF_FAILED(CheckTiff(file.View()));
  return RunFile(vtkNew<vtkTIFFReader>(), path, image);
}

} // namespace waft
