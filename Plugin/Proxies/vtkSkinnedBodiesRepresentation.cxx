// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSkinnedBodiesRepresentation.h"

#include "vtkActorOfParts.h"
#include "vtkCheckedFiles.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkCellArray.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPVRenderView.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkStringArray.h>
#include <vtkTexture.h>
#include <vtkView.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

vtkStandardNewMacro(vtkSkinnedBodiesRepresentation);

namespace
{

constexpr int MostTexels = 4096; // along a side
constexpr double Film = 0.999;   // opacity from which on a body is none
// Cut out by alpha rather than blended: right from every side without sorting.
constexpr const char* CutOut = "//VTK::TCoord::Impl\n  if (gl_FragData[0].a < 0.5) discard;\n";
// VTK turns a normal towards the eye; what the first light throws on the other side comes through.
constexpr const char* ShineThrough =
  "//VTK::Light::Impl\n  fragOutput0.rgb += 0.35 * diffuseColor * lightColor0"
  " * max(0.0, dot(normalVCVSOutput, lightDirectionVC0));\n";

void TakeColor(vtkFieldData* fields, const char* name, vtkIdType shape, double color[3])
{
  vtkDataArray* array = fields->GetArray(name);
  if (array != nullptr && array->GetNumberOfComponents() == 3 && shape < array->GetNumberOfTuples())
  {
    for (int c = 0; c < 3; ++c)
    {
      color[c] = std::clamp(array->GetComponent(shape, c), 0.0, 1.0);
    }
  }
}

std::string TextureNamed(vtkFieldData* fields, vtkIdType shape)
{
  auto* names = vtkStringArray::SafeDownCast(fields->GetAbstractArray("Texture"));
  return names != nullptr && shape < names->GetNumberOfTuples() ? names->GetValue(shape)
                                                                : std::string();
}

/// What of some surfaces is of one shape, points in the order in which they come.
class PartOfShape
{
public:
  explicit PartOfShape(vtkPolyData* whole) :
    Whole(whole), Place(static_cast<std::size_t>(whole->GetNumberOfPoints()), -1)
  {
  }
  void Add(vtkIdType count, const vtkIdType* corners)
  {
    this->Cells->InsertNextCell(static_cast<int>(count));
    for (vtkIdType i = 0; i < count; ++i)
    {
      vtkIdType& place = this->Place[static_cast<std::size_t>(corners[i])];
      if (place < 0)
      {
        place = static_cast<vtkIdType>(this->Points.size());
        this->Points.push_back(corners[i]);
      }
      this->Cells->InsertCellPoint(place);
    }
  }
  vtkSmartPointer<vtkPolyData> Take() const
  {
    const auto part = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    points->SetData(this->Picked(this->Whole->GetPoints()->GetData()));
    part->SetPoints(points);
    part->SetPolys(this->Cells);
    vtkPointData* data = this->Whole->GetPointData();
    if (data->GetNormals() != nullptr)
    {
      part->GetPointData()->SetNormals(this->Picked(data->GetNormals()));
    }
    if (data->GetTCoords() != nullptr)
    {
      part->GetPointData()->SetTCoords(this->Picked(data->GetTCoords()));
    }
    return part;
  }

private:
  vtkSmartPointer<vtkFloatArray> Picked(vtkDataArray* array) const
  {
    const auto picked = vtkSmartPointer<vtkFloatArray>::New();
    picked->SetName(array->GetName());
    picked->SetNumberOfComponents(array->GetNumberOfComponents());
    picked->SetNumberOfTuples(static_cast<vtkIdType>(this->Points.size()));
    for (std::size_t i = 0; i < this->Points.size(); ++i)
    {
      picked->SetTuple(static_cast<vtkIdType>(i), array->GetTuple(this->Points[i]));
    }
    return picked;
  }

  vtkPolyData* Whole;
  vtkNew<vtkCellArray> Cells;
  std::vector<vtkIdType> Points; // of the whole
  std::vector<vtkIdType> Place;  // in the part, by point of the whole
};

/// {shape: its part}
std::map<vtkIdType, vtkSmartPointer<vtkPolyData>> PartsOf(vtkPolyData* bodies)
{
  vtkDataArray* shapes = bodies->GetPointData()->GetArray("ShapeId");
  std::map<vtkIdType, PartOfShape> parts;
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  vtkCellArray* polygons = bodies->GetPolys();
  for (polygons->InitTraversal(); polygons->GetNextCell(count, corners) != 0;)
  {
    const auto shape = shapes != nullptr && count > 0
                         ? static_cast<vtkIdType>(shapes->GetComponent(corners[0], 0))
                         : 0;
    parts.try_emplace(std::max<vtkIdType>(shape, 0), bodies).first->second.Add(count, corners);
  }
  std::map<vtkIdType, vtkSmartPointer<vtkPolyData>> taken;
  for (const auto& [shape, part] : parts)
  {
    taken[shape] = part.Take();
  }
  return taken;
}

} // namespace

vtkSkinnedBodiesRepresentation::vtkSkinnedBodiesRepresentation()
{
  this->Actor->Delete();
  this->Actor = vtkActorOfParts::New();
  this->SetupDefaults();
}

vtkSkinnedBodiesRepresentation::~vtkSkinnedBodiesRepresentation() = default;

