// SPDX-License-Identifier: BSD-3-Clause
// Numbers that no property may have: an error that names the property and empty outputs, or finite
// outputs; and all is well once the number is.
#include "PipelineTesting.h"

#include <vtkAirAssimilationFilter.h>
#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkConstraintSource.h>
#include <vtkFeatherShapeSource.h>
#include <vtkFieldData.h>
#include <vtkGridSmokeSource.h>
#include <vtkLeafShapeSource.h>
#include <vtkMotionDatabaseSource.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectSource.h>
#include <vtkPhotographShapeSource.h>
#include <vtkPolyData.h>
#include <vtkRotationRefineFilter.h>
#include <vtkSPHSpacetimeFilter.h>
#include <vtkShapeKeyframeSource.h>
#include <vtkSmartPointer.h>
#include <vtkStylisticPlannerFilter.h>
#include <vtkTable.h>
#include <vtkTrajectoryClusterFilter.h>
#include <vtkTrajectoryTraceFilter.h>
#include <vtkVDBReader.h>
#include <vtkVortexFitFilter.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
const std::vector<double> BadNumbers = { NaN, Infinity, -Infinity, 1e308, -1e308 };
const std::vector<double> BadCounts = { 2147483647.0, -2147483648.0 };

/// A property, how it is set, a number that is right for it, and the ones that may be wrong.
template <class Stage>
struct Line
{
  const char* Name;
  std::function<void(Stage*, double)> Set;
  double Good;
  std::vector<double> Bad;
};

#define NUMBER(Stage, Name, Good)                                                                  \
  Line<Stage>                                                                                      \
  {                                                                                                \
#Name, [](Stage * s, double x) { s->Set##Name(x); }, Good, BadNumbers                          \
  }
#define COUNT(Stage, Name, Good)                                                                   \
  Line<Stage>                                                                                      \
  {                                                                                                \
#Name, [](Stage * s, double x) { s->Set##Name(int(x)); }, Good, BadCounts                      \
  }
/// The second of two numbers, the first being small.
#define ENDS(Stage, Name, Good)                                                                    \
  Line<Stage>                                                                                      \
  {                                                                                                \
#Name, [](Stage * s, double x) { s->Set##Name(1e-3, x); }, Good, BadNumbers                    \
  }
/// The first of three numbers.
#define VECTOR(Stage, Name, Good)                                                                  \
  Line<Stage>                                                                                      \
  {                                                                                                \
#Name, [](Stage * s, double x) { s->Set##Name(x, 0.5, 0.25); }, Good, BadNumbers               \
  }
#define SCENE(Stage)                                                                               \
  COUNT(Stage, NumberOfFrames, 300), NUMBER(Stage, FramesPerSecond, 30), Line<Stage>               \
  {                                                                                                \
    "Bounds", [](Stage* s, double x) { s->SetBounds(-2, x, -2, 2, 0, 4); }, 2.0, BadNumbers        \
  }

bool IsFinite(vtkFieldData* data)
{
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    for (vtkIdType k = 0; array && k < array->GetNumberOfValues(); ++k)
    {
      if (!std::isfinite(array->GetVariantValue(k).ToDouble()))
      {
        return false;
      }
    }
  }
  return true;
}

bool IsFinite(vtkDataObject* data)
{
  bool isFinite = IsFinite(data->GetFieldData());
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data))
  {
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(blocks->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      isFinite = isFinite && IsFinite(leaf->GetCurrentDataObject());
    }
  }
  if (auto* table = vtkTable::SafeDownCast(data))
  {
    isFinite = isFinite && IsFinite(table->GetRowData());
  }
  if (auto* set = vtkDataSet::SafeDownCast(data))
  {
    isFinite = isFinite && IsFinite(set->GetPointData()) && IsFinite(set->GetCellData());
    for (vtkIdType p = 0; p < set->GetNumberOfPoints(); ++p)
    {
      const double* x = set->GetPoint(p);
      isFinite = isFinite && std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
    }
  }
  return isFinite;
}

bool IsEmpty(vtkDataObject* data)
{
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data);
  return blocks ? blocks->GetNumberOfBlocks() == 0
                : data->GetNumberOfElements(vtkDataObject::POINT) == 0 &&
                    data->GetNumberOfElements(vtkDataObject::ROW) == 0;
}

