// SPDX-License-Identifier: BSD-3-Clause
// What the stages take that move objects to their marks, and its way into streams of bytes.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/ForceFields.h"
#include "Base/Mesh.h"
#include "Base/Motion.h"
#include "Base/StateArchive.h"
#include "Constraints/Constraint.h"

#include <vector>

namespace waft
{

struct MotionProblem
{
  SceneInfo Scene;
  std::vector<Track> Tracks;           // planned, one an object, one sample a frame
  std::vector<MotionObject> Objects;   // those of the tracks
  std::vector<Constraint> Constraints; // every row assigned
  std::vector<ObstacleMesh> Obstacles; // the ground among them
  std::vector<Vortex> Vortices;
  FieldSeries Wind; // the user's, or empty
};

/// At least one track, at least so many frames, in each track one finite position a frame.
Result CheckTracks(const MotionProblem& problem, int leastFrames);

void Serialise(StateArchive& stream, Track& track);
void Serialise(StateArchive& stream, ReportRow& line);
void Serialise(StateArchive& stream, Vortex& vortex);
void Serialise(StateArchive& stream, AnalyticWind& wind);
void Serialise(StateArchive& stream, FieldSeries& field);
void Serialise(StateArchive& stream, Constraint& constraint);
void Serialise(StateArchive& stream, MotionObject& object);
void Serialise(StateArchive& stream, ObstacleMesh& obstacle);
void Serialise(StateArchive& stream, MotionProblem& problem);

} // namespace waft
