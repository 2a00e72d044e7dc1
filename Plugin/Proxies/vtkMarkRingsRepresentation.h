// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMarkRingsRepresentation
 * @brief   shows marks as rings that face the viewer
 *
 * Of rows of places (point data `Kind`). A ring is of the row's `Radius`; a small one where that is
 * none. From its `Frame` on it is green where its `Status` is met, and red where it is not.
 */
#ifndef vtkMarkRingsRepresentation_h
#define vtkMarkRingsRepresentation_h

#include "vtkPartsRepresentation.h"
#include "vtkWaftProxiesModule.h"

class VTKWAFTPROXIES_EXPORT vtkMarkRingsRepresentation : public vtkPartsRepresentation
{
public:
  static vtkMarkRingsRepresentation* New();
  vtkTypeMacro(vtkMarkRingsRepresentation, vtkPartsRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Whether the volume of the scene is drawn, too: its edges, its floor, and how high each place
  /// is above it. Default off.
  vtkSetMacro(ShowVolume, bool);
  vtkGetMacro(ShowVolume, bool);
  ///@}

protected:
  vtkMarkRingsRepresentation();
  ~vtkMarkRingsRepresentation() override;

  void AddParts(vtkPolyData* block, double time, Parts& parts) override;
  bool VariesInTime() const override { return true; }

private:
  void AddVolume(vtkPolyData* block, Parts& parts);

  bool ShowVolume = false;
  vtkSmartPointer<vtkTexture> Pool;

  vtkMarkRingsRepresentation(const vtkMarkRingsRepresentation&) = delete;
  void operator=(const vtkMarkRingsRepresentation&) = delete;
};

#endif
