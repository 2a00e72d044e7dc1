// SPDX-License-Identifier: BSD-3-Clause
// Properties of a class that are fields of an options struct of Core, one line each:
//
//   WaftProperty(double, Viscosity);
//
// is a member Viscosity with SetViscosity and GetViscosity. VTK's parser expands the macros, so
// that wrappings have the methods as if they were written out. Default, range, unit and sentence
// stand in the struct, which the class names as a friend; its constructor takes the defaults from
// there (Bridge/Pipeline/StageOptions.h).
#ifndef WaftProperty_h
#define WaftProperty_h

#include "vtkSetGet.h"

#include <string>

/// A number that the class brings into its range, by its own InRange(name, value).
#define WaftProperty(type, name)                                                                   \
protected:                                                                                         \
  type name = 0;                                                                                   \
                                                                                                   \
public:                                                                                            \
  virtual void Set##name(type value)                                                               \
  {                                                                                                \
    const type kept = static_cast<type>(InRange(#name, value));                                    \
    if (this->name != kept)                                                                        \
    {                                                                                              \
      this->name = kept;                                                                           \
      this->Modified();                                                                            \
    }                                                                                              \
  }                                                                                                \
  vtkGetMacro(name, type)

/// A number that is kept as it comes, and refused when the class works: one of which the nearest
/// number in the range is not what was meant.
#define WaftOpenProperty(type, name)                                                               \
protected:                                                                                         \
  type name = 0;                                                                                   \
                                                                                                   \
public:                                                                                            \
  vtkSetMacro(name, type);                                                                         \
  vtkGetMacro(name, type)

/// Several numbers, 2, 3, 4 or 6, which are kept as they come.
#define WaftVector(type, name, count)                                                              \
protected:                                                                                         \
  type name[count] = {};                                                                           \
                                                                                                   \
public:                                                                                            \
  vtkSetVector##count##Macro(name, type);                                                          \
  vtkGetVector##count##Macro(name, type)

#define WaftFlag(name)                                                                             \
protected:                                                                                         \
  bool name = false;                                                                               \
                                                                                                   \
public:                                                                                            \
  vtkSetMacro(name, bool);                                                                         \
  vtkGetMacro(name, bool);                                                                         \
  vtkBooleanMacro(name, bool)

#define WaftText(name)                                                                             \
protected:                                                                                         \
  std::string name;                                                                                \
                                                                                                   \
public:                                                                                            \
  vtkSetMacro(name, std::string);                                                                  \
  vtkGetMacro(name, std::string)

/// The same as C has texts; null is an empty one.
#define WaftFile(name)                                                                             \
protected:                                                                                         \
  std::string name;                                                                                \
                                                                                                   \
public:                                                                                            \
  vtkSetStdStringFromCharMacro(name);                                                              \
  vtkGetCharFromStdStringMacro(name)

/// A file that the class writes beside its outputs. None from now on is no reason to work again.
#define WaftWrittenFile(name)                                                                      \
protected:                                                                                         \
  std::string name;                                                                                \
                                                                                                   \
public:                                                                                            \
  virtual void Set##name(const char* value)                                                        \
  {                                                                                                \
    const std::string given = value != nullptr ? value : "";                                       \
    if (this->name != given)                                                                       \
    {                                                                                              \
      this->name = given;                                                                          \
      if (!given.empty())                                                                          \
      {                                                                                            \
        this->Modified();                                                                          \
      }                                                                                            \
    }                                                                                              \
  }                                                                                                \
  vtkGetCharFromStdStringMacro(name)

/// Of a class whose work may be done in slices (vtkSlicedPolyDataAlgorithm says how); its Kept() is
/// the work. SliceOptions is a friend.
///
/// SetSlice: seconds of work after which an update shows the motion so far, to go on from there
/// when it is asked to; 0: all at once. The motion comes to the same bits. 0 to 1e+09. Does not
/// modify the stage: it holds from the next piece of work on. WorkInSlices: works as a window wants
/// it: a Slice of 0.2 s, and on from there beside the updates. GoOn: the next update goes on with
/// the work that has not ended, and where it goes on beside shows what it has come to; nothing
/// where none is. Hold: work that goes on beside waits, from its next tick on, until an update
/// after GoOn, which then shows it without waiting and lets it go. LetGo: discards the work that
/// has not ended, and the motion that there is: of a stage that nobody sees any more, which a
/// window may keep for a while. The next update begins anew. GetComplete: 1 when nothing is left to
/// do: what the last update gave is the whole result, or it failed. 0 when it is not: the stage's
/// own work has not ended, or an input is not complete. GetWorkState, GetWorkDone, GetWorkText,
/// GetSecondsLeft: of the work that has not been shown whole: one of WorkStates (BESIDE: it goes on
/// by itself, after Hold to its next tick; ARRIVED: it went on by itself to its end, which the next
/// update after GoOn shows); 0 to 1 of it; what it does, or why it failed; seconds that it will
/// take from here on by those that it took, below 0 while that is not known.
#define WaftSlices                                                                                 \
protected:                                                                                         \
  double Slice = 0.0;                                                                              \
                                                                                                   \
public:                                                                                            \
  enum WorkStates                                                                                  \
  {                                                                                                \
    NO_WORK,                                                                                       \
    HELD,                                                                                          \
    BESIDE,                                                                                        \
    ARRIVED                                                                                        \
  };                                                                                               \
  void SetSlice(double seconds);                                                                   \
  vtkGetMacro(Slice, double);                                                                      \
  void WorkInSlices();                                                                             \
  void GoOn();                                                                                     \
  void Hold();                                                                                     \
  void LetGo();                                                                                    \
  int GetComplete();                                                                               \
  int GetWorkState();                                                                              \
  double GetWorkDone();                                                                            \
  std::string GetWorkText();                                                                       \
  double GetSecondsLeft()

#endif
