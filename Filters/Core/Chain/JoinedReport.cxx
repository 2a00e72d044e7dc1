// SPDX-License-Identifier: BSD-3-Clause
#include "Chain/JoinedReport.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace waft
{
namespace
{

constexpr const char* Between = "; ";
constexpr const char* Approach = "it comes within ";

using RowKey = std::pair<int, int>; // Row, Target

template <class Row>
RowKey KeyOf(const Row& row)
{
  return { row.Row, row.Target };
}

/// Adds those sentences of a message that say how near the motion comes, or the others.
void AddSentences(const std::string& message, bool areApproaches, std::string& joined)
{
  const std::string between = Between;
  std::size_t begin = 0;
  while (begin <= message.size())
  {
    const std::size_t end = std::min(message.find(between, begin), message.size());
    const std::string sentence = message.substr(begin, end - begin);
    if ((sentence.rfind(Approach, 0) == 0) == areApproaches)
    {
      joined += (joined.empty() ? "" : between) + sentence;
    }
    begin = end + between.size();
  }
}

} // namespace

std::vector<JoinedRow> JoinReports(const std::vector<ReportRow>& moved,
                                   const std::vector<ReportRow>& planned,
                                   const std::vector<ReportRow>& turned,
                                   const std::vector<Constraint>& rests)
{
  std::map<RowKey, const ReportRow*> reasons, measured;
  std::map<RowKey, const Constraint*> kept;
  for (const ReportRow& row : planned)
  {
    if (row.Status != ConstraintStatus::Met)
    {
      reasons[KeyOf(row)] = &row;
    }
  }
  for (const ReportRow& row : turned)
  {
    measured[KeyOf(row)] = &row;
  }
  for (const Constraint& row : rests)
  {
    kept[KeyOf(row)] = &row;
  }
  std::vector<JoinedRow> joined;
  for (const ReportRow& row : moved)
  {
    JoinedRow line;
    static_cast<ReportRow&>(line) = row;
    if (const auto reason = reasons.find(KeyOf(row)); reason != reasons.end())
    {
      line.Message.clear();
      AddSentences(reason->second->Message, false, line.Message);
      AddSentences(row.Message, true, line.Message);
    }
    const auto pose = measured.find(KeyOf(row));
    if (pose != measured.end() && IsAttitude(row.Kind) && row.Status == ConstraintStatus::Met)
    {
      line.Residual = pose->second->Residual;
      line.Status = pose->second->Status;
      line.Message = pose->second->Message;
    }
    else if (pose != measured.end() && row.Status == ConstraintStatus::Met &&
             pose->second->Status != ConstraintStatus::Met)
    {
      line.Status = pose->second->Status; // it is there, but faces otherwise
      line.Message = pose->second->Message;
    }
    if (const auto rest = kept.find(KeyOf(row)); rest != kept.end())
    {
      line.TouchDown = rest->second->TouchDown;
      line.Settled = rest->second->Settled;
      line.LiftOff = rest->second->LiftOff;
    }
    joined.push_back(std::move(line));
  }
  return joined;
}

} // namespace waft
