// SPDX-License-Identifier: BSD-3-Clause
// Writes the meshes and textures of Data/Shapes:  WaftMakeShapeFiles FOLDER
#include "Base/AtomicFile.h"
#include "Shapes/PngImage.h"
#include "Shapes/TextureImage.h"
#include "Shapes/ThinShape.h"

#include <cstdio>

namespace
{

struct Job
{
  const char* File;
  const char* Builtin;
  waft::SkinOptions Skin;
  int Height;
};

// Wavefront OBJ with texture coordinates, metres, z up.
bool WriteObj(const std::string& path, const waft::Shape& shape)
{
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file)
  {
    return false;
  }
  std::fprintf(file, "# Waft %s: metres, z up, x along the length\n", shape.Name.c_str());
  for (const waft::Vec3& p : shape.Mesh.Points)
  {
    std::fprintf(file, "v %.7f %.7f %.7f\n", p.x(), p.y(), p.z());
  }
  for (const auto& t : shape.TextureCoordinates)
  {
    std::fprintf(file, "vt %.5f %.5f\n", t[0], t[1]);
  }
  for (const auto& t : shape.Mesh.Triangles)
  {
    std::fprintf(file, "f %d/%d %d/%d %d/%d\n", t[0] + 1, t[0] + 1, t[1] + 1, t[1] + 1, t[2] + 1,
                 t[2] + 1);
  }
  return std::fclose(file) == 0;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  using Color = std::array<double, 3>;
  const auto job = [](const char* file, const char* builtin, int width, int height, Color base,
                      Color edge, Color vein, double blotches, std::uint64_t seed) {
    return Job{ file, builtin, { "", width, base, edge, vein, blotches, seed }, height };
  };
  const Job jobs[] = {
    job("leaf-green.png", "leaf", 384, 192, { 0.36, 0.52, 0.14 }, { 0.66, 0.62, 0.16 },
        { 0.74, 0.78, 0.44 }, 0.35, 1),
    job("leaf-gold.png", "leaf", 384, 192, { 0.90, 0.68, 0.15 }, { 0.80, 0.42, 0.10 },
        { 0.62, 0.38, 0.12 }, 0.6, 2),
    job("maple-red.png", "maple", 352, 352, { 0.80, 0.20, 0.09 }, { 0.88, 0.46, 0.12 },
        { 0.48, 0.10, 0.07 }, 0.6, 3),
    job("oak-brown.png", "oak", 384, 224, { 0.70, 0.43, 0.16 }, { 0.45, 0.25, 0.10 },
        { 0.86, 0.66, 0.36 }, 0.6, 4),
    job("willow-yellow.png", "willow", 384, 96, { 0.80, 0.74, 0.28 }, { 0.66, 0.48, 0.14 },
        { 0.93, 0.89, 0.55 }, 0.5, 5),
    job("aspen-gold.png", "aspen", 288, 256, { 0.93, 0.74, 0.16 }, { 0.85, 0.52, 0.10 },
        { 0.98, 0.90, 0.55 }, 0.5, 10),
    job("aspen-red.png", "aspen", 288, 256, { 0.80, 0.30, 0.12 }, { 0.62, 0.16, 0.08 },
        { 0.95, 0.66, 0.36 }, 0.6, 11),
    job("feather-barred.png", "feather", 512, 160, { 0.93, 0.90, 0.84 }, { 0.44, 0.31, 0.22 },
        { 0.90, 0.84, 0.72 }, 0.9, 6),
    job("feather-white.png", "feather", 512, 160, { 0.96, 0.95, 0.93 }, { 0.80, 0.82, 0.86 },
        { 0.93, 0.89, 0.80 }, 0.4, 7),
    job("down-white.png", "down", 256, 256, { 0.98, 0.97, 0.95 }, { 0.90, 0.90, 0.92 },
        { 0.95, 0.95, 0.95 }, 0.0, 8),
    job("petal-pink.png", "petal", 256, 224, { 0.98, 0.78, 0.84 }, { 0.88, 0.36, 0.52 },
        { 0.80, 0.30, 0.46 }, 0.0, 9),
  };
  for (const Job& job : jobs)
  {
    std::vector<std::uint8_t> pixels;
    waft::Outline outline;
    const std::string path = std::string(argv[1]) + "/" + job.File;
    std::string png;
    waft::Result result = waft::OutlineOf(job.Builtin, outline);
    if (result)
    {
      result = waft::PaintTexture(outline, job.Skin, job.Height, pixels);
    }
    if (result)
    {
      png = waft::EncodePng(pixels, job.Skin.TextureSize, job.Height);
      result = waft::WriteWholeFile(path, png);
    }
    if (!result)
    {
      std::fprintf(stderr, "%s: %s\n", job.File, result.Message().c_str());
      return 1;
    }
    std::printf("%s %zu bytes\n", path.c_str(), png.size());
  }
  for (const char* name : { "leaf", "maple", "oak", "feather" })
  {
    waft::Shape shape;
    const std::string path = std::string(argv[1]) + "/" + name + ".obj";
    if (!waft::MakeBuiltinShape(name, 0.0, shape) || !WriteObj(path, shape))
    {
      std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
      return 1;
    }
    std::printf("%s %zu triangles\n", path.c_str(), shape.Mesh.Triangles.size());
  }
  return 0;
}
