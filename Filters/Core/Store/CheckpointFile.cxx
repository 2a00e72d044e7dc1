// SPDX-License-Identifier: BSD-3-Clause
#include "Store/CheckpointFile.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

namespace waft
{
namespace
{

constexpr double WritingFraction = 0.02;                 // of the time, for checkpoints
constexpr std::size_t PieceBytes = std::size_t(4) << 20; // between two looks at the clock

using Clock = std::chrono::steady_clock;

/// What goes to a file as long as there is time.
class TimedStream : public StateArchive
{
public:
  TimedStream(StateArchive& file, double seconds) : File(file), Seconds(seconds) {}
  bool IsReading() const override { return false; }
  bool IsLate() const
  {
    return std::chrono::duration<double>(Clock::now() - this->Begin).count() > this->Seconds;
  }

protected:
  bool Put(const void* bytes, std::size_t size) override
  {
    const char* at = static_cast<const char*>(bytes);
    for (std::size_t done = 0; done < size && !this->IsLate() && this->File.IsGood();)
    {
      const std::size_t piece = std::min(PieceBytes, size - done);
      this->File.Raw(at + done, piece);
      done += piece;
    }
    return !this->IsLate() && this->File.IsGood();
  }

private:
  StateArchive& File;
  double Seconds;
  Clock::time_point Begin = Clock::now();
};

} // namespace

CheckpointFile::CheckpointFile(Checkpoint what, std::vector<std::string>& warnings) :
  What(std::move(what)), Warnings(warnings), Begin(Clock::now()),
  Schedule(this->What.Interval, WritingFraction)
{
}

double CheckpointFile::Elapsed() const
{
  return std::chrono::duration<double>(Clock::now() - this->Begin).count();
}

bool CheckpointFile::IsDue(bool now) const
{
  return this->IsNamed() && !this->HasFailed && (now || this->Schedule.IsDue(this->Elapsed()));
}

void CheckpointFile::Write(const Content& content, bool now)
{
  const double from = this->Elapsed();
  StateFileWriter file(this->What.Path, this->What.Kind, this->What.Key);
  TimedStream stream(file, now ? std::numeric_limits<double>::infinity()
                               : this->Schedule.Allowance(from));
  content(stream);
  const bool isGivenUp = stream.IsLate() && file.IsGood();
  const Result result = isGivenUp ? Result::Ok() : file.Commit();
  if (!result)
  {
    this->HasFailed = true;
    this->Warnings.push_back("no checkpoint is kept: " + result.Message() + " (CheckpointFile)");
  }
  const double to = this->Elapsed();
  this->Schedule.Record(to, to - from);
}

bool CheckpointFile::Read(const StateContent& content)
{
  const StateLack lack = ReadStateFile(this->What.Path, this->What.Kind, this->What.Key, content);
  if (lack != StateLack::None && lack != StateLack::NoFile)
  {
    this->Warnings.push_back("the checkpoint " + this->What.Path + " " +
                             ToString(lack, this->What.Kind) + ": ignored, " + this->What.Done +
                             " from the start (CheckpointFile)");
  }
  return lack == StateLack::None;
}

void CheckpointFile::Remove() const
{
  if (this->IsNamed())
  {
    RemoveStateFile(this->What.Path);
  }
}

} // namespace waft
