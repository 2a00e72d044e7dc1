// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/PropertyCheck.h"

namespace waft
{

Result CheckProperties(const std::vector<PropertyRange>& properties)
{
  for (const PropertyRange& property : properties)
  {
    for (const double value : property.Values)
    {
      WAFT_RETURN_IF_FAILED(
        (OptionField{ property.Name, property.Range, property.Unit, "" }.Check(value)));
    }
  }
  return Result::Ok();
}

} // namespace waft
