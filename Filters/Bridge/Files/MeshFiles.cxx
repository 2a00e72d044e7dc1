// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/MeshFiles.h"

#include "Bridge/Data/Arrays.h"
#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/FileReading.h"
#include "Files/FileBytes.h"
#include "Files/GltfMesh.h"
#include "Files/MeshReaders.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolygon.h>
#include <vtkVersionMacros.h>

namespace waft
{
namespace
{

// The corners of the triangles that a polygon is split into, by VTK's way of cutting ears off. One
// that has no such split, as it crosses itself, is split into a fan.
void AddTriangles(const PolygonSurface& polygons, std::size_t first, std::size_t count,
                  vtkPolygon* polygon, vtkIdList* split, TriangleMesh& mesh)
{
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c)
  {
    const int* corners = &polygons.Corners[first];
    mesh.Triangles.push_back({ corners[a], corners[b], corners[c] });
  };
  split->Reset();
  if (count > 3)
  {
    const auto size = static_cast<vtkIdType>(count);
    polygon->Points->SetNumberOfPoints(size);
    polygon->PointIds->SetNumberOfIds(size);
    for (vtkIdType i = 0; i < size; ++i)
    {
      const int corner = polygons.Corners[first + static_cast<std::size_t>(i)];
      polygon->Points->SetPoint(i, polygons.Points[static_cast<std::size_t>(corner)].data());
      polygon->PointIds->SetId(i, i);
    }
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 20240101) // 9.3.0 itself has it not
    polygon->TriangulateLocalIds(0, split);
#else
    polygon->Triangulate(split);
#endif
  }
  for (vtkIdType i = 0; i + 2 < split->GetNumberOfIds(); i += 3)
  {
    add(static_cast<std::size_t>(split->GetId(i)), static_cast<std::size_t>(split->GetId(i + 1)),
        static_cast<std::size_t>(split->GetId(i + 2)));
  }
  for (std::size_t i = 2; i < count && split->GetNumberOfIds() == 0; ++i)
  {
    add(0, i - 1, i);
  }
}

void SplitPolygons(PolygonSurface polygons, SurfaceFile& surface)
{
  vtkNew<vtkPolygon> polygon;
  polygon->Points->SetDataTypeToDouble();
  vtkNew<vtkIdList> split;
  std::size_t first = 0;
  for (const std::size_t end : polygons.Ends)
  {
    AddTriangles(polygons, first, end - first, polygon, split, surface.Mesh);
    first = end;
  }
  surface.Mesh.Points = std::move(polygons.Points);
  surface.TextureCoordinates = std::move(polygons.TextureCoordinates);
}

Result ReadPolygons(const std::string& path, Result (*read)(std::string_view, PolygonSurface&),
                    SurfaceFile& surface)
{
  FileBytes file;
  WAFT_RETURN_IF_FAILED(file.Open(path));
  PolygonSurface polygons;
  WAFT_RETURN_IF_FAILED(read(file.View(), polygons));
  SplitPolygons(std::move(polygons), surface);
  return Result::Ok();
}

Result ReadGltfSurface(const std::string& path, SurfaceFile& surface)
{
  GltfSurface read;
  WAFT_RETURN_IF_FAILED(ReadGltf(path, read));
  surface.Mesh = std::move(read.Mesh);
  surface.TextureCoordinates = std::move(read.TextureCoordinates);
  for (Vec3& p : surface.Mesh.Points)
  {
    p = Vec3(p.x(), -p.z(), p.y());
  }
  return Result::Ok();
}

// The polygons of VTK's data; a strip is its triangles, every second of them turned back.
Result PolygonsOf(vtkPolyData* data, PolygonSurface& polygons)
{
  vtkNew<vtkIdList> ids;
  const auto add = [&](std::initializer_list<vtkIdType> corners)
  {
    for (const vtkIdType corner : corners)
    {
      polygons.Corners.push_back(static_cast<int>(ids->GetId(corner)));
    }
  };
  for (vtkIdType cell = 0; cell < data->GetPolys()->GetNumberOfCells(); ++cell)
  {
    data->GetPolys()->GetCellAtId(cell, ids);
    if (ids->GetNumberOfIds() > static_cast<vtkIdType>(MostCorners))
    {
      return Result::Error("polygon " + std::to_string(cell) + ": expected at most " +
                           std::to_string(MostCorners) + " corners, found " +
                           std::to_string(ids->GetNumberOfIds()));
    }
    for (vtkIdType i = 0; ids->GetNumberOfIds() > 2 && i < ids->GetNumberOfIds(); ++i)
    {
      add({ i });
    }
    polygons.Ends.push_back(polygons.Corners.size());
  }
  for (vtkIdType cell = 0; cell < data->GetStrips()->GetNumberOfCells(); ++cell)
  {
    data->GetStrips()->GetCellAtId(cell, ids);
    for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i)
    {
      const vtkIdType odd = i % 2;
      add({ i - 2 + odd, i - 1 - odd, i });
      polygons.Ends.push_back(polygons.Corners.size());
    }
  }
  return Result::Ok();
}

Result ReadPolyData(const std::string& path, SurfaceFile& surface)
{
  vtkNew<vtkPolyData> data;
  WAFT_RETURN_IF_FAILED(ReadPolyDataFile(path, data));
  if (data->GetNumberOfPoints() > static_cast<vtkIdType>(MostOfASurface))
  {
    return Result::Error("expected at most " + std::to_string(MostOfASurface) + " points, found " +
                         std::to_string(data->GetNumberOfPoints()));
  }
  PolygonSurface polygons;
  WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), "mesh", polygons.Points));
  WAFT_RETURN_IF_FAILED(PolygonsOf(data, polygons));
  vtkDataArray* coordinates = data->GetPointData()->GetTCoords();
  for (vtkIdType i = 0; coordinates && i < coordinates->GetNumberOfTuples(); ++i)
  {
    polygons.TextureCoordinates.push_back(
      { coordinates->GetComponent(i, 0), coordinates->GetComponent(i, 1) });
  }
  SplitPolygons(std::move(polygons), surface);
  return Result::Ok();
}

} // namespace

Result ReadSurfaceFile(const std::string& path, SurfaceFile& surface)
{
  const std::string extension = Extension(path);
  SurfaceFile read;
  if (extension == ".glb" || extension == ".gltf")
  {
    WAFT_RETURN_IF_FAILED(ReadGltfSurface(path, read));
  }
  else if (extension == ".obj")
  {
    WAFT_RETURN_IF_FAILED(ReadPolygons(path, ReadObj, read));
  }
  else if (extension == ".ply")
  {
    WAFT_RETURN_IF_FAILED(ReadPolygons(path, ReadPly, read));
  }
  else if (extension == ".stl")
  {
    WAFT_RETURN_IF_FAILED(ReadPolygons(path, ReadStl, read));
  }
  else if (extension == ".vtp")
  {
    WAFT_RETURN_IF_FAILED(ReadPolyData(path, read));
  }
  else
  {
    return Result::Error("expected a .vtp, .obj, .ply, .stl or .glb file, found " +
                         Quoted(extension));
  }
  if (read.Mesh.Triangles.empty())
  {
    return Result::Error("expected a surface with triangles, found none");
  }
  surface = std::move(read);
  return Result::Ok();
}

} // namespace waft