/// Sets each line of the table to each of its bad numbers and then to the good one.
template <class Source>
void TryAll(Source* source, const std::vector<Line<Source>>& table)
{
  ErrorLog errors(source);
  for (const Line<Source>& line : table)
  {
    for (const double bad : line.Bad)
    {
      SCOPED_TRACE(std::string(line.Name) + " of " + std::to_string(bad));
      errors.Text.clear();
      line.Set(source, bad);
      source->Update();
      const bool isRefused = !errors.Text.empty();
      EXPECT_TRUE(isRefused || !std::isnan(bad));
      EXPECT_TRUE(!isRefused || errors.Contains(line.Name)) << errors.Text;
      EXPECT_LT(errors.Text.size(), 2000u);
      for (int port = 0; port < source->GetNumberOfOutputPorts(); ++port)
      {
        vtkDataObject* data = source->GetOutputDataObject(port);
        EXPECT_TRUE(isRefused ? IsEmpty(data) : IsFinite(data)) << "port " << port;
      }
    }
    SCOPED_TRACE(line.Name);
    errors.Text.clear();
    line.Set(source, line.Good);
    source->Update();
    EXPECT_EQ(errors.Text, "");
    EXPECT_FALSE(IsEmpty(source->GetOutputDataObject(0)));
  }
}

/// Of a filter whose other inputs lack something: an error names the property for as long as it is
/// NaN, and no longer.
template <class Filter>
void TryNaN(Filter* filter, const std::vector<Line<Filter>>& table)
{
  ErrorLog errors(filter);
  for (const Line<Filter>& line : table)
  {
    SCOPED_TRACE(line.Name);
    const std::string sentence = std::string(line.Name) + ": expected a number from";
    errors.Text.clear();
    line.Set(filter, NaN);
    filter->Update();
    EXPECT_TRUE(errors.Contains(sentence)) << errors.Text;
    EXPECT_TRUE(IsEmpty(filter->GetOutputDataObject(0)));
    errors.Text.clear();
    line.Set(filter, line.Good);
    filter->Update();
    EXPECT_FALSE(errors.Contains(sentence)) << errors.Text;
  }
}

/// Data of one object with the field data of a scene, for any input that wants points.
struct SceneData
{
  vtkNew<vtkObjectSource> Objects;
  vtkNew<vtkMultiBlockDataSet> Blocks;

  explicit SceneData(vtkAlgorithm* filter, const std::vector<int>& blockPorts = {})
  {
    for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
    {
      const bool wantsBlocks =
        std::find(blockPorts.begin(), blockPorts.end(), port) != blockPorts.end();
      vtkInformation* info = filter->GetInputPortInformation(port);
      if (wantsBlocks)
      {
        filter->SetInputDataObject(port, this->Blocks);
      }
      else if (!info->Has(vtkAlgorithm::INPUT_IS_OPTIONAL()))
      {
        filter->SetInputConnection(port, this->Objects->GetOutputPort());
      }
    }
  }
};

} // namespace

TEST(PropertyValues, OfAnObject)
{
  using S = vtkObjectSource;
  vtkNew<S> source;
  TryAll<S>(source, { VECTOR(S, Position, 0), VECTOR(S, Velocity, 0), VECTOR(S, AngularVelocity, 0),
                      Line<S>{ "Orientation", [](S* s, double x) { s->SetOrientation(x, 0, 0, 0); },
                               1, BadNumbers },
                      COUNT(S, ObjectId, 1), COUNT(S, ShapeId, 0), COUNT(S, ClassId, -1),
                      NUMBER(S, Mass, 0.001), NUMBER(S, SettlingSpeed, 0.8),
                      NUMBER(S, ClearanceRadius, 0.05), NUMBER(S, RestHeight, 0),
                      NUMBER(S, AirDensity, 1.2), SCENE(S) });
}

TEST(PropertyValues, OfAConstraint)
{
  using S = vtkConstraintSource;
  vtkNew<S> source;
  TryAll<S>(source, { VECTOR(S, Value, 0),
                      Line<S>{ "Orientation", [](S* s, double x) { s->SetOrientation(x, 0, 0, 0); },
                               1, BadNumbers },
                      NUMBER(S, Radius, 0.1), COUNT(S, ObjectId, 0), COUNT(S, Frame, 150),
                      COUNT(S, LastFrame, -1), COUNT(S, Until, -1),
                      Line<S>{ "Waypoints", [](S* s, double x) { s->SetWaypoint(1, 0, x, 0); }, 0,
                               BadNumbers },
                      SCENE(S) });
}

