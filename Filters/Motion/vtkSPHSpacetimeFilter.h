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
 * Input port 6, Air (vtkImageData, optional, may vary in time): `Velocity` [m/s] of a drawn air, in
 * which the wind is contained already: the gas begins in it and is drawn towards it.
 *
 * Output port 0, Tracks (vtkPolyData): with `Force`, `AirVelocity` and `SPHVelocity` besides, and
 * the cell data `PositionResidual` [dx] and `VelocityResidual` [dx / frame]: root mean squares of
 * what gas dynamics does not explain, in gas spacings.
 * Output port 1, Particles (vtkPolyData, varies in time): gas and object particles.
 * Output port 2, Vortices (vtkPolyData): as fitted; in a drawn air as they came.
 * Output port 3, Wind (vtkImageData, varies in time): on the optimiser's own lattice [m/s^2].
 * Output port 4, Convergence (vtkTable): one row an iteration, each term of E a column.
 * Output port 5, Report (vtkTable): one line per row and target of the constraints.
 *
 * Shi et al. 2005, section 5 and Appendix B: all positions and velocities of all frames are
 * unknowns of one cost E = c1 Ex + c2 Ev + c3 Ec (Eq. 2), under hard constraints; wind and vortices
 * are estimated in alternation with it. E never grows within a stage. The result is the same, bit
 * by bit, on any number of threads. Stopped half way or by TimeLimit, it gives the best motion so
 * far, and the next run goes on from there.
 *
 * Of several MPI processes (ranks) rank 0 solves, with its threads, and the others wait for it: all
 * must update the filter together. Inputs and properties of rank 0 hold, and its outputs hold the
 * result. Those of the others are empty, but where every rank was given the tracks: then all have
 * the result.
 */
#ifndef vtkSPHSpacetimeFilter_h
#define vtkSPHSpacetimeFilter_h

#include "vtkSlicedPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <vtkSmartPointer.h>

#include <memory>
#include <string>

class vtkMultiProcessController;
class vtkTable;
namespace waft
{
struct SpacetimeOptions;
struct TermWeights;
} // namespace waft

