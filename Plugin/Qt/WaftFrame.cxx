// SPDX-License-Identifier: BSD-3-Clause
#include "WaftFrame.h"

#include <pqDataRepresentation.h>
#include <pqRenderView.h>

#include <vtkBoundingBox.h>
#include <vtkDataObject.h>
#include <vtkMath.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkRenderer.h>
#include <vtkSMOutputPort.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkVector.h>
#include <vtkVersionMacros.h>
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
#include <vtkVectorOperators.h> // of vtkVector.h itself since then
#endif

#include <algorithm>
#include <cmath>
#include <string>

namespace waft
{

namespace
{

const vtkVector3d Direction(-0.35, 1.0, -0.55); // that the camera looks in
constexpr double Around = 1.5;                  // radii of an object that are to be seen
constexpr double Near = 0.05;  // of the extent of what flies: obstacles this near belong to it
constexpr double Filled = 0.9; // of the view's height or width
const double Below[3] = { 0.43, 0.51, 0.57 }; // what is behind all, at the foot of the picture
const double Above[3] = { 0.27, 0.36, 0.44 };

vtkPVDataInformation* DataOf(pqDataRepresentation* shown)
{
  vtkSMOutputPort* port = vtkSMPropertyHelper(shown->getProxy(), "Input").GetAsOutputPort();
  return port != nullptr ? port->GetDataInformation() : nullptr;
}

/// An obstacle made by hand has no id.
bool IsScenery(pqDataRepresentation* shown)
{
  return std::string(shown->getProxy()->GetXMLName()) == "MotionObstaclesRepresentation";
}

/// How far objects reach beyond their places [m], with room round them.
double ReachOf(vtkPVDataInformation* data)
{
  vtkPVArrayInformation* radii = data->GetArrayInformation("ClearanceRadius", vtkDataObject::POINT);
  return radii != nullptr ? Around * radii->GetComponentRange(0)[1] : 0.0;
}

/// Of what flies; without any, of what stands.
vtkBoundingBox BoxOf(const std::vector<pqDataRepresentation*>& shown)
{
  vtkBoundingBox flying, standing;
  for (pqDataRepresentation* one : shown)
  {
    vtkPVDataInformation* data = DataOf(one);
    if (data != nullptr && data->GetNumberOfPoints() > 0)
    {
      double bounds[6];
      data->GetBounds(bounds);
      const bool stands =
        IsScenery(one) || data->GetArrayInformation("ObstacleId", vtkDataObject::POINT) != nullptr;
      vtkBoundingBox own(bounds);
      own.Inflate(ReachOf(data));
      (stands ? standing : flying).AddBox(own);
    }
  }
  if (!flying.IsValid())
  {
    return standing;
  }
  const double near = Near * flying.GetMaxLength();
  double bounds[6];
  flying.GetBounds(bounds);
  for (int axis = 0; standing.IsValid() && axis < 3; ++axis)
  {
    double& low = bounds[2 * axis];
    double& high = bounds[2 * axis + 1];
    low = std::min(low, std::max(standing.GetMinPoint()[axis], low - near));
    high = std::max(high, std::min(standing.GetMaxPoint()[axis], high + near));
  }
  return vtkBoundingBox(bounds);
}

} // namespace

bool IsMotion(pqDataRepresentation* shown)
{
  return shown->getProxy()->IsA("vtkSMMotionRepresentationProxy") != 0;
}

bool Frame(pqRenderView* view, const std::vector<pqDataRepresentation*>& shown)
{
  vtkBoundingBox box = BoxOf(shown);
  if (!box.IsValid())
  {
    return false;
  }
  vtkSMRenderViewProxy* proxy = view->getRenderViewProxy();
  if (box.GetMaxLength() <= 0.0)
  {
    double drawn[6]; // a mark's has the volume in it
    proxy->StillRender();
    proxy->GetRenderer()->ComputeVisiblePropBounds(drawn);
    box.SetBounds(drawn);
  }
  int size[2] = { 0, 0 };
  vtkSMPropertyHelper(proxy, "ViewSize").Get(size, 2);
  const double aspect = size[0] > 0 && size[1] > 0 ? static_cast<double>(size[0]) / size[1] : 1.0;
  const double half = std::tan(
    0.5 * vtkMath::RadiansFromDegrees(vtkSMPropertyHelper(proxy, "CameraViewAngle").GetAsDouble()));
  const vtkVector3d forward = Direction.Normalized();
  const vtkVector3d right = forward.Cross(vtkVector3d(0.0, 0.0, 1.0)).Normalized();
  const vtkVector3d up = right.Cross(forward);
  vtkVector3d center;
  box.GetCenter(center.GetData());
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    vtkVector3d at;
    box.GetCorner(corner, at.GetData());
    at = at - center;
    const double needed = std::max(std::abs(right.Dot(at)) / aspect, std::abs(up.Dot(at)));
    distance = std::max(distance, needed / (Filled * half) - forward.Dot(at));
  }
  const vtkVector3d position = center - forward * distance;
  const double vertical[3] = { 0.0, 0.0, 1.0 };
  vtkSMPropertyHelper(proxy, "InteractionMode").Set(0); // in 3D, for what lies in a plane as well
  vtkSMPropertyHelper(proxy, "CameraPosition").Set(position.GetData(), 3);
  vtkSMPropertyHelper(proxy, "CameraFocalPoint").Set(center.GetData(), 3);
  vtkSMPropertyHelper(proxy, "CameraViewUp").Set(vertical, 3);
  vtkSMPropertyHelper(proxy, "CameraParallelScale").Set(distance * half);
  vtkSMPropertyHelper(proxy, "CenterOfRotation").Set(center.GetData(), 3);
  proxy->UpdateVTKObjects();
  return true;
}

bool Reset(pqRenderView* view, const std::vector<pqDataRepresentation*>& shown)
{
  const vtkBoundingBox box = BoxOf(shown);
  if (box.IsValid())
  {
    double bounds[6];
    box.GetBounds(bounds);
    view->getRenderViewProxy()->ResetCamera(bounds);
  }
  return box.IsValid();
}

void SetBackdrop(pqRenderView* view)
{
  vtkSMRenderViewProxy* proxy = view->getRenderViewProxy();
  vtkSMPropertyHelper ofPalette(proxy, "UseColorPaletteForBackground");
  if (ofPalette.GetAsInt() != 0)
  {
    ofPalette.Set(0);
    vtkSMPropertyHelper(proxy, "Background").Set(Below, 3);
    vtkSMPropertyHelper(proxy, "Background2").Set(Above, 3);
    vtkSMPropertyHelper(proxy, "BackgroundColorMode").Set("Gradient");
    proxy->UpdateVTKObjects();
  }
}

} // namespace waft
