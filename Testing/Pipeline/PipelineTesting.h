// SPDX-License-Identifier: BSD-3-Clause
// What pipeline tests share: error texts, counts of executions, stops, time steps,
// winds.
#pragma once

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

/// The point of an image that is nearest to a place, -1 outside.
inline vtkIdType PointAt(vtkImageData* image, double x, double y, double z)
{
  double place[3] = { x, y, z };
  return image->FindPoint(place);
}

/// Answers an event of some objects for as long as it lives; `data` is what the event brings.
class Observer
{
public:
  Observer(std::initializer_list<vtkObject*> subjects, unsigned long event,
           std::function<void(void* data)> answer) :
    Answer(std::move(answer))
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void* data)
                               { static_cast<Observer*>(self)->Answer(data); });
    for (vtkObject* subject : subjects)
    {
      subject->AddObserver(event, this->Command);
    }
  }
  ~Observer() { this->Command->SetCallback(nullptr); }
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;

private:
  std::function<void(void*)> Answer;
  vtkNew<vtkCallbackCommand> Command;
};

/// Collects the error texts (or warnings) of an algorithm and of its executive instead of printing
/// them.
class ErrorLog
{
public:
  explicit ErrorLog(vtkAlgorithm* algorithm, unsigned long event = vtkCommand::ErrorEvent) :
    Ear({ algorithm, algorithm->GetExecutive() }, event,
        [this](void* text) { this->Text += static_cast<const char*>(text); })
  {
  }
  bool Contains(const std::string& part) const
  {
    return this->Text.find(part) != std::string::npos;
  }

  std::string Text;

private:
  Observer Ear;
};

/// What a new source says against being run after a change of its settings; it must give nothing.
template <class Source, class Change>
std::string ErrorsAfter(const Change& change)
{
  vtkNew<Source> source;
  change(source.Get());
  const ErrorLog errors(source);
  source->Update();
  EXPECT_EQ(source->GetOutput()->GetNumberOfPoints(), 0);
  return errors.Text;
}

/// Counts the executions (StartEvent) of an algorithm.
class ExecutionCount
{
public:
  explicit ExecutionCount(vtkAlgorithm* algorithm) :
    Ear({ algorithm }, vtkCommand::StartEvent, [this](void*) { ++this->Value; })
  {
  }

  int Value = 0;

private:
  Observer Ear;
};

/// Counts the sentences of progress that an algorithm gives while it computes; that it begins and
/// ends (0 and 1) does not count.
class WorkCount
{
public:
  explicit WorkCount(vtkAlgorithm* algorithm) :
    Ear({ algorithm }, vtkCommand::ProgressEvent,
        [this](void* progress)
        {
          const double fraction = *static_cast<double*>(progress);
          this->Value += fraction > 0.0 && fraction < 1.0;
        })
  {
  }

  int Value = 0;

private:
  Observer Ear;
};

/// Asks an algorithm to stop whenever it says that it has come farther than this fraction of its
/// work (without one: at its first word), until the end of the block; then it may run whole.
class AbortBeyond
{
public:
  explicit AbortBeyond(vtkAlgorithm* algorithm, double fraction = -1.0) :
    Algorithm(algorithm), Ear({ algorithm }, vtkCommand::ProgressEvent,
                              [algorithm, fraction](void* progress)
                              {
                                if (*static_cast<double*>(progress) > fraction)
                                {
                                  algorithm->SetAbortExecute(1);
                                }
                              })
  {
  }
  ~AbortBeyond() { this->Algorithm->SetAbortExecute(0); }
  AbortBeyond(const AbortBeyond&) = delete;
  AbortBeyond& operator=(const AbortBeyond&) = delete;

private:
  vtkAlgorithm* Algorithm;
  Observer Ear;
};

/// The time steps that a port offers [s].
inline std::vector<double> TimeSteps(vtkAlgorithm* algorithm, int port = 0)
{
  algorithm->UpdateInformation();
  vtkInformation* info = algorithm->GetOutputInformation(port);
  const int count = info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  const double* steps = info->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  return std::vector<double>(steps, steps + count);
}

/// An image of 3^3 points over the default volume with the same vector at each.
inline void MakeEvenWind(vtkImageData* image, const char* array, const std::array<double, 3>& value)
{
  image->SetDimensions(3, 3, 3);
  image->SetOrigin(-2.0, -2.0, 0.0);
  image->SetSpacing(2.0, 2.0, 2.0);
  vtkNew<vtkFloatArray> values;
  values->SetName(array);
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    values->SetTuple(i, value.data());
  }
  image->GetPointData()->AddArray(values);
}
