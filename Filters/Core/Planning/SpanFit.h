// SPDX-License-Identifier: BSD-3-Clause
// A chain of pieces made the flight of one span: blended, retimed, laid through its marks, brought
// down gently where it lands, eased away from what it was pushed into, checked.
#pragma once

#include "Planning/Span.h"
#include "Planning/SpanWarp.h"

#include <vector>

namespace waft
{

class SpanFitter
{
public:
  /// field holds for paths that reach the goal, missField for the others; checkMargin [m] is kept
  /// beyond the clearance radius.
  SpanFitter(const SegmentLibrary& library, const ClearanceField& field,
             const ClearanceField& missField, const SpanRequest& request, double checkMargin) :
    Library(library),
    Field(field), MissField(missField), Request(request), CheckMargin(checkMargin)
  {
  }

  /// The chain from the start to the goal, or, when toGoal is false, to where it leads by itself.
  /// False when that is too fast, hits something, or cannot go on beyond its mark.
  bool Fit(const PieceChain& chain, bool toGoal, SpanResult& result) const;
  /// The same, with the chain refined where that is of use and passes, too.
  bool FitRefined(const PieceChain& chain, bool toGoal, SpanResult& result) const;

private:
  bool Ease(SpanWarp& span, const std::vector<Vec3>& anchors, bool toGoal,
            std::vector<Vec3>& positions) const;
  bool Fit(const PieceChain& chain, const PieceChain& grown, bool toGoal, SpanResult& result) const;
  bool CanGoOn(const std::vector<Vec3>& positions, const SpanResult& result) const;

  const SegmentLibrary& Library;
  const ClearanceField& Field;
  const ClearanceField& MissField;
  const SpanRequest& Request;
  double CheckMargin;
};

} // namespace waft
