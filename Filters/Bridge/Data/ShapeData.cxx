// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/ShapeData.h"

#include "Base/ShapeMeasures.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"

#include <vtkCellArray.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace waft
{
namespace
{

void ShapeToPolyData(const Shape& shape, vtkPolyData* data)
{
  vtkNew<vtkPoints> points;
  SetPoints(points, shape.Mesh.Points);
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : shape.Mesh.Triangles)
  {
    const vtkIdType ids[3] = { t[0], t[1], t[2] };
    triangles->InsertNextCell(3, ids);
  }
  data->SetPoints(points);
  data->SetPolys(triangles);
  if (!shape.TextureCoordinates.empty())
  {
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetName("TextureCoordinates");
    coordinates->SetNumberOfComponents(2);
    for (const auto& uv : shape.TextureCoordinates)
    {
      coordinates->InsertNextTuple2(uv[0], uv[1]);
    }
    data->GetPointData()->SetTCoords(coordinates);
  }
  vtkFieldData* fields = data->GetFieldData();
  AddDoubles(fields, names::DragCoefficient, { shape.DragCoefficient });
  AddDoubles(fields, names::AreaDensity, { shape.AreaDensity });
  AddDoubles(fields, names::Thickness, { shape.Thickness });
  AddDoubles(fields, names::SettlingSpeed, { shape.SettlingSpeed });
  AddDoubles(fields, names::Damping, { shape.Damping });
  AddInts(fields, names::ClassId, { shape.ClassId });
  LooksToFieldData({ shape }, fields);
  AuthoredToFieldData(shape.Authored, data);
}

void ReadColor(vtkFieldData* fields, const char* name, std::array<double, 3>& color)
{
  vtkDataArray* array = fields->GetArray(name);
  const bool isColor =
    array && array->GetNumberOfComponents() == 3 && array->GetNumberOfTuples() > 0;
  for (int c = 0; isColor && c < 3; ++c)
  {
    color[static_cast<std::size_t>(c)] = array->GetComponent(0, c);
  }
}

Result ShapeFromPolyData(vtkPolyData* data, const std::string& name, Shape& shape)
{
  shape.Name = name;
  WAFT_RETURN_IF_FAILED(MeshFromPolyData(data, "Shapes: block " + name, shape.Mesh));
  if (shape.Mesh.Triangles.empty())
  {
    return Result::Error("Shapes: block " + name + ": expected at least one triangle");
  }
  if (vtkDataArray* coordinates = data->GetPointData()->GetTCoords())
  {
    for (vtkIdType i = 0; i < coordinates->GetNumberOfTuples(); ++i)
    {
      shape.TextureCoordinates.push_back(
        { coordinates->GetComponent(i, 0), coordinates->GetComponent(i, 1) });
    }
  }
  vtkFieldData* fields = data->GetFieldData();
  const std::string owner = "Shapes: block " + name + ": field data";
  const auto number = [&](const char* field, const limits::Range& range, double& value)
  { return ReadNumber(fields, owner, field, range, value); };
  const limits::Range factor = limits::Factor;
  WAFT_RETURN_IF_FAILED(number(names::DragCoefficient, factor, shape.DragCoefficient));
  WAFT_RETURN_IF_FAILED(number(names::AreaDensity, limits::AreaDensity, shape.AreaDensity));
  WAFT_RETURN_IF_FAILED(number(names::Thickness, limits::Distance, shape.Thickness));
  WAFT_RETURN_IF_FAILED(number(names::SettlingSpeed, factor, shape.SettlingSpeed));
  WAFT_RETURN_IF_FAILED(number(names::Damping, factor, shape.Damping));
  double classId = shape.ClassId;
  WAFT_RETURN_IF_FAILED(number(names::ClassId, { -1, limits::Id.High }, classId));
  shape.ClassId = static_cast<int>(classId);
  ReadColor(fields, names::Color, shape.Color);
  ReadColor(fields, names::Tint, shape.Tint);
  shape.Texture = FirstString(fields, names::Texture);
  shape.Skin = SkinOf(fields, 0);
  shape.Authored = AuthoredFromFieldData(data);
  return Result::Ok();
}

// Groups of shapes are taken as one list.
Result AddShapes(vtkMultiBlockDataSet* data, std::vector<Shape>& shapes)
{
  for (unsigned int i = 0; i < data->GetNumberOfBlocks(); ++i)
  {
    const char* name =
      data->HasMetaData(i) && data->GetMetaData(i)->Has(vtkCompositeDataSet::NAME())
        ? data->GetMetaData(i)->Get(vtkCompositeDataSet::NAME())
        : nullptr;
    const std::string title = name ? name : std::to_string(i);
    if (auto* group = vtkMultiBlockDataSet::SafeDownCast(data->GetBlock(i)))
    {
      WAFT_RETURN_IF_FAILED(AddShapes(group, shapes));
      continue;
    }
    auto* block = vtkPolyData::SafeDownCast(data->GetBlock(i));
    if (!block)
    {
      return Result::Error("Shapes: block " + title + ": expected a surface (vtkPolyData)");
    }
    Shape shape;
    WAFT_RETURN_IF_FAILED(ShapeFromPolyData(block, title, shape));
    shapes.push_back(std::move(shape));
  }
  return Result::Ok();
}

} // namespace