TEST(PropertyValues, OfAKeyframe)
{
  using S = vtkShapeKeyframeSource;
  vtkNew<S> source;
  source->SetNumberOfTargets(10);
  TryAll<S>(
    source,
    { NUMBER(S, Radius, 0.1), VECTOR(S, Origin, 0),
      Line<S>{ "U", [](S* s, double x) { s->SetU(x, 0, 0); }, 1, BadNumbers },
      Line<S>{ "V", [](S* s, double x) { s->SetV(0, x, 0); }, 1, BadNumbers }, NUMBER(S, Width, 3),
      COUNT(S, Frame, 250), COUNT(S, Until, -1), COUNT(S, Group, 0),
      Line<S>{ "ClassColors", [](S* s, double x) { s->SetClassColor(0, x, 0, 0); }, 1, BadNumbers },
      SCENE(S) });
}

TEST(PropertyValues, OfTextsAndFiles)
{
  vtkNew<vtkShapeKeyframeSource> source;
  ErrorLog errors(source);
  const std::string megabyte(1 << 20, 'a');
  const auto refuses = [&](const char* name)
  {
    errors.Text.clear();
    source->Update();
    EXPECT_TRUE(errors.Contains(name)) << errors.Text;
    EXPECT_LT(errors.Text.size(), 3000u);
    EXPECT_TRUE(IsEmpty(source->GetOutput()));
  };
  source->SetText(megabyte);
  refuses("expected a text of at most 1000 bytes");
  source->SetText("\xff\xfe");
  refuses("bytes of valid UTF-8");
  source->SetText("\xed\xa0\x80"); // half of a pair
  refuses("bytes of valid UTF-8");
  source->SetText("\xf0\x9f\x8d\x83");
  refuses("letters that it lacks");
  source->SetText("\xc3\xa4\xc3\xb8");
  source->SetFont("no such font");
  refuses("no such font");
  source->SetFont("\xff.ttf");
  refuses(".ttf");
  source->SetFont("sans");
  source->SetShape(vtkShapeKeyframeSource::IMAGE);
  source->SetImageFile("\xff.png");
  refuses(".png");
  source->SetShape(vtkShapeKeyframeSource::TEXT);
  errors.Text.clear();
  source->Update();
  EXPECT_EQ(errors.Text, "");
  EXPECT_FALSE(IsEmpty(source->GetOutput()));
}

TEST(PropertyValues, OfFilesThatCannotBe)
{
  vtkNew<vtkLeafShapeSource> leaf;
  ErrorLog errors(leaf);
  for (const std::string& file : { std::string("no folder/\xff.png"), std::string(5000, 'a') })
  {
    errors.Text.clear();
    leaf->SetTextureFile(file);
    leaf->Update();
    EXPECT_NE(errors.Text, "");
    EXPECT_TRUE(IsEmpty(leaf->GetOutput()));
  }
  errors.Text.clear();
  leaf->SetTextureFile("");
  leaf->Update();
  EXPECT_EQ(errors.Text, "");
  EXPECT_FALSE(IsEmpty(leaf->GetOutput()));

  vtkNew<vtkSPHSpacetimeFilter> optimiser;
  optimiser->SetCheckpointFile(nullptr);
  EXPECT_EQ(optimiser->GetCheckpointFile(), std::string());
}

TEST(PropertyValues, AreKeptInTheRangesOfCore)
{
  vtkNew<vtkVortexFitFilter> fit;
  fit->SetSweeps(100);
  EXPECT_EQ(fit->GetSweeps(), 20);
  fit->SetSweeps(-1);
  EXPECT_EQ(fit->GetSweeps(), 1);
  const vtkMTimeType before = fit->GetMTime();
  fit->SetSweeps(0);
  EXPECT_EQ(fit->GetMTime(), before);
  fit->SetMinimumGain(NaN);
  EXPECT_TRUE(std::isnan(fit->GetMinimumGain()));

  // Of a shape's properties each class of its line knows its own.
  vtkNew<vtkLeafShapeSource> leaf;
  leaf->SetKind(99);
  leaf->SetWidth(99);
  leaf->SetCurl(99);
  EXPECT_EQ(leaf->GetKind(), 5);
  EXPECT_EQ(leaf->GetWidth(), 3.0);
  EXPECT_EQ(leaf->GetCurl(), 2.0);

  // No end that only keeps out nonsense, nor any of a size: these are refused when it works.
  leaf->SetNumberOfFrames(VTK_INT_MAX);
  leaf->SetLength(-1);
  EXPECT_EQ(leaf->GetNumberOfFrames(), VTK_INT_MAX);
  EXPECT_EQ(leaf->GetLength(), -1);
}

