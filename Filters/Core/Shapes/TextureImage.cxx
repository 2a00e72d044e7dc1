// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes/TextureImage.h"

#include "Base/Random.h"
#include "Base/SmoothStep.h"
#include "Shapes/Outline.h"
#include "Shapes/ThinShape.h"

#include <algorithm>
#include <cmath>

namespace waft
{

namespace
{

using Color = std::array<double, 3>;

double Smooth(double low, double high, double x)
{
  return CubicStep(std::clamp((x - low) / (high - low), 0.0, 1.0));
}

Color Mix(const Color& a, const Color& b, double t)
{
  return { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) };
}

Color Scale(const Color& a, double s)
{
  return { a[0] * s, a[1] * s, a[2] * s };
}

// Smooth noise from -1 to 1: random values on a lattice, and octaves of it.
class Noise
{
public:
  /// Where a coordinate is between two lines of the lattice.
  struct Place
  {
    long Line = 0;
    double Beyond = 0.0; // smoothly from 0 to 1
    Place() = default;
    explicit Place(double x)
    {
      const double floor = std::floor(x);
      this->Line = static_cast<long>(floor);
      this->Beyond = Smooth(0.0, 1.0, x - floor);
    }
  };
  using Places = std::array<Place, 5>; // of one coordinate, octave by octave

  explicit Noise(std::uint64_t seed)
  {
    Random random(seed, 7);
    for (double& value : this->Values)
    {
      value = random.Uniform(-1.0, 1.0);
    }
  }
  double At(const Place& x, const Place& y) const
  {
    const double low = this->Value(x.Line, y.Line) +
                       x.Beyond * (this->Value(x.Line + 1, y.Line) - this->Value(x.Line, y.Line));
    const double high =
      this->Value(x.Line, y.Line + 1) +
      x.Beyond * (this->Value(x.Line + 1, y.Line + 1) - this->Value(x.Line, y.Line + 1));
    return low + y.Beyond * (high - low);
  }
  double At(double x, double y) const { return this->At(Place(x), Place(y)); }
  double Octaves(const Places& x, const Places& y, std::size_t count) const
  {
    double sum = 0.0;
    double weight = 0.5;
    for (std::size_t octave = 0; octave < count; ++octave)
    {
      sum += weight * this->At(x[octave], y[octave]);
      weight *= 0.5;
    }
    return sum;
  }
  static Places Along(double x, std::size_t count) { return PlacesOf(x, 17.3, count); }
  static Places Across(double y, std::size_t count) { return PlacesOf(y, -9.1, count); }

private:
  static constexpr int Side = 64;
  static Places PlacesOf(double at, double shift, std::size_t count)
  {
    Places places;
    for (std::size_t octave = 0; octave < count; ++octave)
    {
      places[octave] = Place(at + shift * static_cast<double>(octave));
      at *= 2.0;
    }
    return places;
  }
  double Value(long i, long j) const
  {
    return this->Values[static_cast<std::size_t>((i & (Side - 1)) + Side * (j & (Side - 1)))];
  }
  std::array<double, Side * Side> Values;
};

// 1 on a line, 0 away from it.
double Line(double distance, double halfWidth)
{
  return 1.0 - Smooth(0.6 * halfWidth, 1.4 * halfWidth, std::abs(distance));
}

// Distance of a number to the nearest integer.
double ToInteger(double x)
{
  return x - std::round(x);
}

/// The noises that a skin has along its own axes.
struct Grains
{
  double AlongScale, AcrossScale;
  std::size_t Octaves;
};
constexpr Grains LeafBlotches{ 7.0, 7.0, 5 }, LeafGrain{ 24.0, 24.0, 3 };
constexpr Grains FeatherBands{ 14.0, 22.0, 3 }, DownBend{ 3.0, 3.0, 1 },
  PetalGrain{ 12.0, 12.0, 4 };
constexpr Grains NoGrain{ 0.0, 0.0, 0 };

/// The coarser noise of a skin, and the finer one.
std::array<Grains, 2> GrainsOf(Outline::Skin skin)
{
  switch (skin)
  {
    case Outline::Skin::Feather:
      return { FeatherBands, NoGrain };
    case Outline::Skin::Down:
      return { DownBend, NoGrain };
    case Outline::Skin::Petal:
      return { PetalGrain, NoGrain };
    case Outline::Skin::Leaf:
      break;
  }
  return { LeafBlotches, LeafGrain };
}

/// What all samples of a column have in common, and all of a row: most of what they cost.
struct Column
{
  double X = 0.0;
  OutlineStation Station;
  double S = 0.0; // along the blade, from 0 to 1
  Noise::Places Coarse, Fine;
};
struct Row
{
  double Y = 0.0;
  Noise::Places Coarse, Fine;
};

struct Painter
{
  const SkinOptions& Options;
  const Outline Plan;
  const Noise Grain;
  const std::array<Grains, 2> Kinds = GrainsOf(Plan.Paint);

