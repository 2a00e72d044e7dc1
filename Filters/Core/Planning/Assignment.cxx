// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Assignment.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>

namespace waft
{

namespace
{

constexpr double Forbidden = std::numeric_limits<double>::infinity();

/// The rows of one (Row, Target).
struct Target
{
  std::vector<std::size_t> Rows;
  int Frame = 0;
  int Until = 0;
  bool HasPlace = false;
  Vec3 Place = Vec3::Zero();
  int ClassId = -1;
  int ObjectId = -1;
};

struct Group
{
  int Frame = 0;
  int Id = 0;
  std::vector<Target> Targets;
};

bool HasPlace(const Constraint& row)
{
  return row.Kind == ConstraintKind::Position || row.Kind == ConstraintKind::Rest;
}

int LastFrame(const Constraint& row)
{
  return row.Kind == ConstraintKind::Rest ? std::max(row.Frame, row.Until) : row.Frame;
}

std::vector<Group> CollectGroups(const std::vector<Constraint>& rows)
{
  std::map<std::pair<int, int>, Target> targets;
  std::map<std::pair<int, int>, int> groupOf;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const Constraint& row = rows[i];
    const std::pair<int, int> key{ row.Row, row.Target };
    Target& target = targets[key];
    if (target.Rows.empty())
    {
      target.Frame = row.Frame;
      groupOf[key] = row.Group;
    }
    target.Rows.push_back(i);
    target.Frame = std::min(target.Frame, row.Frame);
    target.Until = std::max(target.Until, LastFrame(row));
    if (HasPlace(row) && !target.HasPlace)
    {
      target.HasPlace = true;
      target.Place = row.Value;
    }
    target.ClassId = std::max(target.ClassId, row.ClassId);
    target.ObjectId = std::max(target.ObjectId, row.ObjectId);
  }
  // A row without a group is a group of its own.
  std::map<std::tuple<int, int, int>, Group> groups;
  for (const auto& [key, target] : targets)
  {
    const int id = groupOf[key];
    Group& group = groups[id >= 0 ? std::tuple(0, id, 0) : std::tuple(1, key.first, key.second)];
    if (group.Targets.empty())
    {
      group.Frame = target.Frame;
      group.Id = id;
    }
    group.Frame = std::min(group.Frame, target.Frame);
    group.Targets.push_back(target);
  }
  std::vector<Group> result;
  for (auto& entry : groups)
  {
    result.push_back(std::move(entry.second));
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Group& a, const Group& b) { return a.Frame < b.Frame; });
  return result;
}

/// Where an object was last asked to be before a frame, and whether it is asked to be anywhere
/// between two frames.
class Places
{
public:
  Places(const std::vector<MotionObject>& objects, const std::vector<Constraint>& rows)
  {
    for (const MotionObject& object : objects)
    {
      this->Known[object.ObjectId][-1] = { object.Position, -1 };
    }
    for (const Constraint& row : rows)
    {
      if (row.ObjectId >= 0 && HasPlace(row))
      {
        this->Add(row.ObjectId, row.Frame, LastFrame(row), row.Value);
      }
    }
  }
  void Add(int object, int frame, int until, const Vec3& place)
  {
    this->Known[object][frame] = { place, until };
  }
  const Vec3& Before(int object, int frame) const
  {
    return std::prev(this->Known.at(object).lower_bound(frame))->second.first;
  }
  bool IsTaken(int object, int frame, int until) const
  {
    const auto& places = this->Known.at(object);
    const auto next = places.lower_bound(frame);
    return (next != places.end() && next->first <= until) ||
           std::prev(next)->second.second >= frame;
  }

private:
  std::map<int, std::map<int, std::pair<Vec3, int>>> Known;
};

} // namespace

