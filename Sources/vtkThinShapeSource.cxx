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
#include <vtkNew.h>

#include <utility>

struct vtkThinShapeSource::Internals
{
  waft::StageCache Cache; // each frame that is played asks for the shape
  vtkNew<vtkMultiBlockDataSet> Kept;
};

vtkThinShapeSource::vtkThinShapeSource() : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(0);
}

vtkThinShapeSource::~vtkThinShapeSource() = default;

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

int vtkThinShapeSource::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                    vtkInformationVector* outputs)
{
  const waft::SceneInfo info = waft::OptionsOf<waft::SceneFrame>(*this).Info();
  Internals& impl = *this->Impl;
  if (!impl.Cache.IsCurrent(this, inputs))
  {
    impl.Cache.Forget();
    waft::Shape shape;
    waft::CopyFields<waft::ThinBody>(*this, shape);
    if (waft::Result made = this->MakeShape(shape); !made)
    {
      return waft::Fail(this, outputs, made.Message());
    }
    waft::ShapesToMultiBlock({ std::move(shape) }, info, impl.Kept);
    impl.Cache.MarkCurrent(this, inputs);
  }
  vtkMultiBlockDataSet::GetData(outputs)->ShallowCopy(impl.Kept);
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}
