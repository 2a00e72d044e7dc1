// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkWindSource
 * @brief   a wind of the artist's, made by hand
 *
 * Output port 0, Wind (vtkImageData, time-varying): `Wind` [m/s^2], Strength along Direction at
 * Center, less beside it and before and after CenterTime as a bell is, or, as a front, along
 * Heading over Width behind an edge that travels; on a lattice over Bounds whose spacing is a
 * sixteenth of its width or half of Radius. The field data `Bounds`, `NumberOfFrames`,
 * `FramesPerSecond` describe the scene.
 */
#ifndef vtkWindSource_h
#define vtkWindSource_h

#include "WaftProperty.h"
#include "vtkImageAlgorithm.h"
#include "vtkWaftSourcesModule.h"

namespace waft
{
struct PassingForce;
struct SceneFrame;
struct WindSourceOptions;
}

class VTKWAFTSOURCES_EXPORT vtkWindSource : public vtkImageAlgorithm
{
public:
  static vtkWindSource* New();
  vtkTypeMacro(vtkWindSource, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftProperty(int, Kind);
  WaftVector(double, Direction, 3);
  WaftOpenProperty(double, Strength);
  WaftVector(double, Center, 3);
  WaftOpenProperty(double, Radius);
  WaftVector(double, Origin, 3);
  WaftVector(double, Heading, 3);
  WaftOpenProperty(double, Speed);
  WaftOpenProperty(double, Width);
  WaftProperty(int, StartFrame);
  WaftOpenProperty(double, CenterTime);
  WaftOpenProperty(double, Duration);
  WaftVector(double, Bounds, 6);
  WaftProperty(int, NumberOfFrames);
  WaftOpenProperty(double, FramesPerSecond);

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkWindSource();
  ~vtkWindSource() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkWindSource(const vtkWindSource&) = delete;
  void operator=(const vtkWindSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::WindSourceOptions;
  friend struct waft::PassingForce;
  friend struct waft::SceneFrame;
};

#endif