  Column ColumnAt(double x) const
  {
    Column column;
    column.X = x;
    if (this->Plan.Type == Outline::Kind::Strip)
    {
      column.Station = this->Plan.StationAt(x);
      column.S = std::clamp(column.Station.Along, 0.0, 1.0);
    }
    column.Coarse = Noise::Along(this->Kinds[0].AlongScale * x, this->Kinds[0].Octaves);
    column.Fine = Noise::Along(this->Kinds[1].AlongScale * x, this->Kinds[1].Octaves);
    return column;
  }

  /// y in the plan as it is stretched; the skins are painted before the stretch.
  Row RowAt(double stretched) const
  {
    Row row;
    row.Y = stretched / this->Plan.Width;
    row.Coarse = Noise::Across(this->Kinds[0].AcrossScale * row.Y, this->Kinds[0].Octaves);
    row.Fine = Noise::Across(this->Kinds[1].AcrossScale * row.Y, this->Kinds[1].Octaves);
    return row;
  }

  double Coarse(const Column& column, const Row& row) const
  {
    return this->Grain.Octaves(column.Coarse, row.Coarse, this->Kinds[0].Octaves);
  }
  double Fine(const Column& column, const Row& row) const
  {
    return this->Grain.Octaves(column.Fine, row.Fine, this->Kinds[1].Octaves);
  }

  OutlineCoordinates CoordinatesOf(const Column& column, const Row& row) const
  {
    const double stretched = this->Plan.Width * row.Y;
    return this->Plan.Type == Outline::Kind::Strip
             ? this->Plan.CoordinatesOf(column.Station, stretched)
             : this->Plan.CoordinatesOf(column.X, stretched);
  }

  // How strongly a vein shows at a point of a strip: rib, side veins that bend towards the tip,
  // and a net between them.
  double StripVeins(double s, double t, double off) const
  {
    const double across = std::abs(t);
    const double rib = Line(off, 0.009 * (1.15 - s));
    double side = Smooth(1.05, 0.7, across);
    if (side > 0.0)
    {
      const double lead = s - 0.20 * std::pow(across, 1.4) + (t > 0.0 ? 0.0 : 0.03);
      side *= Line(ToInteger(11.0 * lead) / 11.0, 0.0042 * (1.2 - 0.7 * across));
    }
    const double net =
      0.30 * Line(ToInteger(55.0 * (s + 0.5 * across)) / 55.0, 0.003) * Smooth(0.02, 0.2, across);
    return std::max({ rib, 0.8 * side, net });
  }

  // One rib into each lobe of a maple leaf, with side veins.
  double StarVeins(double angle, double r) const
  {
    double veins = 0.0;
    for (const Outline::Rib& rib : this->Plan.Ribs)
    {
      const double off = SmallestAngle(angle - rib.Angle);
      if (r > 0.0 && std::abs(off) < 0.43)
      {
        const double along = r * std::cos(off);
        const double away = r * std::sin(off);
        veins = std::max(veins, Line(away, 0.008 * (1.2 - 1.5 * r)));
        const double lead = along - 0.9 * std::abs(away);
        veins = std::max(veins, 0.6 * Line(ToInteger(14.0 * lead) / 14.0, 0.004));
      }
    }
    return veins;
  }

  Color LeafColor(double across, double veins, const Column& column, const Row& row) const
  {
    const double blotch = this->Coarse(column, row);
    const double edge = Smooth(0.45, 1.05, across + 0.5 * blotch);
    const double spots = this->Options.Blotches * Smooth(0.05, 0.45, blotch);
    Color color = Mix(this->Options.BaseColor, this->Options.EdgeColor,
                      std::clamp(0.8 * edge + spots, 0.0, 1.0));
    color = Scale(color, 1.0 + 0.22 * this->Fine(column, row));
    return Mix(color, this->Options.VeinColor, 0.75 * veins);
  }

  void Leaf(const Column& column, const Row& row, Color& color, double& alpha) const
  {
    const OutlineCoordinates at = this->CoordinatesOf(column, row);
    if (this->Plan.Type == Outline::Kind::Star)
    {
      const double r = std::hypot(column.X - this->Plan.CenterX, row.Y);
      color = this->LeafColor(at.Across, this->StarVeins(at.Along, r), column, row);
      alpha = at.Across < 1.03 ? 1.0 : 0.0;
    }
    else
    {
      const double s = column.S;
      const double veins = this->StripVeins(s, at.Across, row.Y - column.Station.Middle);
      color = this->LeafColor(std::abs(at.Across), veins, column, row);
      // Teeth: the edge runs back a little and jumps out again.
      const double phase = 26.0 * s;
      const double tooth = this->Plan.Teeth * (phase - std::floor(phase));
      const bool inside = at.Along > -0.01 && at.Along < 1.01;
      alpha = inside && std::abs(at.Across) < 1.02 - tooth ? 1.0 : 0.0;
    }
    this->Stem(column.X, row.Y, color, alpha);
  }

