// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "Grid/AdvectionKernels.h"

#include <gtest/gtest.h>

#include <cstring>

#include <array>
#include <cmath>

using namespace waft;

namespace
{

enum class Scheme
{
  Linear,
  Cubic,
  MacCormack
};

struct Field
{
  StaggeredLayout Layout;
  std::vector<float> Values;
};

constexpr AxisEnds Walls{ { { EndKind::Wall, EndKind::Wall },
                            { EndKind::Wall, EndKind::Wall },
                            { EndKind::Wall, EndKind::Wall } } };

double Blob(double x, double y)
{
  const double r2 = (x - 0.5) * (x - 0.5) + (y - 0.7) * (y - 0.7);
  return std::exp(-r2 / (2.0 * 0.08 * 0.08));
}

// Root of the mean squared error after a whole turn of solid rotation in the unit square (n x n x
// 4 voxels), at a Courant number that does not change with n.
double ErrorAfterATurn(int n, Scheme scheme, double* largest = nullptr)
{
  const StaggeredLayout layout({ n, n, 4 });
  std::array<std::vector<float>, 3> velocity;
  for (std::vector<float>& v : velocity)
  {
    v.assign(layout.Size(), 0.0f);
  }
  std::vector<float> values(layout.Size(), 0.0f);
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i)
      {
        velocity[0][layout.Index(i, j, k)] = static_cast<float>(0.5 - (j + 0.5) / n);
        velocity[1][layout.Index(i, j, k)] = static_cast<float>((i + 0.5) / n - 0.5);
        values[layout.Index(i, j, k)] = static_cast<float>(Blob((i + 0.5) / n, (j + 0.5) / n));
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    FillGhosts(layout, Walls, axis, velocity[axis].data());
  }
  const int steps = 2 * n;
  CarrierFlow flow;
  flow.Layout = &layout;
  flow.Ends = Walls;
  flow.Velocity = { velocity[0].data(), velocity[1].data(), velocity[2].data() };
  flow.Scale.fill(static_cast<float>(2.0 * M_PI / steps * n));
  CarrierFlow back = flow;
  back.Scale.fill(-flow.Scale[0]);
  std::array<std::vector<float>, 3> backwards = velocity;
  std::array<std::vector<float>, 3> forwards = velocity;
  for (int k = 0; k < 4; ++k)
  {
    TracePlane(flow, k, { backwards[0].data(), backwards[1].data(), backwards[2].data() });
    TracePlane(back, k, { forwards[0].data(), forwards[1].data(), forwards[2].data() });
  }
  FootRow feet;
  feet.Resize(n);
  std::vector<float> moved = values;
  std::vector<float> returned = values;
  for (int step = 0; step < steps; ++step)
  {
    FillGhosts(layout, Walls, -1, values.data());
    const auto forRows =
      [&](const std::array<std::vector<float>, 3>& displacement, const auto& body)
    {
      for (int k = 0; k < 4; ++k)
      {
        for (int j = 0; j < n; ++j)
        {
          FindFeet(layout, Walls,
                   { displacement[0].data(), displacement[1].data(), displacement[2].data() }, -1,
                   j, k, feet);
          body(layout.Index(0, j, k));
        }
      }
    };
    forRows(backwards,
            [&](std::ptrdiff_t row)
            {
              (scheme == Scheme::Cubic ? SampleCubicRow : SampleLinearRow)(
                layout, values.data(), row, feet, n, moved.data() + row);
            });
    if (scheme == Scheme::MacCormack)
    {
      FillGhosts(layout, Walls, -1, moved.data());
      forRows(forwards, [&](std::ptrdiff_t row)
              { SampleLinearRow(layout, moved.data(), row, feet, n, returned.data() + row); });
      forRows(backwards,
              [&](std::ptrdiff_t row)
              {
                CorrectMacCormackRow(layout, values.data(), row, feet, n, moved.data() + row,
                                     returned.data() + row, moved.data() + row);
              });
    }
    std::swap(values, moved);
  }
  double sum = 0.0;
  double most = 0.0;
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const double value = values[layout.Index(i, j, 1)];
      const double error = value - Blob((i + 0.5) / n, (j + 0.5) / n);
      sum += error * error;
      most = std::max(most, value);
    }
  }
  if (largest != nullptr)
  {
    *largest = most;
  }
  return std::sqrt(sum / (n * n));
}

double Order(Scheme scheme, int n)
{
  return std::log2(ErrorAfterATurn(n, scheme) / ErrorAfterATurn(2 * n, scheme));
}

} // namespace

