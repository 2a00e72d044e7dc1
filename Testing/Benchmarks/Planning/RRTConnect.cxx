// SPDX-License-Identifier: BSD-3-Clause
#include "RRTConnect.h"

#include "Planning/ClearanceField.h"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <ctime>

namespace waft
{

namespace
{

constexpr double Limit = 10.0;       // s
constexpr double Resolution = 0.005; // of the volume's diagonal: motions are looked at so often

Vec3 PlaceOf(const ompl::base::State* state)
{
  const double* values = state->as<ompl::base::RealVectorStateSpace::StateType>()->values;
  return { values[0], values[1], values[2] };
}

} // namespace

std::vector<double> RunRRTConnect(const ObstacleSet& obstacles, const Box& bounds, double radius,
                                  const Vec3& start, const Vec3& goal, int runs)
{
  namespace ob = ompl::base;
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  ompl::RNG::setSeed(1);
  ClearanceField field;
  field.Obstacles = &obstacles;
  field.Bounds = bounds;
  field.Rule.Radius = radius;
  const auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds limits(3);
  for (unsigned int i = 0; i < 3; ++i)
  {
    limits.setLow(i, bounds.Min[i]);
    limits.setHigh(i, bounds.Max[i]);
  }
  space->setBounds(limits);
  ompl::geometric::SimpleSetup setup(space);
  setup.setStateValidityChecker([&](const ob::State* state)
                                { return field.Distance(PlaceOf(state), 0.0, radius) >= radius; });
  setup.getSpaceInformation()->setStateValidityCheckingResolution(Resolution);
  ob::ScopedState<ob::RealVectorStateSpace> from(space);
  ob::ScopedState<ob::RealVectorStateSpace> to(space);
  for (unsigned int i = 0; i < 3; ++i)
  {
    from[i] = start[i];
    to[i] = goal[i];
  }
  setup.setStartAndGoalStates(from, to);
  setup.setPlanner(std::make_shared<ompl::geometric::RRTConnect>(setup.getSpaceInformation()));
  std::vector<double> result;
  for (int run = 0; run < runs; ++run)
  {
    setup.clear();
    const std::clock_t begin = std::clock();
    if (setup.solve(Limit) == ob::PlannerStatus::EXACT_SOLUTION)
    {
      result.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    }
  }
  return result;
}

} // namespace waft
