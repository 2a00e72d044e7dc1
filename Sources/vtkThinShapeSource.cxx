// SPDX-License-Identifier: BSD-3-Clause
#include "vtkThinShapeSource.h"

#include "Base/SceneFrame.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Shapes/ThinShape.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>

#include <utility>

vtkThinShapeSource::vtkThinShapeSource()
{
  this->SetNumberOfInputPorts(0);
}

double vtkThinShapeSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::Bending, waft::ThinBody, waft::SceneFrame>(property, value);
}

int vtkThinShapeSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                           vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::OptionsOf<waft::SceneFrame>(*this).Info().Time, outputs);
  return 1;
}

int vtkThinShapeSource::RequestData(vtkInformation*, vtkInformationVector**,
                                    vtkInformationVector* outputs)
{
  const waft::SceneInfo info = waft::OptionsOf<waft::SceneFrame>(*this).Info();
  waft::Shape shape;
  waft::CopyFields<waft::ThinBody>(*this, shape);
  if (waft::Result made = this->MakeShape(shape); !made)
  {
    return waft::Fail(this, outputs, made.Message());
  }
  waft::ShapesToMultiBlock({ std::move(shape) }, info, vtkMultiBlockDataSet::GetData(outputs));
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}