int vtkSkinnedBodiesRepresentation::ProcessViewRequest(vtkInformationRequestKey* request,
                                                       vtkInformation* input,
                                                       vtkInformation* output)
{
  if (this->Superclass::ProcessViewRequest(request, input, output) == 0)
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_RENDER())
  {
    vtkAlgorithmOutput* producer = vtkPVRenderView::GetPieceProducer(input, this);
    this->Dress(producer == nullptr || this->IsColoredByArray()
                  ? nullptr
                  : producer->GetProducer()->GetOutputDataObject(producer->GetIndex()));
  }
  return 1;
}

bool vtkSkinnedBodiesRepresentation::IsColoredByArray()
{
  vtkInformation* array = this->GetInputArrayInformation(0);
  const char* name = array != nullptr && array->Has(vtkDataObject::FIELD_NAME())
                       ? array->Get(vtkDataObject::FIELD_NAME())
                       : nullptr;
  return name != nullptr && *name != '\0';
}

void vtkSkinnedBodiesRepresentation::Dress(vtkDataObject* data)
{
  if (data != this->Dressed || (data != nullptr && data->GetMTime() > this->DressTime))
  {
    std::vector<Skin> skins;
    if (auto* blocks = vtkCompositeDataSet::SafeDownCast(data))
    {
      const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
      for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
      {
        this->DressBlock(vtkPolyData::SafeDownCast(block->GetCurrentDataObject()), skins);
      }
    }
    else
    {
      this->DressBlock(vtkPolyData::SafeDownCast(data), skins);
    }
    this->Skins = std::move(skins);
    this->Dressed = data;
    this->DressTime.Modified();
    std::vector<vtkSmartPointer<vtkActor>> parts;
    for (const Skin& skin : this->Skins)
    {
      parts.push_back(skin.Part);
    }
    static_cast<vtkActorOfParts*>(this->Actor)->SetParts(std::move(parts));
  }
  if (this->PaintTime < this->DressTime || this->PaintTime < this->Property->GetMTime())
  {
    std::for_each(this->Skins.begin(), this->Skins.end(),
                  [this](const Skin& skin) { this->Paint(skin); });
    this->PaintTime.Modified();
  }
}

// Actors of before are taken again: their programs are compiled.
void vtkSkinnedBodiesRepresentation::DressBlock(vtkPolyData* bodies, std::vector<Skin>& skins)
{
  if (bodies == nullptr || bodies->GetNumberOfPoints() == 0)
  {
    return;
  }
  vtkFieldData* fields = bodies->GetFieldData();
  for (const auto& [shape, part] : PartsOf(bodies))
  {
    Skin skin;
    const bool has = part->GetPointData()->GetTCoords() != nullptr;
    vtkTexture* texture = has ? this->TextureOf(TextureNamed(fields, shape)) : nullptr;
    TakeColor(fields, texture != nullptr ? "Tint" : "Color", shape, skin.Color);
    vtkDataArray* opacities = fields->GetArray("Opacity");
    if (opacities != nullptr && shape < opacities->GetNumberOfTuples())
    {
      skin.Opacity = std::clamp(opacities->GetComponent(shape, 0), 0.0, 1.0);
    }
    vtkActor* before = skins.size() < this->Skins.size() ? this->Skins[skins.size()].Part.Get()
                                                         : nullptr;
    if (before != nullptr && before->GetTexture() == texture)
    {
      skin.Part = before;
    }
    else
    {
      skin.Part = vtkSmartPointer<vtkActor>::New();
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->ScalarVisibilityOff();
      skin.Part->SetMapper(mapper);
      skin.Part->SetTexture(texture);
      if (texture != nullptr)
      {
        skin.Part->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::TCoord::Impl", true,
                                                                     CutOut, false);
      }
      skin.Part->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
                                                                   ShineThrough, false);
    }
    vtkPolyDataMapper::SafeDownCast(skin.Part->GetMapper())->SetInputData(part);
    skins.push_back(std::move(skin));
  }
}

void vtkSkinnedBodiesRepresentation::Paint(const Skin& skin)
{
  vtkProperty* look = skin.Part->GetProperty();
  look->DeepCopy(this->Property);
  const double* color = this->Property->GetDiffuseColor();
  look->SetColor(color[0] * skin.Color[0], color[1] * skin.Color[1], color[2] * skin.Color[2]);
  look->SetOpacity(skin.Opacity * this->Property->GetOpacity());
  skin.Part->SetForceOpaque(look->GetOpacity() >= Film);
}

vtkTexture* vtkSkinnedBodiesRepresentation::TextureOf(const std::string& path)
{
  if (path.empty())
  {
    return nullptr;
  }
  std::error_code error;
  const auto written = std::filesystem::last_write_time(path, error).time_since_epoch().count();
  vtkSmartPointer<vtkTexture>& texture = this->Textures[path + '\n' + std::to_string(written)];
  if (texture == nullptr)
  {
    texture = vtkSmartPointer<vtkTexture>::New();
    vtkNew<vtkImageData> picture;
    if (vtkCheckedFiles::ReadPicture(path, picture).empty())
    {
      const int* size = picture->GetDimensions();
      const int block = std::max(1, (std::max(size[0], size[1]) - 1) / MostTexels + 1);
      vtkNew<vtkImageShrink3D> shrink;
      shrink->SetInputData(picture);
      shrink->SetShrinkFactors(block, block, 1);
      shrink->Update();
      texture->SetInputData(shrink->GetOutput());
      texture->InterpolateOn();
      texture->MipmapOn();
    }
  }
  return texture->GetInput() != nullptr ? texture.Get() : nullptr;
}

void vtkSkinnedBodiesRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Skins: " << this->Skins.size() << "\n";
}
