// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMMotionAnimationProxy
 * @brief   a source of all stages, and the stages made from it
 *
 * The source runs by itself (vtkMotionAnimationSource). What ParaView's client has to do for it is
 * here. With the property Unfold the stages become sources and filters of their own, joined as the
 * table of the chain has it and set as the source is. They give the same bytes, and nothing links
 * them back. ShowStages, what it was called before, does the same.
 */
#ifndef vtkSMMotionAnimationProxy_h
#define vtkSMMotionAnimationProxy_h

#include "vtkSMSourceProxy.h"
#include "vtkWaftProxiesModule.h"

#include <string>

class VTKWAFTPROXIES_EXPORT vtkSMMotionAnimationProxy : public vtkSMSourceProxy
{
public:
  static vtkSMMotionAnimationProxy* New();
  vtkTypeMacro(vtkSMMotionAnimationProxy, vtkSMSourceProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void UpdateVTKObjects() override;
  /// Says of a state from before, once, what it holds nothing of.
  void UpdatePipelineInformation() override;
  /// A state keeps the flight, too.
  vtkPVXMLElement* SaveXMLState(vtkPVXMLElement* root) override;
  int LoadXMLState(vtkPVXMLElement* element, vtkSMProxyLocator* locator) override;
  /// ParaView's own ends the process where a source has more than ten ports.
  void CreateSelectionProxies() override;

protected:
  vtkSMMotionAnimationProxy() = default;
  ~vtkSMMotionAnimationProxy() override;

  void PostUpdateData(bool usingCache) override;

private:
  vtkSMMotionAnimationProxy(const vtkSMMotionAnimationProxy&) = delete;
  void operator=(const vtkSMMotionAnimationProxy&) = delete;

  /// Whether a property that asks for it is set, which it is then no more.
  bool TakeRequest();
  void Unfold();
  /// Edits are those of one file: another one has none, unless they come along.
  void KeepEditsOfFile();

  std::string FileBefore, EditsBefore;
  bool IsOfBefore = false; // it was loaded from a state of an earlier version
};

#endif
