// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCheckedFiles
 * @brief   files for scripts, read as the scene reader reads those that a scene names, and written
 *
 * Those that are read are looked at before VTK's readers see them, which trust counts, indices and
 * chunks. Each function gives what is wrong, with the place in the file, or an empty text; nothing
 * goes to the console, and `data` stays as it was on failure.
 */
#ifndef vtkCheckedFiles_h
#define vtkCheckedFiles_h

#include "vtkObject.h"
#include "vtkWaftSourcesModule.h"

#include <string>

class vtkDataObject;
class vtkFieldData;
class vtkImageData;
class vtkMultiBlockDataSet;
class vtkPolyData;

class VTKWAFTSOURCES_EXPORT vtkCheckedFiles : public vtkObject
{
public:
  static vtkCheckedFiles* New();
  vtkTypeMacro(vtkCheckedFiles, vtkObject);

  /** A .vtp of cells whose points are there. */
  static std::string ReadSurface(const std::string& path, vtkPolyData* data);
  /** A .vtm of surfaces and tables. */
  static std::string ReadBlocks(const std::string& path, vtkMultiBlockDataSet* data);
  /** A .vti. */
  static std::string ReadImage(const std::string& path, vtkImageData* data);
  /** A .png, .jpg, .tif or .bmp of at most 2^26 pixels. */
  static std::string ReadPicture(const std::string& path, vtkImageData* data);
  /** The skin that a shape has in memory, of field data as shapes and meshes have them. */
  static std::string ReadSkin(vtkFieldData* fields, int shape, vtkImageData* data);
  /** A .vtp, .vti or .vtt, piece by piece: see Bridge/Files/DataWriting.h. */
  static std::string Write(const std::string& path, vtkDataObject* data, bool packsWell);
  /** Whether a .vtm is a motion database by its structure; one that is being replaced is waited for
   * (Bridge/Run/MakeDatabase.h). */
  static std::string CheckDatabase(const std::string& path);

protected:
  vtkCheckedFiles() = default;
  ~vtkCheckedFiles() override = default;

private:
  vtkCheckedFiles(const vtkCheckedFiles&) = delete;
  void operator=(const vtkCheckedFiles&) = delete;
};

#endif
