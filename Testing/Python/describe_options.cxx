// SPDX-License-Identifier: BSD-3-Clause
// Prints what the options structs of Core say of their fields, by the class of the pipeline that
// has them as its properties, as JSON.
#include "Rotation/RotationRefine.h"
#include "Spacetime/Spacetime.h"
#include "Vortex/VortexFit.h"

#include <nlohmann/json.hpp>

#include <iostream>

namespace
{

template <class Options>
nlohmann::json FieldsOf()
{
  auto fields = nlohmann::json::array();
  const Options options;
  const auto add = [&fields](const waft::OptionField& field, const auto& value)
  {
    nlohmann::json said{ { "name", field.Name }, { "sentence", field.Sentence } };
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
    {
      said["default"] = value;
    }
    else
    {
      said["default"] = static_cast<double>(value);
      said["range"] = { field.Range.Low, field.Range.High };
    }
    fields.push_back(said);
  };
  Options::Visit(add, options);
  return fields;
}

} // namespace

int main()
{
  const nlohmann::json classes{
    { "vtkRotationRefineFilter", FieldsOf<waft::RotationOptions>() },
    { "vtkSPHSpacetimeFilter", FieldsOf<waft::SpacetimeOptions>() },
    { "vtkVortexFitFilter", FieldsOf<waft::VortexFitOptions>() },
  };
  std::cout << classes.dump(1) << "\n";
  return 0;
}
