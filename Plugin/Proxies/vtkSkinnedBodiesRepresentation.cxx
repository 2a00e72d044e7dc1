// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSkinnedBodiesRepresentation.h"

#include "BodyShadows.h"
#include "PartOfSurface.h"
#include "SoftDisc.h"
#include "vtkCheckedFiles.h"

#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkShaderProperty.h>
#include <vtkStringArray.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>

vtkStandardNewMacro(vtkSkinnedBodiesRepresentation);

namespace
{

constexpr int MostTexels = 4096; // along a side
constexpr double Veiled = 0.99;  // opacity, as near to 1 as what is blended has it
// Cut out by alpha rather than blended: right from every side without sorting.
constexpr const char* CutOut = "//VTK::TCoord::Impl\n  if (gl_FragData[0].a < 0.5) discard;\n";
// VTK turns a normal towards the eye; what the first light throws on the other side comes through.
// What is seen from its edge is lit all around, so that it stands out from what is behind it.
constexpr const char* ShineThrough =
  "//VTK::Light::Impl\n  fragOutput0.rgb += 0.35 * diffuseColor * lightColor0"
  " * max(0.0, dot(normalVCVSOutput, lightDirectionVC0))\n"
  "    + 0.4 * diffuseColor * pow(1.0 - abs(normalVCVSOutput.z), 2.0);\n";

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

// All of them: field data come as new arrays from a server, frame by frame.
std::string SkinsIn(vtkFieldData* fields)
{
  auto* skins = vtkUnsignedCharArray::SafeDownCast(fields->GetAbstractArray("Skin"));
  return skins == nullptr ? std::string()
                          : std::string(reinterpret_cast<const char*>(skins->GetPointer(0)),
                                        static_cast<std::size_t>(skins->GetNumberOfValues()));
}

void LetLightThrough(vtkActor* actor)
{
  vtkShaderProperty* shader = actor->GetShaderProperty();
  if (actor->GetTexture() != nullptr)
  {
    shader->AddFragmentShaderReplacement("//VTK::TCoord::Impl", true, CutOut, false);
  }
  shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, ShineThrough, false);
}

} // namespace

vtkSkinnedBodiesRepresentation::vtkSkinnedBodiesRepresentation() : Spot(waft::MakeSoftDisc(1.0)) {}

vtkSkinnedBodiesRepresentation::~vtkSkinnedBodiesRepresentation() = default;

void vtkSkinnedBodiesRepresentation::AddParts(vtkPolyData* block, double, Parts& parts)
{
  vtkFieldData* fields = block->GetFieldData();
  vtkDataArray* opacities = fields->GetArray("Opacity");
  for (const auto& [shape, surface] : waft::PartsBy("ShapeId", block))
  {
    Part part;
    const bool has = surface->GetPointData()->GetTCoords() != nullptr;
    vtkTexture* texture = has ? this->TextureOf(fields, shape) : nullptr;
    TakeColor(fields, texture != nullptr ? "Tint" : "Color", shape, part.Color);
    if (opacities != nullptr && shape < opacities->GetNumberOfTuples())
    {
      part.Opacity = std::clamp(opacities->GetComponent(shape, 0), 0.0, 1.0);
    }
    part.Actor = this->ActorFor(parts, surface, texture, LetLightThrough);
    parts.push_back(std::move(part));
  }
  this->AddShadows(block, parts);
}

void vtkSkinnedBodiesRepresentation::AddShadows(vtkPolyData* block, Parts& parts)
{
  const vtkSmartPointer<vtkPolyData> shadows = waft::ShadowsOf(block);
  if (shadows == nullptr)
  {
    return;
  }
  Part part;
  part.Opacity = Veiled;
  part.IsLit = false;
  part.IsVeil = true;
  part.Actor = this->ActorFor(parts, shadows, this->Spot, waft::TakeColorsOfPoints);
  parts.push_back(std::move(part));
}

vtkTexture* vtkSkinnedBodiesRepresentation::TextureOf(vtkFieldData* fields, vtkIdType shape)
{
  const std::string path = TextureNamed(fields, shape);
  const std::string skins = path.empty() ? SkinsIn(fields) : std::string();
  if (path.empty() && skins.empty())
  {
    return nullptr;
  }
  std::error_code error;
  const auto which =
    path.empty() ? shape : std::filesystem::last_write_time(path, error).time_since_epoch().count();
  vtkSmartPointer<vtkTexture>& texture =
    this->Textures[path + skins + '\n' + std::to_string(which)];
  if (texture == nullptr)
  {
    texture = vtkSmartPointer<vtkTexture>::New();
    vtkNew<vtkImageData> picture;
    const std::string lack = path.empty()
                               ? vtkCheckedFiles::ReadSkin(fields, static_cast<int>(shape), picture)
                               : vtkCheckedFiles::ReadPicture(path, picture);
    if (lack.empty())
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
  os << indent << "Textures: " << this->Textures.size() << "\n";
}
