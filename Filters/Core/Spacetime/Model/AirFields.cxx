// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/AirFields.h"

#include "Constraints/MotionProblem.h"

namespace waft
{

void Serialise(StateArchive& stream, AirFields& fields)
{
  stream.List(fields.Vortices, [](StateArchive& s, Vortex& v) { Serialise(s, v); });
  Serialise(stream, fields.Wind);
  stream.Value(fields.Cost);
}

} // namespace waft