class VTKWAFTFILTERS_EXPORT vtkSPHSpacetimeFilter : public vtkSlicedPolyDataAlgorithm
{
public:
  static vtkSPHSpacetimeFilter* New();
  vtkTypeMacro(vtkSPHSpacetimeFilter, vtkSlicedPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Gas particles that fill the volume; they set the spacing dx. 64 to 200000. */
  vtkSetClampMacro(NumberOfGasParticles, int, 64, 200000);
  vtkGetMacro(NumberOfGasParticles, int);
  ///@}
  ///@{
  /** Particles of all objects together, shared among them, one to five each. 1 to 100000. */
  vtkSetClampMacro(NumberOfObjectParticles, int, 1, 100000);
  vtkGetMacro(NumberOfObjectParticles, int);
  ///@}
  ///@{
  /** Weight c1 of Eq. 2: positions follow their prediction. 1e-6 to 1e+06. */
  vtkSetClampMacro(PositionWeight, double, 1e-6, 1e+06);
  vtkGetMacro(PositionWeight, double);
  ///@}
  ///@{
  /** Weight c2 of Eq. 2: velocities follow their prediction. 1e-6 to 1e+06. */
  vtkSetClampMacro(VelocityWeight, double, 1e-6, 1e+06);
  vtkGetMacro(VelocityWeight, double);
  ///@}
  ///@{
  /** Weight c3 of Eq. 2: how much objects move with the air about them. 0 to 1e+06. */
  vtkSetClampMacro(CoherenceWeight, double, 0.0, 1e+06);
  vtkGetMacro(CoherenceWeight, double);
  ///@}
  ///@{
  /** Fraction c31 of neighbours in space in Eq. 4; the rest is neighbours in time. 0 to 1. */
  vtkSetClampMacro(SpatialShare, double, 0.0, 1.0);
  vtkGetMacro(SpatialShare, double);
  ///@}
  ///@{
  /** How often the air about it counts in Eq. 4 for an object, where it counts once for gas:
   * objects are what is seen. 0 to 1e+06. */
  vtkSetClampMacro(ObjectCoherence, double, 0.0, 1e+06);
  vtkGetMacro(ObjectCoherence, double);
  ///@}
  ///@{
  /** How often PositionWeight counts for an object, where it counts once for gas: a step of its own
   * beside its velocity is seen as a kink at the next mark. 0.001 to 1e+06. */
  vtkSetClampMacro(ObjectPosition, double, 0.001, 1e+06);
  vtkGetMacro(ObjectPosition, double);
  ///@}
  ///@{
  /** Frames w to either side in Eq. 4. 1 to 30. */
  vtkSetClampMacro(TemporalWindow, int, 1, 30);
  vtkGetMacro(TemporalWindow, int);
  ///@}
  ///@{
  /** Smoothing length h over the spacing dx. 0.8 to 2. */
  vtkSetClampMacro(SmoothingLength, double, 0.8, 2.0);
  vtkGetMacro(SmoothingLength, double);
  ///@}
  ///@{
  /** Sound speed times frame step over h: how stiff the gas is. 0.1 to 1. */
  vtkSetClampMacro(CourantNumber, double, 0.1, 1.0);
  vtkGetMacro(CourantNumber, double);
  ///@}
  ///@{
  /** Artificial viscosity alpha. 0 to 2. */
  vtkSetClampMacro(Viscosity, double, 0.0, 2.0);
  vtkGetMacro(Viscosity, double);
  ///@}
  ///@{
  /** Factor epsilon of the XSPH correction, Eq. 10. 0 to 1. */
  vtkSetClampMacro(XsphFactor, double, 0.0, 1.0);
  vtkGetMacro(XsphFactor, double);
  ///@}
  ///@{
  /** Exponent gamma of the equation of state, Eq. 12. 1 to 7. */
  vtkSetClampMacro(PressureExponent, double, 1.0, 7.0);
  vtkGetMacro(PressureExponent, double);
  ///@}
  ///@{
  /** Reduced gravity of the objects in m/s^2; with it and drag they fall at their
   * SettlingSpeed in still air. 0 to 20. */
  vtkSetClampMacro(EffectiveGravity, double, 0.0, 20.0);
  vtkGetMacro(EffectiveGravity, double);
  ///@}
  ///@{
  /** Distance between centres that objects keep, in metres; negative: from their sizes; 0:
   * none. -1 to 100. */
  vtkSetClampMacro(ContactDistance, double, -1.0, 100.0);
  vtkGetMacro(ContactDistance, double);
  ///@}
  ///@{
  /** Rate in 1/s with which a wind given as a velocity draws the gas. 0 to 100. */
  vtkSetClampMacro(WindDrag, double, 0.0, 100.0);
  vtkGetMacro(WindDrag, double);
  ///@}
  ///@{
  /** Rate in 1/s with which gas that moves otherwise than the drawn air of the input Air comes
   * back to it. With less its disorder shakes the objects. 0 to 100. */
  vtkSetClampMacro(AirDrag, double, 0.0, 100.0);
  vtkGetMacro(AirDrag, double);
  ///@}
  ///@{
  /** Estimate a smooth wind from what nothing else explains, and freeze it in the prediction. */
  vtkSetMacro(EstimateWind, bool);
  vtkGetMacro(EstimateWind, bool);
  vtkBooleanMacro(EstimateWind, bool);
  ///@}
  ///@{
  /** Fit the vortices anew between the passes. */
  vtkSetMacro(FitVortexFields, bool);
  vtkGetMacro(FitVortexFields, bool);
  vtkBooleanMacro(FitVortexFields, bool);
  ///@}
  ///@{
  /** How many of the vortices that the planned paths bring stir the air, the strongest of each
   * place and time first; those of the scene itself always do. 0 to 1000. */
  vtkSetClampMacro(MaximumNumberOfVortices, int, 0, 1000);
  vtkGetMacro(MaximumNumberOfVortices, int);
  ///@}
  ///@{
  /** Alternations of solving with estimating the force fields. 1 to 10. */
  vtkSetClampMacro(Passes, int, 1, 10);
  vtkGetMacro(Passes, int);
  ///@}
  ///@{
  /** Keep every point near the planned path at first, in a ball that grows and is then
   * removed. */
  vtkSetMacro(UseLeash, bool);
  vtkGetMacro(UseLeash, bool);
  vtkBooleanMacro(UseLeash, bool);
  ///@}
  ///@{
  /** Iterations at each of the five radii of the leash. 1 to 10000. */
  vtkSetClampMacro(LeashIterations, int, 1, 10000);
  vtkGetMacro(LeashIterations, int);
  ///@}
  ///@{
  /** Iterations at most: a third of them on every fourth frame, two fifths in each stage on every
   * second, a third in each on all; in a drawn air two ninths, in one stage on all frames.
   * 1 to 100000. */
  vtkSetClampMacro(MaximumNumberOfIterations, int, 1, 100000);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}
  ///@{
  /** A stage ends when E fell by less than this fraction in 20 iterations; 0: never. 0 to 1. */
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}
  ///@{
  /** Seconds after which the best motion so far is given; 0: no limit. With a limit two runs
   * may differ. 0 to 1e+09. */
  vtkSetClampMacro(TimeLimit, double, 0.0, 1e+09);
  vtkGetMacro(TimeLimit, double);
  ///@}
  ///@{
  /** Pairs that L-BFGS keeps. 1 to 20. */
  vtkSetClampMacro(HistorySize, int, 1, 20);
  vtkGetMacro(HistorySize, int);
  ///@}
  ///@{
  /** After a change, go on from the motion and the fields of the last run instead of from the
   * planned tracks, as long as objects, frames and gas are the same. The first run of a filter is
   * the same with it and without. */
  vtkSetMacro(WarmStart, bool);
  vtkGetMacro(WarmStart, bool);
  vtkBooleanMacro(WarmStart, bool);
  ///@}
  ///@{
  /** When only some tracks or rows changed since the last run: seconds before and after the changed
   * frames that are solved again; 0: all is solved on. 0 to 1000. */
  vtkSetClampMacro(EditDuration, double, 0.0, 1000.0);
  vtkGetMacro(EditDuration, double);
  ///@}
  ///@{
  /** Then: metres about the changed objects within which gas and objects move; nothing else does.
   * 0: all is solved on. 0 to 1000. */
  vtkSetClampMacro(EditRadius, double, 0.0, 1000.0);
  vtkGetMacro(EditRadius, double);
  ///@}
  ///@{
  /** Megabytes that a run may take besides its input; 0: no limit. Frames are solved in windows, in
   * several times the time, where all at once would take more. 0 to 1e+09. */
  vtkSetClampMacro(MemoryLimit, double, 0.0, 1e+09);
  vtkGetMacro(MemoryLimit, double);
  ///@}
  ///@{
  /** A file that the state of a run is written to at intervals, whole or not at all; empty: none.
   * A run of the same inputs and properties that was ended before its time goes on from it, to the
   * same bits; a run that ends by itself removes it. */
  vtkSetStdStringFromCharMacro(CheckpointFile);
  vtkGetCharFromStdStringMacro(CheckpointFile);
  ///@}
  ///@{
  /** Seconds between two writings of CheckpointFile, and as many more as keep them within 2 % of
   * the time; 0: after each iteration. 0 to 1e+06. */
  vtkSetClampMacro(CheckpointInterval, double, 0.0, 1e+06);
  vtkGetMacro(CheckpointInterval, double);
  ///@}
  /** Whether there is room, with these properties, for so many objects and frames in a volume
   * (xmin, xmax, ymin, ymax, zmin, zmax) [m] above its ground: for layers of gas, and in memory.
   * Says what is lacking; empty when nothing is. A script may ask before anything is planned. */
  std::string CheckRoom(const double bounds[6], int numberOfFrames, int numberOfObjects) const;
  /** Makes a table the Convergence of no iteration: the columns alone. */
  static void EmptyConvergence(vtkTable* table);
  /** Solve on: the next update goes on from where the last one ended although nothing changed. */
  void Continue();
  /** Forget the last run: the next update starts from the planned tracks. */
  void Restart();

  ///@{
  /** The processes that wait for the first to solve; the global controller, unless set. Null: this
   * one solves for itself. */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  ///@{
  /// Take an optional input away.
  void RemoveAllObstacles() { this->SetInputConnection(3, nullptr); }
  void RemoveAllVortices() { this->SetInputConnection(4, nullptr); }
  void RemoveAllWind() { this->SetInputConnection(5, nullptr); }
  void RemoveAllAir() { this->SetInputConnection(6, nullptr); }
  ///@}

  ///@{
  /** Whether the stage runs. One that rests takes none of its inputs and gives empty outputs. */
  vtkSetMacro(Active, bool);
  vtkGetMacro(Active, bool);
  vtkBooleanMacro(Active, bool);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkSPHSpacetimeFilter();
  ~vtkSPHSpacetimeFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                          vtkInformationVector* outputs) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;
  waft::KeptStage& Kept() override;

