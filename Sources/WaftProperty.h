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

#endif