TEST(PropertyValues, OfCountsThatAreStored)
{
  vtkNew<vtkConstraintSource> waypoints;
  const ErrorLog tooMany(waypoints);
  waypoints->SetNumberOfWaypoints(VTK_INT_MAX);
  EXPECT_TRUE(tooMany.Contains("NumberOfWaypoints: expected at most 1000000")) << tooMany.Text;
  waypoints->SetWaypoint(VTK_INT_MAX, 0, 0, 0);
  EXPECT_EQ(waypoints->GetNumberOfWaypoints(), 2);

  vtkNew<vtkShapeKeyframeSource> colors;
  const ErrorLog tooColorful(colors);
  colors->SetNumberOfClassColors(VTK_INT_MAX);
  EXPECT_TRUE(tooColorful.Contains("NumberOfClassColors: expected at most")) << tooColorful.Text;
  colors->SetClassColor(VTK_INT_MAX, 0, 0, 0);
  EXPECT_EQ(colors->GetNumberOfClassColors(), 0);
}

namespace
{
template <class S>
std::vector<Line<S>> ShapeLines()
{
  return { NUMBER(S, Length, 0.1),        NUMBER(S, Curl, 0.3),        NUMBER(S, Camber, 0.1),
           NUMBER(S, Twist, 0.1),         NUMBER(S, AreaDensity, 0.1), NUMBER(S, Thickness, 0.001),
           NUMBER(S, DragCoefficient, 1), NUMBER(S, SettlingSpeed, 1), SCENE(S) };
}
template <class S>
std::vector<Line<S>> PaintedLines()
{
  std::vector<Line<S>> lines = ShapeLines<S>();
  lines.insert(lines.end(),
               { NUMBER(S, Width, 1), NUMBER(S, Bend, 1), COUNT(S, Rows, 8), COUNT(S, Columns, 4),
                 VECTOR(S, BaseColor, 1), VECTOR(S, EdgeColor, 1), VECTOR(S, VeinColor, 1),
                 NUMBER(S, Blotches, 0.5), COUNT(S, Seed, 1) });
  return lines;
}
} // namespace

TEST(PropertyValues, OfShapes)
{
  vtkNew<vtkLeafShapeSource> leaf;
  std::vector<Line<vtkLeafShapeSource>> lines = PaintedLines<vtkLeafShapeSource>();
  lines.push_back(NUMBER(vtkLeafShapeSource, StemLength, 1));
  lines.push_back(NUMBER(vtkLeafShapeSource, Lobing, 1));
  TryAll<vtkLeafShapeSource>(leaf, lines);

  vtkNew<vtkFeatherShapeSource> feather;
  TryAll<vtkFeatherShapeSource>(feather, { NUMBER(vtkFeatherShapeSource, ShaftLength, 1),
                                           NUMBER(vtkFeatherShapeSource, Asymmetry, 1) });

  vtkNew<vtkPhotographShapeSource> photograph;
  photograph->SetPhotograph(WAFT_SOURCE_DIR "/Data/Shapes/leaf-gold.png");
  TryAll<vtkPhotographShapeSource>(photograph, { NUMBER(vtkPhotographShapeSource, Threshold, 0.5),
                                                 NUMBER(vtkPhotographShapeSource, Detail, 0.05) });
}

