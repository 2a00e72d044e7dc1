// SPDX-License-Identifier: BSD-3-Clause
// Targets of a keyframe: points, or points sampled from a text, a picture or a surface.
#include "Scene/LetterSpacing.h"
#include "Scene/SceneReader.h"
#include "Scene/SurfaceSampling.h"
#include "Scene/TargetSampling.h"
#include "Scene/TextFonts.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

// Of a text: its picture has to be drawn whole.
constexpr int MostLetters = 1000;
constexpr double LevelTolerance = 1e-6; // m

} // namespace

SceneReader::TargetFrame SceneReader::ReadTargetFrame(const SceneNode& node, bool needsWidth) const
{
  TargetFrame frame;
  frame.Origin = node.At("origin", "the centre [x, y, z]").Vector();
  const auto direction = [&](const char* field, Vec3& value)
  {
    if (node.Has(field))
    {
      const Vec3 v = node.At(field, "").Vector();
      if (!(v.norm() > 1e-12))
      {
        node.At(field, "").Fail("a direction that is not zero");
      }
      value = v.normalized();
    }
  };
  direction("u", frame.U);
  direction("v", frame.V);
  if (frame.U.cross(frame.V).norm() < 1e-3)
  {
    node.FailWith("expected directions `u` and `v` that are not parallel, found parallel ones");
  }
  if (needsWidth || node.Has("width"))
  {
    frame.Width = node.At("width", "a width in metres").Number();
  }
  return frame;
}

// The largest extent of any object, in pixels of a picture that is so wide.
double SceneReader::BodyWidth(const TargetFrame& frame, int pixels) const
{
  double radius = 0.0;
  for (const MotionObject& object : this->Out.Objects)
  {
    radius = std::max(radius, object.ClearanceRadius);
  }
  return 2.0 * radius / frame.Width * pixels;
}

std::vector<SceneReader::Target> SceneReader::SamplePlane(const SceneNode& node, TargetMask mask,
                                                          std::size_t count,
                                                          const std::vector<int>& classIds,
                                                          int row) const
{
  const TargetFrame frame = this->ReadTargetFrame(node, true);
  mask.BodyWidth = this->BodyWidth(frame, mask.Width);
  std::vector<std::size_t> limits(classIds.size(), 0);
  for (std::size_t c = 0; c < classIds.size(); ++c)
  {
    limits[c] = static_cast<std::size_t>(
      std::count_if(this->Out.Objects.begin(), this->Out.Objects.end(),
                    [&](const MotionObject& o) { return o.ClassId == classIds[c]; }));
  }
  std::vector<PlaneTarget> samples;
  Check(node,
        [&]
        {
          return SampleMask(mask, count, limits, this->Out.Info.Seed,
                            static_cast<std::uint64_t>(row), samples);
        });
  if (this->Drawings != nullptr)
  {
    this->Drawings->push_back(
      { row, frame.Origin, frame.U, frame.V, frame.Width, std::move(mask) });
  }
  std::vector<Target> targets;
  for (const PlaneTarget& sample : samples)
  {
    targets.push_back({ frame.Origin + frame.Width * (sample.X * frame.U + sample.Y * frame.V),
                        sample.Class < 0 ? -1 : classIds[sample.Class],
                        sample.X,
                        sample.Y,
                        {} });
  }
  return targets;
}

std::vector<SceneReader::Target> SceneReader::SampleMesh(const SceneNode& node, std::size_t count,
                                                         int row) const
{
  const SceneNode file = node.At("mesh", "");
  TriangleMesh mesh;
  const std::string path = this->File(file);
  Check(file, [&] { return this->Assets.LoadMesh(path, mesh); });
  if (mesh.Points.empty())
  {
    file.Fail("a mesh with points");
  }
  const auto [low, high] = BoxAbout(mesh.Points);
  const TargetFrame frame = this->ReadTargetFrame(node, false);
  const double extent = high.x() - low.x();
  if (node.Has("width") && !(extent > 0.0))
  {
    file.Fail("a mesh that extends along its x axis (`width` scales it)");
  }
  const double scale = node.Has("width") ? frame.Width / extent : 1.0;
  std::vector<Vec3> points;
  Check(file,
        [&]
        {
          return SampleSurface(mesh, count, this->Out.Info.Seed, static_cast<std::uint64_t>(row),
                               points);
        });
  const Vec3 w = frame.U.cross(frame.V).normalized();
  std::vector<Target> targets;
  for (const Vec3& p : points)
  {
    const Vec3 local = scale * (p - 0.5 * (low + high));
    targets.push_back({ frame.Origin + local.x() * frame.U + local.y() * frame.V + local.z() * w,
                        -1,
                        local.x(),
                        local.y(),
                        {} });
  }
  return targets;
}

int SceneReader::TargetClass(const SceneNode& node, const std::string& name) const
{
  const auto found = std::find(this->Out.Classes.begin(), this->Out.Classes.end(), name);
  if (found == this->Out.Classes.end())
  {
    node.FailWith("expected the class of a shape, found the unknown class \"" + Shortened(name) +
                  "\"");
  }
  return static_cast<int>(found - this->Out.Classes.begin());
}