private:
  vtkSPHSpacetimeFilter(const vtkSPHSpacetimeFilter&) = delete;
  void operator=(const vtkSPHSpacetimeFilter&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::SpacetimeOptions;
  friend struct waft::TermWeights;
  int NumberOfGasParticles = 2500;
  int NumberOfObjectParticles = 125;
  double PositionWeight = 5.0;
  double VelocityWeight = 10.0;
  double CoherenceWeight = 0.05;
  double SpatialShare = 0.5;
  double ObjectCoherence = 24.0;
  double ObjectPosition = 30.0;
  int TemporalWindow = 1;
  double SmoothingLength = 1.2;
  double CourantNumber = 0.5;
  double Viscosity = 0.2;
  double XsphFactor = 0.0;
  double PressureExponent = 1.0;
  double EffectiveGravity = 0.8;
  double ContactDistance = -1.0;
  double WindDrag = 2.0;
  double AirDrag = 8.0;
  bool EstimateWind = true;
  bool FitVortexFields = true;
  int Passes = 2;
  bool UseLeash = true;
  int LeashIterations = 20;
  int MaximumNumberOfVortices = 16;
  int MaximumNumberOfIterations = 150;
  double Tolerance = 0.01;
  double TimeLimit = 0.0;
  int HistorySize = 6;
  bool WarmStart = true;
  double EditDuration = 1.0;
  double EditRadius = 1.0;
  double MemoryLimit = 0.0;
  std::string CheckpointFile;
  double CheckpointInterval = 10.0;

  vtkSmartPointer<vtkMultiProcessController> Controller;
  bool Active = true;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
