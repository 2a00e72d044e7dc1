// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSPHSpacetimeFilter
 * @brief   turns planned paths into the motion of things in one body of air, marks met exactly
 *
 * Input port 0, Tracks (vtkPolyData): planned paths, one polyline an object, one point a frame.
 * Input port 1, Objects (vtkPolyData): one vertex an object.
 * Input port 2, Constraints (vtkPolyData): rows, each assigned to an object; those that a stage
 * before found impossible (`Status`) do not bind.
 * Input port 3, Obstacles (vtkPolyData, optional, may move): closed surfaces.
 * Input port 4, Vortices (vtkPolyData, optional): first guesses and priors.
 * Input port 5, Wind (vtkImageData, optional, may vary in time): `Wind` or `Velocity`, a fixed
 * background.
 * Input port 6, Air (vtkImageData, optional, may vary in time): `Velocity` [m/s] of a sampled air,
 * in which the wind is contained already: the gas begins in it and is drawn towards it.
 *
 * Output port 0, Tracks (vtkPolyData): with `Force`, `AirVelocity` and `SPHVelocity` besides, and
 * the cell data `PositionResidual` [dx] and `VelocityResidual` [dx / frame]: root mean squares of
 * what gas dynamics does not explain, in gas spacings.
 * Output port 1, Particles (vtkPolyData, varies in time): gas and object particles.
 * Output port 2, Vortices (vtkPolyData): as fitted; in a sampled air as they came.
 * Output port 3, Wind (vtkImageData, varies in time): on the optimiser's own lattice [m/s^2].
 * Output port 4, Convergence (vtkTable): one row an iteration, each term of E a column.
 * Output port 5, Report (vtkTable): one line per row and target of the constraints.
 *
 * Shi et al. 2005, section 5 and Appendix B: all positions and velocities of all frames are
 * unknowns of one cost E = c1 Ex + c2 Ev + c3 Ec (Eq. 2), under hard constraints; wind and vortices
 * are estimated in alternation with it. E never grows within a stage. The result is the same, bit
 * by bit, on any number of threads. Stopped half way or by TimeLimit, it gives the best motion so
 * far; the next run begins with the tracks.
 *
 * Of several MPI processes (ranks) rank 0 solves, with its threads, and the others wait for it: all
 * must update the filter together. Inputs and properties of rank 0 hold, and its outputs hold the
 * result. Those of the others are empty, but where every rank was given the tracks: then all have
 * the result.
 */
#ifndef vtkSPHSpacetimeFilter_h
#define vtkSPHSpacetimeFilter_h

#include "WaftProperty.h"
#include "vtkChainStageAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>
#include <string>

class vtkTable;
namespace waft
{
struct SpacetimeOptions;
struct TermWeights;
} // namespace waft

class VTKWAFTFILTERS_EXPORT vtkSPHSpacetimeFilter : public vtkChainStageAlgorithm
{
public:
  static vtkSPHSpacetimeFilter* New();
  vtkTypeMacro(vtkSPHSpacetimeFilter, vtkChainStageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  WaftProperty(int, NumberOfGasParticles);
  WaftProperty(int, NumberOfObjectParticles);
  WaftProperty(double, PositionWeight);
  WaftProperty(double, VelocityWeight);
  WaftProperty(double, CoherenceWeight);
  WaftProperty(double, SpatialShare);
  WaftProperty(double, ObjectCoherence);
  WaftProperty(double, ObjectPosition);
  WaftProperty(int, TemporalWindow);
  WaftProperty(double, SmoothingLength);
  WaftProperty(double, CourantNumber);
  WaftProperty(double, Viscosity);
  WaftProperty(double, XsphFactor);
  WaftProperty(double, PressureExponent);
  WaftProperty(double, EffectiveGravity);
  WaftProperty(double, ContactDistance);
  WaftProperty(double, WindDrag);
  WaftProperty(double, AirDrag);
  WaftFlag(EstimateWind);
  WaftFlag(FitVortexFields);
  WaftProperty(int, MaximumNumberOfVortices);
  WaftProperty(int, WindCells);
  WaftProperty(double, FieldRidge);
  WaftProperty(int, Passes);
  WaftFlag(UseLeash);
  WaftProperty(int, LeashIterations);
  WaftFlag(MoveGas);
  WaftProperty(int, MaximumNumberOfIterations);
  WaftProperty(double, Tolerance);
  WaftProperty(double, TimeLimit);
  WaftProperty(int, HistorySize);
  WaftProperty(int, WindowLength);
  WaftFlag(WarmStart);
  WaftProperty(double, EditDuration);
  WaftProperty(double, EditRadius);
  WaftProperty(double, MemoryLimit);
  WaftWrittenFile(CheckpointFile);
  WaftProperty(double, CheckpointInterval);

  ///@{
  /** The next update solves from the tracks, although nothing changed, as after a stop. */
  void Continue();
  void Restart();
  ///@}

  /** The processes that wait for the first to solve; the global controller, unless set. Null: this
   * one solves for itself. */
  void SetController(vtkMultiProcessController* controller) override;

  ///@{
  /// Take an optional input away.
  void RemoveAllObstacles() { this->SetInputConnection(3, nullptr); }
  void RemoveAllVortices() { this->SetInputConnection(4, nullptr); }
  void RemoveAllWind() { this->SetInputConnection(5, nullptr); }
  void RemoveAllAir() { this->SetInputConnection(6, nullptr); }
  ///@}

protected:
  vtkSPHSpacetimeFilter();
  ~vtkSPHSpacetimeFilter() override;

  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  waft::KeptStage& Kept() override;
  std::vector<waft::PropertyRange> Ranges() const override;

private:
  vtkSPHSpacetimeFilter(const vtkSPHSpacetimeFilter&) = delete;
  void operator=(const vtkSPHSpacetimeFilter&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::SpacetimeOptions;
  friend struct waft::TermWeights;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
