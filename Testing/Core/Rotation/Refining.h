// SPDX-License-Identifier: BSD-3-Clause
// The rotation stage as its tests run it.
#pragma once

#include "RotationFixtures.h"

#include <gtest/gtest.h>

namespace waft::fixtures
{

/// Must succeed.
inline RotationOutput Refine(const RotationInput& input, const RotationOptions& options = {},
                             int threads = 1)
{
  SilentMonitor silent;
  RotationOutput output;
  const Result result = RunRotationRefine(input, options, ThreadedFor(threads), silent, output);
  EXPECT_TRUE(result) << result.Message();
  return output;
}

inline RotationOptions WithModel(AirModel model)
{
  RotationOptions options;
  options.Model = model;
  return options;
}

} // namespace waft::fixtures
