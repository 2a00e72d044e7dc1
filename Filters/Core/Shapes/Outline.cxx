// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes/Outline.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

double Zero(double)
{
  return 0.0;
}

// s^a (1 - s)^b with a maximum of 1: a blade that opens like s^a and closes like (1 - s)^b.
std::function<double(double)> Blade(double a, double b)
{
  const double peak = a / (a + b);
  const double top = std::pow(peak, a) * std::pow(1.0 - peak, b);
  return [=](double s)
  {
    const double clamped = std::clamp(s, 0.0, 1.0);
    return std::pow(clamped, a) * std::pow(1.0 - clamped, b) / top;
  };
}

Outline Strip(double bladeStart, double stemWidth, const std::function<double(double)>& halfWidth)
{
  Outline outline;
  outline.BladeStart = bladeStart;
  outline.StemWidth = stemWidth;
  outline.Left = halfWidth;
  outline.Right = halfWidth;
  outline.Middle = Zero;
  return outline;
}

Outline Leaf()
{
  const auto blade = Blade(0.62, 0.95);
  Outline outline = Strip(0.14, 0.012, [=](double s) { return 0.24 * blade(s); });
  outline.Middle = [](double s) { return 0.02 * std::sin(2.6 * s); };
  return outline;
}

Outline Willow()
{
  const auto blade = Blade(0.7, 0.9);
  Outline outline = Strip(0.06, 0.010, [=](double s) { return 0.075 * blade(s); });
  outline.Middle = [](double s) { return 0.05 * std::sin(3.14159 * s) - 0.02 * s; };
  return outline;
}

// Rounded lobes, four a side, deeper in the middle of the blade.
Outline Oak()
{
  const auto blade = Blade(0.85, 0.42);
  const auto lobes = [](double s, double shift)
  {
    const double deep = std::sin(3.14159265 * std::clamp(s, 0.0, 1.0));
    return 1.0 - 0.40 * deep * (0.5 - 0.5 * std::cos(2.0 * M_PI * (4.0 * s + 0.30 + shift)));
  };
  Outline outline = Strip(0.09, 0.014, Zero);
  outline.Left = [=](double s) { return 0.30 * blade(s) * lobes(s, 0.0); };
  outline.Right = [=](double s) { return 0.30 * blade(s) * lobes(s, 0.08); };
  outline.Middle = [](double s) { return 0.015 * std::sin(3.0 * s); };
  return outline;
}

// The outer vane is narrower than the inner one; the shaft is bare at its base and bent.
Outline Feather()
{
  const auto vane = Blade(0.30, 0.34);
  Outline outline = Strip(0.20, 0.014, Zero);
  outline.Left = [=](double s) { return 0.065 * vane(s); };
  outline.Right = [=](double s) { return 0.105 * vane(s); };
  outline.Middle = [](double s) { return 0.07 * s * s; };
  return outline;
}

Outline Petal()
{
  const auto blade = Blade(1.0, 0.32);
  return Strip(0.0, 0.0, [=](double s) { return 0.40 * blade(s); });
}

// A pointed lobe about an angle: 1 at its tip, falling linearly.
double Lobe(double angle, double center, double halfAngle)
{
  return std::max(0.0, 1.0 - std::abs(std::remainder(angle - center, 2.0 * M_PI)) / halfAngle);
}

// Five lobes about the place where the stem ends, with teeth. The tip of the middle one is at x =
// 1.
Outline Maple()
{
  Outline outline;
  outline.Type = Outline::Kind::Star;
  outline.CenterX = 0.42;
  outline.BladeStart = 0.36;
  outline.StemWidth = 0.012;
  outline.Radius = [](double angle)
  {
    const double lobes[5][3] = { { 0.0, 0.58, 0.46 },
                                 { 0.86, 0.54, 0.42 },
                                 { -0.86, 0.54, 0.42 },
                                 { 1.72, 0.36, 0.42 },
                                 { -1.72, 0.36, 0.42 } };
    // The blade between the lobes; a notch where the stem comes in.
    const double back = std::abs(std::remainder(angle - M_PI, 2.0 * M_PI));
    double radius = 0.22 - 0.12 * std::max(0.0, 1.0 - back / 0.8);
    for (const auto& lobe : lobes)
    {
      const double height = Lobe(angle, lobe[0], lobe[2]);
      radius = std::max(radius, 0.20 + (lobe[1] - 0.20) * std::pow(height, 0.9));
    }
    return radius * (1.0 - 0.06 * (0.5 - 0.5 * std::cos(angle * 28.0)));
  };
  return outline;
}

Outline Disc(double wobble)
{
  Outline outline;
  outline.Type = Outline::Kind::Star;
  outline.Radius = [=](double angle)
  {
    return 0.5 * (1.0 - wobble * (0.5 + 0.3 * std::sin(3.0 * angle + 0.4) +
                                  0.2 * std::sin(7.0 * angle + 1.9)));
  };
  return outline;
}

} // namespace

void Outline::PointAt(const OutlinePlace& place, double& x, double& y) const
{
  if (this->Type == Kind::Star)
  {
    const double r = place.Across * this->Radius(place.Along);
    x = this->CenterX + r * std::cos(place.Along);
    y = r * std::sin(place.Along);
    return;
  }
  const double width = place.Across > 0.0 ? this->Left(place.Along) : this->Right(place.Along);
  x = this->BladeStart + place.Along * (this->BladeEnd - this->BladeStart);
  y = this->Middle(place.Along) + place.Across * width;
}

OutlinePlace Outline::PlaceOf(double x, double y) const
{
  OutlinePlace place;
  if (this->Type == Kind::Star)
  {
    place.Along = std::atan2(y, x - this->CenterX);
    place.Across = std::hypot(x - this->CenterX, y) / this->Radius(place.Along);
    return place;
  }
  place.Along = (x - this->BladeStart) / (this->BladeEnd - this->BladeStart);
  const double s = std::clamp(place.Along, 0.0, 1.0);
  const double off = y - this->Middle(s);
  const double width = off > 0.0 ? this->Left(s) : this->Right(s);
  place.Across = off / std::max(width, 1e-9);
  return place;
}

Result OutlineOf(const std::string& builtin, Outline& outline)
{
  if (builtin == "leaf")
  {
    outline = Leaf();
  }
  else if (builtin == "maple")
  {
    outline = Maple();
  }
  else if (builtin == "oak")
  {
    outline = Oak();
  }
  else if (builtin == "willow")
  {
    outline = Willow();
  }
  else if (builtin == "feather")
  {
    outline = Feather();
  }
  else if (builtin == "down")
  {
    outline = Disc(0.3);
  }
  else if (builtin == "petal")
  {
    outline = Petal();
  }
  else if (builtin == "disc")
  {
    outline = Disc(0.0);
  }
  else
  {
    return Result::Error(
      "expected leaf, maple, oak, willow, feather, down, petal or disc, found \"" + builtin + "\"");
  }
  return Result::Ok();
}

} // namespace waft
