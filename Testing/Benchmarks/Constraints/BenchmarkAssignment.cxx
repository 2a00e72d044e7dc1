// SPDX-License-Identifier: BSD-3-Clause
// Prints how long the assignment of n objects in a volume to n targets takes, its peak memory and
// how far it may be from the least cost, beside the plain way over a table of all pairs up to 1000.
// Arguments: numbers of targets [500 1000 10000].
#include "Base/Random.h"
#include "Constraints/NearestColumns.h"
#include "PlainAssignment.h"

#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

using namespace waft;

namespace
{

constexpr std::size_t MostPlain = 1000;

double PeakMegabytes()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

double SecondsSince(std::clock_t begin)
{
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void Assign(const char* name, std::size_t count, const Box& targets)
{
  Random random(5);
  std::vector<NearestColumns::Candidate> candidates;
  std::vector<NearestColumns::Row> rows;
  for (std::size_t i = 0; i < count; ++i)
  {
    candidates.push_back({ i, random.InBox(Box()), 0 });
    rows.push_back({ 0, random.InBox(targets) });
  }
  const RankedCost leftOut{ static_cast<std::int64_t>(count) + 1, 0.0 };
  NearestColumns search(count, leftOut, { candidates }, rows);
  std::clock_t begin = std::clock();
  const Assignment found = AssignLeastCost(search);
  std::printf("%-7s n %6zu: %8.3f CPU-s, peak %4.0f MB, cost %.10g m^2, above bound by %.1e m^2",
              name, count, SecondsSince(begin), PeakMegabytes(), found.Cost.Amount,
              found.Cost.Amount - found.Bound.Amount);
  if (count <= MostPlain)
  {
    AssignmentProblem table(count, search.LeftOut());
    for (std::size_t row = 0; row < count; ++row)
    {
      for (std::size_t column = 0; column < count; ++column)
      {
        table.At(row, column) = search.Cost(row, column);
      }
    }
    begin = std::clock();
    const std::vector<int> plain = test::PlainAssignment(table).Run();
    std::printf("; plain %.3f CPU-s, %s", SecondsSince(begin),
                plain == found.ColumnOf ? "the same" : "another result");
  }
  std::printf("\n");
}

} // namespace

int main(int argc, char** argv)
{
  std::vector<std::size_t> counts;
  for (int i = 1; i < argc; ++i)
  {
    counts.push_back(std::strtoul(argv[i], nullptr, 10));
  }
  if (counts.empty())
  {
    counts = { 500, 1000, 10000 };
  }
  for (const std::size_t count : counts)
  {
    Assign("volume", count, Box());
    Assign("ground", count, { Vec3(-2, -2, 0), Vec3(2, 2, 0) });
    Assign("line", count, { Vec3(9, 1, 0), Vec3(9, 1, 4) });
  }
  return 0;
}
