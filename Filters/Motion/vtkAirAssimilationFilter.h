// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAirAssimilationFilter
 * @brief   draws one air in which all objects drift to their marks with the least control
 *
 * Input port 0, Tracks (vtkPolyData): planned paths, one polyline an object, one point a frame.
 * Input port 1, Objects (vtkPolyData): one vertex an object.
 * Input port 2, Constraints (vtkPolyData): rows, each assigned to an object; those that a stage
 * before found impossible (`Status`) do not bind.
 * Input port 3, Obstacles (vtkPolyData, optional, may move): closed surfaces.
 * Input port 4, Wind (vtkImageData, optional, may vary in time): `Wind` or `Velocity`, which acts
 * on the air. Input port 5, Vortices (vtkPolyData, optional): the scene's own.
 *
 * Output port 0, Tracks (vtkPolyData): with `AirVelocity` and `Control` [m/s], what moves a body
 * beside the air.
 * Output port 1, Air (vtkImageData, varies in time): `Velocity` [m/s]; `Wind` [m/s^2], the force of
 * the common wind, which `Velocity` contains.
 * Output port 2, Vortices (vtkPolyData): all that stir the air.
 * Output port 3, Constraints (vtkPolyData): with `TouchDown`, the frame from which a rest is kept.
 * Output port 4, Report (vtkTable): one line per row and target of the constraints.
 * Output port 5, Rounds (vtkTable): `Stage`, `Candidate`, `ControlRms`, `ControlMedian`,
 * `FlowRms`, `WindRms` [m/s], `Seconds`.
 *
 * The result is the same, bit by bit, on any number of threads.
 */
#ifndef vtkAirAssimilationFilter_h
#define vtkAirAssimilationFilter_h

#include "vtkSlicedPolyDataAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>
#include <string>

namespace waft
{
struct AssimilationOptions;
} // namespace waft

