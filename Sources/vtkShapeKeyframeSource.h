// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkShapeKeyframeSource
 * @brief   targets that draw a text, a picture or a surface, as one keyframe
 *
 * Input port 0, Input (vtkPolyData, optional): the surface of the shape SURFACE.
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

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <array>
#include <string>
#include <vector>

namespace waft
{
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
  ///@{
  /** What is drawn: Text (0), the picture ImageFile (1) or the Input (2). */
  vtkSetClampMacro(Shape, int, TEXT, SURFACE);
  vtkGetMacro(Shape, int);
  ///@}
  ///@{
  /** A line of text. */
  vtkSetMacro(Text, std::string);
  vtkGetMacro(Text, std::string);
  ///@}
  ///@{
  /** sans, serif, mono or the path of a font file. */
  vtkSetMacro(Font, std::string);
  vtkGetMacro(Font, std::string);
  ///@}
  ///@{
  /** A picture file. */
  vtkSetMacro(ImageFile, std::string);
  vtkGetMacro(ImageFile, std::string);
  ///@}
  ///@{
  /** Colours (red, green, blue in 0..1) of the classes of a picture's targets. */
  void SetNumberOfClassColors(int count);
  int GetNumberOfClassColors() const { return static_cast<int>(this->ClassColors.size()); }
  void SetClassColor(int index, double red, double green, double blue);
  ///@}
  ///@{
  /** Targets, 1 to 100000. */
  vtkSetClampMacro(NumberOfTargets, int, 1, 100000);
  vtkGetMacro(NumberOfTargets, int);
  ///@}
  ///@{
  /** Frame of the keyframe, 0 or more. */
  vtkSetClampMacro(Frame, int, 0, VTK_INT_MAX);
  vtkGetMacro(Frame, int);
  ///@}
  ///@{
  /** True: the objects lie still on what is below; false: they pass the targets. */
  vtkSetMacro(Rest, bool);
  vtkGetMacro(Rest, bool);
  vtkBooleanMacro(Rest, bool);
  ///@}
  ///@{
  /** Rests last to this frame; -1: the scene's last. */
  vtkSetClampMacro(Until, int, -1, VTK_INT_MAX);
  vtkGetMacro(Until, int);
  ///@}
  ///@{
  /** By how much a target may be missed [m]; 0: exact. */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}
  ///@{
  /** Keyframes of different groups may go to the same objects; 0 or more. */
  vtkSetClampMacro(Group, int, 0, VTK_INT_MAX);
  vtkGetMacro(Group, int);
  ///@}
  ///@{
  /** Centre of the drawing [m]; a SURFACE stands where it is. */
  vtkSetVector3Macro(Origin, double);
  vtkGetVector3Macro(Origin, double);
  ///@}
  ///@{
  /** Direction of the drawing's width. */
  vtkSetVector3Macro(U, double);
  vtkGetVector3Macro(U, double);
  ///@}
  ///@{
  /** Direction of the drawing's height. */
  vtkSetVector3Macro(V, double);
  vtkGetVector3Macro(V, double);
  ///@}
  ///@{
  /** Width of the drawing [m], more than 0. */
  vtkSetMacro(Width, double);
  vtkGetMacro(Width, double);
  ///@}
  ///@{
  /** Seed of everything random, 0 or more. */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}
  ///@{
  /** The volume (xmin, xmax, ymin, ymax, zmin, zmax) [m]. */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}
  ///@{
  /** Frames of the scene, 1 or more. */
  vtkSetClampMacro(NumberOfFrames, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfFrames, int);
  ///@}
  ///@{
  /** Frames per second, more than 0. */
  vtkSetMacro(FramesPerSecond, double);
  vtkGetMacro(FramesPerSecond, double);
  ///@}

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkShapeKeyframeSource();
  ~vtkShapeKeyframeSource() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                         vtkInformationVector* outputs) override;
  int RequestData(vtkInformation*, vtkInformationVector** inputs,
                  vtkInformationVector* outputs) override;

private:
  vtkShapeKeyframeSource(const vtkShapeKeyframeSource&) = delete;
  void operator=(const vtkShapeKeyframeSource&) = delete;

  // The properties of the same names; what they may be is said there, and a test holds the
  // literals here against it.
  friend struct waft::KeyframeOptions;
  friend struct waft::SceneFrame;
  int Shape = TEXT;
  std::string Text = "WAFT";
  std::string Font = "sans";
  std::string ImageFile;
  std::vector<std::array<double, 3>> ClassColors;
  int NumberOfTargets = 48;
  int Frame = 250;
  bool Rest = true;
  int Until = -1;
  double Radius = 0.0;
  int Group = 0;
  double Origin[3] = { 0.0, 0.0, 0.1 };
  double U[3] = { 1.0, 0.0, 0.0 };
  double V[3] = { 0.0, 1.0, 0.0 };
  double Width = 3.4;
  int Seed = 1;
  double Bounds[6] = { -2.0, 2.0, -2.0, 2.0, 0.0, 4.0 };
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;
};

#endif
