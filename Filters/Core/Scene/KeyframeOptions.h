// SPDX-License-Identifier: BSD-3-Clause
// One keyframe, made by hand: targets that together draw a text, a picture or a surface.
#pragma once

#include "Base/Leaving.h"
#include "Base/SceneFrame.h"
#include "Constraints/Arrivals.h"
#include "Scene/FacingOptions.h"

#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace waft
{

enum class DrawnShape
{
  Text,
  Image,
  Surface
};

struct KeyframeOptions
  : SceneFrame
  , FacingOptions
{
  DrawnShape Shape = DrawnShape::Text;
  std::string Text = "WAFT";
  std::string Font = "sans";
  std::string ImageFile;
  std::vector<std::array<double, 3>> ClassColors;
  int NumberOfTargets = 0;
  int Frame = 250;
  int FrameFrom = -1;
  int Order = 0; // 0: by the air, else 1 + PlaceOrder; the last: along the arrow
  Vec3 OrderFrom{ -1.0, 0.0, 0.1 };
  Vec3 OrderTo{ 1.0, 0.0, 0.1 };
  int Hold = 0;
  bool Drift = false;
  int On = -1;
  int Leave = 0; // 0: they stay, 1: they fade, else 2 + index of SidesOut
  int LeaveFrame = 280;
  int LastLeave = -1;
  bool Rest = true;
  int Until = -1;
  double Radius = 0.0;
  int Group = 0;
  Vec3 Origin{ 0.0, 0.0, 0.1 };
  Vec3 U = Vec3::UnitX();
  Vec3 V = Vec3::UnitY();
  double Width = 3.4;
  std::uint64_t Seed = 1;

  SceneInfo Info() const
  {
    SceneInfo info = this->SceneFrame::Info();
    info.Seed = this->Seed;
    return info;
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(
      OptionField{
        "Shape", { 0, 2 }, "", "What is drawn: Text, the picture Image File or the Input." },
      of.Shape...);
    visit(TextField("Text", "A line of text."), of.Text...);
    visit(TextField("Font", "sans, serif, mono or the path of a font file."), of.Font...);
    visit(TextField("ImageFile", "A picture file; transparent pixels, or without transparency the "
                                 "colour of its border, are background."),
          of.ImageFile...);
    visit(OptionField{ "ClassColors",
                       { 0, 1 },
                       "",
                       "Colours (red, green, blue from 0 to 1) of the classes of a picture: a "
                       "target takes the class of the nearest, its index in this list." },
          of.ClassColors...);
    visit(OptionField{ "NumberOfTargets",
                       { 0, limits::Count.High },
                       "",
                       "Targets, of which no object has more than one; 0: as many as there are "
                       "Objects, and 48 as long as none are joined." },
          of.NumberOfTargets...);
    visit(OptionField{ "Frame", limits::UpTo(limits::MostInt), "",
                       "Frame at which the objects are there." },
          of.Frame...);
    visit(OptionField{ "FrameFrom",
                       { -1, limits::MostInt },
                       "",
                       "First frame of a window that ends at Frame: each object comes at a frame "
                       "of its own in it; -1: at Frame." },
          of.FrameFrom...);
    visit(OptionField{ "Order",
                       { 0, NumberOfPlaceOrders + 1 },
                       "",
                       "Who comes when in a window: at the frames of least control (Air), or one "
                       "after another." },
          of.Order...);
    visit(OptionField{ "OrderFrom", limits::Coordinate, "m",
                       "Where the arrow begins along which they come, in metres." },
          of.OrderFrom...);
    visit(OptionField{ "OrderTo", limits::Coordinate, "m", "Where it ends, in metres." },
          of.OrderTo...);
    visit(OptionField{ "Leave",
                       { 0, 1 + static_cast<double>(std::size(SidesOut)) },
                       "",
                       "How the objects go out of the shot after that: by no means, by fading "
                       "where they are, or by an open side (Open X, Open Top of the objects)." },
          of.Leave...);
    visit(OptionField{ "LeaveFrame", limits::UpTo(limits::MostInt), "",
                       "Frame from which they go, the first of them." },
          of.LeaveFrame...);
    visit(OptionField{ "LastLeave",
                       { -1, limits::MostInt },
                       "",
                       "Frame from which the last of them goes, in the Order of a window, else by "
                       "chance; -1: all at Leave Frame." },
          of.LastLeave...);
    visit(OptionField{ "Hold", limits::UpTo(limits::MostInt), "",
                       "Frames for which all stay once the last has come, still; not of rests." },
          of.Hold...);
    visit(FlagField("Drift",
                    "What is held drifts as one form, and each object stays near its place "
                    "in it."),
          of.Drift...);
    visit(OptionField{ "On",
                       { -1, limits::MostInt },
                       "",
                       "ObstacleId of the obstacle that targets go along with from their frame on; "
                       "-1: none." },
          of.On...);
    visit(FlagField("Rest", "The objects lie still on the first surface straight below their "
                            "targets; else they pass them."),
          of.Rest...);
    visit(OptionField{ "Until",
                       { -1, limits::MostInt },
                       "",
                       "Rests last to this frame; -1 is the last of the scene." },
          of.Until...);
    visit(OptionField{ "Radius", limits::Distance, "m",
                       "By how much a target may be missed, in metres; 0 is exact." },
          of.Radius...);
    visit(
      OptionField{
        "Group", limits::UpTo(limits::MostInt), "",
        "The targets of one group go to distinct objects; another keyframe needs another group." },
      of.Group...);
    visit(OptionField{ "Origin", limits::Coordinate, "m",
                       "Centre of the drawing in metres; a surface stands where it is." },
          of.Origin...);
    visit(OptionField{ "U", limits::Direction, "", "Direction of the drawing's width." }, of.U...);
    visit(OptionField{ "V", limits::Direction, "", "Direction of the drawing's height." }, of.V...);
    visit(OptionField{ "Width", limits::Length, "m", "Width of the drawing in metres." },
          of.Width...);
    FacingOptions::Visit(visit, of...);
    visit(SeedField(), of.Seed...);
    SceneFrame::Visit(visit, of...);
  }
};

} // namespace waft
