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

// The steps of a .pvd, times increasing.
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
    if (!steps.empty() && time <= steps.back().first)
    {
      return Result::Error(Quoted(name) + ": expected timesteps that increase, found " +
                           NumberText(time, 10) + " s after " + NumberText(steps.back().first, 10) +
                           " s");
    }
    steps.emplace_back(time, (std::filesystem::path(path).parent_path() / name).string());
  }
  if (!isCollection || !isWhole || tags.IsBroken())
  {
    return Result::Error("expected a whole ParaView collection of .vti files, found " +
                         std::string(isCollection ? "a cut or damaged one" : "none"));
  }
  return steps.empty() ? Result::Error("expected at least one file in the collection, found none")
                       : Result::Ok();
}

// The one step of a field on another lattice, zero outside its own box.
FieldSeries OnLatticeOf(const FieldSeries& lattice, const FieldSeries& step)
{
  FieldSeries moved = lattice;
  moved.Times = step.Times;
  moved.Values.assign(1, {});
  const Box box{ step.Origin, step.Origin + Vec3(step.Dimensions[0] - 1, step.Dimensions[1] - 1,
                                                 step.Dimensions[2] - 1)
                                              .cwiseProduct(step.Spacing) };
  for (int k = 0; k < lattice.Dimensions[2]; ++k)
  {
    for (int j = 0; j < lattice.Dimensions[1]; ++j)
    {
      for (int i = 0; i < lattice.Dimensions[0]; ++i)
      {
        const Vec3 x = lattice.Origin + Vec3(i, j, k).cwiseProduct(lattice.Spacing);
        const bool isInside = box.InnerDistance(x) > -1e-9;
        const Vec3 v = isInside ? step.Sample(x, step.Times[0]) : Vec3(Vec3::Zero());
        moved.Values[0].push_back({ float(v.x()), float(v.y()), float(v.z()) });
      }
    }
  }
  return moved;
}

Result ReadVdbSeries(const std::string& path, const Timeline& line, FieldSeries& wind)
{
  FieldSeries series;
  for (const auto& [frame, file] : SeriesFiles(path))
  {
    FieldSeries step;
    Result result = ReadVectorVolume(file, line.Time(frame), step);
    if (!result)
    {
      return Result::Error(file + ": " + result.Message());
    }
    if (series.IsEmpty())
    {
      series = std::move(step);
      continue;
    }
    if (step.Times[0] == series.Times.back())
    {
      return Result::Error(file + ": expected one file a frame, found two");
    }
    if (step.Meaning != series.Meaning)
    {
      return Result::Error(file + ": expected the grid of the first file of the series");
    }
    // The box of active voxels may differ from file to file: each is sampled on the first one's.
    if (step.Dimensions != series.Dimensions || step.Origin != series.Origin ||
        step.Spacing != series.Spacing)
    {
      step = OnLatticeOf(series, step);
    }
    series.Times.push_back(step.Times[0]);
    series.Values.push_back(std::move(step.Values[0]));
  }
  if (series.IsEmpty())
  {
    return Result::Error("expected a .vdb file that can be read, found none");
  }
  wind = std::move(series);
  return wind.Validate("Wind");
}

} // namespace

Result ReadWindFile(const std::string& path, const Timeline& line, FieldSeries& wind)
{
  const std::string extension = Extension(path);
  if (extension == ".vdb")
  {
    return ReadVdbSeries(path, line, wind);
  }
  std::vector<std::pair<double, std::string>> steps;
  if (extension == ".vti")
  {
    steps.emplace_back(0.0, path);
  }
  else if (extension == ".pvd")
  {
    Result result = PvdSteps(path, steps);
    if (!result)
    {
      return result;
    }
  }
  else
  {
    return Result::Error("expected a .vti, .pvd or .vdb file, found \"" + extension + "\"");
  }
  FieldCollector collector;
  for (const auto& [time, file] : steps)
  {
    Result result = AddWindStep(file, time, collector);
    if (!result)
    {
      return result;
    }
  }
  wind = collector.Take();
  return wind.Validate("Wind");
}

} // namespace waft
