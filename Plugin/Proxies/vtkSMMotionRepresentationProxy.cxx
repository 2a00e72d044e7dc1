// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMMotionRepresentationProxy.h"

#include <vtkDataObject.h>
#include <vtkObjectFactory.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMOutputPort.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>

#include <sstream>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMMotionRepresentationProxy);

namespace
{

// Numbers, or the text of a choice.
void SetFrom(vtkSMProperty* property, const std::string& text)
{
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
  vtkSMProperty* input = this->GetProperty("Input");
  if (!this->HasLook && input != nullptr && vtkSMPropertyHelper(input).GetAsProxy() != nullptr)
  {
    this->HasLook = true;
    vtkPVXMLElement* hints = this->GetHints();
    if (vtkPVXMLElement* look =
          hints != nullptr ? hints->FindNestedElementByName("FirstPicture") : nullptr)
    {
      this->PutOn(look);
    }
  }
  this->Superclass::UpdateVTKObjects();
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
  if (const char* array = look->GetAttribute("size"))
  {
    this->SizeBy(array);
  }
  const char* color = look->GetAttribute("color");
  const bool ofCells = std::string(look->GetAttributeOrEmpty("of")) == "CELLS";
  vtkSMPropertyHelper(this, "ColorArrayName")
    .SetInputArrayToProcess(ofCells ? vtkDataObject::CELL : vtkDataObject::POINT,
                            color != nullptr ? color : "");
}

void vtkSMMotionRepresentationProxy::SizeBy(const char* array)
{
  vtkSMPropertyHelper input(this, "Input");
  vtkSMOutputPort* port = input.GetAsOutputPort();
  vtkPVArrayInformation* found = port != nullptr
    ? port->GetDataInformation()->GetArrayInformation(array, vtkDataObject::POINT)
    : nullptr;
  if (found != nullptr && found->GetComponentRange(0)[0] > 0.0)
  {
    vtkSMPropertyHelper(this, "ScaleByArray").Set(1);
    vtkSMPropertyHelper(this, "SetScaleArray")
      .SetInputArrayToProcess(vtkDataObject::POINT, array);
    vtkSMPropertyHelper(this, "GaussianRadius").Set(1.0);
  }
}

void vtkSMMotionRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HasLook: " << this->HasLook << "\n";
}
