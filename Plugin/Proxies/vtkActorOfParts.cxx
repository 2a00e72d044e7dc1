// SPDX-License-Identifier: BSD-3-Clause
#include "vtkActorOfParts.h"

#include <vtkAssemblyPath.h>
#include <vtkAssemblyPaths.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkRenderer.h>
#include <vtk_glew.h>

#include <algorithm>
#include <utility>

vtkStandardNewMacro(vtkActorOfParts);

void vtkActorOfParts::SetParts(Actors parts, Actors veils, double reach)
{
  this->Parts = std::move(parts);
  this->Veils = std::move(veils);
  this->Reach = reach;
  this->Modified();
}

double* vtkActorOfParts::GetBounds()
{
  double* bounds = this->Superclass::GetBounds();
  if (bounds == nullptr || !this->HasParts() || vtkMath::AreBoundsInitialized(bounds) == 0)
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
  return this->HasParts() && (renderer == nullptr || renderer->GetSelector() == nullptr);
}

int vtkActorOfParts::Draw(const Actors& parts, vtkViewport* viewport,
                          int (vtkActor::*draw)(vtkViewport*))
{
  int drawn = 0;
  for (vtkActor* part : parts)
  {
    part->SetUserMatrix(this->GetMatrix());
    part->SetPropertyKeys(this->GetPropertyKeys());
    drawn = std::max(drawn, (part->*draw)(viewport));
  }
  return drawn;
}

int vtkActorOfParts::RenderOpaqueGeometry(vtkViewport* viewport)
{
  this->AreVeilsDrawn = false;
  return this->DrawsParts(viewport)
           ? this->Draw(this->Parts, viewport, &vtkActor::RenderOpaqueGeometry)
           : this->Superclass::RenderOpaqueGeometry(viewport);
}

// This pass comes where something is translucent in the view: then veils are sorted with it.
int vtkActorOfParts::RenderTranslucentPolygonalGeometry(vtkViewport* viewport)
{
  if (!this->DrawsParts(viewport))
  {
    return this->Superclass::RenderTranslucentPolygonalGeometry(viewport);
  }
  this->AreVeilsDrawn = true;
  const int parts =
    this->Draw(this->Parts, viewport, &vtkActor::RenderTranslucentPolygonalGeometry);
  return std::max(parts,
                  this->Draw(this->Veils, viewport, &vtkActor::RenderTranslucentPolygonalGeometry));
}

// The last pass, else, before which depths are no longer looked at, and what was drawn is smoothed.
int vtkActorOfParts::RenderOverlay(vtkViewport* viewport)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(viewport->GetVTKWindow());
  if (!this->DrawsParts(viewport) || this->AreVeilsDrawn || window == nullptr)
  {
    return this->Superclass::RenderOverlay(viewport);
  }
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglEnableDisable before(state, GL_DEPTH_TEST);
  state->vtkglEnable(GL_DEPTH_TEST);
  glEnable(GL_LINE_SMOOTH);
  const int drawn =
    this->Draw(this->Veils, viewport, &vtkActor::RenderTranslucentPolygonalGeometry);
  glDisable(GL_LINE_SMOOTH);
  return drawn;
}

vtkTypeBool vtkActorOfParts::HasTranslucentPolygonalGeometry()
{
  return !this->HasParts() ? this->Superclass::HasTranslucentPolygonalGeometry()
                           : std::any_of(this->Parts.begin(), this->Parts.end(),
                                         [](vtkActor* part)
                                         { return part->HasTranslucentPolygonalGeometry() != 0; });
}

vtkTypeBool vtkActorOfParts::HasOpaqueGeometry()
{
  return !this->HasParts()
           ? this->Superclass::HasOpaqueGeometry()
           : std::any_of(this->Parts.begin(), this->Parts.end(),
                         [](vtkActor* part) { return part->HasOpaqueGeometry() != 0; });
}

void vtkActorOfParts::ReleaseGraphicsResources(vtkWindow* window)
{
  for (const Actors* parts : { &this->Parts, &this->Veils })
  {
    for (vtkActor* part : *parts)
    {
      part->ReleaseGraphicsResources(window);
    }
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkActorOfParts::BuildPaths(vtkAssemblyPaths* paths, vtkAssemblyPath* path)
{
  if (!this->HasParts())
  {
    this->Superclass::BuildPaths(paths, path);
    return;
  }
  const vtkNew<vtkMatrix4x4> asHere; // the path so far has this actor's own
  for (const Actors* parts : { &this->Parts, &this->Veils })
  {
    for (vtkActor* part : *parts)
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
}

void vtkActorOfParts::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Parts: " << this->Parts.size() << ", veils: " << this->Veils.size() << "\n";
}
