// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSceneryRepresentation.h"

#include "PartOfSurface.h"
#include "SoftDisc.h"

#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataConnectivityFilter.h>
#include <vtkTexture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

vtkStandardNewMacro(vtkSceneryRepresentation);

namespace
{

constexpr int MostParts = 64;     // that are drawn by themselves where none has an id
constexpr double Standing = 0.55; // opacity of obstacles: what flies behind them is seen
constexpr double Obstacle[3] = { 0.80, 0.82, 0.84 };

using Box = std::array<double, 6>;

Box BoxOf(vtkPolyData* data)
{
  Box box{};
  data->GetBounds(box.data());
  return box;
}

/// A flat slab that reaches past the whole floor of the volume.
bool IsGround(vtkPolyData* obstacle, vtkDataArray* volume)
{
  if (volume == nullptr || volume->GetNumberOfValues() != 6)
  {
    return false;
  }
  const Box own = BoxOf(obstacle);
  const auto at = [volume](vtkIdType i) { return volume->GetVariantValue(i).ToDouble(); };
  for (vtkIdType i = 0; i < obstacle->GetNumberOfPoints(); ++i)
  {
    const double z = obstacle->GetPoint(i)[2];
    if (z != own[4] && z != own[5])
    {
      return false;
    }
  }
  return own[0] <= at(0) && own[1] >= at(1) && own[2] <= at(2) && own[3] >= at(3) && own[5] < at(5);
}

/// By their ids; of what has none, each part that hangs together is an obstacle, as stages have it.
std::map<vtkIdType, vtkSmartPointer<vtkPolyData>> ObstaclesOf(vtkPolyData* surface)
{
  if (surface->GetPointData()->HasArray("ObstacleId"))
  {
    return waft::PartsBy("ObstacleId", surface);
  }
  vtkNew<vtkPolyDataConnectivityFilter> parts;
  parts->SetInputData(surface);
  parts->SetExtractionModeToAllRegions();
  parts->ColorRegionsOn();
  parts->Update();
  return parts->GetNumberOfExtractedRegions() > MostParts
           ? waft::PartsBy("ObstacleId", surface)
           : waft::PartsBy("RegionId", parts->GetOutput());
}

} // namespace

vtkSceneryRepresentation::vtkSceneryRepresentation() : Pool(waft::MakeSoftDisc(waft::FloorStrength))
{
}

vtkSceneryRepresentation::~vtkSceneryRepresentation() = default;

void vtkSceneryRepresentation::AddParts(vtkPolyData* block, double, Parts& parts)
{
  vtkDataArray* volume = block->GetFieldData()->GetArray("Bounds");
  for (const auto& [number, surface] : ObstaclesOf(block))
  {
    const bool isGround = IsGround(surface, volume);
    Part part;
    std::copy_n(isGround ? waft::FloorColor : Obstacle, 3, part.Color);
    part.IsLit = !isGround;
    part.IsPool = isGround;
    part.Opacity = isGround ? 1.0 : Standing;
    const vtkSmartPointer<vtkPolyData> drawn =
      isGround ? waft::TopOf(BoxOf(surface).data()) : surface;
    part.Actor = this->ActorFor(parts, drawn, isGround ? this->Pool : nullptr,
                                isGround ? waft::LeaveOutRim : nullptr);
    parts.push_back(std::move(part));
  }
}

void vtkSceneryRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Pool: " << this->Pool << "\n";
}
