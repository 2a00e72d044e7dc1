// SPDX-License-Identifier: BSD-3-Clause
// Data that vary in time as files, and ParaView's list of them.
#pragma once

#include "Base/Result.h"
#include "Base/Types.h"
#include "Bridge/Files/DataWriting.h"

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

class vtkImageData;

namespace waft
{

/// Of all frames [s].
std::vector<double> TimesOf(const Timeline& line);
/// Indices of the first of the times, of those that keep at most the interval from the one before,
/// and of the last: as few as that takes.
std::vector<std::size_t> Spaced(const std::vector<double>& times, double interval);

/// Writes folder/NAME.pvd with a file in folder/NAME for each of the steps (by default: of all
/// times), several at once by threads. at: what there is at a time; it is called by one thread.
/// Fails with the path of what cannot be written.
Result WriteSeries(const std::string& folder, const std::string& name, const std::string& suffix,
                   const std::vector<double>& times, const DataFileForm& form,
                   const std::function<vtkSmartPointer<vtkDataObject>(double time)>& at,
                   std::vector<std::size_t> steps = {});

/// Rounds arrays of points to steps that are so many binary digits below their typical value.
void RoundPoints(vtkImageData* data, int digits);

/// A text as the value of an attribute, with its quotes. What cannot be seen is an escape.
std::string QuotedXml(const std::string& text);

} // namespace waft
