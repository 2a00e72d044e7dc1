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

#include "WaftProperty.h"
#include "vtkMultiBlockDataSetAlgorithm.h"
#include "vtkWaftFiltersModule.h"

#include <memory>

namespace waft
{
struct ClusterOptions;
struct ClusterTreeOptions;
struct ConnectionOptions;
class KeptStage;
struct SegmentationOptions;
struct RotationRange;
struct SliceOptions;
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

  WaftProperty(int, ShortestSegment);
  WaftProperty(int, LongestSegment);
  WaftOpenProperty(double, LengthRatio);
  WaftProperty(double, FeatureCurvature);
  WaftOpenProperty(double, FeatureContrast);
  WaftProperty(double, LeastSpeed);
  WaftProperty(int, Window);
  WaftProperty(double, RelativeError);
  WaftProperty(int, MaximumSegments);
  WaftProperty(int, NumberOfTopNodes);
  WaftProperty(int, Branching);
  WaftProperty(int, RotationFreedom);
  WaftProperty(double, MaxTilt);
  WaftOpenProperty(double, NotConnectible);
  WaftProperty(int, Seed);

  WaftSlices;

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

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::ClusterOptions;
  friend struct waft::RotationRange;
  friend struct waft::ClusterTreeOptions;
  friend struct waft::ConnectionOptions;
  friend struct waft::SegmentationOptions;
  friend struct waft::SliceOptions;

  waft::KeptStage& Kept();

  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