  // Whatever lies before the blade is stem.
  void Stem(double x, double y, Color& color, double& alpha) const
  {
    const double end = this->Plan.StemEnd();
    if (this->Plan.StemWidth > 0.0 && x < end && x >= this->Plan.StemStart)
    {
      double along = 0.0;
      double middle = 0.0;
      this->Plan.StemAt((x - this->Plan.StemStart) / (end - this->Plan.StemStart), along, middle);
      const double off = std::abs(this->Plan.Width * y - middle);
      if (off < 0.7 * this->Plan.StemWidth)
      {
        const double round = 1.0 - 0.5 * off / this->Plan.StemWidth;
        const double tint = this->Plan.Paint == Outline::Skin::Feather ? 0.0 : 0.3;
        color = Scale(Mix(this->Options.VeinColor, this->Options.EdgeColor, tint), round);
        alpha = 1.0;
      }
    }
  }

  void Feather(const Column& column, const Row& row, Color& color, double& alpha) const
  {
    const OutlineCoordinates at = this->CoordinatesOf(column, row);
    const double s = column.S;
    const double across = std::abs(at.Across);
    const double off = row.Y - column.Station.Middle;
    // Barbs leave the shaft forwards; clumps of them part at the splits.
    const double barb = s - 0.9 * std::abs(off) * (1.0 + 0.6 * across);
    const double fine = 0.5 + 0.5 * std::cos(2.0 * M_PI * 150.0 * barb);
    const double clumps =
      this->Grain.Octaves(Noise::Along(60.0 * barb, 2), Noise::Across(off > 0.0 ? 3.0 : 8.0, 2), 2);
    const double bands = Smooth(-0.1, 0.35,
                                std::sin(2.0 * M_PI * (5.2 * (s - 0.3 * std::abs(off)) + 0.2)) +
                                  0.8 * this->Coarse(column, row));
    color = Mix(this->Options.BaseColor, this->Options.EdgeColor,
                this->Options.Blotches * bands * Smooth(0.10, 0.35, s));
    color = Mix(color, { 0.97, 0.96, 0.94 }, 0.7 * Smooth(0.16, 0.02, s));
    color = Scale(color, 0.90 + 0.10 * fine + 0.16 * clumps);
    const double shaft = Line(off, 0.0085 * (1.05 - s));
    color =
      Mix(color, Scale(this->Options.VeinColor, 1.0 - 0.25 * Smooth(-0.006, 0.006, off)), shaft);
    alpha = at.Along > -0.005 && at.Along < 1.0 && across < 1.0 ? 1.0 : 0.0;
    for (const auto& split : { std::array<double, 3>{ 0.34, 1.0, 0.35 },
                               { 0.63, 1.0, 0.55 },
                               { 0.47, -1.0, 0.45 },
                               { 0.80, -1.0, 0.5 },
                               { 0.23, -1.0, 0.3 } })
    {
      const double open = 0.012 * Smooth(split[2], 1.0, across);
      if (off * split[1] > 0.0 && std::abs(barb - split[0] + 0.06) < open)
      {
        alpha = 0.0;
      }
    }
    // Loose barbs at the base.
    const double loose = 1.0 - s / this->Plan.Fluff;
    if (loose > 0.0 && across > 0.25 &&
        this->Grain.At(170.0 * barb, 5.0 * off) > 0.25 - 0.39 * (1.0 - loose))
    {
      alpha = 0.0;
    }
    // The edge is frayed by single barbs.
    if (across > 0.93 && this->Grain.At(150.0 * barb, 2.0) > 0.1)
    {
      alpha = 0.0;
    }
    if (shaft > 0.5 && at.Along > 0.0 && at.Along < 1.0)
    {
      alpha = 1.0;
    }
    this->Stem(column.X, row.Y, color, alpha);
  }

  void Down(const Column& column, const Row& row, Color& color, double& alpha) const
  {
    const OutlineCoordinates at = this->CoordinatesOf(column, row);
    const double bend = at.Along + 0.6 * this->Grain.At(column.Coarse[0], row.Coarse[0]);
    const double wisps = this->Grain.At(14.0 * bend, 2.0 * at.Across) +
                         0.7 * this->Grain.At(37.0 * bend, 3.0 * at.Across);
    color = Scale(
      Mix(this->Options.BaseColor, this->Options.EdgeColor, 0.5 * Smooth(0.2, 1.0, at.Across)),
      1.0 + 0.08 * wisps);
    alpha = at.Across < 1.0 && wisps > 1.9 * at.Across - 1.35 ? 1.0 : 0.0;
  }

