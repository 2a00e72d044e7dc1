// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/ChainOptions.h"

#include <type_traits>

#include "Base/Limits.h"

namespace waft
{

Result ChainOptions::Validate() const
{
  const OptionField seed{ "Seed", { -1, 4294967295.0 }, "", "" };
  const OptionField limit{ "TimeLimit", { 0, 1e9 }, "s", "" };
  WAFT_RETURN_IF_FAILED(seed.Check(static_cast<double>(this->Seed)));
  WAFT_RETURN_IF_FAILED(limit.Check(this->TimeLimit));
  WAFT_RETURN_IF_FAILED(this->Plan.Validate());
  WAFT_RETURN_IF_FAILED(this->Takes.Validate());
  WAFT_RETURN_IF_FAILED(this->Air.Validate());
  WAFT_RETURN_IF_FAILED(this->Optimiser.Validate());
  return this->Rotation.Validate();
}

ChainOptions ChainOptions::At(Quality quality)
{
  ChainOptions options;
  options.Detail = quality;
  options.Fit.Quantity = VortexFitOptions::AirAcceleration;
  options.Fit.MaximumNewVortices = 16;
  options.Fit.MinimumGain = 0.02;
  options.Fit.UniformBackground = false;
  if (quality == Quality::Preview)
  {
    options.Air.Resolution = 32;
    options.Air.LatticeResolution = 32;
    options.Air.Rounds = 0;
  }
  return options;
}

namespace
{

template <class Options>
bool SetField(Options& options, const std::string& name, double value)
{
  bool isThere = false;
  Options::Visit(
    [&](const OptionField& field, auto& own)
    {
      using Own = std::decay_t<decltype(own)>;
      if constexpr (IsNumber<Own>)
      {
        if (field.Name == name)
        {
          own = static_cast<Own>(value);
          isThere = true;
        }
      }
    },
    options);
  return isThere;
}

} // namespace

bool ChainOptions::Set(ChainStage stage, const std::string& name, double value)
{
  switch (stage)
  {
    case ChainStage::Planner:
      return SetField(this->Plan, name, value);
    case ChainStage::Assimilation:
      if (SetField(this->Air, name, value))
      {
        return true;
      }
      this->Turning = this->Turning.value_or(this->Rotation);
      return SetField(*this->Turning, name, value);
    case ChainStage::Spacetime:
      return SetField(this->Optimiser, name, value);
    case ChainStage::Rotation:
      return SetField(this->Rotation, name, value);
    case ChainStage::VortexFit:
      return SetField(this->Fit, name, value);
    case ChainStage::Scene:
      break;
  }
  return false;
}

} // namespace waft
