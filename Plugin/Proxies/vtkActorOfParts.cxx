// SPDX-License-Identifier: BSD-3-Clause
#include "vtkActorOfParts.h"

#include <vtkAssemblyPath.h>
#include <vtkAssemblyPaths.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <utility>

vtkStandardNewMacro(vtkActorOfParts);

void vtkActorOfParts::SetParts(std::vector<vtkSmartPointer<vtkActor>> parts, double reach)
{
  this->Parts = std::move(parts);
  this->Reach = reach;
  this->Modified();
}

double* vtkActorOfParts::GetBounds()
{
  double* bounds = this->Superclass::GetBounds();
  if (bounds == nullptr || this->Parts.empty() || vtkMath::AreBoundsInitialized(bounds) == 0)
  {
    return bounds;
  }
  for (int side = 0; side < 6; ++side)
  {
    this->Reached[side] = bounds[side] + (side % 2 == 0 ? -this->Reach : this->Reach);
  }
  return this->Reached;
}

bool vtkActorOfParts::DrawsParts(vtkViewport* viewport) const
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  return !this->Parts.empty() && (renderer == nullptr || renderer->GetSelector() == nullptr);
}

int vtkActorOfParts::Draw(vtkViewport* viewport, int (vtkActor::*draw)(vtkViewport*))
{
  int drawn = 0;
  for (vtkActor* part : this->Parts)
  {
    part->SetUserMatrix(this->GetMatrix());
    part->SetPropertyKeys(this->GetPropertyKeys());
    drawn = std::max(drawn, (part->*draw)(viewport));
  }
  return drawn;
}

int vtkActorOfParts::RenderOpaqueGeometry(vtkViewport* viewport)
{
  return this->DrawsParts(viewport) ? this->Draw(viewport, &vtkActor::RenderOpaqueGeometry)
                                    : this->Superclass::RenderOpaqueGeometry(viewport);
}

int vtkActorOfParts::RenderTranslucentPolygonalGeometry(vtkViewport* viewport)
{
  return this->DrawsParts(viewport)
           ? this->Draw(viewport, &vtkActor::RenderTranslucentPolygonalGeometry)
           : this->Superclass::RenderTranslucentPolygonalGeometry(viewport);
}

vtkTypeBool vtkActorOfParts::HasTranslucentPolygonalGeometry()
{
  return this->Parts.empty()
           ? this->Superclass::HasTranslucentPolygonalGeometry()
           : std::any_of(this->Parts.begin(), this->Parts.end(),
                         [](vtkActor* part)
                         { return part->HasTranslucentPolygonalGeometry() != 0; });
}

vtkTypeBool vtkActorOfParts::HasOpaqueGeometry()
{
  return this->Parts.empty()
           ? this->Superclass::HasOpaqueGeometry()
           : std::any_of(this->Parts.begin(), this->Parts.end(),
                         [](vtkActor* part) { return part->HasOpaqueGeometry() != 0; });
}

void vtkActorOfParts::ReleaseGraphicsResources(vtkWindow* window)
{
  for (vtkActor* part : this->Parts)
  {
    part->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkActorOfParts::BuildPaths(vtkAssemblyPaths* paths, vtkAssemblyPath* path)
{
  if (this->Parts.empty())
  {
    this->Superclass::BuildPaths(paths, path);
    return;
  }
  const vtkNew<vtkMatrix4x4> asHere; // the path so far has this actor's own
  for (vtkActor* part : this->Parts)
  {
    if (this->GetVisibility() != 0) // of which a part knows nothing
    {
      part->SetUserMatrix(this->GetMatrix());
      vtkNew<vtkAssemblyPath> toPart;
      toPart->ShallowCopy(path);
      toPart->AddNode(part, asHere);
      paths->AddItem(toPart);
    }
  }
}

void vtkActorOfParts::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Parts: " << this->Parts.size() << "\n";
}
