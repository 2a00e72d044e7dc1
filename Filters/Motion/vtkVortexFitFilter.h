// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVortexFitFilter
 * @brief   fits spacetime vortices to the accelerations of objects
 *
 * Input port 0, Input (vtkPolyData): Tracks with the point data `Force` [m/s^2, vortex plus wind];
 * `ForceType` and `VortexId` say which vortex claims a point, `WindAcceleration` is taken off first
 * when SubtractWind is on.
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

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct VortexFitOptions;
}

class VTKWAFTFILTERS_EXPORT vtkVortexFitFilter : public vtkPolyDataAlgorithm
{
public:
  static vtkVortexFitFilter* New();
  vtkTypeMacro(vtkVortexFitFilter, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Vortices that may be added to the priors, strongest first; 0..1000. */
  vtkSetClampMacro(MaximumNewVortices, int, 0, 1000);
  vtkGetMacro(MaximumNewVortices, int);
  ///@}
  ///@{
  /** Fraction of the energy in its region that a new vortex must explain, 0..1. */
  vtkSetClampMacro(MinimumGain, double, 0.0, 1.0);
  vtkGetMacro(MinimumGain, double);
  ///@}
  ///@{
  /** Takes `WindAcceleration` off `Force` before fitting. */
  vtkSetMacro(SubtractWind, bool);
  vtkGetMacro(SubtractWind, bool);
  vtkBooleanMacro(SubtractWind, bool);
  ///@}
  ///@{
  /** Lets a uniform acceleration beside each vortex take up wind that is not known. */
  vtkSetMacro(UniformBackground, bool);
  vtkGetMacro(UniformBackground, bool);
  vtkBooleanMacro(UniformBackground, bool);
  ///@}
  ///@{
  /** How far results may go from priors: 1 is half of the strength, 0.1 of the volume's width, 20
   * degrees and half a second (standard deviations); more than 0. */
  vtkSetMacro(PriorFreedom, double);
  vtkGetMacro(PriorFreedom, double);
  ///@}
  ///@{
  /** Local searches for each vortex, 1..64. */
  vtkSetClampMacro(NumberOfStarts, int, 1, 64);
  vtkGetMacro(NumberOfStarts, int);
  ///@}
  ///@{
  /** Rounds in which each vortex is fitted to what the others leave, 1..20. */
  vtkSetClampMacro(Sweeps, int, 1, 20);
  vtkGetMacro(Sweeps, int);
  ///@}
  ///@{
  /** Seed of the starts of the searches, 0 or more. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /// Take an optional input away.
  void RemoveAllVortices() { this->SetInputConnection(1, nullptr); }
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkVortexFitFilter();
  ~vtkVortexFitFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkVortexFitFilter(const vtkVortexFitFilter&) = delete;
  void operator=(const vtkVortexFitFilter&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::VortexFitOptions;
  int MaximumNewVortices = 4;
  double MinimumGain = 0.2;
  bool SubtractWind = true;
  bool UniformBackground = true;
  double PriorFreedom = 1.0;
  int NumberOfStarts = 4;
  int Sweeps = 2;
  int Seed = 1;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
