// SPDX-License-Identifier: BSD-3-Clause
// When a long computation writes what it could go on from, so that this never takes much of its
// time, whatever the disk.
#pragma once

#include <limits>

namespace waft
{

/// Of all time up to any moment at most `fraction` is spent on writing. How long a writing takes is
/// not known before the first: one that uses up what is left of the fraction is given up, and the
/// next one waits until there is twice as much. After one that came through the next waits until
/// there is twice its time. All times in seconds since the computation began.
class WritingSchedule
{
public:
  /// interval: between two writings at the least; at 0 one is always due, and takes what it takes.
  WritingSchedule(double interval, double fraction) : Interval(interval), Fraction(fraction) {}

  bool IsDue(double now) const
  {
    return this->Interval <= 0.0 ||
           (now - this->Last >= this->Interval && this->Allowance(now) >= 2.0 * this->Needed);
  }
  /// How long a writing that begins now may take.
  double Allowance(double now) const
  {
    return this->Interval <= 0.0 ? std::numeric_limits<double>::infinity()
                                 : this->Fraction * now - this->Spent;
  }
  /// A writing ended now, whole or given up, after so many seconds.
  void Record(double now, double seconds)
  {
    this->Last = now;
    this->Spent += seconds;
    this->Needed = seconds;
  }

private:
  double Interval, Fraction;
  double Last = 0.0, Spent = 0.0;
  double Needed = 0.0; // by the last writing: the next one takes as much at the least
};

} // namespace waft
