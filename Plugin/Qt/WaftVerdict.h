// SPDX-License-Identifier: BSD-3-Clause
// What became of the marks of a flight, as its stages report it to the client.
#pragma once

#include <QStringList>

#include <utility>

class vtkPolyData;
class vtkSMProxy;
class vtkSMSourceProxy;

namespace waft
{

/// Whether a source gives bodies that fly, out of a file or out of stages.
bool IsFlight(vtkSMProxy* source);
/// The one that a source is part of; nullptr without any.
vtkSMProxy* FlightOf(vtkSMProxy* source);
/// Whether it was asked to fly.
bool HasFlown(vtkSMProxy* flight);
/// Its ways; nullptr where the client has none.
vtkPolyData* PosesOf(vtkSMProxy* flight);

/// The port that has its marks with what became of them; nullptr without any.
std::pair<vtkSMSourceProxy*, int> MarksOf(vtkSMProxy* flight);

/// How many marks of a flight that is complete are not met, and each of them with why, those first
/// that cannot be; empty where all are met, and where no report says.
QStringList UnmetMarksOf(vtkSMProxy* flight);

} // namespace waft