class VTKWAFTFILTERS_EXPORT vtkAirAssimilationFilter : public vtkSlicedPolyDataAlgorithm
{
public:
  static vtkAirAssimilationFilter* New();
  vtkTypeMacro(vtkAirAssimilationFilter, vtkSlicedPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Voxels of the simulation along the longest side of the volume. 16 to 256. */
  vtkSetClampMacro(Resolution, int, 16, 256);
  vtkGetMacro(Resolution, int);
  ///@}
  ///@{
  /** Points of the lattice of the air that objects drift in and that is given out, along the
   * longest side. 8 to 256. */
  vtkSetClampMacro(LatticeResolution, int, 8, 256);
  vtkGetMacro(LatticeResolution, int);
  ///@}
  ///@{
  /** Airs that are tried by coarse simulations: draws of the forces, and of each its quarter turns
   * and mirror images where nothing forbids them. The one goes on in which objects need the least
   * control and move as bodies do. 1 to 256. */
  vtkSetClampMacro(Candidates, int, 1, 256);
  vtkGetMacro(Candidates, int);
  ///@}
  ///@{
  /** Paths that each object's search begins with besides its plan, the straight line and free
   * drift. 0 to 1000. */
  vtkSetClampMacro(Starts, int, 0, 1000);
  vtkGetMacro(Starts, int);
  ///@}
  ///@{
  /** How often the air is simulated again, at most, with the force of the common wind. 0 to 10.
   * */
  vtkSetClampMacro(Rounds, int, 0, 10);
  vtkGetMacro(Rounds, int);
  ///@}
  ///@{
  /** Alternations of fitting the common wind with drifting in it, in a round. 0 to 100. */
  vtkSetClampMacro(WindRounds, int, 0, 100);
  vtkGetMacro(WindRounds, int);
  ///@}
  ///@{
  /** Spacing of the common wind's splines in space, in metres. 0.001 to 1000. */
  vtkSetClampMacro(WindSpacing, double, 0.001, 1000.0);
  vtkGetMacro(WindSpacing, double);
  ///@}
  ///@{
  /** Spacing of the common wind's splines in time, in seconds. 0.001 to 1000. */
  vtkSetClampMacro(WindTimeSpacing, double, 0.001, 1000.0);
  vtkGetMacro(WindTimeSpacing, double);
  ///@}
  ///@{
  /** Factor of what a common wind that is not smooth costs. 0.001 to 1000. */
  vtkSetClampMacro(WindStiffness, double, 0.001, 1000.0);
  vtkGetMacro(WindStiffness, double);
  ///@}
  ///@{
  /** Cost of changes of the control over that of the control, in s^2. 0 to 10. */
  vtkSetClampMacro(Smoothness, double, 0.0, 10.0);
  vtkGetMacro(Smoothness, double);
  ///@}
  ///@{
  /** Seconds that an object may lie before the frame from which it has to. 0 to 60. */
  vtkSetClampMacro(TouchDownSpread, double, 0.0, 60.0);
  vtkGetMacro(TouchDownSpread, double);
  ///@}
  ///@{
  /** Bodies come after the air as g / SettlingSpeed has it, instead of at once. */
  vtkSetMacro(Inertia, bool);
  vtkGetMacro(Inertia, bool);
  vtkBooleanMacro(Inertia, bool);
  ///@}
  ///@{
  /** Seconds after which the best motion so far is given; 0: no limit. With a limit two runs may
   * differ. 0 to 1e+09. */
  vtkSetClampMacro(TimeLimit, double, 0.0, 1e+09);
  vtkGetMacro(TimeLimit, double);
  ///@}
  ///@{
  /** Seed of the forces that are drawn: another one is another air; -1 is the scene's own. */
  vtkSetClampMacro(Seed, int, -1, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}
  ///@{
  /** When only some objects, rows or tracks changed since the last run: the same air, and only
   * what changed drifts again. */
  vtkSetMacro(WarmStart, bool);
  vtkGetMacro(WarmStart, bool);
  vtkBooleanMacro(WarmStart, bool);
  ///@}
  ///@{
  /** A file that the state of a run is written to after each of its parts, whole or not at all;
   * empty: none. A run of the same inputs and properties that was ended before its time goes on
   * from it, to the same bits; a run that ends by itself removes it. */
  vtkSetStdStringFromCharMacro(CheckpointFile);
  vtkGetCharFromStdStringMacro(CheckpointFile);
  ///@}
  ///@{
  /** A file that a finished run is kept in, for later edits; empty: none. */
  vtkSetStdStringFromCharMacro(StateFile);
  vtkGetCharFromStdStringMacro(StateFile);
  ///@}
  ///@{
  /** The State File of a run of the same scene that differs in some objects' rows: the same air,
   * and only what changed drifts again; empty: none. */
  vtkSetStdStringFromCharMacro(EditOf);
  vtkGetCharFromStdStringMacro(EditOf);
  ///@}
  /** Forgets the last run: the next one draws an air. */
  void Restart();

  ///@{
  /// Take an optional input away.
  void RemoveAllObstacles() { this->SetInputConnection(3, nullptr); }
  void RemoveAllWind() { this->SetInputConnection(4, nullptr); }
  void RemoveAllVortices() { this->SetInputConnection(5, nullptr); }
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
  vtkAirAssimilationFilter();
  ~vtkAirAssimilationFilter() override;

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
  vtkAirAssimilationFilter(const vtkAirAssimilationFilter&) = delete;
  void operator=(const vtkAirAssimilationFilter&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::AssimilationOptions;
  int Resolution = 64;
  int LatticeResolution = 48;
  int Candidates = 32;
  int Starts = 8;
  int Rounds = 3;
  int WindRounds = 5;
  double WindSpacing = 0.4;
  double WindTimeSpacing = 0.5;
  double WindStiffness = 2.0;
  double Smoothness = 0.005;
  double TouchDownSpread = 2.0;
  bool Inertia = false;
  int Seed = -1;
  double TimeLimit = 0.0;
  bool WarmStart = true;
  std::string CheckpointFile;
  std::string StateFile;
  std::string EditOf;

  bool Active = true;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
