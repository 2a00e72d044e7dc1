// SPDX-License-Identifier: BSD-3-Clause
// Winds of one file and of a series, and what samples them. The first byte of an input chooses the
// kind of file; a .vti is also the second step of a series whose collection is right.
#include "Fuzz.h"

#include "Bridge/Files/WindFiles.h"

#include <vtkObject.h>

#include <array>

using namespace waft;

namespace
{

void Read(const std::string& path)
{
  SceneInfo scene;
  scene.Time.NumberOfFrames = 31;
  WindFile file;
  file.Path = path;
  FieldSeries wind;
  if (ReadWindFile(file, scene, wind))
  {
    (void)wind.Sample(Vec3(0.1, -0.2, 1.3), 0.4);
    (void)wind.Sample(Vec3(1e6, -1e6, 1e6), 1e6);
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static constexpr std::array<const char*, 3> kinds{ ".vti", ".pvd", ".vdb" };
  if (size == 0)
  {
    return 0;
  }
  vtkObject::GlobalWarningDisplayOff();
  const std::size_t kind = data[0] % kinds.size();
  const FuzzFile file(std::string("fuzz") + kinds[kind], FuzzBytes(data, size, 1));
  Read(file.Path);
  if (kind == 0)
  {
    const FuzzFile series(
      "fuzz.pvd",
      "<VTKFile type=\"Collection\" version=\"0.1\"><Collection>"
      "<DataSet timestep=\"0\" file=\"fuzz.vti\"/><DataSet timestep=\"1\" file=\"fuzz.vti\"/>"
      "</Collection></VTKFile>");
    Read(series.Path);
  }
  return 0;
}
