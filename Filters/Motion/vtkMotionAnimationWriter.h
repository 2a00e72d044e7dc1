// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMotionAnimationWriter
 * @brief   writes poses as an animation for other programs: .glb or .csv
 *
 * Input port 0, Poses (vtkPolyData): Tracks with `Orientation`.
 * Input port 1, Objects (vtkPolyData): `ObjectId`, `ShapeId`.
 * Input port 2, Shapes (vtkMultiBlockDataSet): meshes, textures, colours.
 * Input port 3, Constraints (vtkPolyData, optional): whose frames have exact keys in any case.
 * Output port 0: the poses, unchanged.
 *
 * FileName ending in .glb: binary glTF 2.0, one mesh a shape, one animated node an object, turned
 * to y up, textures embedded. Ending in .csv: object, frame, time, position, orientation, velocity
 * and angular velocity, 17 significant digits. With Constraints a .glb of more than 100,000 poses
 * is written without keys that those beside them give back; without them it has all, since nobody
 * says which frames matter. The file is whole or not there. Executing the stage writes it, once for
 * each change; without a FileName nothing is written. A texture that cannot be read is warned
 * about, and its shape is written in its colour.
 */
#ifndef vtkMotionAnimationWriter_h
#define vtkMotionAnimationWriter_h

#include "WaftProperty.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>
#include <string>

namespace waft
{
struct AnimationOptions;
}

class VTKWAFTFILTERS_EXPORT vtkMotionAnimationWriter : public vtkPolyDataAlgorithm
{
public:
  static vtkMotionAnimationWriter* New();
  vtkTypeMacro(vtkMotionAnimationWriter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Takes the optional input away. */
  void RemoveAllConstraints() { this->SetInputConnection(3, nullptr); }

  WaftText(FileName);

  /** Writes now, even when nothing changed. False when the file could not be written (the error was
   * reported). */
  bool Write();

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkMotionAnimationWriter();
  ~vtkMotionAnimationWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkMotionAnimationWriter(const vtkMotionAnimationWriter&) = delete;
  void operator=(const vtkMotionAnimationWriter&) = delete;

  // Whose fields the properties are.
  friend struct waft::AnimationOptions;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
