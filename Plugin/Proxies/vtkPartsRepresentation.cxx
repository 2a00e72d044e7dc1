// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPartsRepresentation.h"

#include "vtkActorOfParts.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPVRenderView.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTexture.h>

#include <algorithm>
#include <utility>

namespace
{

constexpr double Film = 0.999;    // opacity from which on a body is none
constexpr float VeilWidth = 1.0F; // of its lines, in pixels

} // namespace

vtkPartsRepresentation::vtkPartsRepresentation()
{
  this->Actor->Delete();
  this->Actor = vtkActorOfParts::New();
  this->SetupDefaults();
}

vtkPartsRepresentation::~vtkPartsRepresentation() = default;

int vtkPartsRepresentation::ProcessViewRequest(vtkInformationRequestKey* request,
                                               vtkInformation* input, vtkInformation* output)
{
  if (this->Superclass::ProcessViewRequest(request, input, output) == 0)
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_RENDER())
  {
    vtkAlgorithmOutput* producer = vtkPVRenderView::GetPieceProducer(input, this);
    auto* view = vtkPVView::SafeDownCast(this->GetView());
    this->Make(producer == nullptr || this->IsColoredByArray()
                 ? nullptr
                 : producer->GetProducer()->GetOutputDataObject(producer->GetIndex()),
               view != nullptr ? view->GetViewTime() : 0.0);
  }
  return 1;
}

bool vtkPartsRepresentation::IsColoredByArray()
{
  vtkInformation* array = this->GetInputArrayInformation(0);
  const char* name = array != nullptr && array->Has(vtkDataObject::FIELD_NAME())
                       ? array->Get(vtkDataObject::FIELD_NAME())
                       : nullptr;
  return name != nullptr && *name != '\0';
}

void vtkPartsRepresentation::Make(vtkDataObject* data, double time)
{
  if (data != this->Of || (data != nullptr && data->GetMTime() > this->MakeTime) ||
      (this->VariesInTime() && time != this->Time))
  {
    Parts parts;
    const auto add = [&](vtkDataObject* block)
    {
      auto* surface = vtkPolyData::SafeDownCast(block);
      if (surface != nullptr && surface->GetNumberOfPoints() > 0)
      {
        this->AddParts(surface, time, parts);
      }
    };
    if (auto* blocks = vtkCompositeDataSet::SafeDownCast(data))
    {
      const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
      for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
      {
        add(block->GetCurrentDataObject());
      }
    }
    else
    {
      add(data);
    }
    this->Made = std::move(parts);
    this->Of = data;
    this->Time = time;
    this->MakeTime.Modified();
    std::vector<vtkSmartPointer<vtkActor>> actors, veils;
    double reach = 0.0;
    for (const Part& part : this->Made)
    {
      (part.IsVeil ? veils : actors).push_back(part.Actor);
      reach = std::max(reach, part.Reach);
    }
    static_cast<vtkActorOfParts*>(this->Actor)
      ->SetParts(std::move(actors), std::move(veils), reach);
  }
  if (this->PaintTime < this->MakeTime || this->PaintTime < this->Property->GetMTime())
  {
    std::for_each(this->Made.begin(), this->Made.end(),
                  [this](const Part& part) { this->Paint(part); });
    this->PaintTime.Modified();
  }
}

vtkSmartPointer<vtkActor> vtkPartsRepresentation::ActorFor(const Parts& parts, vtkPolyData* data,
                                                           vtkTexture* texture,
                                                           void (*make)(vtkActor*)) const
{
  vtkSmartPointer<vtkActor> actor =
    parts.size() < this->Made.size() ? this->Made[parts.size()].Actor : nullptr;
  if (actor == nullptr || actor->GetTexture() != texture)
  {
    actor = vtkSmartPointer<vtkActor>::New();
    actor->SetTexture(texture);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->ScalarVisibilityOff();
    actor->SetMapper(mapper);
    if (make != nullptr)
    {
      make(actor);
    }
  }
  vtkPolyDataMapper::SafeDownCast(actor->GetMapper())->SetInputData(data);
  return actor;
}

void vtkPartsRepresentation::Paint(const Part& part)
{
  vtkProperty* look = part.Actor->GetProperty();
  look->DeepCopy(this->Property);
  const double* color = this->Property->GetDiffuseColor();
  look->SetColor(color[0] * part.Color[0], color[1] * part.Color[1], color[2] * part.Color[2]);
  look->SetOpacity(part.Opacity * this->Property->GetOpacity());
  look->SetLighting(part.IsLit && this->Property->GetLighting());
  if (part.IsVeil)
  {
    // Tubes are for what is coloured by an array.
    look->RenderLinesAsTubesOff();
    look->SetLineWidth(VeilWidth);
  }
  // What is opaque is blended, too: by itself it needs no passes that sort what is behind it.
  part.Actor->SetForceOpaque(part.IsPool || look->GetOpacity() >= Film);
}

void vtkPartsRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Parts: " << this->Made.size() << "\n";
}