void LooksToFieldData(const std::vector<Shape>& shapes, vtkFieldData* fields)
{
  std::vector<Vec3> colors, tints;
  std::vector<double> opacities;
  std::vector<std::string> textures;
  std::vector<unsigned char> skins;
  std::vector<int> sizes;
  for (const Shape& shape : shapes)
  {
    colors.emplace_back(shape.Color[0], shape.Color[1], shape.Color[2]);
    tints.emplace_back(shape.Tint[0], shape.Tint[1], shape.Tint[2]);
    opacities.push_back(Opacity(shape));
    textures.push_back(shape.Texture);
    skins.insert(skins.end(), shape.Skin.begin(), shape.Skin.end());
    sizes.push_back(static_cast<int>(shape.Skin.size()));
  }
  AddVectors(fields, names::Color, colors);
  AddVectors(fields, names::Tint, tints);
  AddDoubles(fields, names::Opacity, opacities);
  AddStrings(fields, names::Texture, textures);
  if (!skins.empty())
  {
    AddBytes(fields, names::Skin, skins);
    AddInts(fields, names::SkinSize, sizes);
  }
}

std::string SkinOf(vtkFieldData* fields, std::size_t shape)
{
  auto* bytes = vtkUnsignedCharArray::SafeDownCast(fields->GetAbstractArray(names::Skin));
  auto* sizes = vtkIntArray::SafeDownCast(fields->GetAbstractArray(names::SkinSize));
  const auto index = static_cast<vtkIdType>(shape);
  if (bytes == nullptr || sizes == nullptr || index >= sizes->GetNumberOfValues())
  {
    return {};
  }
  vtkIdType begin = 0;
  for (vtkIdType i = 0; i < index; ++i)
  {
    begin += std::max(0, sizes->GetValue(i));
  }
  const vtkIdType size = sizes->GetValue(index);
  return size > 0 && begin + size <= bytes->GetNumberOfValues()
           ? std::string(reinterpret_cast<const char*>(bytes->GetPointer(begin)),
                         static_cast<std::size_t>(size))
           : std::string();
}

void ShapesToMultiBlock(const std::vector<Shape>& shapes, const SceneInfo& info,
                        vtkMultiBlockDataSet* data)
{
  data->Initialize();
  data->SetNumberOfBlocks(static_cast<unsigned int>(shapes.size()));
  for (unsigned int i = 0; i < shapes.size(); ++i)
  {
    vtkNew<vtkPolyData> block;
    ShapeToPolyData(shapes[i], block);
    data->SetBlock(i, block);
    data->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), shapes[i].Name.c_str());
  }
  SceneInfoToFieldData(info, data);
}

Result ShapesFromMultiBlock(vtkMultiBlockDataSet* data, std::vector<Shape>& shapes)
{
  std::vector<Shape> read;
  WAFT_RETURN_IF_FAILED(AddShapes(data, read));
  shapes = std::move(read);
  return Result::Ok();
}

Result BodiesFromMultiBlock(vtkMultiBlockDataSet* data, std::vector<Shape>& shapes)
{
  WAFT_RETURN_IF_FAILED(ShapesFromMultiBlock(data, shapes));
  return shapes.empty()
           ? Result::Error("Shapes: no shapes: expected a block (vtkPolyData) for each "
                           "ShapeId of Objects, found none")
           : Result::Ok();
}

} // namespace waft
