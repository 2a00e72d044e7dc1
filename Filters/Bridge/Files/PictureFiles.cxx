// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/PictureFiles.h"

#include "Bridge/Files/FileReading.h"
#include "Files/FileBytes.h"
#include "Files/PictureFile.h"
#include "Files/PictureOrientation.h"
#include "Files/PngFile.h"
#include "Files/TiffFile.h"

#include <vtkBMPReader.h>
#include <vtkImageData.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <utility>

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

Result RunTiff(std::string_view bytes, vtkImageData* image)
{
  PictureBytes picture;
  WAFT_RETURN_IF_FAILED(ReadTiff(bytes, picture));
  image->Initialize();
  image->SetDimensions(picture.Width, picture.Height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, picture.Channels);
  const std::size_t row = static_cast<std::size_t>(picture.Width) * picture.Channels;
  for (int y = 0; y < picture.Height; ++y)
  {
    // The first row of the file is the top one, that of an image the lowest.
    std::copy_n(&picture.Values[row * static_cast<std::size_t>(y)], row,
                static_cast<unsigned char*>(image->GetScalarPointer(0, picture.Height - 1 - y, 0)));
  }
  return Result::Ok();
}

// Pixels of an image moved to where an orientation (Files/PictureOrientation.h) has them.
void Turn(int orientation, vtkImageData* image)
{
  const int width = image->GetDimensions()[0];
  const int height = image->GetDimensions()[1];
  const bool isExchanged = orientation >= 5; // rows and columns
  const bool isMirrored =
    orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool isUpsideDown =
    orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  vtkNew<vtkImageData> turned;
  turned->SetDimensions(isExchanged ? height : width, isExchanged ? width : height, 1);
  turned->AllocateScalars(image->GetScalarType(), image->GetNumberOfScalarComponents());
  vtkDataArray* from = image->GetPointData()->GetScalars();
  vtkDataArray* to = turned->GetPointData()->GetScalars();
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      // Column and row of the file, whose first row is the top one, as they are seen.
      std::pair<int, int> seen(x, height - 1 - y);
      if (isExchanged)
      {
        std::swap(seen.first, seen.second);
      }
      const int* size = turned->GetDimensions();
      seen.first = isMirrored ? size[0] - 1 - seen.first : seen.first;
      seen.second = isUpsideDown ? size[1] - 1 - seen.second : seen.second;
      to->SetTuple(static_cast<vtkIdType>(size[1] - 1 - seen.second) * size[0] + seen.first,
                   static_cast<vtkIdType>(y) * width + x, from);
    }
  }
  image->ShallowCopy(turned);
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
    return ReadPng(file.View(), image);
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
  return RunTiff(file.View(), image);
}

Result ReadPng(std::string_view bytes, vtkImageData* image)
{
  std::string sound;
  WAFT_RETURN_IF_FAILED(SoundPng(bytes, sound));
  return RunBytes(vtkNew<vtkPNGReader>(), sound, image);
}

Result ReadUprightPicture(const std::string& path, vtkImageData* image)
{
  WAFT_RETURN_IF_FAILED(ReadPictureFile(path, image));
  FileBytes file;
  WAFT_RETURN_IF_FAILED(file.Open(path));
  const int orientation = PictureOrientation(file.View());
  if (orientation != 1)
  {
    Turn(orientation, image);
  }
  return Result::Ok();
}

} // namespace waft
