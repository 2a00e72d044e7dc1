// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVortexSource
 * @brief   a vortex of the artist's, made by hand
 *
 * Output port 0, Vortices (vtkPolyData): one line from pole to pole. Air turns round it with the
 * acceleration of Shi et al. 2005, Eq. 13, with a core, and a bell over time. Append several of
 * these for several vortices, each with a VortexId of its own. The field data `Bounds`,
 * `NumberOfFrames`, `FramesPerSecond` describe the scene.
 */
#ifndef vtkVortexSource_h
#define vtkVortexSource_h

#include "WaftProperty.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftSourcesModule.h"

namespace waft
{
struct PassingForce;
struct SceneFrame;
struct VortexSourceOptions;
}

class VTKWAFTSOURCES_EXPORT vtkVortexSource : public vtkPolyDataAlgorithm
{
public:
  static vtkVortexSource* New();
  vtkTypeMacro(vtkVortexSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftProperty(int, VortexId);
  WaftVector(double, P1, 3);
  WaftVector(double, P2, 3);
  WaftOpenProperty(double, Strength);
  WaftOpenProperty(double, CoreRadius);
  WaftOpenProperty(double, CenterTime);
  WaftOpenProperty(double, Duration);
  WaftVector(double, Bounds, 6);
  WaftProperty(int, NumberOfFrames);
  WaftOpenProperty(double, FramesPerSecond);

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkVortexSource();
  ~vtkVortexSource() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkVortexSource(const vtkVortexSource&) = delete;
  void operator=(const vtkVortexSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::VortexSourceOptions;
  friend struct waft::PassingForce;
  friend struct waft::SceneFrame;
};

#endif
