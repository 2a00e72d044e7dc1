// SPDX-License-Identifier: BSD-3-Clause
// A small scene with a moving obstacle and all stages from its file to posed meshes.
#pragma once

#include "Base/TemporaryFolder.h"

#include <vtkAirAssimilationFilter.h>
#include <vtkMotionSceneReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRotationRefineFilter.h>
#include <vtkSPHSpacetimeFilter.h>
#include <vtkStylisticPlannerFilter.h>
#include <vtkXMLMultiBlockDataReader.h>

#include <string>
#include <vector>

/// Every stage takes all it can from the reader itself (the wind: see BlowWind); planning uses the
/// database of the project.
struct SceneChain
{
  waft::test::TemporaryFolder Folder;
  vtkNew<vtkMotionSceneReader> Reader;
  vtkNew<vtkXMLMultiBlockDataReader> Database;
  vtkNew<vtkStylisticPlannerFilter> Planner;
  vtkNew<vtkSPHSpacetimeFilter> Spacetime;
  vtkNew<vtkRotationRefineFilter> Rotation;

  explicit SceneChain(const std::string& scene)
  {
    this->Reader->SetFileName(this->Folder.Write("scene.waft.json", scene));
    this->Database->SetFileName(WAFT_SOURCE_DIR "/Data/Database/embedded.vtm");
    const auto fromReader = [this](vtkAlgorithm* stage, int port, int what)
    { stage->SetInputConnection(port, this->Reader->GetOutputPort(what)); };

    this->Planner->SetInputConnection(0, this->Database->GetOutputPort());
    fromReader(this->Planner, 1, vtkMotionSceneReader::OBJECTS);
    fromReader(this->Planner, 2, vtkMotionSceneReader::CONSTRAINTS);
    fromReader(this->Planner, 3, vtkMotionSceneReader::OBSTACLES);

    this->Spacetime->SetInputConnection(0, this->Planner->GetOutputPort(0));
    fromReader(this->Spacetime, 1, vtkMotionSceneReader::OBJECTS);
    this->Spacetime->SetInputConnection(2, this->Planner->GetOutputPort(3));
    fromReader(this->Spacetime, 3, vtkMotionSceneReader::OBSTACLES);
    fromReader(this->Spacetime, 4, vtkMotionSceneReader::VORTICES);
    this->Spacetime->SetNumberOfGasParticles(343);
    this->Spacetime->SetNumberOfObjectParticles(6);
    this->Spacetime->SetPasses(1);
    this->Spacetime->SetLeashIterations(4);
    this->Spacetime->SetMaximumNumberOfIterations(15);

    this->Rotation->SetInputConnection(0, this->Spacetime->GetOutputPort(0));
    fromReader(this->Rotation, 1, vtkMotionSceneReader::OBJECTS);
    fromReader(this->Rotation, 2, vtkMotionSceneReader::SHAPES);
    fromReader(this->Rotation, 3, vtkMotionSceneReader::OBSTACLES);
    this->Rotation->SetInputConnection(5, this->Planner->GetOutputPort(3));
  }

  /// Of a scene that has winds: the optimiser and the turning objects feel them.
  void BlowWind()
  {
    this->Spacetime->SetInputConnection(5, this->Reader->GetOutputPort(vtkMotionSceneReader::WIND));
    this->Rotation->SetInputConnection(4, this->Reader->GetOutputPort(vtkMotionSceneReader::WIND));
  }

  std::vector<vtkAlgorithm*> Stages() const
  {
    return { this->Reader, this->Planner, this->Spacetime, this->Rotation };
  }

  static vtkPolyData* Poly(vtkAlgorithm* stage, int port)
  {
    return vtkPolyData::SafeDownCast(stage->GetOutputDataObject(port));
  }
};

/// The same with a coarse assimilation, which the optimiser goes on from.
struct AssimilatedChain : SceneChain
{
  vtkNew<vtkAirAssimilationFilter> Assimilation;

  explicit AssimilatedChain(const std::string& scene) : SceneChain(scene)
  {
    this->Assimilation->SetInputConnection(0, this->Planner->GetOutputPort(0));
    this->Assimilation->SetInputConnection(
      1, this->Reader->GetOutputPort(vtkMotionSceneReader::OBJECTS));
    this->Assimilation->SetInputConnection(2, this->Planner->GetOutputPort(3));
    this->Assimilation->SetInputConnection(
      3, this->Reader->GetOutputPort(vtkMotionSceneReader::OBSTACLES));
    this->Assimilation->SetResolution(16);
    this->Assimilation->SetLatticeResolution(12);
    this->Assimilation->SetRounds(1);
    this->Assimilation->SetCandidates(1);
    this->Assimilation->SetStarts(0);
    this->Assimilation->SetWindRounds(2);
    this->Spacetime->SetInputConnection(0, this->Assimilation->GetOutputPort(0));
    this->Spacetime->SetInputConnection(6, this->Assimilation->GetOutputPort(1));
  }

  /// The air feels the wind, too.
  void BlowWind()
  {
    this->SceneChain::BlowWind();
    this->Assimilation->SetInputConnection(4,
                                           this->Reader->GetOutputPort(vtkMotionSceneReader::WIND));
  }
};