  void Petal(const Column& column, const Row& row, Color& color, double& alpha) const
  {
    const OutlineCoordinates at = this->CoordinatesOf(column, row);
    const double s = column.S;
    const double lines = 0.5 + 0.5 * std::cos(60.0 * at.Across);
    color = Mix(this->Options.EdgeColor, this->Options.BaseColor, Smooth(0.0, 0.75, s));
    color = Mix(color, this->Options.VeinColor, 0.12 * lines * (1.0 - 0.6 * s));
    color = Scale(color, 1.0 + 0.10 * this->Coarse(column, row));
    const double notch = 0.06 * std::exp(-(row.Y / 0.05) * (row.Y / 0.05));
    alpha = s < 1.0 - notch && std::abs(at.Across) < 1.02 ? 1.0 : 0.0;
  }

  void Paint(const Column& column, const Row& row, Color& color, double& alpha) const
  {
    switch (this->Plan.Paint)
    {
      case Outline::Skin::Feather:
        this->Feather(column, row, color, alpha);
        break;
      case Outline::Skin::Down:
        this->Down(column, row, color, alpha);
        break;
      case Outline::Skin::Petal:
        this->Petal(column, row, color, alpha);
        break;
      case Outline::Skin::Leaf:
        this->Leaf(column, row, color, alpha);
        break;
    }
  }
};

} // namespace

SkinOptions FeatherSkin()
{
  SkinOptions skin;
  skin.BaseColor = { 0.93, 0.90, 0.84 };
  skin.EdgeColor = { 0.44, 0.31, 0.22 };
  skin.VeinColor = { 0.90, 0.84, 0.72 };
  skin.Blotches = 0.9;
  return skin;
}

int TextureHeight(const Outline& outline, int width)
{
  const PlanBox box = TextureBox(outline);
  const double ratio = (box.Y1 - box.Y0) / (box.X1 - box.X0);
  return std::clamp(static_cast<int>(std::lround(ratio * width)),
                    static_cast<int>(TexturePixels.Low), static_cast<int>(TexturePixels.High));
}

Result PaintTexture(const Outline& outline, const SkinOptions& options, int height,
                    std::vector<std::uint8_t>& pixels)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  WAFT_RETURN_IF_FAILED((OptionField{ "height", TexturePixels, "pixels", "" }.Check(height)));
  const PlanBox box = TextureBox(outline);
  const Painter painter{ options, outline, Noise(options.Seed) };
  pixels.assign(4 * static_cast<std::size_t>(options.TextureSize) * height, 0);
  constexpr int fine = 3; // samples a side of a pixel
  const auto sample = [](int pixel, int part, int count)
  { return (pixel + (part + 0.5) / fine) / count; };
  std::vector<Column> columns;
  for (int i = 0; i < fine * options.TextureSize; ++i)
  {
    const double u = sample(i / fine, i % fine, options.TextureSize);
    columns.push_back(painter.ColumnAt(box.X0 + u * (box.X1 - box.X0)));
  }
  std::array<Row, fine> rows;
  for (int j = 0; j < height; ++j)
  {
    for (int part = 0; part < fine; ++part)
    {
      rows[part] = painter.RowAt(box.Y0 + sample(j, part, height) * (box.Y1 - box.Y0));
    }
    for (int i = 0; i < options.TextureSize; ++i)
    {
      Color sum{ 0.0, 0.0, 0.0 };
      double cover = 0.0;
      for (int k = 0; k < fine * fine; ++k)
      {
        Color color{};
        double alpha = 0.0;
        painter.Paint(columns[fine * i + k % fine], rows[k / fine], color, alpha);
        cover += alpha;
        for (int c = 0; c < 3; ++c)
        {
          sum[c] += color[c];
        }
      }
      // Colour goes on beyond the outline, so that filtering does not darken its edge.
      std::uint8_t* pixel = &pixels[4 * (static_cast<std::size_t>(j) * options.TextureSize +
                                         static_cast<std::size_t>(i))];
      for (int c = 0; c < 3; ++c)
      {
        pixel[c] = static_cast<std::uint8_t>(
          std::lround(255.0 * std::clamp(sum[c] / (fine * fine), 0.0, 1.0)));
      }
      pixel[3] = static_cast<std::uint8_t>(std::lround(255.0 * cover / (fine * fine)));
    }
  }
  return Result::Ok();
}

} // namespace waft
