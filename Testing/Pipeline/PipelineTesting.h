// SPDX-License-Identifier: BSD-3-Clause
// What pipeline tests share: collecting error texts, updating to a time, counting executions.
#pragma once

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <string>
#include <vector>

/// Collects the error texts (or warnings) of an algorithm and of its executive instead of printing
/// them.
class ErrorLog
{
public:
  explicit ErrorLog(vtkAlgorithm* algorithm, unsigned long event = vtkCommand::ErrorEvent)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* text)
      { static_cast<ErrorLog*>(self)->Text += static_cast<const char*>(text); });
    algorithm->AddObserver(event, this->Command);
    algorithm->GetExecutive()->AddObserver(event, this->Command);
  }
  ~ErrorLog() { this->Command->SetCallback(nullptr); }
  ErrorLog(const ErrorLog&) = delete;
  ErrorLog& operator=(const ErrorLog&) = delete;
  bool Contains(const std::string& part) const
  {
    return this->Text.find(part) != std::string::npos;
  }

  std::string Text;

private:
  vtkNew<vtkCallbackCommand> Command;
};

/// Counts the executions (StartEvent) of an algorithm.
class ExecutionCount
{
public:
  explicit ExecutionCount(vtkAlgorithm* algorithm)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback([](vtkObject*, unsigned long, void* self, void*)
                               { ++static_cast<ExecutionCount*>(self)->Value; });
    algorithm->AddObserver(vtkCommand::StartEvent, this->Command);
  }

  ~ExecutionCount() { this->Command->SetCallback(nullptr); }
  ExecutionCount(const ExecutionCount&) = delete;
  ExecutionCount& operator=(const ExecutionCount&) = delete;

  int Value = 0;

private:
  vtkNew<vtkCallbackCommand> Command;
};

/// Counts the sentences of progress that an algorithm gives while it computes; that it begins and
/// ends (0 and 1) does not count.
class WorkCount
{
public:
  explicit WorkCount(vtkAlgorithm* algorithm)
  {
    this->Command->SetClientData(this);
    this->Command->SetCallback(
      [](vtkObject*, unsigned long, void* self, void* progress)
      {
        const double fraction = *static_cast<double*>(progress);
        static_cast<WorkCount*>(self)->Value += fraction > 0.0 && fraction < 1.0;
      });
    algorithm->AddObserver(vtkCommand::ProgressEvent, this->Command);
  }
  ~WorkCount() { this->Command->SetCallback(nullptr); }
  WorkCount(const WorkCount&) = delete;
  WorkCount& operator=(const WorkCount&) = delete;

  int Value = 0;

private:
  vtkNew<vtkCallbackCommand> Command;
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