std::vector<int> AssignLeastCost(const std::vector<double>& costs, std::size_t rows,
                                 std::size_t columns)
{
  // A pair that is not allowed costs more than all that are, so that it is taken last.
  double largest = 1.0;
  for (double cost : costs)
  {
    largest = cost < Forbidden ? std::max(largest, cost) : largest;
  }
  const double prohibitive = largest * (static_cast<double>(rows) + 1.0) * 4.0;
  const std::size_t width = std::max(rows, columns);
  const auto at = [&](std::size_t r, std::size_t c)
  {
    const double cost = c < columns ? costs[r * columns + c] : Forbidden;
    return cost < Forbidden ? cost : prohibitive;
  };
  constexpr std::size_t None = static_cast<std::size_t>(-1);
  std::vector<double> u(rows, 0.0);
  std::vector<double> v(width, 0.0);
  std::vector<std::size_t> rowOf(width, None);
  for (std::size_t start = 0; start < rows; ++start)
  {
    std::vector<double> shortest(width, Forbidden);
    std::vector<std::size_t> from(width, None); // the column before on the path
    std::vector<char> isDone(width, 0);
    std::size_t row = start;
    std::size_t last = None;
    double distance = 0.0;
    std::size_t sink = None;
    while (sink == None)
    {
      std::size_t nearest = None;
      for (std::size_t c = 0; c < width; ++c)
      {
        if (isDone[c] != 0)
        {
          continue;
        }
        const double reduced = distance + at(row, c) - u[row] - v[c];
        if (reduced < shortest[c])
        {
          shortest[c] = reduced;
          from[c] = last;
        }
        if (nearest == None || shortest[c] < shortest[nearest])
        {
          nearest = c;
        }
      }
      distance = shortest[nearest];
      isDone[nearest] = 1;
      if (rowOf[nearest] == None)
      {
        sink = nearest;
      }
      else
      {
        row = rowOf[nearest];
        last = nearest;
      }
    }
    u[start] += distance;
    for (std::size_t c = 0; c < width; ++c)
    {
      if (isDone[c] != 0 && c != sink)
      {
        u[rowOf[c]] += distance - shortest[c];
        v[c] -= distance - shortest[c];
      }
    }
    for (std::size_t c = sink; c != None;)
    {
      const std::size_t before = from[c];
      rowOf[c] = before == None ? start : rowOf[before];
      c = before;
    }
  }
  std::vector<int> result(rows, -1);
  for (std::size_t c = 0; c < columns; ++c)
  {
    if (rowOf[c] != None && costs[rowOf[c] * columns + c] < Forbidden)
    {
      result[rowOf[c]] = static_cast<int>(c);
    }
  }
  return result;
}

void AssignRows(const std::vector<MotionObject>& objects, std::vector<Constraint>& rows)
{
  Places places(objects, rows);
  for (const Group& group : CollectGroups(rows))
  {
    std::set<int> named;
    std::vector<const Target*> open;
    for (const Target& target : group.Targets)
    {
      if (target.ObjectId >= 0)
      {
        named.insert(target.ObjectId);
      }
      else
      {
        open.push_back(&target);
      }
    }
    if (open.empty())
    {
      continue;
    }
    std::vector<double> costs(open.size() * objects.size(), Forbidden);
    for (std::size_t t = 0; t < open.size(); ++t)
    {
      const Target& target = *open[t];
      for (std::size_t o = 0; o < objects.size(); ++o)
      {
        const MotionObject& object = objects[o];
        if (named.count(object.ObjectId) > 0 ||
            (target.ClassId >= 0 && target.ClassId != object.ClassId) ||
            (target.HasPlace && places.IsTaken(object.ObjectId, target.Frame, target.Until)))
        {
          continue;
        }
        costs[t * objects.size() + o] =
          target.HasPlace
            ? (target.Place - places.Before(object.ObjectId, target.Frame)).squaredNorm()
            : 0.0;
      }
    }
    const std::vector<int> chosen = AssignLeastCost(costs, open.size(), objects.size());
    for (std::size_t t = 0; t < open.size(); ++t)
    {
      if (chosen[t] < 0)
      {
        continue;
      }
      const int object = objects[static_cast<std::size_t>(chosen[t])].ObjectId;
      for (std::size_t row : open[t]->Rows)
      {
        rows[row].ObjectId = object;
      }
      if (open[t]->HasPlace)
      {
        places.Add(object, open[t]->Frame, open[t]->Until, open[t]->Place);
      }
    }
  }
}

} // namespace waft
