// SPDX-License-Identifier: BSD-3-Clause
// Which fields of a file are a wind, by their names.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Result.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace waft
{

/// A field on a lattice, as its file calls it.
struct NamedField
{
  std::string Name;
  int Components = 0;
};

/// Where a wind's numbers are: one field of three components, or three of one.
struct WindFields
{
  FieldMeaning Meaning = FieldMeaning::Acceleration;
  std::vector<std::size_t> Fields;
};

/// The field of this name; an empty one stands for the first of: `Wind`, `Velocity`, the same in
/// other letters, and the names that other programs give to velocities (vel, U, v). A name stands
/// for three fields of one number as well: vel.x, vel_x or velx and so on. Only `Wind`, in whatever
/// letters, is an acceleration. False when there is none.
bool ChooseWind(const std::vector<NamedField>& fields, const std::string& name, WindFields& chosen);

/// What is wrong with a file without one. list: what it has (ListOfFields).
Result NoWind(const std::string& name, const std::string& list);

/// "`U` (3), `p` (1)", names with their components; "none" of none.
std::string ListOfFields(const std::vector<NamedField>& fields);

} // namespace waft
