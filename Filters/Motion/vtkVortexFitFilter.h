// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVortexFitFilter
 * @brief   fits spacetime vortices to the accelerations of objects
 *
 * Input port 0, Input (vtkPolyData): Tracks with the point data `Force` [m/s^2, vortex plus wind];
 * `ForceType` and `VortexId` say which vortex claims a point, `WindAcceleration` is taken off first
 * when SubtractWind is on.
 * With Quantity AirAcceleration the point data `AirVelocity` take the place of these, and the field
 * data `Explained` and `ExplainedLeftOut` of output port 0 say how much of it the vortices explain,
 * of all tracks and of every fifth by a fit that did not see it (NaN of fewer than five).
 * Input port 1, Vortices (vtkPolyData, optional): first guesses and priors. They keep their
 * `VortexId`; they may be edited, added or deleted by hand.
 *
 * Output port 0, Vortices (vtkPolyData): one 2-point line per vortex, with `Confidence` (0..1) and
 * `ObjectCount` (tracks that felt it).
 * Output port 1, Tracks (vtkPolyData): the input with the point data `VortexForce` (what the fitted
 * vortices give) and `ResidualForce` (`Force` less `VortexForce`), both double[3], m/s^2.
 *
 * The model is Shi et al. 2005, Appendix C (Eq. 13), with a regularised denominator. Each vortex is
 * fitted to all tracks that pass its region of space and time together: from one track alone the
 * parameters are ambiguous, which shows as a low `Confidence`. Up to MaximumNewVortices more are
 * sought in what the priors leave. Stopped half way, it gives the vortices fitted so far.
 */
#ifndef vtkVortexFitFilter_h
#define vtkVortexFitFilter_h

#include "WaftProperty.h"
#include "vtkKeptPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct VortexFitOptions;
}

class VTKWAFTFILTERS_EXPORT vtkVortexFitFilter : public vtkKeptPolyDataAlgorithm
{
public:
  static vtkVortexFitFilter* New();
  vtkTypeMacro(vtkVortexFitFilter, vtkKeptPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum
  {
    Force,
    AirAcceleration
  };
  WaftProperty(int, Quantity);
  WaftProperty(int, MaximumNewVortices);
  WaftProperty(double, MinimumGain);

  ///@{
  /** Takes `WindAcceleration` off `Force` before fitting. */
  vtkSetMacro(SubtractWind, bool);
  vtkGetMacro(SubtractWind, bool);
  vtkBooleanMacro(SubtractWind, bool);
  ///@}

  WaftFlag(UniformBackground);

  ///@{
  /** How far results may go from priors: 1 is half of the strength, 0.1 of the volume's width, 20
   * degrees and half a second (standard deviations); more than 0. */
  vtkSetMacro(PriorFreedom, double);
  vtkGetMacro(PriorFreedom, double);
  ///@}

  WaftProperty(int, NumberOfStarts);
  WaftProperty(int, Sweeps);
  WaftProperty(int, Seed);

  ///@{
  /// Take an optional input away.
  void RemoveAllVortices() { this->SetInputConnection(1, nullptr); }
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkVortexFitFilter();
  ~vtkVortexFitFilter() override;

  waft::KeptStage& Kept() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkVortexFitFilter(const vtkVortexFitFilter&) = delete;
  void operator=(const vtkVortexFitFilter&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::VortexFitOptions;
  bool SubtractWind = true;
  double PriorFreedom = 1.0;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
