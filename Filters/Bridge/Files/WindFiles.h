// SPDX-License-Identifier: BSD-3-Clause
// Winds from files, whole series at once.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Types.h"
#include "Scene/Scene.h"

namespace waft
{

/// A wind from a .vti (one time, which then holds throughout), a .pvd (a series of .vti, in the
/// order of their times) or a .vdb, of the array that ChooseWind takes. A .vdb whose name ends in
/// digits is the first of a series: of all files in its folder that differ in these digits alone
/// and have no lower number; the digits are the frame.
Result ReadWindFile(const WindFile& file, const Timeline& line, FieldSeries& wind);

} // namespace waft
