// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/WindFiles.h"

#include "Bridge/FieldCollectors.h"
#include "Bridge/FileReading.h"
#include "Volumes/VectorVolume.h"
#include "Volumes/VolumeSeries.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
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
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(path.c_str());
  Result result = RunReader(reader);
  return result ? collector.Add(reader->GetOutput(), time) : result;
}

// The steps of a .pvd in order of time.
Result PvdSteps(const std::string& path, std::vector<std::pair<double, std::string>>& steps)
{
  const auto root =
    vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection)
  {
    return Result::Error("expected a ParaView collection of .vti files, found none");
  }
  for (int i = 0; i < collection->GetNumberOfNestedElements(); ++i)
  {
    vtkXMLDataElement* entry = collection->GetNestedElement(i);
    const char* file = entry->GetAttribute("file");
    double time = i;
    entry->GetScalarAttribute("timestep", time);
    if (!file || Extension(file) != ".vti")
    {
      return Result::Error("expected .vti files in the collection, found \"" +
                           std::string(file ? file : "") + "\"");
    }
    steps.emplace_back(time, (std::filesystem::path(path).parent_path() / file).string());
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
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
