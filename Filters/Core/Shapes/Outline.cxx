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

// A strip with a stem of the given fraction of its natural length.
Outline Strip(double bladeStart, double stemWidth, double stemLength,
              const std::function<double(double)>& halfWidth)
{
  Outline outline;
  outline.BladeStart = bladeStart;
  outline.StemStart = bladeStart * (1.0 - stemLength);
  outline.StemWidth = stemLength > 0.0 ? stemWidth : 0.0;
  outline.Left = halfWidth;
  outline.Right = halfWidth;
  outline.Middle = Zero;
  return outline;
}

Outline Ovate(const LeafForm& form)
{
  const auto blade = Blade(0.62, 0.95);
  Outline outline = Strip(0.14, 0.012, form.StemLength, [=](double s) { return 0.24 * blade(s); });
  outline.Middle = [bend = form.Bend](double s) { return 0.02 * bend * std::sin(2.6 * s); };
  outline.Teeth = 0.06 * form.Lobing;
  return outline;
}

// Broadest near the base, drawn out to a point.
Outline Birch(const LeafForm& form)
{
  const auto blade = Blade(0.36, 1.15);
  Outline outline = Strip(0.20, 0.012, form.StemLength, [=](double s) { return 0.30 * blade(s); });
  outline.Middle = [bend = form.Bend](double s) { return 0.015 * bend * std::sin(3.0 * s); };
  outline.Teeth = 0.11 * form.Lobing;
  return outline;
}

// Round, with shallow teeth and a short point.
Outline Aspen(const LeafForm& form)
{
  const auto blade = Blade(0.50, 0.56);
  Outline outline = Strip(0.12, 0.012, form.StemLength, [=](double s) { return 0.44 * blade(s); });
  outline.Middle = [bend = form.Bend](double s) { return 0.01 * bend * std::sin(3.0 * s); };
  outline.Teeth = 0.05 * form.Lobing;
  return outline;
}

Outline Willow(const LeafForm& form)
{
  const auto blade = Blade(0.7, 0.9);
  Outline outline = Strip(0.06, 0.010, form.StemLength, [=](double s) { return 0.075 * blade(s); });
  outline.Middle = [bend = form.Bend](double s)
  { return bend * (0.05 * std::sin(3.14159 * s) - 0.02 * s); };
  return outline;
}

// Rounded lobes, four a side, deeper in the middle of the blade.
Outline Oak(const LeafForm& form)
{
  const auto blade = Blade(0.85, 0.42);
  const double depth = 0.40 * form.Lobing;
  const auto lobes = [depth](double s, double shift)
  {
    const double deep = std::sin(3.14159265 * std::clamp(s, 0.0, 1.0));
    return 1.0 - depth * deep * (0.5 - 0.5 * std::cos(2.0 * M_PI * (4.0 * s + 0.30 + shift)));
  };
  Outline outline = Strip(0.09, 0.014, form.StemLength, Zero);
  outline.Left = [=](double s) { return 0.30 * blade(s) * lobes(s, 0.0); };
  outline.Right = [=](double s) { return 0.30 * blade(s) * lobes(s, 0.08); };
  outline.Middle = [bend = form.Bend](double s) { return 0.015 * bend * std::sin(3.0 * s); };
  return outline;
}

// The outer vane is narrower than the inner one; the shaft is bare at its base and bent.
Outline Flight(const FeatherForm& form)
{
  const auto vane = Blade(0.30, 0.34);
  Outline outline = Strip(0.20, 0.014, form.ShaftLength, Zero);
  outline.Left = [=](double s) { return (0.085 - 0.020 * form.Asymmetry) * vane(s); };
  outline.Right = [=](double s) { return (0.085 + 0.020 * form.Asymmetry) * vane(s); };
  outline.Middle = [bend = form.Bend](double s) { return 0.07 * bend * s * s; };
  outline.Paint = Outline::Skin::Feather;
  outline.Fluff = 0.13;
  return outline;
}

Outline Contour(const FeatherForm& form)
{
  const auto vane = Blade(0.42, 0.40);
  Outline outline = Strip(0.10, 0.012, form.ShaftLength, Zero);
  outline.Left = [=](double s) { return (0.170 - 0.008 * form.Asymmetry) * vane(s); };
  outline.Right = [=](double s) { return (0.170 + 0.008 * form.Asymmetry) * vane(s); };
  outline.Middle = [bend = form.Bend](double s) { return 0.05 * bend * s * s; };
  outline.Paint = Outline::Skin::Feather;
  outline.Fluff = 0.42;
  return outline;
}

Outline Petal()
{
  const auto blade = Blade(1.0, 0.32);
  Outline outline = Strip(0.0, 0.0, 0.0, [=](double s) { return 0.40 * blade(s); });
  outline.Paint = Outline::Skin::Petal;
  return outline;
}

// A pointed lobe about an angle: 1 at its tip, falling linearly.
double Lobe(double angle, double center, double halfAngle)
{
  return std::max(0.0, 1.0 - std::abs(SmallestAngle(angle - center)) / halfAngle);
}

