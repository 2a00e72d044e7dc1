// SPDX-License-Identifier: BSD-3-Clause
// Prints what the options structs of Core say of their fields, by the class of the pipeline that
// has them as its properties, as JSON.
#include "Air/Run/AirAssimilation.h"
#include "Base/SliceOptions.h"
#include "Chain/ChainOptions.h"
#include "Database/DatabaseBuild.h"
#include "Export/AnimationOptions.h"
#include "Planning/Takes.h"
#include "Rotation/RotationRefine.h"
#include "Scene/ConstraintOptions.h"
#include "Scene/ForceOptions.h"
#include "Scene/KeyframeOptions.h"
#include "Scene/ObjectOptions.h"
#include "Scene/ObstacleOptions.h"
#include "Scene/SceneFileOptions.h"
#include "Shapes/Photograph.h"
#include "Shapes/TextureImage.h"
#include "Shapes/ThinShape.h"
#include "Spacetime/Run/Spacetime.h"
#include "Trajectory/TrajectoryClusters.h"
#include "Trajectory/TrajectoryTracer.h"
#include "Volumes/VolumeOptions.h"
#include "Vortex/VortexFit.h"

#include <nlohmann/json.hpp>

#include <iostream>
#include <iterator>
#include <type_traits>
#include <utility>

namespace
{

/// Of its numbers: "flag", "whole", "real"; or "text".
template <class Value>
const char* TypeOf()
{
  if constexpr (std::is_same_v<Value, std::string>)
  {
    return "text";
  }
  else if constexpr (std::is_same_v<Value, waft::Box>)
  {
    return "real";
  }
  else if constexpr (waft::IsNumber<Value>)
  {
    return std::is_same_v<Value, bool>       ? "flag"
           : std::is_floating_point_v<Value> ? "real"
                                             : "whole";
  }
  else
  {
    return TypeOf<std::decay_t<decltype(*std::begin(std::declval<Value&>()))>>();
  }
}

template <class... Options>
nlohmann::json FieldsOf(const Options&... options)
{
  auto fields = nlohmann::json::array();
  const auto add = [&fields](const waft::OptionField& field, const auto& value)
  {
    using Value = std::decay_t<decltype(value)>;
    nlohmann::json said{ { "name", field.Name },
                         { "sentence", field.Sentence },
                         { "text", field.Text() },
                         { "type", TypeOf<Value>() } };
    if constexpr (std::is_same_v<Value, std::string>)
    {
      said["default"] = value;
    }
    else
    {
      const std::vector<double> numbers = waft::NumbersOf(value);
      said["default"] =
        waft::IsNumber<Value> ? nlohmann::json(numbers[0]) : nlohmann::json(numbers);
      said["range"] = { field.Range.Low, field.Range.High };
      said["offered"] = { field.Offered.Low, field.Offered.High };
    }
    if (*field.Unset)
    {
      said["unset"] = field.Unset;
    }
    if (*field.Input)
    {
      said["acts"] = { { "input", field.Input }, { "joined", field.ActsWhereJoined } };
    }
    fields.push_back(said);
  };
  (Options::Visit(add, options), ...);
  return fields;
}

} // namespace

int main()
{
  const waft::SceneFrame frame;
  const nlohmann::json classes{
    { "vtkConstraintSource", FieldsOf(waft::ConstraintOptions()) },
    { "vtkFeatherShapeSource", FieldsOf(waft::FeatherForm(), waft::FeatherSheet(),
                                        waft::FeatherBody(), waft::FeatherSkin(), frame) },
    { "vtkLeafShapeSource", FieldsOf(waft::LeafForm(), waft::SheetOptions(), waft::ThinBody(),
                                     waft::SkinOptions(), frame) },
    { "vtkMotionAnimationSource",
      FieldsOf(waft::FlightOptions(), waft::TakeOptions(), waft::SliceOptions()) },
    { "vtkMotionAnimationWriter", FieldsOf(waft::AnimationOptions()) },
    { "vtkMotionSceneFileWriter", FieldsOf(waft::SceneSaveOptions()) },
    { "vtkMotionSceneReader", FieldsOf(waft::SceneReadOptions()) },
    { "vtkMotionSceneWriter", FieldsOf(waft::SceneWriteOptions()) },
    { "vtkObjectSource", FieldsOf(waft::ObjectOptions()) },
    { "vtkObstacleSource", FieldsOf(waft::ObstacleSourceOptions()) },
    { "vtkPhotographShapeSource",
      FieldsOf(waft::PhotographFile(), waft::PhotographOptions(), waft::ThinBody(), frame) },
    { "vtkShapeKeyframeSource", FieldsOf(waft::KeyframeOptions()) },
    { "vtkVDBReader", FieldsOf(waft::VolumeReadOptions()) },
    { "vtkVDBWriter", FieldsOf(waft::VolumeWriteOptions()) },
    { "vtkVortexSource", FieldsOf(waft::VortexSourceOptions()) },
    { "vtkWindSource", FieldsOf(waft::WindSourceOptions()) },
    { "vtkGridSmokeSource",
      FieldsOf(waft::SmokeOptions(), waft::EnsembleOptions(), waft::SliceOptions()) },
    { "vtkMotionDatabaseSource", FieldsOf(waft::DatabaseOptions(), waft::SliceOptions()) },
    { "vtkRotationRefineFilter", FieldsOf(waft::RotationOptions(), waft::SliceOptions()) },
    { "vtkAirAssimilationFilter",
      FieldsOf(waft::AssimilationOptions(), waft::TurningOptions(), waft::SliceOptions()) },
    { "vtkSPHSpacetimeFilter", FieldsOf(waft::SpacetimeOptions(), waft::SliceOptions()) },
    { "vtkStylisticPlannerFilter",
      FieldsOf(waft::PlanOptions(), waft::TakeOptions(), waft::SliceOptions()) },
    { "vtkTrajectoryClusterFilter",
      FieldsOf(waft::ClusterOptions(), waft::SegmentationOptions(), waft::ClusterTreeOptions(),
               waft::ConnectionOptions(), waft::SliceOptions()) },
    { "vtkTrajectoryTraceFilter",
      FieldsOf(waft::TraceOptions(), waft::AnnotationOptions(), waft::SliceOptions()) },
    { "vtkVortexFitFilter", FieldsOf(waft::VortexFitOptions()) },
  };
  std::cout << classes.dump(1) << "\n";
  return 0;
}
