// SPDX-License-Identifier: BSD-3-Clause
// Converters from the pipeline's data: points, cells and arrays of an input's own making, right or
// not.
#include "Fuzz.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include <array>
#include <limits>

using namespace waft;

namespace
{

/// Small numbers drawn from an input; zeros behind its end.
class Draws
{
public:
  Draws(const std::uint8_t* data, std::size_t size) : At(data), End(data + size) {}
  int Number(int below) { return this->At < this->End ? *this->At++ % below : 0; }
  bool IsEmpty() const { return this->At == this->End; }
  double Real()
  {
    static constexpr std::array<double, 12> odd{ 0.0,
                                                 -0.0,
                                                 1.0,
                                                 -1.0,
                                                 1e-300,
                                                 1e300,
                                                 -1e308,
                                                 std::numeric_limits<double>::quiet_NaN(),
                                                 std::numeric_limits<double>::infinity(),
                                                 2147483648.0,
                                                 -5.0,
                                                 0.5 };
    const int drawn = this->Number(256);
    return drawn < 2 * static_cast<int>(odd.size()) ? odd[drawn / 2] : (drawn - 128) / 64.0;
  }

private:
  const std::uint8_t* At;
  const std::uint8_t* End;
};

vtkSmartPointer<vtkAbstractArray> DrawArray(Draws& draws, const char* name, int components,
                                            vtkIdType tuples)
{
  // Most have the components and tuples that they should.
  const int wrong = draws.Number(16);
  components += wrong == 1 ? 1 : 0;
  tuples += wrong == 2 ? 1 : wrong == 3 && tuples > 0 ? -1 : 0;
  const int kind = draws.Number(8);
  if (kind == 7)
  {
    vtkNew<vtkStringArray> texts;
    texts->SetName(name);
    texts->SetNumberOfValues(tuples);
    return texts;
  }
  vtkSmartPointer<vtkDataArray> numbers;
  if (kind < 4)
  {
    numbers = vtkSmartPointer<vtkDoubleArray>::New();
  }
  else
  {
    numbers = vtkSmartPointer<vtkIntArray>::New();
  }
  numbers->SetName(name);
  numbers->SetNumberOfComponents(components);
  numbers->SetNumberOfTuples(tuples);
  for (vtkIdType i = 0; i < tuples * components; ++i)
  {
    const double value = kind < 4 ? draws.Real() : draws.Number(9) - 2.0;
    numbers->SetComponent(i / components, static_cast<int>(i % components), value);
  }
  return numbers;
}

struct Known
{
  const char* Name;
  int Components;
};

template <std::size_t N>
void DrawArrays(Draws& draws, const std::array<Known, N>& known, vtkIdType tuples,
                vtkFieldData* arrays)
{
  for (const Known& array : known)
  {
    if (draws.Number(4) > 0)
    {
      arrays->AddArray(DrawArray(draws, array.Name, array.Components, tuples));
    }
  }
}

void DrawCells(Draws& draws, vtkIdType points, vtkCellArray* cells)
{
  for (int cell = draws.Number(6); cell > 0; --cell)
  {
    const int size = draws.Number(5);
    cells->InsertNextCell(size);
    for (int i = 0; i < size; ++i)
    {
      const int odd = draws.Number(32);
      cells->InsertCellPoint(odd == 1   ? -1
                             : odd == 2 ? points
                             : odd == 3 ? vtkIdType{ 1 } << 40
                                        : draws.Number(static_cast<int>(points) + 1));
    }
  }
}

void Draw(Draws& draws, vtkPolyData* data)
{
  static constexpr std::array<Known, 26> ofPoints{ { { names::Frame, 1 },
                                                     { names::Time, 1 },
                                                     { names::Velocity, 3 },
                                                     { names::ForceType, 1 },
                                                     { names::VortexId, 1 },
                                                     { names::VortexAcceleration, 3 },
                                                     { names::WindAcceleration, 3 },
                                                     { names::Force, 3 },
                                                     { names::ObjectId, 1 },
                                                     { names::Orientation, 4 },
                                                     { names::AngularVelocity, 3 },
                                                     { names::Torque, 3 },
                                                     { names::ShapeId, 1 },
                                                     { names::Mass, 1 },
                                                     { names::SettlingSpeed, 1 },
                                                     { names::ClassId, 1 },
                                                     { names::ClearanceRadius, 1 },
                                                     { names::RestHeight, 1 },
                                                     { names::Kind, 1 },
                                                     { names::Value, 4 },
                                                     { names::Radius, 1 },
                                                     { names::Until, 1 },
                                                     { names::Row, 1 },
                                                     { names::Target, 1 },
                                                     { names::Group, 1 },
                                                     { names::ObstacleId, 1 } } };
  static constexpr std::array<Known, 8> ofCells{ { { names::ObjectId, 1 },
                                                   { names::VortexId, 1 },
                                                   { names::Strength, 1 },
                                                   { names::CenterTime, 1 },
                                                   { names::Duration, 1 },
                                                   { names::CoreRadius, 1 },
                                                   { names::Confidence, 1 },
                                                   { names::ObjectCount, 1 } } };
  static constexpr std::array<Known, 5> ofScene{ { { names::Bounds, 6 },
                                                   { names::NumberOfFrames, 1 },
                                                   { names::FramesPerSecond, 1 },
                                                   { names::AirDensity, 1 },
                                                   { names::Seed, 1 } } };
  const vtkIdType count = draws.Number(8);
  if (draws.Number(8) > 0)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (vtkIdType i = 0; i < count; ++i)
    {
      const double x = draws.Real(), y = draws.Real(), z = draws.Real();
      points->InsertNextPoint(x, y, z);
    }
    data->SetPoints(points);
  }
  vtkNew<vtkCellArray> verts, lines, polys;
  if (draws.Number(2) > 0)
  {
    DrawCells(draws, count, verts);
    data->SetVerts(verts);
  }
  DrawCells(draws, count, lines);
  data->SetLines(lines);
  DrawCells(draws, count, polys);
  data->SetPolys(polys);
  DrawArrays(draws, ofPoints, count, data->GetPointData());
  DrawArrays(draws, ofCells, lines->GetNumberOfCells(), data->GetCellData());
  DrawArrays(draws, ofScene, 1, data->GetFieldData());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  vtkObject::GlobalWarningDisplayOff();
  Draws draws(data, size);
  vtkNew<vtkPolyData> drawn;
  Draw(draws, drawn);

  SceneInfo info;
  (void)static_cast<bool>(SceneInfoFromFieldData(drawn, info));
  std::vector<Track> tracks;
  (void)static_cast<bool>(TracksFromPolyData(drawn, tracks));
  std::vector<PoseTrack> poses;
  (void)static_cast<bool>(PosesFromPolyData(drawn, tracks, poses));
  std::vector<Vortex> vortices;
  (void)static_cast<bool>(VorticesFromPolyData(drawn, vortices));
  std::vector<MotionObject> objects;
  (void)static_cast<bool>(ObjectsFromPolyData(drawn, objects));
  std::vector<Constraint> constraints;
  (void)static_cast<bool>(ConstraintsFromPolyData(drawn, info.Time, constraints));
  TriangleMesh mesh;
  (void)static_cast<bool>(MeshFromPolyData(drawn, "fuzz", mesh));
  ObstacleCollector obstacles;
  (void)static_cast<bool>(obstacles.Add(drawn, 0.0, info.Time));
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, drawn);
  std::vector<Shape> shapes;
  (void)static_cast<bool>(ShapesFromMultiBlock(blocks, shapes));
  return 0;
}
