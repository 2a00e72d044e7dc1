// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMotionSceneWriter
 * @brief   keeps a scene in a file (*.waft.json)
 *
 * Input port 0, Objects (vtkPolyData): one vertex an object; its field data give the volume, the
 * frames, the air and the seed.
 * Input port 1, Constraints (vtkPolyData, optional): one vertex a row.
 * Input port 2, Obstacles (vtkPolyData, optional, may move): surfaces with `ObstacleId`.
 * Input port 3, Shapes (vtkMultiBlockDataSet, optional): the bodies. Without any, objects of
 * `ShapeId` 0 are written as discs.
 * Input port 4, Vortices (vtkPolyData, optional): one line a vortex.
 * Input port 5, Wind (vtkImageData, optional, may vary in time): `Wind` or `Velocity`.
 * Output port 0, Scene (vtkMultiBlockDataSet): all of it over all its time, as
 * vtkMotionSceneFileWriter takes it.
 *
 * What sources made by hand, or vtkMotionSceneReader read, edited or not, reads back from the file
 * the same, number by number; the format is in Documentation/SceneFiles.md, with what it does not
 * keep. Inputs (of Shapes each block) that carry the field data `Authored` (text, from
 * vtkMotionSceneReader) are written in the artist's own words, entry by entry, as far as these
 * still make the data; edits win. Meshes without words and edited winds go into files beside the
 * scene's. A file there that the writer did not make as it is stays, and others are named; a
 * warning says so. All files are written, or none: upon an error, which names the object, row,
 * shape or obstacle, what stood there before is untouched.
 * Executing the stage writes, once for each change; without a FileName nothing is written.
 */
#ifndef vtkMotionSceneWriter_h
#define vtkMotionSceneWriter_h

#include "WaftProperty.h"
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>
#include <string>

namespace waft
{
struct SceneWriteOptions;
}

class VTKWAFTFILTERS_EXPORT vtkMotionSceneWriter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkMotionSceneWriter* New();
  vtkTypeMacro(vtkMotionSceneWriter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftText(FileName);
  WaftText(Title);

  /** Writes now, even when nothing changed. False when the file could not be written (the error was
   * reported). */
  bool Write();

  ///@{
  /// Take an optional input away.
  void RemoveAllConstraints() { this->SetInputConnection(1, nullptr); }
  void RemoveAllObstacles() { this->SetInputConnection(2, nullptr); }
  void RemoveAllShapes() { this->SetInputConnection(3, nullptr); }
  void RemoveAllVortices() { this->SetInputConnection(4, nullptr); }
  void RemoveAllWind() { this->SetInputConnection(5, nullptr); }
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkMotionSceneWriter();
  ~vtkMotionSceneWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkMotionSceneWriter(const vtkMotionSceneWriter&) = delete;
  void operator=(const vtkMotionSceneWriter&) = delete;

  // Whose fields the properties are.
  friend struct waft::SceneWriteOptions;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
