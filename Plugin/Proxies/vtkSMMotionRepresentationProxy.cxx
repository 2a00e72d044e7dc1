// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSMMotionRepresentationProxy.h"

#include <vtkDataObject.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMOutputPort.h>
#include <vtkSMParaViewPipelineController.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxyListDomain.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSettings.h>
#include <vtkSMTransferFunctionManager.h>
#include <vtkTimeStamp.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMMotionRepresentationProxy);

namespace
{

constexpr double Nothing = 1e-30; // up to which a number is what sums of zeros leave

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

/// Of vectors that are zero everywhere nothing is to be seen.
bool IsThere(vtkPVArrayInformation* array)
{
  return array != nullptr &&
         (array->GetNumberOfComponents() != 3 || array->GetComponentRange(-1)[1] > Nothing);
}

/// Gives an array that was never mapped to colours a way from colour to colour, and else nothing.
void MapBy(const std::string& array, const char* colors, vtkSMSessionProxyManager* proxies)
{
  if (colors == nullptr ||
      proxies->GetProxy("lookup_tables", (array + ".PVLookupTable").c_str()) != nullptr)
  {
    return;
  }
  std::vector<double> points;
  std::istringstream stream(colors);
  for (double number = 0.0; stream >> number;)
  {
    if (points.size() % 4 == 0)
    {
      points.push_back(0.0);
    }
    points.push_back(number);
  }
  for (std::size_t at = 0; at < points.size(); at += 4)
  {
    points[at] = static_cast<double>(at) / static_cast<double>(points.size() - 4);
  }
  vtkNew<vtkSMTransferFunctionManager> functions;
  vtkSMProxy* map = functions->GetColorTransferFunction(array.c_str(), proxies);
  vtkSMPropertyHelper(map, "RGBPoints")
    .Set(points.data(), static_cast<unsigned int>(points.size()));
  vtkSMPropertyHelper(map, "ColorSpace").Set("Lab");
  map->UpdateVTKObjects();
}

double FieldOf(vtkPVDataInformation* data, const char* name)
{
  vtkPVArrayInformation* array = data->GetArrayInformation(name, vtkDataObject::FIELD);
  return array != nullptr ? array->GetComponentRange(0)[0] : 0.0;
}

/// What is saved as a film, and played in real time, goes at the pace of its scene, where a user
/// has settled nothing else.
void TakePace(vtkPVDataInformation* data, vtkSMProxy* scene)
{
  const double rate = FieldOf(data, "FramesPerSecond"), frames = FieldOf(data, "NumberOfFrames");
  if (scene == nullptr || !(rate > 0.0) || !(frames > 1.0))
  {
    return;
  }
  const int whole = std::max(1, static_cast<int>(std::lround(rate)));
  vtkSMSettings* settings = vtkSMSettings::GetInstance();
  if (settings->GetSettingAsInt(".misc.SaveAnimation.FrameRate", 0) != whole)
  {
    vtkTimeStamp now; // of settings in memory the latest count
    now.Modified();
    settings->AddCollectionFromString(
      "{\"misc\":{\"SaveAnimation\":{\"FrameRate\":" + std::to_string(whole) + "}}}",
      static_cast<double>(now.GetMTime()));
  }
  vtkSMPropertyHelper(scene, "Duration")
    .Set(std::max(1, static_cast<int>(std::lround((frames - 1.0) / rate))));
  scene->UpdateVTKObjects();
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
    if (this->Look == nullptr)
    {
      vtkNew<vtkSMParaViewPipelineController> controller;
      TakePace(data, controller->FindAnimationScene(this->GetSession()));
    }
    vtkPVXMLElement* look = this->LookFor(data);
    if (look != nullptr && look != this->Look)
    {
      this->PutOn(look);
      late = this->WasEmpty ? look : nullptr;
    }
    this->Look = look;
    this->HasLook = look == nullptr || look->GetAttribute("until") == nullptr;
  }
  this->TakeColorsAsTheyAre();
  this->Superclass::UpdateVTKObjects();
  if (late != nullptr && late->GetAttribute("color") != nullptr) // ParaView did so when it was made
  {
    this->SetScalarColoring(late->GetAttribute("color"), AssociationOf(late));
    this->RescaleTransferFunctionToDataRange();
  }
}

vtkPVXMLElement* vtkSMMotionRepresentationProxy::LookFor(vtkPVDataInformation* data)
{
  vtkPVXMLElement* hints = this->GetHints();
  for (unsigned int i = 0; hints != nullptr && i < hints->GetNumberOfNestedElements(); ++i)
  {
    vtkPVXMLElement* look = hints->GetNestedElement(i);
    const char* color = look->GetAttribute("color");
    if (std::string(look->GetName()) == "FirstPicture" &&
        (color == nullptr || IsThere(data->GetArrayInformation(color, AssociationOf(look)))))
    {
      return look;
    }
  }
  return nullptr;
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
  if (color != nullptr)
  {
    MapBy(color, look->GetAttribute("colors"), this->GetSessionProxyManager());
  }
  vtkSMPropertyHelper(this, "ColorArrayName")
    .SetInputArrayToProcess(AssociationOf(look), color != nullptr ? color : "");
}

// The skins' colours are bytes for the screen, whose magnitude means nothing.
void vtkSMMotionRepresentationProxy::TakeColorsAsTheyAre()
{
  const std::string array = this->ColorArray();
  vtkSMProperty* maps = this->GetProperty("MapScalars");
  if (maps != nullptr && array != this->Colored && (array == "Color" || this->Colored == "Color"))
  {
    vtkSMPropertyHelper(maps).Set(array == "Color" ? 0 : 1);
  }
  this->Colored = array;
}

std::string vtkSMMotionRepresentationProxy::ColorArray()
{
  const char* array =
    vtkSMPropertyHelper(this, "ColorArrayName", /*quiet=*/true).GetInputArrayNameToProcess();
  return array != nullptr ? array : "";
}

bool vtkSMMotionRepresentationProxy::ShowsMeasure()
{
  const std::string name = this->ColorArray();
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
