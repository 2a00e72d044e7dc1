// SPDX-License-Identifier: BSD-3-Clause
// The surfaces about a body in each frame of its way, and how high its mesh is above them.
#pragma once

#include "Rotation/Contact.h"

#include <vector>

namespace waft
{

/// A frame's surroundings are planes: that of the surface nearest to the centre (beside an edge
/// that of PlaneBeside), and those found since that a vertex was below of. A pose is turned by a
/// blend between the one given (0) and the one that lies flat in them (1).
class Surroundings
{
public:
  /// Both have to outlive it; poses are read when they are asked about.
  Surroundings(const ContactInput& input, const std::vector<Quat>& orientations);

  /// Finds the nearest surface of each frame that a vertex could reach, and the turn that would lay
  /// the body flat on it; false when there is none.
  bool LookAround();

  /// Could a vertex reach a surface in this frame?
  bool IsNear(std::size_t k) const { return this->Scenes[k].Near; }
  /// Or in one within twice the time that blends are smoothed over?
  bool AnyNear(std::size_t k) const;
  /// Is the surface the first plane alone, as far as the body reaches?
  bool IsPlain(std::size_t k) const { return this->Scenes[k].Plain; }

  Quat Blended(std::size_t k, double blend) const;
  /// Would the body lie on one side in this frame and on the other in the next?
  bool ChangesSide(std::size_t k) const;
  /// Height of the lowest vertex above the planes of this frame [m].
  double Lowest(std::size_t k, double blend) const;
  /// The vertex deepest below a surface, whatever the planes, and its depth [m]; 0 when none is.
  double Deepest(const Vec3& center, const Quat& q, double frame, Vec3& deepest) const;
  /// Adds the plane that the deepest vertex is below of; false when there is none.
  bool FindMorePlanes(std::size_t k, double blend);

private:
  struct Plane
  {
    Vec3 Point;
    Vec3 Normal;
  };
  struct Scene
  {
    bool Near = false;
    bool Plain = true;
    std::vector<Plane> Planes;
    Vec3 Turn = Vec3::Zero(); // rotation vector from the pose to the flat one [rad]
  };

  /// Vertices that stand out in some direction, and some of the others: those that touch curved or
  /// broken surfaces first.
  void ChooseFeelers();
  Quat FlatTurn(std::size_t k, const Vec3& normal) const;
  /// Where the side is given turns go the same way round from the rest backwards or onwards, be
  /// it the longer one: what is left to turn never jumps.
  void GoOneWayRound(std::vector<Quat>& turns) const;
  bool FitsOnePlane(std::size_t k) const;

  const ContactInput& Input;
  const std::vector<Quat>& Orientations;
  std::vector<Scene> Scenes;
  std::vector<Vec3> Feelers;
};

} // namespace waft
