// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMMotionRepresentationProxy
 * @brief   a representation of ParaView that begins with a look of its own
 *
 * Its XML names the look, by hints FirstPicture, of which the first counts whose array `color` is
 * there, and as a vector not zero everywhere: the attributes `color` (an array) and `of` (POINTS or
 * CELLS), `colors` (red, green and blue from the least to the largest value, for an array that was
 * never mapped), `type` (of the representation) and a nested Property, name and value, for each
 * property that differs from ParaView's default. The look is put on once, when there are first
 * points to show, one with the attribute `until` until another counts; what is loaded from a state
 * or set later stays. Where no hint counts, data look as ParaView has it.
 */
#ifndef vtkSMMotionRepresentationProxy_h
#define vtkSMMotionRepresentationProxy_h

#include "vtkSMPVRepresentationProxy.h"
#include "vtkWaftProxiesModule.h"

#include <string>

class vtkPVDataInformation;
class vtkPVXMLElement;

class VTKWAFTPROXIES_EXPORT vtkSMMotionRepresentationProxy : public vtkSMPVRepresentationProxy
{
public:
  static vtkSMMotionRepresentationProxy* New();
  vtkTypeMacro(vtkSMMotionRepresentationProxy, vtkSMPVRepresentationProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void UpdateVTKObjects() override;
  using Superclass::SetScalarBarVisibility;
  /// Numbers of things are no measure, and colours that are taken as they are have none: no bar is
  /// shown for either.
  bool SetScalarBarVisibility(vtkSMProxy* view, bool visible) override;
  /// Takes away a bar that was shown for them all the same.
  void ViewUpdated(vtkSMProxy* view) override;
  int LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator) override;

protected:
  vtkSMMotionRepresentationProxy() = default;
  ~vtkSMMotionRepresentationProxy() override;

private:
  vtkSMMotionRepresentationProxy(const vtkSMMotionRepresentationProxy&) = delete;
  void operator=(const vtkSMMotionRepresentationProxy&) = delete;

  vtkPVDataInformation* Shown();
  vtkPVXMLElement* LookFor(vtkPVDataInformation* data);
  void PutOn(vtkPVXMLElement* look);
  void TakeColorsAsTheyAre();
  std::string ColorArray();
  bool ShowsMeasure();

  bool HasLook = false;
  bool WasEmpty = false;           // when it was made: its data come later
  vtkPVXMLElement* Look = nullptr; // of the hints
  std::string Colored;             // the array of which was last seen that it colours
};

#endif
