// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/KeptDistances.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr double ShortestParting = 1.0, LongestParting = 3.0; // s

} // namespace

void KeptDistances::AddBody(double radius, double settlingSpeed, int frames,
                            std::vector<HeldMark> marks, int first)
{
  Body body;
  body.Radius = radius;
  body.First = first;
  // Pushed off evenly it is at its fastest at the end: twice the radius over the time.
  const double seconds = 2.0 * radius < LongestParting * settlingSpeed
                           ? std::max(ShortestParting, 2.0 * radius / settlingSpeed)
                           : LongestParting;
  body.Parting = seconds * this->Rate;
  std::stable_sort(marks.begin(), marks.end(),
                   [](const HeldMark& a, const HeldMark& b)
                   { return a.Frame != b.Frame ? a.Frame < b.Frame : a.Radius < b.Radius; });
  marks.erase(std::unique(marks.begin(), marks.end(),
                          [](const HeldMark& a, const HeldMark& b) { return a.Frame == b.Frame; }),
              marks.end());
  body.Marks = std::move(marks);
  int next = 0;
  for (int frame = 0; !body.Marks.empty() && frame < frames; ++frame)
  {
    while (next < static_cast<int>(body.Marks.size()) &&
           body.Marks[static_cast<std::size_t>(next)].Frame < frame)
    {
      ++next;
    }
    body.Next.push_back(next);
  }
  this->Bodies.push_back(std::move(body));
}

int KeptDistances::MarksAbout(const Body& body, int frame, Nearby (&found)[2])
{
  int count = 0;
  if (body.Marks.empty())
  {
    return count;
  }
  const int next = body.Next[static_cast<std::size_t>(frame)];
  for (const int k : { next - 1, next })
  {
    if (k >= 0 && k < static_cast<int>(body.Marks.size()))
    {
      const HeldMark& mark = body.Marks[static_cast<std::size_t>(k)];
      const double aside = std::abs(frame - mark.Frame) / body.Parting;
      if (aside < 1.0)
      {
        found[count++] = { &mark, body.Radius * aside * aside };
      }
    }
  }
  return count;
}

std::array<int, 2> KeptDistances::MarkFrames(int frame, std::size_t body) const
{
  std::array<int, 2> frames{ -1, -1 };
  Nearby found[2];
  const int count = MarksAbout(this->Bodies[body], frame, found);
  for (int k = 0; k < count; ++k)
  {
    const int at = found[k].Mark->Frame;
    frames[at < frame ? 0 : 1] = at;
  }
  return frames;
}

double KeptDistances::At(int frame, std::size_t a, std::size_t b) const
{
  double distance = this->Needed(a, b);
  Nearby one[2], other[2];
  const int ofOne = MarksAbout(this->Bodies[a], frame, one);
  const int ofOther = ofOne > 0 ? MarksAbout(this->Bodies[b], frame, other) : 0;
  for (int i = 0; i < ofOne; ++i)
  {
    for (int j = 0; j < ofOther; ++j)
    {
      const HeldMark& mine = *one[i].Mark;
      const HeldMark& theirs = *other[j].Mark;
      const double marks =
        std::max((mine.Place - theirs.Place).norm(), std::min(mine.Radius, theirs.Radius));
      distance = std::min(distance, marks + one[i].Growth + other[j].Growth);
    }
  }
  return distance;
}

} // namespace waft