// Points, and the class that each is for where they have any ("": any class).
std::vector<SceneReader::Target> SceneReader::ReadPoints(const SceneNode& node) const
{
  node.CheckFields("pointTargets");
  const SceneNode points = node.At("points", "");
  std::vector<Target> targets;
  const std::size_t count = points.Size("a list of points");
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vec3 point = points.Item(i).Vector();
    targets.push_back({ point, -1, point.x(), point.z(), {} });
  }
  const bool areLevel =
    std::all_of(targets.begin(), targets.end(),
                [&](const Target& target)
                { return std::abs(target.Up - targets.front().Up) < LevelTolerance; });
  for (Target& target : targets)
  {
    target.Up = areLevel ? target.Position.y() : target.Up; // as seen from above
  }
  if (node.Has("classes"))
  {
    const SceneNode classes = node.At("classes", "");
    if (classes.Size("a list of classes, one a point") != targets.size())
    {
      classes.FailWith("expected " + std::to_string(targets.size()) +
                       " classes, one a point, found " +
                       std::to_string(classes.Size("a list of classes")));
    }
    for (std::size_t i = 0; i < targets.size(); ++i)
    {
      const SceneNode name = classes.Item(i);
      targets[i].ClassId = name.Text().empty() ? -1 : this->TargetClass(name, name.Text());
    }
  }
  return targets;
}

std::vector<SceneReader::Target> SceneReader::ReadTargets(const SceneNode& node, int row,
                                                          std::size_t objects) const
{
  const char* kinds[] = { "points", "text", "image", "mesh" };
  const auto given =
    std::count_if(std::begin(kinds), std::end(kinds), [&](const char* k) { return node.Has(k); });
  if (given != 1)
  {
    (void)node.Fields(); // says so when this is no object at all
    node.Fail("targets with one of `points`, `text`, `image` and `mesh`");
  }
  std::vector<Target> targets;
  if (node.Has("points"))
  {
    return this->ReadPoints(node);
  }
  node.CheckFields(node.Has("text") ? "textTargets"
                                    : (node.Has("image") ? "imageTargets" : "meshTargets"));
  std::size_t count = objects;
  node.Take("count", count, "a number of targets");
  if (node.Has("mesh"))
  {
    return this->SampleMesh(node, count, row);
  }
  Picture picture;
  if (node.Has("text"))
  {
    const SceneNode text = node.At("text", "");
    std::string font = node.Has("font") ? node.At("font", "").Text() : "sans";
    if (!IsFontFamily(font))
    {
      font = this->File(node.At("font", ""));
    }
    const std::string letters = text.Lines();
    const auto length = std::count_if(letters.begin(), letters.end(),
                                      [](char c) { return (c & 0xc0) != 0x80; }); // UTF-8
    if (length < 1 || length > MostLetters)
    {
      text.Fail("a text of 1 to " + std::to_string(MostLetters) + " characters");
    }
    Check(text, [&] { return this->Assets.DrawText(letters, font, picture); });
    TargetMask close = MaskFromPicture(picture, {});
    close.BodyWidth = this->BodyWidth(this->ReadTargetFrame(node, true), close.Width);
    const double distance = TargetDistance(close, count);
    picture = SpreadLetters(picture, distance);
    std::vector<Target> drawn =
      this->SamplePlane(node, MaskFromPicture(picture, {}), count, {}, row);
    std::vector<std::array<double, 2>> pixels;
    for (const Target& target : drawn)
    {
      pixels.push_back({ (target.Across + 0.5) * picture.Width,
                         target.Up * picture.Width + 0.5 * picture.Height });
    }
    const std::vector<TextPlace> places = PlacesInText(picture, letters, pixels);
    for (std::size_t t = 0; t < drawn.size(); ++t)
    {
      drawn[t].Place = places[t];
    }
    return drawn;
  }
  const SceneNode image = node.At("image", "");
  const std::string path = this->File(image);
  Check(image, [&] { return this->Assets.LoadPicture(path, picture); });
  const std::string remark = RemarkOnTransparency(picture);
  if (!remark.empty() && !node.Has("classes"))
  {
    this->Out.Warnings.push_back(this->Name + ": " + image.Pointer() + ": " + remark);
  }
  std::vector<int> classIds;
  std::vector<std::array<double, 3>> colors;
  if (node.Has("classes"))
  {
    const SceneNode classes = node.At("classes", "");
    for (const std::string& name : classes.Fields())
    {
      const SceneNode color = classes.At(name, "");
      classIds.push_back(this->TargetClass(color, name));
      const Vec3 rgb = color.Vector();
      colors.push_back({ rgb[0], rgb[1], rgb[2] });
    }
    if (!node.Has("count"))
    {
      count = 0;
      for (const MotionObject& object : this->Out.Objects)
      {
        count += std::find(classIds.begin(), classIds.end(), object.ClassId) != classIds.end();
      }
    }
  }
  return this->SamplePlane(node, MaskFromPicture(picture, colors), count, classIds, row);
}

} // namespace waft
