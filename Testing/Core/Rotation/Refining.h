// SPDX-License-Identifier: BSD-3-Clause
// The rotation stage as its tests run it.
#pragma once

#include "RotationFixtures.h"

#include <gtest/gtest.h>

namespace waft::fixtures
{

/// Must succeed. Several bodies on one path are several experiments: they are not kept apart.
inline RotationOutput Refine(const RotationInput& input, RotationOptions options = {},
                             int threads = 1, bool keepApart = false)
{
  SilentMonitor silent;
  RotationOutput output;
  options.KeepApart = keepApart;
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
