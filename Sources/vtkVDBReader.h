// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVDBReader
 * @brief   reads smoke and wind from OpenVDB files, a file a frame
 *
 * Output port 0 (vtkImageData, time-varying): one float array a grid of numbers or vectors, on the
 * lattice of the first vector grid, over the active voxels of all files. Grids named vel or v are
 * called `Velocity`, so that the image may serve as `Wind` of other stages. Field data of a scene,
 * as the files record it, else from the lattice.
 *
 * A FileName whose stem ends in digits stands for all files of its folder that differ in these
 * digits alone; they are the frame. Grids on another lattice are left out with a warning. A turned
 * grid, a file that cannot be read or one without such grids is an error that names it.
 */
#ifndef vtkVDBReader_h
#define vtkVDBReader_h

#include "WaftProperty.h"
#include "vtkImageAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <memory>
#include <string>

namespace waft
{
struct VolumeReadOptions;
}

class VTKWAFTSOURCES_EXPORT vtkVDBReader : public vtkImageAlgorithm
{
public:
  static vtkVDBReader* New();
  vtkTypeMacro(vtkVDBReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Any file of the series; setting it reads the series anew. */
  void SetFileName(const std::string& name);
  vtkGetMacro(FileName, std::string);
  ///@}

  WaftProperty(double, FramesPerSecond);

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkVDBReader();
  ~vtkVDBReader() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkVDBReader(const vtkVDBReader&) = delete;
  void operator=(const vtkVDBReader&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::VolumeReadOptions;
  std::string FileName;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
