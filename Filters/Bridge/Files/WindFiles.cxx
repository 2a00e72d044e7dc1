// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/WindFiles.h"

#include "Base/Limits.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/FileReading.h"
#include "Files/FileBytes.h"
#include "Files/XmlTags.h"
#include "Volumes/VectorVolume.h"
#include "Volumes/VolumeSeries.h"

#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>
#include <vector>

namespace waft
{
namespace
{

Result AddWindStep(const std::string& path, double time, FieldCollector& collector)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
  {
    return Result::Error("expected a file that exists, found none at \"" + path + "\"");
  }
  vtkNew<vtkImageData> image;
  Result result = ReadImageFile(path, image);
  result = result ? collector.Add(image, time) : result;
  return result ? result : Result::Error("\"" + path + "\": " + result.Message());
}

// The steps of a .pvd in the order of their times, whatever that of the entries is.
Result PvdSteps(const std::string& path, std::vector<std::pair<double, std::string>>& steps)
{
  FileBytes file;
  WAFT_RETURN_IF_FAILED(file.Open(path));
  XmlTags tags(file.View());
  XmlTag tag;
  bool isCollection = false;
  bool isWhole = false;
  while (tags.Next(tag))
  {
    isCollection = isCollection || (tag.IsOpening && tag.Name == "Collection");
    isWhole = isWhole || (tag.IsClosing && tag.Name == "VTKFile");
    if (!isCollection || !tag.IsOpening || tag.Name != "DataSet")
    {
      continue;
    }
    const std::string name = Unescaped(tag.Attribute("file"));
    if (Extension(name) != ".vti")
    {
      return Result::Error("expected .vti files in the collection, found " + Quoted(name));
    }
    const std::string_view text = tag.Attribute("timestep");
    auto time = static_cast<double>(steps.size());
    if (tag.Has("timestep") && (!ParseNumber(text, time) || !limits::Time.Holds(time)))
    {
      return Result::Error(Quoted(name) + ": expected a timestep that is " + limits::Time.Text() +
                           ", found " + Quoted(text));
    }
    steps.emplace_back(time, (std::filesystem::path(path).parent_path() / name).string());
  }
  if (!isCollection || !isWhole || tags.IsBroken())
  {
    return Result::Error("expected a whole ParaView collection of .vti files, found " +
                         std::string(isCollection ? "a cut or damaged one" : "none"));
  }
  if (steps.empty())
  {
    return Result::Error("expected at least one file in the collection, found none");
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto twice = std::adjacent_find(
    steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.first == b.first; });
  return twice == steps.end() ? Result::Ok()
                              : Result::Error("expected one file a timestep, found two at " +
                                              NumberText(twice->first, 10) + " s");
}

// The series that begins with a file: those of lower numbers may be of another year.
std::vector<std::pair<int, std::string>> SeriesFrom(const std::string& path)
{
  std::vector<std::pair<int, std::string>> files = SeriesFiles(path);
  const auto name = [](const std::string& file) { return std::filesystem::path(file).filename(); };
  const auto first =
    std::find_if(files.begin(), files.end(),
                 [&](const auto& entry) { return name(entry.second) == name(path); });
  files.erase(files.begin(), first == files.end() ? files.begin() : first);
  return files;
}

// The volume in the axes of a file.
Box InAxesOf(const WindFile& file, const Box& volume)
{
  return file.IsYUp ? Box{ { volume.Min.x(), volume.Min.z(), -volume.Max.y() },
                           { volume.Max.x(), volume.Max.z(), -volume.Min.y() } }
                    : volume;
}

Result ReadVolumes(const WindFile& file, const SceneInfo& scene, FieldSeries& wind)
{
  const std::vector<std::pair<int, std::string>> files = SeriesFrom(file.Path);
  return files.empty()
           ? Result::Error("expected a .vdb file that can be read, found none")
           : ReadVectorVolumes(files, file.Array, scene.Time, InAxesOf(file, scene.Bounds), wind);
}

constexpr std::size_t MostSteps = 10000; // of a series that are read

// Seconds by which a series is moved.
double ShiftOf(const WindFile& file, const SceneInfo& scene, double first)
{
  return file.FirstFrame ? scene.Time.Time(*file.FirstFrame) - first : 0.0;
}

// Leaves out what comes after the first step past the scene's end.
Result CutAtEnd(const WindFile& file, const SceneInfo& scene,
                std::vector<std::pair<double, std::string>>& steps)
{
  const double end =
    scene.Time.Time(scene.Time.NumberOfFrames - 1) - ShiftOf(file, scene, steps.front().first);
  const auto past =
    std::find_if(steps.begin(), steps.end(), [end](const auto& step) { return step.first >= end; });
  steps.erase(past == steps.end() ? past : past + 1, steps.end());
  return steps.size() <= MostSteps ? Result::Ok()
                                   : Result::Error("expected at most " + std::to_string(MostSteps) +
                                                   " files up to the end of the scene, found " +
                                                   std::to_string(steps.size()));
}

Result ReadImages(const WindFile& file, const std::string& extension, const SceneInfo& scene,
                  FieldSeries& wind)
{
  std::vector<std::pair<double, std::string>> steps;
  if (extension == ".vti")
  {
    steps.emplace_back(0.0, file.Path);
  }
  else
  {
    WAFT_RETURN_IF_FAILED(PvdSteps(file.Path, steps));
    WAFT_RETURN_IF_FAILED(CutAtEnd(file, scene, steps));
  }
  FieldCollector collector(FieldRole::WindFile, file.Array);
  for (const auto& [time, image] : steps)
  {
    WAFT_RETURN_IF_FAILED(AddWindStep(image, time, collector));
  }
  wind = collector.Take();
  return Result::Ok();
}

// A point (x, y, z) of a file whose y axis is up is (x, -z, y), and so is a vector.
void TurnYUp(FieldSeries& wind)
{
  const std::array<int, 3> n = wind.Dimensions;
  const Vec3 last = wind.Origin + Vec3(n[0] - 1, n[1] - 1, n[2] - 1).cwiseProduct(wind.Spacing);
  for (FieldSeries::Field& values : wind.Values)
  {
    FieldSeries::Field turned;
    turned.reserve(values.size());
    for (int j = 0; j < n[1]; ++j)
    {
      for (int k = n[2] - 1; k >= 0; --k)
      {
        for (int i = 0; i < n[0]; ++i)
        {
          const auto& v = values[(static_cast<std::size_t>(k) * n[1] + j) * n[0] + i];
          turned.push_back({ v[0], -v[2], v[1] });
        }
      }
    }
    values = std::move(turned);
  }
  wind.Dimensions = { n[0], n[2], n[1] };
  wind.Origin = Vec3(wind.Origin.x(), -last.z(), wind.Origin.y());
  wind.Spacing = Vec3(wind.Spacing.x(), wind.Spacing.z(), wind.Spacing.y());
}

} // namespace

Result ReadWindFile(const WindFile& file, const SceneInfo& scene, FieldSeries& wind)
{
  const std::string extension = Extension(file.Path);
  if (extension != ".vdb" && extension != ".vti" && extension != ".pvd")
  {
    return Result::Error("expected a .vti, .pvd or .vdb file, found \"" + extension + "\"");
  }
  FieldSeries read;
  WAFT_RETURN_IF_FAILED(extension == ".vdb" ? ReadVolumes(file, scene, read)
                                            : ReadImages(file, extension, scene, read));
  if (file.IsYUp)
  {
    TurnYUp(read);
  }
  const double shift = ShiftOf(file, scene, read.Times.front());
  for (double& time : read.Times)
  {
    time += shift;
  }
  for (FieldSeries::Field& values : read.Values)
  {
    for (std::array<float, 3>& value : values)
    {
      for (float& number : value)
      {
        number = static_cast<float>(file.Scale * number);
      }
    }
  }
  WAFT_RETURN_IF_FAILED(read.Validate("Wind"));
  wind = std::move(read);
  return Result::Ok();
}

} // namespace waft
