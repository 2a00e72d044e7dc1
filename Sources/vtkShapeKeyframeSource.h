// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkShapeKeyframeSource
 * @brief   targets that draw a text, a picture or a surface, as one keyframe
 *
 * Input port 0, Input (vtkPolyData, optional): the surface of the shape SURFACE.
 * Input port 1, Objects (vtkPolyData, optional): of them there are as many targets where
 * NumberOfTargets is 0; without them 48.
 * Output port 0, Constraints (vtkPolyData): NumberOfTargets rows for any object (`ObjectId` -1) at
 * Frame, of one `Group`, so that they go to distinct objects: rests on the first surface straight
 * below, or positions. With ClassColors the targets of a picture have the `ClassId` of the nearest
 * colour, its index in the list. `Row` is -1: a row's number is its vertex's. The field data
 * `Bounds`, `NumberOfFrames`, `FramesPerSecond`, `Seed` describe the scene.
 *
 * Texts are drawn along their middle lines where strokes are thin, pictures by brightness against
 * their background as a weighted centroidal Voronoi tessellation, surfaces evenly by area.
 */
#ifndef vtkShapeKeyframeSource_h
#define vtkShapeKeyframeSource_h

#include "WaftProperty.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace waft
{
struct FacingOptions;
struct KeyframeOptions;
struct SceneFrame;
}

class VTKWAFTSOURCES_EXPORT vtkShapeKeyframeSource : public vtkPolyDataAlgorithm
{
public:
  static vtkShapeKeyframeSource* New();
  vtkTypeMacro(vtkShapeKeyframeSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Shapes
  {
    TEXT = 0,
    IMAGE = 1,
    SURFACE = 2
  };

  WaftProperty(int, Shape);
  WaftText(Text);
  WaftText(Font);
  WaftText(ImageFile);

  ///@{
  /** Colours (red, green, blue in 0..1) of the classes of a picture's targets. */
  void SetNumberOfClassColors(int count);
  int GetNumberOfClassColors() const { return static_cast<int>(this->ClassColors.size()); }
  void SetClassColor(int index, double red, double green, double blue);
  ///@}

  WaftProperty(int, NumberOfTargets);
  WaftProperty(int, Frame);
  WaftProperty(int, FrameFrom);
  WaftProperty(int, Order);
  WaftVector(double, OrderFrom, 3);
  WaftVector(double, OrderTo, 3);
  WaftProperty(int, Leave);
  WaftProperty(int, LeaveFrame);
  WaftProperty(int, LastLeave);
  WaftProperty(int, Hold);
  WaftFlag(Drift);
  WaftProperty(int, On);
  WaftFlag(Rest);
  WaftProperty(int, Until);
  WaftProperty(double, Radius);
  WaftProperty(int, Group);
  WaftVector(double, Origin, 3);
  WaftVector(double, U, 3);
  WaftVector(double, V, 3);
  WaftOpenProperty(double, Width);
  WaftVector(double, Facing, 3);
  WaftProperty(double, FacingTolerance);
  WaftProperty(int, Seed);
  WaftVector(double, Bounds, 6);
  WaftProperty(int, NumberOfFrames);
  WaftOpenProperty(double, FramesPerSecond);

  enum Ports
  {
    INPUT_PORT,
    OBJECTS_PORT
  };
  /// Takes the input away.
  void RemoveAllObjects() { this->SetInputConnection(OBJECTS_PORT, nullptr); }

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkShapeKeyframeSource();
  ~vtkShapeKeyframeSource() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkShapeKeyframeSource(const vtkShapeKeyframeSource&) = delete;
  void operator=(const vtkShapeKeyframeSource&) = delete;

  static double InRange(const char* property, double value);

  // Whose fields the properties are.
  friend struct waft::FacingOptions;
  friend struct waft::KeyframeOptions;
  friend struct waft::SceneFrame;
  std::vector<std::array<double, 3>> ClassColors;
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

#endif
