// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/SceneOutput.h"

#include "Base/AtomicFile.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Files/FileWriting.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Files/WrittenMark.h"
#include "Scene/SceneWind.h"
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
  writer->SetDataModeToBinary(); // the text stays XML
  writer->Write();
  return writer->GetOutputString();
}

std::string MeshFileOf(const Scene& scene, const SceneMeshFile& file)
{
  Shape shape; // of an obstacle only the mesh matters
  if (file.IsShape)
  {
    shape = scene.Shapes[file.Index];
  }
  else
  {
    shape.Mesh = scene.Obstacles[file.Index].Mesh;
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
  FieldSeriesToImage(scene.Wind, scene.Wind.Times[step], scene.Parts.Info, image);
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

/// Puts the authored winds where they still make the field in hand; else there is the field alone.
void FindAuthoredWinds(SceneContents& scene)
{
  Scene authored;
  SceneWind wind;
  const std::string& part = scene.Parts.Authored.Winds;
  if (part.empty() || !ParseScene(part, {}, {}, VtkSceneAssets(), authored))
  {
    return;
  }
  authored.Info = scene.Parts.Info;
  if (wind.Build(authored, VtkSceneAssets()) && wind.Makes(scene.Wind))
  {
    scene.Parts.Winds = std::move(authored.Winds);
    scene.Parts.Fronts = std::move(authored.Fronts);
    scene.Parts.WindFiles = std::move(authored.WindFiles);
  }
}

/// All files of a scene, itself the last, when those beside it are called by this stem.
Result MakeFiles(SceneContents scene, const std::string& folder, const std::string& fileName,
                 const std::string& stem, std::vector<FileContent>& files,
                 std::vector<std::string>& named)
{
  files.clear();
  Scene& parts = scene.Parts;
  if (!scene.Wind.IsEmpty() && parts.Winds.empty() && parts.Fronts.empty() &&
      parts.WindFiles.empty())
  {
    parts.WindFiles.emplace_back();
    parts.WindFiles.back().Path = AddWind(scene, folder, stem, files);
  }
  SceneText text;
  WAFT_RETURN_IF_FAILED(FormatScene(parts, VtkSceneAssets(), folder, stem, text));
  for (const SceneMeshFile& mesh : text.Meshes)
  {
    files.push_back({ folder + mesh.Name, MeshFileOf(parts, mesh) });
  }
  for (FileContent& file : files)
  {
    file.Bytes += WrittenMark(file.Bytes);
  }
  for (const SceneSkinFile& skin : text.Skins)
  {
    files.push_back({ folder + skin.Name, MarkedPng(parts.Shapes[skin.Index].Skin) });
  }
  files.push_back({ fileName, text.Json });
  named = text.NamedFiles;
  return Result::Ok();
}

/// The first of the files beside a scene whose name is taken; an empty text when all are free.
std::string TakenName(const std::vector<FileContent>& files, const std::vector<std::string>& named)
{
  namespace fs = std::filesystem;
  for (std::size_t i = 0; i + 1 < files.size(); ++i)
  {
    std::error_code error;
    const std::string& path = files[i].Path;
    const std::string whole = fs::absolute(path, error).lexically_normal().string();
    const bool isNamed = std::find(named.begin(), named.end(), whole) != named.end();
    if (isNamed || (fs::exists(fs::symlink_status(path, error)) && !IsMarkedAsWritten(path)))
    {
      return path;
    }
  }
  return {};
}

Result CheckNameOf(const std::string& fileName)
{
  std::error_code error;
  if (!std::filesystem::exists(fileName, error) || IsSceneFile(fileName))
  {
    return Result::Ok();
  }
  return Result::Error(fileName + ": nothing was written: expected a new name or a scene file, "
                                  "found something else of this name, which is left alone");
}

} // namespace

Result WriteSceneFiles(const SceneContents& scene, const std::string& fileName,
                       std::vector<std::string>& remarks)
{
  const std::filesystem::path path(fileName);
  const std::string stem = StemOf(path.filename().string());
  if (stem.empty())
  {
    return WrongEnding(fileName, ".waft.json");
  }
  WAFT_RETURN_IF_FAILED(CheckNameOf(fileName));
  std::string folder = path.parent_path().string();
  folder += folder.empty() ? "" : "/";
  SceneContents whole = scene;
  if (whole.Parts.Shapes.empty() && !whole.Parts.Objects.empty())
  {
    WAFT_RETURN_IF_FAILED(AddDisc(whole.Parts));
  }
  FindAuthoredWinds(whole);
  std::vector<FileContent> files;
  std::string taken, freeStem = stem;
  for (int k = 2;; ++k)
  {
    std::vector<std::string> named;
    const Result made = MakeFiles(whole, folder, fileName, freeStem, files, named);
    if (!made)
    {
      return Result::Error(fileName + ": nothing was written: " + made.Message());
    }
    const std::string inTheWay = TakenName(files, named);
    if (inTheWay.empty())
    {
      break;
    }
    taken = taken.empty() ? inTheWay : taken;
    freeStem = stem + "-" + std::to_string(k);
  }
  if (!taken.empty())
  {
    remarks.push_back("\"" + taken +
                      "\" is left alone, since no writing of this scene made it as it "
                      "is, or the scene names it: the files beside the scene are called " +
                      freeStem + ".*");
  }
  return WriteWholeFiles(files);
}

} // namespace waft
