// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes/Photograph.h"

#include "Shapes/Triangulation.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

constexpr int Slabs = 96;           // along the length, of the profile
constexpr double Smoothing = 0.06;  // lengths, standard deviation over the profile
constexpr double LeastWidth = 0.35; // of the greatest half width: a stem does not curl
constexpr double SideOfArea = 2.3;  // squared side of a triangle over its area, evenly sided
constexpr int MostAttempts = 5;     // at an outline that does not cross itself

/// Takes pixels to the plan: length along x from 0 to 1.
struct PlanFrame
{
  double X, Y;         // pixels, centre
  double Cosine, Sine; // of the length's direction in the picture
  double Low, Length;  // pixels, along the length from the centre

  std::array<double, 2> ToPlan(const std::array<double, 2>& p) const
  {
    const double x = p[0] - this->X;
    const double y = p[1] - this->Y;
    return { (this->Cosine * x + this->Sine * y - this->Low) / this->Length,
             (this->Cosine * y - this->Sine * x) / this->Length };
  }
};

// The polygon's centroid, its axis of largest spread, the heavier end towards lower x.
PlanFrame FrameOf(const Polygon& polygon)
{
  // Moments over the fan of triangles from the first corner.
  double area = 0.0;
  double mx = 0.0;
  double my = 0.0;
  const auto fan = [&](auto&& visit)
  {
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    {
      const auto& a = polygon[0];
      const auto& b = polygon[k];
      const auto& c = polygon[k + 1];
      visit(0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])), a, b, c);
    }
  };
  fan(
    [&](double part, const auto& a, const auto& b, const auto& c)
    {
      area += part;
      mx += part * (a[0] + b[0] + c[0]) / 3.0;
      my += part * (a[1] + b[1] + c[1]) / 3.0;
    });
  PlanFrame frame{ mx / area, my / area, 1.0, 0.0, 0.0, 1.0 };
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  fan(
    [&](double part, const auto& a, const auto& b, const auto& c)
    {
      const double x[3] = { a[0] - frame.X, b[0] - frame.X, c[0] - frame.X };
      const double y[3] = { a[1] - frame.Y, b[1] - frame.Y, c[1] - frame.Y };
      const double sx = x[0] + x[1] + x[2];
      const double sy = y[0] + y[1] + y[2];
      xx += part * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + sx * sx);
      yy += part * (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + sy * sy);
      xy += part * (x[0] * y[0] + x[1] * y[1] + x[2] * y[2] + sx * sy);
    });
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  frame.Cosine = std::cos(angle);
  frame.Sine = std::sin(angle);
  double skew = 0.0;
  fan(
    [&](double part, const auto& a, const auto& b, const auto& c)
    {
      const std::array<double, 2> middle{ (a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0 };
      skew += part * std::pow(frame.ToPlan(middle)[0], 3);
    });
  if (skew < 0.0)
  {
    frame.Cosine = -frame.Cosine;
    frame.Sine = -frame.Sine;
  }
  double low = 1e300;
  double high = -1e300;
  for (const auto& p : polygon)
  {
    const double x = frame.ToPlan(p)[0];
    low = std::min(low, x);
    high = std::max(high, x);
  }
  frame.Low = low;
  frame.Length = high - low;
  return frame;
}

/// Middle and half width of the plan along its length, smooth.
struct Profile
{
  std::vector<double> Middle = std::vector<double>(Slabs, 0.0);
  std::vector<double> Half = std::vector<double>(Slabs, 0.0);

  explicit Profile(const Polygon& plan)
  {
    std::vector<double> low(Slabs, 1e300);
    std::vector<double> high(Slabs, -1e300);
    for (std::size_t k = 0; k < plan.size(); ++k)
    {
      const auto& a = plan[k];
      const auto& b = plan[(k + 1) % plan.size()];
      for (int s = 0; s < Slabs; ++s)
      {
        const double x = (s + 0.5) / Slabs;
        if ((a[0] <= x) != (b[0] <= x))
        {
          const double y = a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
          low[s] = std::min(low[s], y);
          high[s] = std::max(high[s], y);
        }
      }
    }
    double widest = 0.0;
    for (int s = 0; s < Slabs; ++s)
    {
      widest = std::max(widest, 0.5 * (high[s] - low[s]));
    }
    for (int s = 0; s < Slabs; ++s)
    {
      double total = 0.0;
      for (int t = 0; t < Slabs; ++t)
      {
        const double away = (s - t) / (Smoothing * Slabs);
        const double weight = high[t] >= low[t] ? std::exp(-0.5 * away * away) : 0.0;
        total += weight;
        this->Middle[s] += weight * 0.5 * (low[t] + high[t]);
        this->Half[s] += weight * 0.5 * (high[t] - low[t]);
      }
      this->Middle[s] /= total;
      this->Half[s] = std::max(this->Half[s] / total, LeastWidth * widest);
    }
  }

  static double At(const std::vector<double>& values, double x)
  {
    const double f = std::clamp(x * Slabs - 0.5, 0.0, Slabs - 1.0);
    const int s = std::min(static_cast<int>(f), Slabs - 2);
    return values[s] + (f - s) * (values[s + 1] - values[s]);
  }
};

} // namespace

Result MakePhotographSheet(const AlphaMask& mask, const PhotographOptions& options, Shape& shape)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  Polygon traced;
  WAFT_RETURN_IF_FAILED(TraceOutline(mask, options.Threshold, traced));
  const PlanFrame frame = FrameOf(traced);
  FlatSheet sheet;
  std::vector<std::array<double, 2>> pixels;
  Polygon outline;
  Result filled = Result::Ok();
  double tolerance = options.Detail * frame.Length;
  for (int attempt = 0; attempt < MostAttempts; ++attempt)
  {
    // Fewer corners may cross each other where the outline is narrow: then they are too few.
    outline = SimplifyOutline(traced, attempt + 1 < MostAttempts ? tolerance : 0.0);
    const double side = std::sqrt(SideOfArea * SignedArea(outline) / options.NumberOfTriangles);
    filled = TriangulatePolygon(outline, side, pixels, sheet.Triangles);
    if (filled)
    {
      break;
    }
    tolerance *= 0.4;
  }
  WAFT_RETURN_IF_FAILED(filled);
  Polygon plan;
  for (const auto& p : outline)
  {
    plan.push_back(frame.ToPlan(p));
  }
  const Profile profile(plan);
  shape.TextureCoordinates.clear();
  for (const auto& p : pixels)
  {
    const std::array<double, 2> q = frame.ToPlan(p);
    const double off = q[1] - Profile::At(profile.Middle, q[0]);
    sheet.Points.push_back(q);
    sheet.Rise.push_back(0.5 * off * off / Profile::At(profile.Half, q[0]));
    shape.TextureCoordinates.push_back({ p[0] / mask.Width, p[1] / mask.Height });
  }
  BendSheet(sheet, options, shape);
  return Result::Ok();
}

} // namespace waft
