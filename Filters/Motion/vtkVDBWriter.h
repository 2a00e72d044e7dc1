// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVDBWriter
 * @brief   writes smoke, wind or any image as OpenVDB files for other programs, a file a frame
 *
 * Input port 0 (vtkImageData, may vary in time): each point data array of one or three components
 * becomes a grid of its name, in metres, z up. Output port 0: the input, unchanged.
 *
 * Executing the stage writes all time steps, once for each change: smoke.vdb gives smoke_0000.vdb
 * and so on, the frame by the scene's frames per second, else by counting; an input without time
 * gives smoke.vdb itself. Each file is whole or not there. Stopped half way, the files of the
 * frames before stay. Without a FileName nothing is written.
 */
#ifndef vtkVDBWriter_h
#define vtkVDBWriter_h

#include "WaftProperty.h"
#include "vtkImageAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>
#include <string>

namespace waft
{
struct VolumeWriteOptions;
}

class VTKWAFTFILTERS_EXPORT vtkVDBWriter : public vtkImageAlgorithm
{
public:
  static vtkVDBWriter* New();
  vtkTypeMacro(vtkVDBWriter, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftText(FileName);

  /** Writes now, even when nothing changed. False when a file could not be written (the error was
   * reported) or it was stopped. */
  bool Write();

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkVDBWriter();
  ~vtkVDBWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkVDBWriter(const vtkVDBWriter&) = delete;
  void operator=(const vtkVDBWriter&) = delete;

  // Whose fields the properties are.
  friend struct waft::VolumeWriteOptions;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