TEST(PropertyValues, OfSmoke)
{
  using S = vtkGridSmokeSource;
  vtkNew<S> source;
  source->SetResolution(8, 8, 8);
  source->SetNumberOfFrames(2);
  source->SetWarmUpSeconds(0.1);
  source->SetNumberOfVortices(1);
  source->SetNumberOfWinds(1);
  source->SetNumberOfObstacles(1);
  source->SetNumberOfEmitters(1);
  TryAll<S>(source, { Line<S>{ "Resolution", [](S* s, double x) { s->SetResolution(8, int(x), 8); },
                               8, BadCounts },
                      SCENE(S),
                      NUMBER(S, AirDensity, 1.2),
                      NUMBER(S, WarmUpSeconds, 0.1),
                      NUMBER(S, Confinement, 0),
                      NUMBER(S, BuoyancyDensity, 0),
                      NUMBER(S, BuoyancyTemperature, 0.1),
                      NUMBER(S, EmitterTemperature, 30),
                      NUMBER(S, Dissipation, 0),
                      NUMBER(S, WindDrag, 1),
                      NUMBER(S, CourantNumber, 2),
                      NUMBER(S, Tolerance, 1e-3),
                      ENDS(S, VortexDiameter, 0.3),
                      ENDS(S, VortexLength, 0.5),
                      ENDS(S, VortexAcceleration, 1),
                      ENDS(S, VortexDuration, 1),
                      ENDS(S, WindRadius, 0.3),
                      ENDS(S, WindAcceleration, 1),
                      ENDS(S, WindDuration, 1),
                      ENDS(S, ObstacleSize, 0.2),
                      COUNT(S, CacheLimit, 100),
                      COUNT(S, Seed, 1) });
}

TEST(PropertyValues, OfADatabase)
{
  using S = vtkMotionDatabaseSource;
  vtkNew<S> source;
  source->SetNumberOfSimulations(1);
  source->SetNumberOfFrames(90);
  source->SetResolution(8);
  source->SetSeedStride(2);
  source->SetWarmUpSeconds(0.1);
  source->SetNumberOfTopNodes(4);
  TryAll<S>(source,
            { Line<S>{ "NumberOfFrames",
                       [](S* s, double x) { s->SetNumberOfFrames(int(x)); },
                       90,
                       { 2147483647.0 } },
              NUMBER(S, FramesPerSecond, 30),
              Line<S>{ "Bounds", [](S* s, double x) { s->SetBounds(-2, x, -2, 2, 0, 4); }, 2.0,
                       BadNumbers },
              NUMBER(S, WarmUpSeconds, 0.1),
              NUMBER(S, SettlingSpeed, 0),
              NUMBER(S, StopBelow, 0),
              NUMBER(S, CoverageTolerance, 0.05),
              NUMBER(S, TimeLimit, 0),
              NUMBER(S, RelativeError, 0.002),
              NUMBER(S, NotConnectible, 0.15),
              ENDS(S, VortexDiameter, 0.3),
              ENDS(S, VortexLength, 0.5),
              ENDS(S, VortexAcceleration, 1),
              ENDS(S, VortexDuration, 1),
              ENDS(S, WindRadius, 0.3),
              ENDS(S, WindAcceleration, 1),
              ENDS(S, WindDuration, 1),
              ENDS(S, ObstacleSize, 0.2),
              Line<S>{ "NumberOfSimulations",
                       [](S* s, double x) { s->SetNumberOfSimulations(int(x)); }, 1, BadCounts },
              COUNT(S, Resolution, 8),
              COUNT(S, NumberOfVortices, 2),
              COUNT(S, NumberOfWinds, 2),
              COUNT(S, NumberOfObstacles, 0),
              COUNT(S, MaximumSegments, 500),
              COUNT(S, NumberOfTopNodes, 4),
              COUNT(S, Seed, 1) });
}

TEST(PropertyValues, OfThePlanner)
{
  using S = vtkStylisticPlannerFilter;
  vtkNew<S> filter;
  const SceneData data(filter, { 0 });
  TryNaN<S>(filter, { NUMBER(S, MaxTilt, 0.3), NUMBER(S, ConnectionThreshold, 0.1),
                      NUMBER(S, JoinThreshold, 0.1), NUMBER(S, RetimingLimit, 0.1),
                      NUMBER(S, GuideWeight, 0.1) });
}

TEST(PropertyValues, OfTheAssimilation)
{
  using S = vtkAirAssimilationFilter;
  vtkNew<S> filter;
  const SceneData data(filter);
  TryNaN<S>(filter, { NUMBER(S, WindSpacing, 0.0), NUMBER(S, WindTimeSpacing, 0.5),
                      NUMBER(S, WindStiffness, 2), NUMBER(S, Smoothness, 0.005),
                      NUMBER(S, TouchDownSpread, 2), NUMBER(S, TimeLimit, 0) });
}