// Five lobes about the point where the stem ends, with teeth. The tip of the middle one is at x =
// 1.
Outline Maple(const LeafForm& form)
{
  Outline outline;
  outline.Type = Outline::Kind::Star;
  outline.CenterX = 0.42;
  outline.BladeStart = 0.36;
  outline.StemStart = outline.CenterX * (1.0 - form.StemLength);
  outline.StemWidth = form.StemLength > 0.0 ? 0.012 : 0.0;
  outline.Ribs = { { 0.0, 0.58, 0.46 },
                   { 0.86, 0.54, 0.42 },
                   { -0.86, 0.54, 0.42 },
                   { 1.72, 0.36, 0.42 },
                   { -1.72, 0.36, 0.42 } };
  const double between = 0.20 + 0.16 * std::max(0.0, 1.0 - form.Lobing); // reach between lobes
  outline.Radius = [ribs = outline.Ribs, between, lobing = form.Lobing](double angle)
  {
    // The blade between the lobes; a notch where the stem comes in.
    const double back = std::abs(SmallestAngle(angle - M_PI));
    double radius = between + 0.02 - 0.12 * std::max(0.0, 1.0 - back / 0.8);
    for (const Outline::Rib& rib : ribs)
    {
      const double height = Lobe(angle, rib.Angle, rib.HalfAngle);
      radius = std::max(radius, between + (rib.Reach - between) * std::pow(height, 0.9));
    }
    return radius * (1.0 - 0.06 * lobing * (0.5 - 0.5 * std::cos(angle * 28.0)));
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

Outline Down()
{
  Outline outline = Disc(0.3);
  outline.Paint = Outline::Skin::Down;
  return outline;
}

} // namespace

double SmallestAngle(double angle)
{
  return angle > M_PI ? angle - 2.0 * M_PI : angle < -M_PI ? angle + 2.0 * M_PI : angle;
}

void Outline::PointAt(const OutlineCoordinates& at, double& x, double& y) const
{
  if (this->Type == Kind::Star)
  {
    const double r = at.Across * this->Radius(at.Along);
    x = this->CenterX + r * std::cos(at.Along);
    y = this->Width * r * std::sin(at.Along);
    return;
  }
  const double width = at.Across > 0.0 ? this->Left(at.Along) : this->Right(at.Along);
  x = this->BladeStart + at.Along * (this->BladeEnd - this->BladeStart);
  y = this->Width * (this->Middle(at.Along) + at.Across * width);
}

OutlineCoordinates Outline::CoordinatesOf(double x, double stretched) const
{
  if (this->Type == Kind::Star)
  {
    const double y = stretched / this->Width;
    OutlineCoordinates at;
    at.Along = std::atan2(y, x - this->CenterX);
    at.Across = std::hypot(x - this->CenterX, y) / this->Radius(at.Along);
    return at;
  }
  return this->CoordinatesOf(this->StationAt(x), stretched);
}

OutlineStation Outline::StationAt(double x) const
{
  OutlineStation station;
  station.Along = (x - this->BladeStart) / (this->BladeEnd - this->BladeStart);
  const double s = std::clamp(station.Along, 0.0, 1.0);
  station.Middle = this->Middle(s);
  station.Left = this->Left(s);
  station.Right = this->Right(s);
  return station;
}

OutlineCoordinates Outline::CoordinatesOf(const OutlineStation& station, double stretched) const
{
  const double off = stretched / this->Width - station.Middle;
  const double width = off > 0.0 ? station.Left : station.Right;
  return { station.Along, off / std::max(width, 1e-9) };
}

void Outline::StemAt(double s, double& x, double& y) const
{
  const double end = this->StemEnd();
  const double length = end - this->StemStart;
  const double endY = this->Type == Kind::Star ? 0.0 : this->Width * this->Middle(0.0);
  x = this->StemStart + s * length;
  y = endY - 0.12 * length * (1.0 - s) * (1.0 - s);
}

Result OutlineOfLeaf(const LeafForm& form, Outline& outline)
{
  WAFT_RETURN_IF_FAILED(form.Validate());
  switch (form.Kind)
  {
    case LeafKind::Ovate:
      outline = Ovate(form);
      break;
    case LeafKind::Maple:
      outline = Maple(form);
      break;
    case LeafKind::Oak:
      outline = Oak(form);
      break;
    case LeafKind::Willow:
      outline = Willow(form);
      break;
    case LeafKind::Birch:
      outline = Birch(form);
      break;
    case LeafKind::Aspen:
      outline = Aspen(form);
      break;
  }
  outline.Width = form.Width;
  return Result::Ok();
}

Result OutlineOfFeather(const FeatherForm& form, Outline& outline)
{
  WAFT_RETURN_IF_FAILED(form.Validate());
  outline = form.Kind == FeatherKind::Flight    ? Flight(form)
            : form.Kind == FeatherKind::Contour ? Contour(form)
                                                : Down();
  outline.Width = form.Width;
  return Result::Ok();
}

Result OutlineOf(const std::string& builtin, Outline& outline)
{
  const std::pair<const char*, LeafKind> leaves[] = { { "leaf", LeafKind::Ovate },
                                                      { "maple", LeafKind::Maple },
                                                      { "oak", LeafKind::Oak },
                                                      { "willow", LeafKind::Willow },
                                                      { "aspen", LeafKind::Aspen } };
  for (const auto& [name, kind] : leaves)
  {
    if (builtin == name)
    {
      LeafForm form;
      form.Kind = kind;
      return OutlineOfLeaf(form, outline);
    }
  }
  if (builtin == "feather" || builtin == "down")
  {
    FeatherForm form;
    form.Kind = builtin == "down" ? FeatherKind::Down : FeatherKind::Flight;
    return OutlineOfFeather(form, outline);
  }
  if (builtin == "petal")
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
      "expected leaf, maple, oak, willow, aspen, feather, down, petal or disc, found \"" + builtin +
      "\"");
  }
  return Result::Ok();
}

} // namespace waft
