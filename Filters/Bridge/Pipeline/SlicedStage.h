// SPDX-License-Identifier: BSD-3-Clause
// The methods of a class whose work may be done in slices (Bridge/Pipeline/KeptStage.h). The class
// declares them by WaftSlices (Sources/WaftProperty.h), and has them here, whatever it derives
// from.
#pragma once

#include "Base/SliceOptions.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/StageFailure.h"

#include <vtkAlgorithm.h>

#include <algorithm>
#include <string>

#define WaftSlicesOf(Class)                                                                        \
  void Class::SetSlice(double seconds)                                                             \
  {                                                                                                \
    this->Slice = std::clamp(seconds, 0.0, 1e+09);                                                 \
  }                                                                                                \
  void Class::WorkInSlices()                                                                       \
  {                                                                                                \
    this->SetSlice(0.2);                                                                           \
    this->Kept().WorkBeside();                                                                     \
  }                                                                                                \
  void Class::GoOn()                                                                               \
  {                                                                                                \
    this->Kept().GoOn();                                                                           \
  }                                                                                                \
  void Class::Hold()                                                                               \
  {                                                                                                \
    this->Kept().Hold();                                                                           \
  }                                                                                                \
  void Class::LetGo()                                                                              \
  {                                                                                                \
    for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)                              \
    {                                                                                              \
      if (vtkDataObject* output = this->GetOutputDataObject(port))                                 \
      {                                                                                            \
        output->Initialize();                                                                      \
      }                                                                                            \
    }                                                                                              \
    this->Kept().LetGo();                                                                          \
    this->Modified();                                                                              \
  }                                                                                                \
  int Class::GetComplete()                                                                         \
  {                                                                                                \
    return waft::HasFailed(this) || this->Kept().IsComplete() ? 1 : 0;                             \
  }                                                                                                \
  int Class::GetWorkState()                                                                        \
  {                                                                                                \
    return static_cast<int>(this->Kept().Now());                                                   \
  }                                                                                                \
  double Class::GetWorkDone()                                                                      \
  {                                                                                                \
    return this->Kept().SoFar().Done;                                                              \
  }                                                                                                \
  std::string Class::GetWorkText()                                                                 \
  {                                                                                                \
    const std::string text = this->Kept().SoFar().Text;                                            \
    const char* ended = this->GetProgressText();                                                   \
    return !text.empty() || ended == nullptr ? text : ended;                                       \
  }                                                                                                \
  double Class::GetSecondsLeft()                                                                   \
  {                                                                                                \
    return this->Kept().SecondsLeft();                                                             \
  }
