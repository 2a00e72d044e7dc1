// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/PropertyCheck.h"

namespace waft
{

Result CheckProperties(const std::vector<PropertyRange>& properties)
{
  for (const PropertyRange& property : properties)
  {
    for (const double value : property.Values)
    {
      if (!property.Range.Holds(value))
      {
        return Result::Error(std::string(property.Name) + ": expected " + property.Range.Text() +
                             ", found " + NumberText(value, 10));
      }
    }
  }
  return Result::Ok();
}

} // namespace waft
