// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMotionSceneFileWriter
 * @brief   ParaView's Save Data of a scene that vtkMotionSceneWriter gathered
 *
 * Input port 0 (vtkMultiBlockDataSet): the output of vtkMotionSceneWriter. Write() writes the scene
 * file and what goes beside it: all, or nothing and an error.
 */
#ifndef vtkMotionSceneFileWriter_h
#define vtkMotionSceneFileWriter_h

#include "WaftProperty.h"
#include "vtkWaftFiltersModule.h"
#include "vtkWriter.h"

#include <string>

namespace waft
{
struct SceneSaveOptions;
}

class VTKWAFTFILTERS_EXPORT vtkMotionSceneFileWriter : public vtkWriter
{
public:
  static vtkMotionSceneFileWriter* New();
  vtkTypeMacro(vtkMotionSceneFileWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftText(FileName);

protected:
  vtkMotionSceneFileWriter();
  ~vtkMotionSceneFileWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkMotionSceneFileWriter(const vtkMotionSceneFileWriter&) = delete;
  void operator=(const vtkMotionSceneFileWriter&) = delete;

  // Whose fields the properties are.
  friend struct waft::SceneSaveOptions;
};

#endif
