// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkActorOfParts
 * @brief   an actor of a representation that draws actors of its own in place of its mapper's data
 *
 * The parts are where this actor is, and seen where it is. Where a view picks by what it draws, and
 * where there are no parts, the mapper's data are drawn, as by any actor.
 */
#ifndef vtkActorOfParts_h
#define vtkActorOfParts_h

#include "vtkPVLODActor.h"
#include "vtkSmartPointer.h"
#include "vtkWaftProxiesModule.h"

#include <vector>

class VTKWAFTPROXIES_EXPORT vtkActorOfParts : public vtkPVLODActor
{
public:
  static vtkActorOfParts* New();
  vtkTypeMacro(vtkActorOfParts, vtkPVLODActor);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// reach: how far beyond the mapper's data they are drawn [m], so that a part of a picture that
  /// has a part's edge alone has it, too. veils: so faint
  /// that their order is not seen; they ask for no passes over the picture that sort what is
  /// translucent, but are drawn with what does.
  void SetParts(std::vector<vtkSmartPointer<vtkActor>> parts,
                std::vector<vtkSmartPointer<vtkActor>> veils, double reach);

  using Superclass::GetBounds;
  double* GetBounds() override;
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderTranslucentPolygonalGeometry(vtkViewport* viewport) override;
  int RenderOverlay(vtkViewport* viewport) override;
  vtkTypeBool HasTranslucentPolygonalGeometry() override;
  vtkTypeBool HasOpaqueGeometry() override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  /// Who goes over a scene's actors, as writers of it do, finds the parts with their looks.
  void BuildPaths(vtkAssemblyPaths* paths, vtkAssemblyPath* path) override;

protected:
  vtkActorOfParts() = default;
  ~vtkActorOfParts() override = default;

private:
  vtkActorOfParts(const vtkActorOfParts&) = delete;
  void operator=(const vtkActorOfParts&) = delete;

  using Actors = std::vector<vtkSmartPointer<vtkActor>>;

  bool HasParts() const { return !this->Parts.empty() || !this->Veils.empty(); }
  bool DrawsParts(vtkViewport* viewport) const;
  int Draw(const Actors& parts, vtkViewport* viewport, int (vtkActor::*draw)(vtkViewport*));

  Actors Parts;
  Actors Veils;
  bool AreVeilsDrawn = false; // of the picture that is being drawn
  double Reach = 0.0;
  double Reached[6];
};

#endif
