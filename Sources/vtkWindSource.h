// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkWindSource
 * @brief   a wind of the artist's, made by hand
 *
 * Output port 0, Wind (vtkImageData, time-varying): `Wind` [m/s^2], Strength along Direction at
 * Center, less beside it and before and after CenterTime as a bell is; on a lattice over Bounds
 * whose spacing is a sixteenth of its width or half of Radius. The field data `Bounds`,
 * `NumberOfFrames`, `FramesPerSecond` describe the scene.
 */
#ifndef vtkWindSource_h
#define vtkWindSource_h

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

  ///@{
  /** Where the wind blows; its length does not matter. */
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  ///@}
  ///@{
  /** Acceleration of the air at the centre [m/s^2]. */
  vtkSetMacro(Strength, double);
  vtkGetMacro(Strength, double);
  ///@}
  ///@{
  /** Where the wind is strongest [m]. */
  vtkSetVector3Macro(Center, double);
  vtkGetVector3Macro(Center, double);
  ///@}
  ///@{
  /** Standard deviation of its strength about the centre [m], more than 0. */
  vtkSetMacro(Radius, double);
  vtkGetMacro(Radius, double);
  ///@}
  ///@{
  /** When it is strongest [s]. */
  vtkSetMacro(CenterTime, double);
  vtkGetMacro(CenterTime, double);
  ///@}
  ///@{
  /** Standard deviation of its strength over time [s], more than 0. */
  vtkSetMacro(Duration, double);
  vtkGetMacro(Duration, double);
  ///@}
  ///@{
  /** The volume (xmin, xmax, ymin, ymax, zmin, zmax) [m]. */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}
  ///@{
  /** Frames of the scene, 1 or more. */
  vtkSetClampMacro(NumberOfFrames, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfFrames, int);
  ///@}
  ///@{
  /** Frames per second, more than 0. */
  vtkSetMacro(FramesPerSecond, double);
  vtkGetMacro(FramesPerSecond, double);
  ///@}

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

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::WindSourceOptions;
  friend struct waft::PassingForce;
  friend struct waft::SceneFrame;
  double Direction[3] = { 1.0, 0.0, 0.0 };
  double Strength = 1.0;
  double Center[3] = { 0.0, 0.0, 2.0 };
  double Radius = 1.0;
  double CenterTime = 5.0;
  double Duration = 3.0;
  double Bounds[6] = { -2.0, 2.0, -2.0, 2.0, 0.0, 4.0 };
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;
};

#endif
