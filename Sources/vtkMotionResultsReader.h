// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMotionResultsReader
 * @brief   reads the folder of a finished flight; nothing is flown again
 *
 * The file is the folder's report.json. Output ports:
 *  - 0 Meshes, 1 Poses: all bodies as they are turned (vtkRotationRefineFilter); the first varies
 *    in time.
 *  - 2 Obstacles, 3 Objects, 4 Marks: as vtkMotionAnimationSource gives them; the first may vary in
 *    time, the last say by `Status` what became of them.
 *
 * What the folder's files name is not followed out of it. An error's text names the file, and all
 * outputs are then empty.
 */
#ifndef vtkMotionResultsReader_h
#define vtkMotionResultsReader_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <memory>
#include <string>

class VTKWAFTSOURCES_EXPORT vtkMotionResultsReader : public vtkPolyDataAlgorithm
{
public:
  static vtkMotionResultsReader* New();
  vtkTypeMacro(vtkMotionResultsReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Ports
  {
    MESHES,
    POSES,
    OBSTACLES,
    OBJECTS,
    MARKS
  };

  ///@{
  /** The report.json of the folder. Setting it reads the folder anew, also under the same name. */
  void SetFileName(const std::string& name);
  vtkGetMacro(FileName, std::string);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkMotionResultsReader();
  ~vtkMotionResultsReader() override;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkMotionResultsReader(const vtkMotionResultsReader&) = delete;
  void operator=(const vtkMotionResultsReader&) = delete;

  struct Contents;
  std::unique_ptr<Contents> Read;
  std::string FileName;
};

#endif
