// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSegmentFanRepresentation
 * @brief   shows the segments of a motion database as they are kept: from one place, in one
 * direction
 *
 * A colour for each group of segments (cell data `Group`); of many, some alone, evenly chosen.
 * Blocks without groups are not drawn.
 */
#ifndef vtkSegmentFanRepresentation_h
#define vtkSegmentFanRepresentation_h

#include "vtkPartsRepresentation.h"
#include "vtkWaftProxiesModule.h"

class VTKWAFTPROXIES_EXPORT vtkSegmentFanRepresentation : public vtkPartsRepresentation
{
public:
  static vtkSegmentFanRepresentation* New();
  vtkTypeMacro(vtkSegmentFanRepresentation, vtkPartsRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSegmentFanRepresentation() = default;
  ~vtkSegmentFanRepresentation() override = default;

  void AddParts(vtkPolyData* block, double time, Parts& parts) override;

private:
  vtkSegmentFanRepresentation(const vtkSegmentFanRepresentation&) = delete;
  void operator=(const vtkSegmentFanRepresentation&) = delete;
};

#endif
