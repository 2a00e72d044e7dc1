// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSceneDrawings
 * @brief   the texts and pictures that the keyframes of a scene file draw, for scripts
 *
 * `drawings` gets a block (vtkImageData) for each, one pixel deep: point data `Weight` (float, how
 * much of a pixel is drawn), spacing in metres, the picture's middle at its own origin of
 * coordinates; field data `Row` (int, the keyframe's place in the scene's list), `Origin`, `U`, `V`
 * (double[3]: where that middle is [m], the unit directions of width and height). Targets that are
 * points or of a mesh draw none. Gives what is wrong with the file, or an empty text; `drawings`
 * stays as it was then.
 */
#ifndef vtkSceneDrawings_h
#define vtkSceneDrawings_h

#include "vtkObject.h"
#include "vtkWaftSourcesModule.h"

#include <string>

class vtkMultiBlockDataSet;

class VTKWAFTSOURCES_EXPORT vtkSceneDrawings : public vtkObject
{
public:
  static vtkSceneDrawings* New();
  vtkTypeMacro(vtkSceneDrawings, vtkObject);

  static std::string Read(const std::string& fileName, vtkMultiBlockDataSet* drawings);

protected:
  vtkSceneDrawings() = default;
  ~vtkSceneDrawings() override = default;

private:
  vtkSceneDrawings(const vtkSceneDrawings&) = delete;
  void operator=(const vtkSceneDrawings&) = delete;
};

#endif
