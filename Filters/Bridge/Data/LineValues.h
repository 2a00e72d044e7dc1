// SPDX-License-Identifier: BSD-3-Clause
// Values of points, line by line.
#pragma once

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstddef>
#include <vector>

namespace waft
{

/// all: one value a point, or nothing, which leaves the items as they are. Each item, one a line,
/// gets a list of its points' values as a member.
template <class Value, class Item>
void TakeByLine(vtkPolyData* data, const std::vector<Value>& all, std::vector<Value> Item::*member,
                std::vector<Item>& items)
{
  vtkNew<vtkIdList> line;
  for (std::size_t cell = 0; !all.empty() && cell < items.size(); ++cell)
  {
    data->GetCellPoints(static_cast<vtkIdType>(cell), line);
    std::vector<Value>& values = items[cell].*member;
    values.clear();
    values.reserve(static_cast<std::size_t>(line->GetNumberOfIds()));
    for (vtkIdType i = 0; i < line->GetNumberOfIds(); ++i)
    {
      values.push_back(all[static_cast<std::size_t>(line->GetId(i))]);
    }
  }
}

} // namespace waft
