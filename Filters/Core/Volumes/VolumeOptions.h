// SPDX-License-Identifier: BSD-3-Clause
// The series of .vdb files that a user names.
#pragma once

#include "Base/OptionFields.h"

#include <string>

namespace waft
{

struct VolumeReadOptions
{
  std::string FileName;
  double FramesPerSecond = 0.0;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(TextField(
            "FileName",
            "Any file of the series; files whose names differ in one number alone belong together, "
            "the number is the frame. Setting it reads the series anew."),
          of.FileName...);
    visit(OptionField{ "FramesPerSecond", limits::UpTo(limits::FramesPerSecond.High), "1/s",
                       "Frame k is at time k / FramesPerSecond; 0: as the files say, else 30." },
          of.FramesPerSecond...);
  }
};

struct VolumeWriteOptions
{
  std::string FileName;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(
      TextField(
        "FileName",
        "The file to write, ending in .vdb, without the frame; nothing is written without one."),
      of.FileName...);
  }
};

} // namespace waft
