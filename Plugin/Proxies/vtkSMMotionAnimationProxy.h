// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSMMotionAnimationProxy
 * @brief   the stages from a scene file to bodies that fly, as one source
 *
 * A compound proxy of ParaView over the stages' own proxies, which its XML names: Scene, Planner,
 * Vortices, Assimilation, Spacetime and Rotation. It holds no data and computes nothing. What a
 * compound cannot say in XML is done here whenever its properties are pushed:
 *
 * - Quality and StopAfter: which stages run (their property Active) and which output the next one
 *   takes. A stage that rests gives empty outputs. The hint Preview of AirAssimilationFilter names
 *   the values of its properties at the quality Preview.
 * - Seed goes to the planner, the assimilation and the rotation; a negative one is the scene's own.
 * - Slice goes to all stages that have it.
 * - ShowStages: the stages stand in the pipeline browser, the very ones that this source runs.
 */
#ifndef vtkSMMotionAnimationProxy_h
#define vtkSMMotionAnimationProxy_h

#include "vtkSMCompoundSourceProxy.h"
#include "vtkWaftProxiesModule.h"

#include <array>

class VTKWAFTPROXIES_EXPORT vtkSMMotionAnimationProxy : public vtkSMCompoundSourceProxy
{
public:
  static vtkSMMotionAnimationProxy* New();
  vtkTypeMacro(vtkSMMotionAnimationProxy, vtkSMCompoundSourceProxy);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Qualities
  {
    PREVIEW,
    AIR,
    ASSIMILATED = AIR, // what it was called before
    FULL,
    PAPER
  };
  enum Stops
  {
    AFTER_SCENE,
    AFTER_PLAN,
    AFTER_ASSIMILATION,
    AFTER_OPTIMISATION,
    AFTER_ALL
  };

  void UpdateVTKObjects() override;
  using Superclass::UpdatePropertyInformation;
  /// Those that are a stage's own as well.
  void UpdatePropertyInformation(vtkSMProperty* property) override;

protected:
  vtkSMMotionAnimationProxy() = default;
  ~vtkSMMotionAnimationProxy() override;

  void CreateVTKObjects() override;
  void PostUpdateData(bool usingCache) override;

private:
  vtkSMMotionAnimationProxy(const vtkSMMotionAnimationProxy&) = delete;
  void operator=(const vtkSMMotionAnimationProxy&) = delete;

  bool AreInRange(int quality, int stop);
  void Arrange(int quality, int stop);
  void SetDetail(bool isPreview);
  void SetSeed(int seed);
  void SetSlice(double seconds);
  void ShowStages(bool shown);

  std::array<int, 2> Arranged{ -1, -1 }; // quality and stop that the stages stand for
  bool AreShown = false;
};

#endif
