// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/SceneOutput.h"

#include "Base/AtomicFile.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Files/FileWriting.h"
#include "Bridge/Files/SceneFiles.h"
#include "Scene/WriteScene.h"
#include "Shapes/ThinShape.h"

#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace waft
{
namespace
{

constexpr const char* Extensions[] = { ".waft.json", ".json" };

/// The file's name without its extension; an empty text when it has another one.
std::string StemOf(const std::string& name)
{
  for (const std::string extension : Extensions)
  {
    if (HasEnding(name, extension))
    {
      return name.substr(0, name.size() - extension.size());
    }
  }
  return {};
}

template <typename Writer>
std::string XmlOf(vtkDataObject* data)
{
  vtkNew<Writer> writer;
  writer->SetInputDataObject(data);
  writer->SetWriteToOutputString(true);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn(); // the text stays XML
  writer->Write();
  return writer->GetOutputString();
}

std::string MeshFileOf(const Scene& scene, const SceneMeshFile& file)
{
  Shape shape; // of an obstacle only the mesh matters
  if (file.IsShape)
  {
    shape = scene.Shapes[file.Place];
  }
  else
  {
    shape.Mesh = scene.Obstacles[file.Place].Mesh;
  }
  vtkNew<vtkMultiBlockDataSet> blocks;
  ShapesToMultiBlock({ shape }, scene.Info, blocks);
  vtkNew<vtkPolyData> surface;
  surface->ShallowCopy(blocks->GetBlock(0));
  surface->GetFieldData()->Initialize(); // the numbers are in the scene file
  return XmlOf<vtkXMLPolyDataWriter>(surface);
}

std::string WindStep(const SceneContents& scene, std::size_t step)
{
  vtkNew<vtkImageData> image;
  StepToImage(scene.Wind, step, scene.Parts.Info, image);
  return XmlOf<vtkXMLImageDataWriter>(image);
}

/// Adds the files of the wind; returns the name that the scene file says.
std::string AddWind(const SceneContents& scene, const std::string& folder, const std::string& stem,
                    std::vector<FileContent>& files)
{
  const FieldSeries& wind = scene.Wind;
  const bool isSteady = std::all_of(wind.Values.begin(), wind.Values.end(),
                                    [&](const auto& step) { return step == wind.Values[0]; });
  const std::string name = stem + ".wind";
  if (isSteady)
  {
    files.push_back({ folder + name + ".vti", WindStep(scene, 0) });
    return name + ".vti";
  }
  std::string list =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (std::size_t step = 0; step < wind.Times.size(); ++step)
  {
    char file[32];
    std::snprintf(file, sizeof(file), "/wind_%04d.vti", static_cast<int>(step));
    char time[40];
    std::snprintf(time, sizeof(time), "%.17g", wind.Times[step]);
    files.push_back({ folder + name + file, WindStep(scene, step) });
    list += std::string("    <DataSet timestep=\"") + time + "\" part=\"0\" file=\"" + name + file +
            "\"/>\n";
  }
  files.push_back({ folder + name + ".pvd", list + "  </Collection>\n</VTKFile>\n" });
  return name + ".pvd";
}

/// A body for objects that have none: the file format knows no objects without a shape.
Result AddDisc(Scene& scene)
{
  const MotionObject& first = scene.Objects.front();
  Shape disc;
  WAFT_RETURN_IF_FAILED(MakeBuiltinShape("disc", 2.0 * first.ClearanceRadius, disc));
  disc.ClassId = -1;
  scene.Shapes.push_back(std::move(disc));
  return Result::Ok();
}

} // namespace

Result WriteSceneFiles(const SceneContents& scene, const std::string& fileName)
{
  const std::filesystem::path path(fileName);
  const std::string stem = StemOf(path.filename().string());
  if (stem.empty())
  {
    return WrongEnding(fileName, ".waft.json");
  }
  std::string folder = path.parent_path().string();
  folder += folder.empty() ? "" : "/";
  SceneContents whole = scene;
  if (whole.Parts.Shapes.empty() && !whole.Parts.Objects.empty())
  {
    WAFT_RETURN_IF_FAILED(AddDisc(whole.Parts));
  }
  std::vector<FileContent> files;
  if (!whole.Wind.IsEmpty())
  {
    whole.Parts.WindFiles = { { AddWind(whole, folder, stem, files), {} } };
  }
  SceneText text;
  const Result formatted = FormatScene(whole.Parts, VtkSceneAssets(), folder, stem, text);
  if (!formatted)
  {
    return Result::Error(fileName + ": nothing was written: " + formatted.Message());
  }
  for (const SceneMeshFile& mesh : text.Meshes)
  {
    files.push_back({ folder + mesh.Name, MeshFileOf(whole.Parts, mesh) });
  }
  files.push_back({ fileName, text.Json });
  return WriteWholeFiles(files);
}

} // namespace waft