TEST(PropertyValues, OfTheOptimisation)
{
  using S = vtkSPHSpacetimeFilter;
  vtkNew<S> filter;
  const SceneData data(filter);
  TryNaN<S>(filter, { NUMBER(S, PositionWeight, 1),    NUMBER(S, VelocityWeight, 1),
                      NUMBER(S, CoherenceWeight, 1),   NUMBER(S, SpatialShare, 0.5),
                      NUMBER(S, ObjectCoherence, 1),   NUMBER(S, ObjectPosition, 1),
                      NUMBER(S, SmoothingLength, 1),   NUMBER(S, CourantNumber, 0.5),
                      NUMBER(S, Viscosity, 1),         NUMBER(S, XsphFactor, 0.5),
                      NUMBER(S, PressureExponent, 2),  NUMBER(S, EffectiveGravity, 1),
                      NUMBER(S, ContactDistance, -1),  NUMBER(S, WindDrag, 1),
                      NUMBER(S, AirDrag, 1),           NUMBER(S, Tolerance, 0.1),
                      NUMBER(S, TimeLimit, 0),         NUMBER(S, EditDuration, 1),
                      NUMBER(S, EditRadius, 1),        NUMBER(S, MemoryLimit, 0),
                      NUMBER(S, CheckpointInterval, 1) });
}

TEST(PropertyValues, OfTheRotation)
{
  using S = vtkRotationRefineFilter;
  vtkNew<S> filter;
  const SceneData data(filter, { 2 });
  TryNaN<S>(filter,
            { NUMBER(S, Damping, 1), NUMBER(S, Lift, 1), NUMBER(S, PressureShift, 0.1),
              NUMBER(S, Follow, 1), NUMBER(S, Roll, 1), NUMBER(S, Spin, 0),
              NUMBER(S, VariationPerObject, 0.1), NUMBER(S, LandingTime, 1),
              NUMBER(S, TurningTime, 1), NUMBER(S, TurningRate, 10), NUMBER(S, MaximumTurn, 60) });
}

TEST(PropertyValues, OfTheVortexFit)
{
  using S = vtkVortexFitFilter;
  vtkNew<S> filter;
  const SceneData data(filter);
  TryNaN<S>(filter, { NUMBER(S, MinimumGain, 0.1), NUMBER(S, PriorFreedom, 1) });
}

TEST(PropertyValues, OfTraceAndCluster)
{
  vtkNew<vtkImageData> wind;
  MakeEvenWind(wind, "Velocity", { 0.1, 0.0, 0.0 });
  using T = vtkTrajectoryTraceFilter;
  vtkNew<T> trace;
  trace->SetInputDataObject(wind);
  TryAll<T>(trace,
            { NUMBER(T, SettlingSpeed, 0), NUMBER(T, VortexShare, 0.5), NUMBER(T, ForceFloor, 0.1),
              NUMBER(T, ShortestRun, 0.1), COUNT(T, SeedStride, 1) });

  using C = vtkTrajectoryClusterFilter;
  vtkNew<C> cluster;
  const SceneData data(cluster);
  TryNaN<C>(cluster, { NUMBER(C, LengthRatio, 2), NUMBER(C, FeatureCurvature, 1),
                       NUMBER(C, FeatureContrast, 2), NUMBER(C, LeastSpeed, 0.1),
                       NUMBER(C, RelativeError, 0.01), NUMBER(C, MaxTilt, 0.1),
                       NUMBER(C, NotConnectible, 0.1) });
  ErrorLog errors(cluster);
  cluster->SetShortestSegment(VTK_INT_MAX);
  cluster->Update();
  EXPECT_TRUE(errors.Contains("ShortestSegment: expected a number from")) << errors.Text;
}

TEST(PropertyValues, OfTheVolumeReader)
{
  using S = vtkVDBReader;
  vtkNew<S> reader;
  reader->SetFileName("none.0000.vdb");
  TryNaN<S>(reader, { NUMBER(S, FramesPerSecond, 30) });
  const ErrorLog errors(reader);
  reader->SetFramesPerSecond(1e-300);
  reader->Update();
  EXPECT_TRUE(errors.Contains("FramesPerSecond: expected a number from")) << errors.Text;
}
