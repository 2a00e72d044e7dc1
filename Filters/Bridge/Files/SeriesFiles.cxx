// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/SeriesFiles.h"

#include "Base/AtomicFile.h"
#include "Base/Characters.h"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>

namespace waft
{

std::vector<double> TimesOf(const Timeline& line)
{
  std::vector<double> times;
  for (int frame = 0; frame < line.NumberOfFrames; ++frame)
  {
    times.push_back(line.Time(frame));
  }
  return times;
}

std::vector<std::size_t> Spaced(const std::vector<double>& times, double interval)
{
  std::vector<std::size_t> chosen{ 0 };
  for (std::size_t i = 1; i < times.size(); ++i)
  {
    if (i + 1 == times.size() || times[i + 1] - times[chosen.back()] > interval * (1.0 + 1e-9))
    {
      chosen.push_back(i);
    }
  }
  return chosen;
}

std::string QuotedXml(const std::string& text)
{
  const bool hasQuote = text.find('"') != std::string::npos;
  const char quote = hasQuote && text.find('\'') == std::string::npos ? '\'' : '"';
  std::string quoted(1, quote);
  for (std::size_t at = 0; at < text.size();)
  {
    const Character character = CharacterAt(text, at);
    const std::size_t bytes = std::max<std::size_t>(character.Bytes, 1);
    const std::string own = text.substr(at, bytes);
    quoted += IsControl(character.Code)     ? "\\" + CodeText(character.Code)
              : own == "&"                  ? "&amp;"
              : own == "<"                  ? "&lt;"
              : own == ">"                  ? "&gt;"
              : own == "\"" && quote == '"' ? "&quot;"
                                            : own;
    at += bytes;
  }
  return quoted + quote;
}

void RoundPoints(vtkImageData* data, int digits)
{
  for (int index = 0; index < data->GetPointData()->GetNumberOfArrays(); ++index)
  {
    auto* array = vtkFloatArray::SafeDownCast(data->GetPointData()->GetArray(index));
    const vtkIdType count = array->GetNumberOfValues();
    float* values = array->GetPointer(0);
    double sum = 0.0;
    for (vtkIdType i = 0; i < count; ++i)
    {
      sum += static_cast<double>(values[i]) * values[i];
    }
    const double typical = count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
    if (typical > 0.0)
    {
      const auto step = static_cast<float>(std::exp2(std::floor(std::log2(typical)) - digits));
      for (vtkIdType i = 0; i < count; ++i)
      {
        values[i] = std::nearbyint(values[i] / step) * step;
      }
    }
  }
}

Result WriteSeries(const std::string& folder, const std::string& name, const std::string& suffix,
                   const std::vector<double>& times, const DataFileForm& form,
                   const std::function<vtkSmartPointer<vtkDataObject>(double time)>& at,
                   std::vector<std::size_t> steps)
{
  if (steps.empty())
  {
    steps.resize(times.size());
    std::iota(steps.begin(), steps.end(), std::size_t(0));
  }
  std::error_code wrong;
  std::filesystem::create_directories(folder + "/" + name, wrong);
  if (wrong)
  {
    return Result::Error(folder + "/" + name + ": could not be made: " + wrong.message());
  }
  std::string entries;
  const auto together =
    static_cast<std::size_t>(std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads()));
  for (std::size_t first = 0; first < steps.size(); first += together)
  {
    const std::size_t count = std::min(together, steps.size() - first);
    std::vector<vtkSmartPointer<vtkDataObject>> data;
    std::vector<std::string> files;
    for (std::size_t i = first; i < first + count; ++i)
    {
      const double time = times[steps[i]];
      char number[32], stamp[32];
      std::snprintf(number, sizeof(number), "_%04zu", steps[i]);
      std::snprintf(stamp, sizeof(stamp), "%.17g", time);
      // Two are written at once, and each notes ranges in its arrays.
      const vtkSmartPointer<vtkDataObject> there = at(time);
      data.push_back(vtkSmartPointer<vtkDataObject>::Take(there->NewInstance()));
      data.back()->DeepCopy(there);
      files.push_back(name + "/" + name + number + suffix);
      entries += std::string("    <DataSet timestep=\"") + stamp +
                 "\" part=\"0\" file=" + QuotedXml(files.back()) + "/>\n";
    }
    std::vector<Result> written(count, Result::Ok());
    const auto write = [&](vtkIdType begin, vtkIdType end)
    {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      {
        written[i] = WriteDataFile(folder + "/" + files[i], data[i], form);
      }
    };
    vtkSMPTools::For(0, static_cast<vtkIdType>(count), 1, write);
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!written[i])
      {
        return Result::Error(files[i] + ": could not be written: " + written[i].Message());
      }
    }
  }
  return WriteWholeFile(folder + "/" + name + ".pvd",
                        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                        "  <Collection>\n" +
                          entries + "  </Collection>\n</VTKFile>\n");
}

} // namespace waft
