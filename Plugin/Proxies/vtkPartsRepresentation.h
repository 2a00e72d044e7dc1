// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPartsRepresentation
 * @brief   a surface that is drawn by actors of its own (vtkActorOfParts)
 *
 * Who derives says what these are, of each block of the data and at the view's time. What is
 * coloured by an array is drawn as any surface.
 */
#ifndef vtkPartsRepresentation_h
#define vtkPartsRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkSmartPointer.h"
#include "vtkWaftProxiesModule.h"

#include <vector>

class vtkActor;
class vtkDataObject;
class vtkPolyData;
class vtkTexture;

class VTKWAFTPROXIES_EXPORT vtkPartsRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  vtkAbstractTypeMacro(vtkPartsRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(vtkInformationRequestKey* request, vtkInformation* input,
                         vtkInformation* output) override;

protected:
  vtkPartsRepresentation();
  ~vtkPartsRepresentation() override;

  struct Part
  {
    vtkSmartPointer<vtkActor> Actor;
    double Color[3] = { 1.0, 1.0, 1.0 }; // times the colour of the representation
    double Opacity = 1.0;                // likewise
    bool IsLit = true;
    bool IsPool = false; // lies under all else, and is blended into it by its texture's alpha
    bool IsVeil = false; // faint all over, drawn in no order
    double Reach = 0.0;  // how far beyond the data it is drawn [m]
  };
  using Parts = std::vector<Part>;

  /// Adds the parts of a block that has points; time: of the view [s].
  virtual void AddParts(vtkPolyData* block, double time, Parts& parts) = 0;
  /// Whether parts depend on the time where data do not.
  virtual bool VariesInTime() const { return false; }
  /// An actor of a mapper of that data and a texture or null. Actors of before are taken again
  /// where they stood at this place: their programs are compiled. `make`, or null, sets up a new
  /// one.
  vtkSmartPointer<vtkActor> ActorFor(const Parts& parts, vtkPolyData* data, vtkTexture* texture,
                                     void (*make)(vtkActor*) = nullptr) const;

private:
  vtkPartsRepresentation(const vtkPartsRepresentation&) = delete;
  void operator=(const vtkPartsRepresentation&) = delete;

  bool IsColoredByArray();
  void Make(vtkDataObject* data, double time);
  void Paint(const Part& part);

  Parts Made;
  vtkSmartPointer<vtkDataObject> Of;
  double Time = 0.0;
  vtkTimeStamp MakeTime;
  vtkTimeStamp PaintTime;
};

#endif
