// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTrajectoryClusterFilter
 * @brief   a motion database from traced trajectories
 *
 * Input port 0, Input (vtkPolyData, repeatable): Tracks, one data set per simulation, all of one
 * frame rate; annotated ones as vtkTrajectoryTraceFilter gives them.
 * Input port 1, Vortices (vtkPolyData, optional, repeatable): those that the `VortexId` of the i-th
 * Input name; the i-th for the i-th.
 *
 * Output port 0 (vtkMultiBlockDataSet): blocks `Segments`, `Basis`, `Nodes`, `Connections`,
 * `Vortices`, `Provenance`; the leaves are vtkPolyData and vtkTable. It can be written with
 * vtkXMLMultiBlockDataWriter and read back without a bit changed.
 *
 * Trajectories are cut at least curvature between their features, grouped by length, truncated,
 * compressed by singular value decomposition and organised by tree-structured vector quantisation
 * down to single segments; a directional table says which representatives may follow which (Shi
 * et al. 2005, section 3.2 and Eq. 1).
 */
#ifndef vtkTrajectoryClusterFilter_h
#define vtkTrajectoryClusterFilter_h

#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct ClusterOptions;
struct ClusterTreeOptions;
struct ConnectionOptions;
struct SegmentationOptions;
struct RotationRange;
}

class VTKWAFTFILTERS_EXPORT vtkTrajectoryClusterFilter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkTrajectoryClusterFilter* New();
  vtkTypeMacro(vtkTrajectoryClusterFilter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum RotationFreedomType
  {
    YAW = 0,
    YAW_AND_TILT = 1,
    ANY = 2
  };

  ///@{
  /** Shortest and longest segments [samples]; the longest at least twice the shortest. */
  vtkSetClampMacro(ShortestSegment, int, 4, VTK_INT_MAX);
  vtkGetMacro(ShortestSegment, int);
  vtkSetClampMacro(LongestSegment, int, 8, VTK_INT_MAX);
  vtkGetMacro(LongestSegment, int);
  ///@}
  ///@{
  /** Lengths of the groups grow by this ratio; above 1. */
  vtkSetMacro(LengthRatio, double);
  vtkGetMacro(LengthRatio, double);
  ///@}
  ///@{
  /** Bends that peak below this curvature are no features [1/m]; 0: four over the width. */
  vtkSetClampMacro(FeatureCurvature, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(FeatureCurvature, double);
  ///@}
  ///@{
  /** Bends part where the curvature between them falls to the lower peak over this; above 1. */
  vtkSetMacro(FeatureContrast, double);
  vtkGetMacro(FeatureContrast, double);
  ///@}
  ///@{
  /** Segments of a lower mean speed are left out [m/s]. */
  vtkSetClampMacro(LeastSpeed, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LeastSpeed, double);
  ///@}
  ///@{
  /** Samples that consecutive segments overlap in; 3 to those of the shortest segment. */
  vtkSetClampMacro(Window, int, 3, VTK_INT_MAX);
  vtkGetMacro(Window, int);
  ///@}
  ///@{
  /** Error of the compression: rms left out over rms of the segments, 1e-6 to 1. */
  vtkSetClampMacro(RelativeError, double, 1e-6, 1.0);
  vtkGetMacro(RelativeError, double);
  ///@}
  ///@{
  /** More segments than this are thinned at random; 0: all are kept. */
  vtkSetClampMacro(MaximumSegments, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumSegments, int);
  ///@}
  ///@{
  /** Initial clusters of all groups together. */
  vtkSetClampMacro(NumberOfTopNodes, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfTopNodes, int);
  ///@}
  ///@{
  /** Children of an inner node, at most; at least 2. */
  vtkSetClampMacro(Branching, int, 2, VTK_INT_MAX);
  vtkGetMacro(Branching, int);
  ///@}
  ///@{
  /** Which rotations the connection table may use: 0 Yaw, 1 YawAndTilt, 2 Any. */
  vtkSetClampMacro(RotationFreedom, int, YAW, ANY);
  vtkGetMacro(RotationFreedom, int);
  ///@}
  ///@{
  /** Largest lean of the vertical under YawAndTilt [rad]. */
  vtkSetClampMacro(MaxTilt, double, 0.0, 3.14159265358979323846);
  vtkGetMacro(MaxTilt, double);
  ///@}
  ///@{
  /** Pairs whose residual over chord is above this do not connect. */
  vtkSetMacro(NotConnectible, double);
  vtkGetMacro(NotConnectible, double);
  ///@}
  ///@{
  /** Seed of clustering and thinning. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  /** Takes every connection from input port 1. */
  void RemoveAllVortices();

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkTrajectoryClusterFilter();
  ~vtkTrajectoryClusterFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkTrajectoryClusterFilter(const vtkTrajectoryClusterFilter&) = delete;
  void operator=(const vtkTrajectoryClusterFilter&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::ClusterOptions;
  friend struct waft::RotationRange;
  friend struct waft::ClusterTreeOptions;
  friend struct waft::ConnectionOptions;
  friend struct waft::SegmentationOptions;
  int ShortestSegment = 12;
  int LongestSegment = 60;
  double LengthRatio = 1.5;
  double FeatureCurvature = 0.0;
  double FeatureContrast = 2.0;
  double LeastSpeed = 0.02;
  int Window = 6;
  double RelativeError = 0.002;
  int MaximumSegments = 6000;
  int NumberOfTopNodes = 100;
  int Branching = 4;
  int RotationFreedom = YAW_AND_TILT;
  double MaxTilt = 0.34906585039886591;
  double NotConnectible = 0.15;
  int Seed = 1;

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