TEST(Advection, RotatingBlobConvergesAtTheStatedOrder)
{
  // The linear scheme at these sizes has not reached its first order yet: the blob is smeared flat.
  EXPECT_GT(Order(Scheme::Linear, 64), 0.4);
  EXPECT_GT(Order(Scheme::Cubic, 64), 1.8);
  EXPECT_GT(Order(Scheme::MacCormack, 64), 1.5);
}

TEST(Advection, HigherSchemesKeepTheBlobAndMakeNoNewExtremum)
{
  double linear = 0.0, cubic = 0.0, macCormack = 0.0;
  const double linearError = ErrorAfterATurn(64, Scheme::Linear, &linear);
  EXPECT_LT(ErrorAfterATurn(64, Scheme::Cubic, &cubic), 0.3 * linearError);
  EXPECT_LT(ErrorAfterATurn(64, Scheme::MacCormack, &macCormack), 0.3 * linearError);
  EXPECT_GT(cubic, 1.5 * linear);
  EXPECT_LE(cubic, 1.0 + 1e-5);
  EXPECT_LE(macCormack, 1.0 + 1e-5);
}

TEST(Advection, RowsAreTheSameBitsAsTheirSamplesOneByOne)
{
  constexpr int n = 16, count = 61;
  const StaggeredLayout layout({ n, n, n });
  Random random(11);
  std::vector<float> values(layout.Size());
  for (float& value : values)
  {
    value = random.Index(4) == 0 ? 0.0f : static_cast<float>(random.Normal());
  }
  FootRow feet;
  feet.Resize(count);
  const auto cell = [&] { return static_cast<int>(random.Index(n)); };
  for (std::size_t i = 0; i < count; ++i)
  {
    feet.Corner[i] = static_cast<int>(layout.Index(cell(), cell(), cell()));
    feet.Tx[i] = static_cast<float>(random.Uniform());
    feet.Ty[i] = random.Index(5) == 0 ? 0.0f : static_cast<float>(random.Uniform());
    feet.Tz[i] = static_cast<float>(random.Uniform());
  }
  std::vector<float> together(count);
  SampleCubicRow(layout, values.data(), 0, feet, count, together.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    FootRow one;
    one.Resize(1);
    one.Corner[0] = feet.Corner[i];
    one.Tx[0] = feet.Tx[i];
    one.Ty[0] = feet.Ty[i];
    one.Tz[0] = feet.Tz[i];
    float alone = 0.0f;
    SampleCubicRow(layout, values.data(), 0, one, 1, &alone);
    EXPECT_EQ(std::memcmp(&alone, &together[i], sizeof(alone)), 0) << i;
  }
}

TEST(Advection, CubicIsExactForLinearFieldsAndMonotone)
{
  const int n = 16;
  const StaggeredLayout layout({ n, n, n });
  std::vector<float> ramp(layout.Size(), 0.0f);
  std::vector<float> edge(layout.Size(), 0.0f);
  for (int k = -2; k <= n + 2; ++k)
  {
    for (int j = -2; j <= n + 2; ++j)
    {
      for (int i = -2; i <= n + 2; ++i)
      {
        ramp[layout.Index(i, j, k)] = 0.3f * i - 0.2f * j + 0.1f * k;
        edge[layout.Index(i, j, k)] = i < 8 ? 0.0f : 1.0f;
      }
    }
  }
  FootRow feet; // places (6 + 0.1 s, 4.37, 9.81)
  feet.Resize(40);
  for (int s = 0; s < 40; ++s)
  {
    const float x = 6.0f + 0.1f * s;
    feet.Corner[s] = static_cast<int>(layout.Index(static_cast<int>(x), 4, 9));
    feet.Tx[s] = x - std::floor(x);
    feet.Ty[s] = 0.37f;
    feet.Tz[s] = 0.81f;
  }
  std::vector<float> out(40);
  SampleCubicRow(layout, ramp.data(), 0, feet, 40, out.data());
  for (int s = 0; s < 40; ++s)
  {
    EXPECT_NEAR(out[s], 0.3 * (6.0 + 0.1 * s) - 0.2 * 4.37 + 0.1 * 9.81, 1e-5);
  }
  SampleCubicRow(layout, edge.data(), 0, feet, 40, out.data());
  for (int s = 1; s < 40; ++s)
  {
    EXPECT_GE(out[s], out[s - 1]);
    EXPECT_GE(out[s], 0.0f);
    EXPECT_LE(out[s], 1.0f);
  }
}
