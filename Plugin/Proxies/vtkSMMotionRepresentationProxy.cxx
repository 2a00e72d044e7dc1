// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMMotionRepresentationProxy.h"

#include <vtkDataObject.h>
#include <vtkObjectFactory.h>
#include <vtkPVDataInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMOutputPort.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxyListDomain.h>

#include <sstream>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMMotionRepresentationProxy);

namespace
{

// Numbers, the text of a choice, or the source of a glyph.
void SetFrom(vtkSMProperty* property, const std::string& text)
{
  if (auto* choices = property->FindDomain<vtkSMProxyListDomain>())
  {
    vtkSMPropertyHelper(property).Set(choices->FindProxy("sources", text.c_str()));
    return;
  }
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double number = 0.0; stream >> number;)
  {
    numbers.push_back(number);
  }
  vtkSMPropertyHelper helper(property);
  if (!stream.eof() || numbers.empty())
  {
    helper.Set(text.c_str());
    return;
  }
  for (unsigned int i = 0; i < numbers.size(); ++i)
  {
    helper.Set(i, numbers[i]);
  }
}

int AssociationOf(vtkPVXMLElement* look)
{
  return std::string(look->GetAttributeOrEmpty("of")) == "CELLS" ? vtkDataObject::CELL
                                                                 : vtkDataObject::POINT;
}

} // namespace

vtkSMMotionRepresentationProxy::~vtkSMMotionRepresentationProxy() = default;

int vtkSMMotionRepresentationProxy::LoadXMLState(vtkPVXMLElement* element,
                                                 vtkSMProxyLocator* locator)
{
  this->HasLook = true;
  return this->Superclass::LoadXMLState(element, locator);
}

void vtkSMMotionRepresentationProxy::UpdateVTKObjects()
{
  vtkPVDataInformation* data = this->HasLook ? nullptr : this->Shown();
  vtkPVXMLElement* late = nullptr;
  this->WasEmpty = this->WasEmpty || (data != nullptr && data->GetNumberOfPoints() == 0);
  if (data != nullptr && data->GetNumberOfPoints() > 0)
  {
    this->HasLook = true;
    vtkPVXMLElement* hints = this->GetHints();
    for (unsigned int i = 0; hints != nullptr && i < hints->GetNumberOfNestedElements(); ++i)
    {
      vtkPVXMLElement* look = hints->GetNestedElement(i);
      const char* color = look->GetAttribute("color");
      if (std::string(look->GetName()) == "FirstPicture" &&
          (color == nullptr || data->GetArrayInformation(color, AssociationOf(look)) != nullptr))
      {
        this->PutOn(look);
        late = this->WasEmpty ? look : nullptr;
        break;
      }
    }
  }
  this->Superclass::UpdateVTKObjects();
  if (late != nullptr && late->GetAttribute("color") != nullptr) // ParaView did so when it was made
  {
    this->SetScalarColoring(late->GetAttribute("color"), AssociationOf(late));
    this->RescaleTransferFunctionToDataRange();
  }
}

vtkPVDataInformation* vtkSMMotionRepresentationProxy::Shown()
{
  vtkSMProperty* input = this->GetProperty("Input");
  if (input == nullptr || vtkSMPropertyHelper(input).GetNumberOfElements() == 0)
  {
    return nullptr;
  }
  vtkSMOutputPort* port = vtkSMPropertyHelper(input).GetAsOutputPort();
  return port != nullptr ? port->GetDataInformation() : nullptr;
}

void vtkSMMotionRepresentationProxy::PutOn(vtkPVXMLElement* look)
{
  for (unsigned int i = 0; i < look->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* set = look->GetNestedElement(i);
    vtkSMProperty* property = this->GetProperty(set->GetAttributeOrEmpty("name"));
    if (property == nullptr)
    {
      vtkErrorMacro("FirstPicture of " << this->GetXMLName() << ": expected a property, found "
                                       << set->GetAttributeOrEmpty("name"));
      continue;
    }
    SetFrom(property, set->GetAttributeOrEmpty("value"));
  }
  if (const char* type = look->GetAttribute("type"))
  {
    vtkSMPropertyHelper(this, "Representation").Set(type);
  }
  const char* color = look->GetAttribute("color");
  vtkSMPropertyHelper(this, "ColorArrayName")
    .SetInputArrayToProcess(AssociationOf(look), color != nullptr ? color : "");
}

bool vtkSMMotionRepresentationProxy::ShowsMeasure()
{
  const char* array =
    vtkSMPropertyHelper(this, "ColorArrayName", /*quiet=*/true).GetInputArrayNameToProcess();
  const std::string name = array != nullptr ? array : "";
  const bool isNumber = name == "ObjectId" || name == "ShapeId" || name == "ObstacleId";
  vtkSMProperty* maps = this->GetProperty("MapScalars");
  return !isNumber && (maps == nullptr || vtkSMPropertyHelper(maps).GetAsInt() != 0);
}

bool vtkSMMotionRepresentationProxy::SetScalarBarVisibility(vtkSMProxy* view, bool visible)
{
  return (!visible || this->ShowsMeasure()) &&
         this->Superclass::SetScalarBarVisibility(view, visible);
}

void vtkSMMotionRepresentationProxy::ViewUpdated(vtkSMProxy* view)
{
  this->Superclass::ViewUpdated(view);
  // A ParaView that has this class shows bars by it, past SetScalarBarVisibility. The view is
  // updated before it draws: the bar is gone by then.
#if __has_include(<vtkSMColorMapEditorHelper.h>)
  if (vtkSMPropertyHelper(this, "Visibility").GetAsInt() != 0 && !this->ShowsMeasure() &&
      this->IsScalarBarVisible(view))
  {
    this->Superclass::SetScalarBarVisibility(view, false);
  }
#endif
}

void vtkSMMotionRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HasLook: " << this->HasLook << "\n";
}
