// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMotionSceneReader
 * @brief   reads a scene file (*.waft.json, version 1)
 *
 * The format is in Documentation/SceneFiles.md, its JSON schema in Documentation/scene.schema.json.
 *
 * Output ports:
 *  - 0 Objects (vtkPolyData): one vertex per object at its start, as of vtkObjectSource.
 *  - 1 Constraints (vtkPolyData): one vertex per row with `ObjectId`, `Frame`, `Kind`, `Value`,
 *    `Radius`, `Until`, `Row`, `Target`, `Group`, `ClassId`. Texts, pictures and meshes of targets
 *    are sampled, objects in regions are spread, by the scene's seed.
 *  - 2 Obstacles (vtkPolyData, varies in time when one moves): closed surfaces with the point data
 *    `ObstacleId`; the ground is the last one.
 *  - 3 Shapes (vtkMultiBlockDataSet): one named surface per shape, on its body axes, with texture
 *    coordinates and the field data `DragCoefficient`, `AreaDensity`, `Thickness`, `SettlingSpeed`,
 *    `ClassId`, `Color`, `Texture`.
 *  - 4 Vortices (vtkPolyData): one line per vortex.
 *  - 5 Wind (vtkImageData, varies in time): `Wind` [m/s^2] or `Velocity` [m/s]; without points when
 *    the scene has no wind.
 *
 * Every output carries the field data `Bounds`, `NumberOfFrames`, `FramesPerSecond`, `AirDensity`
 * and `Seed`, and every port the frames as time steps. Every output that a section of the file made
 * (of Shapes each block, of Objects also the title) carries that section as the artist wrote it, in
 * the field data `Authored` (text): a scene file of that section alone, with names of files
 * resolved. vtkMotionSceneWriter writes it back. An error's text is `FILE: /json/pointer:
 * expected what, found what`, and all outputs are then empty.
 */
#ifndef vtkMotionSceneReader_h
#define vtkMotionSceneReader_h

#include "WaftProperty.h"
#include "vtkAlgorithm.h"
#include "vtkWaftSourcesModule.h"

#include <memory>
#include <string>

namespace waft
{
struct SceneReadOptions;
}

class VTKWAFTSOURCES_EXPORT vtkMotionSceneReader : public vtkAlgorithm
{
public:
  static vtkMotionSceneReader* New();
  vtkTypeMacro(vtkMotionSceneReader, vtkAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The output ports; those of vtkMotionSceneWriter's inputs are the same. */
  enum Ports
  {
    OBJECTS,
    CONSTRAINTS,
    OBSTACLES,
    SHAPES,
    VORTICES,
    WIND
  };

  ///@{
  /** The scene file. Setting it reads the file anew, also under the same name. */
  void SetFileName(const std::string& name);
  vtkGetMacro(FileName, std::string);
  ///@}

  WaftFlag(OnEveryRank);

  /** The seed that the scene file gives; 1 before one was read. */
  int GetSceneSeed() const;

  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                             vtkInformationVector* outputs) override;

protected:
  vtkMotionSceneReader();
  ~vtkMotionSceneReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;

private:
  int Process(vtkInformation* request, vtkInformationVector** inputs,
              vtkInformationVector* outputs);
  vtkMotionSceneReader(const vtkMotionSceneReader&) = delete;
  void operator=(const vtkMotionSceneReader&) = delete;

  int RequestInformation(vtkInformationVector* outputs);
  int RequestData(vtkInformation* request, vtkInformationVector* outputs);

  struct Contents;
  std::unique_ptr<Contents> Read;
  // Whose fields the properties are.
  friend struct waft::SceneReadOptions;
  std::string FileName;
};

#endif
