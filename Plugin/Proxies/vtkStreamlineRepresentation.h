// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamlineRepresentation
 * @brief   shows a field of vectors by its streamlines (vtkStreamlineTubes)
 */
#ifndef vtkStreamlineRepresentation_h
#define vtkStreamlineRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkWaftProxiesModule.h"

class vtkStreamlineTubes;

class VTKWAFTPROXIES_EXPORT vtkStreamlineRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkStreamlineRepresentation* New();
  vtkTypeMacro(vtkStreamlineRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Those of vtkStreamlineTubes. */
  void SetNumberOfLines(int lines);
  void SetLineLength(double share);
  void SetTubeRadius(double share);
  ///@}

protected:
  vtkStreamlineRepresentation();
  ~vtkStreamlineRepresentation() override;

private:
  vtkStreamlineRepresentation(const vtkStreamlineRepresentation&) = delete;
  void operator=(const vtkStreamlineRepresentation&) = delete;

  vtkStreamlineTubes* Tubes(); // the filter that makes what is shown
};

#endif
