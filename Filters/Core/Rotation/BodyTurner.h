// SPDX-License-Identifier: BSD-3-Clause
// How each body of a scene turns, by itself; divided over threads and ranks.
#pragma once

#include "Base/SharedWork.h"
#include "Constraints/RowsOfObjects.h"
#include "Rotation/Attitude.h"
#include "Rotation/RotationRefine.h"

#include <map>
#include <vector>

namespace waft
{

/// What came of a track's body.
struct BodyTurn
{
  AttitudeOutcome Outcome;
  BodyFactors Factors;
  std::vector<double> Away; // as RotationOutput's
};

class BodyTurner
{
public:
  /// Tracks and objects are checked, shapes prepared. Refers to all of them.
  BodyTurner(const RotationInput& input, const RotationOptions& options,
             const PreparedShapes& shapes);

  const RotationInput& Input() const { return this->Given; }
  const RotationOptions& Options() const { return this->Chosen; }
  const PreparedShapes& Shapes() const { return this->Prepared; }
  const std::vector<std::size_t>& RowsOf(int objectId) const { return this->Places.Of(objectId); }
  /// rad, that a body may turn from a frame to the next.
  double Most() const { return this->Limit; }

  /// That of the i-th track.
  BodyTurn Turn(std::size_t i) const;
  /// Its Away with other poses.
  std::vector<double> AwayOf(std::size_t i, const PoseTrack& poses) const;

private:
  template <class Act>
  void Set(std::size_t i, const Act& act) const;
  std::vector<double> AwayFrom(std::size_t i, const AttitudePlan& plan, const FlightBody& body,
                               FlightPath& path, const PoseTrack& poses) const;

  const RotationInput& Given;
  const RotationOptions& Chosen;
  const PreparedShapes& Prepared;
  RowsOfObjects Places;
  std::map<int, std::size_t> ObjectOfId;
  double Limit;
};

/// All of them. published: for a monitor that publishes, the poses of the first ones so far.
Result TurnBodies(const BodyTurner& turner, const ParallelFor& parallel, Monitor& monitor,
                  std::vector<PoseTrack>& published, std::vector<BodyTurn>& turned);

inline constexpr const char* TurningKind = "turning";
/// Turns bodies for rank 0. atOnce: threads of parallel.
Result ServeTurning(ReadingStream& inputs, SharedItems& items, int atOnce,
                    const ParallelFor& parallel);

} // namespace waft
