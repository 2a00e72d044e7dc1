// SPDX-License-Identifier: BSD-3-Clause
// How objects go, of objects and of constraints, as arrays.
#pragma once

#include "Base/Leaving.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Columns.h"

#include <vector>

namespace waft
{

/// `LeaveFrom` (int), `LeaveAway` (double[3]), `LeaveFade`, `LeaveHasPlace` (int), `LeavePlace`
/// (double[3]) of rows that have a Leaving, Goes.
template <class Row>
void AddLeavings(const std::vector<Row>& rows, vtkFieldData* data)
{
  AddColumn(data, names::LeaveFrom, rows, [](const Row& row) { return row.Goes.From; });
  AddColumn(data, names::LeaveAway, rows, [](const Row& row) { return row.Goes.Away; });
  AddColumn(data, names::LeaveFade, rows, [](const Row& row) { return row.Goes.Fade; });
  AddColumn(data, names::LeaveHasPlace, rows, [](const Row& row) { return row.Goes.HasPlace; });
  AddColumn(data, names::LeavePlace, rows, [](const Row& row) { return row.Goes.Place; });
}

/// Those arrays that are there.
template <class Row>
Result ReadLeavings(const ArraySource& source, std::vector<Row>& rows)
{
  std::vector<Leaving> all(rows.size());
  WAFT_RETURN_IF_FAILED(ReadOptionalColumn(source, names::LeaveFrom, all, &Leaving::From));
  WAFT_RETURN_IF_FAILED(ReadOptionalColumn(source, names::LeaveAway, all, &Leaving::Away));
  WAFT_RETURN_IF_FAILED(ReadOptionalColumn(source, names::LeaveFade, all, &Leaving::Fade));
  WAFT_RETURN_IF_FAILED(ReadOptionalColumn(source, names::LeaveHasPlace, all, &Leaving::HasPlace));
  WAFT_RETURN_IF_FAILED(ReadOptionalColumn(source, names::LeavePlace, all, &Leaving::Place));
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    rows[i].Goes = all[i];
  }
  return Result::Ok();
}

} // namespace waft
