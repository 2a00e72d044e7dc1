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

  ///@{
  /** The number of the vortex, 0 or more; different in each of those that are appended. */
  vtkSetClampMacro(VortexId, int, 0, VTK_INT_MAX);
  vtkGetMacro(VortexId, int);
  ///@}
  ///@{
  /** One end of the axis [m]. */
  vtkSetVector3Macro(P1, double);
  vtkGetVector3Macro(P1, double);
  ///@}
  ///@{
  /** The other end [m]: the air turns as the fingers of a right hand that points there. */
  vtkSetVector3Macro(P2, double);
  vtkGetVector3Macro(P2, double);
  ///@}
  ///@{
  /** How hard it turns the air [m^2/s^2]; below 0 the other way. */
  vtkSetMacro(Strength, double);
  vtkGetMacro(Strength, double);
  ///@}
  ///@{
  /** Where the acceleration is largest [m from the axis], more than 0. */
  vtkSetMacro(CoreRadius, double);
  vtkGetMacro(CoreRadius, double);
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
  vtkVortexSource();
  ~vtkVortexSource() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkVortexSource(const vtkVortexSource&) = delete;
  void operator=(const vtkVortexSource&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::VortexSourceOptions;
  friend struct waft::PassingForce;
  friend struct waft::SceneFrame;
  int VortexId = 0;
  double P1[3] = { 0.0, 0.0, 0.5 };
  double P2[3] = { 0.0, 0.0, 3.5 };
  double Strength = 2.0;
  double CoreRadius = 0.3;
  double CenterTime = 5.0;
  double Duration = 3.0;
  double Bounds[6] = { -2.0, 2.0, -2.0, 2.0, 0.0, 4.0 };
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;
};

#endif
