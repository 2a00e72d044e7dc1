// SPDX-License-Identifier: BSD-3-Clause
// Singular value decomposition of the segments of one length (Shi et al. 2005, section 3.2).
#pragma once

#include "Trajectory/MotionDatabase.h"

#include <Eigen/Core>

namespace waft
{

/// samples: one segment a column [3 NumberOfSamples x segments], in their own frames [m]. Keeps
/// the least number of singular directions about the mean whose rest has an rms of at most
/// relativeError times the rms of the segments. Fills Mean, Basis and RelativeError of the group
/// and gives the coefficients [rank x segments].
Eigen::MatrixXd CompressSegments(const Eigen::MatrixXd& samples, double relativeError,
                                 SegmentGroup& group);

/// The sum of the outer products of the columns with themselves, in an order of its own: Eigen's
/// depends on the sizes of the processor's caches when there are many columns, and a database
/// should not.
Eigen::MatrixXd SecondMoments(const Eigen::MatrixXd& columns);

} // namespace waft
