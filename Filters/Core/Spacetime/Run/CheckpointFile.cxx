// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/CheckpointFile.h"

#include "Spacetime/Run/SpacetimeDigest.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace waft
{
namespace
{

constexpr StateKind CheckpointKind = { "spacetime checkpoint", 10 };
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

CheckpointFile::CheckpointFile(const SpacetimeInput& input, const SpacetimeOptions& options,
                               std::vector<std::string>& warnings) :
  Path(options.CheckpointFile),
  Key(this->IsNamed() ? DigestOfRun(input, options) : 0), Warnings(warnings), Begin(Clock::now()),
  Schedule(options.CheckpointInterval, WritingFraction)
{
}

double CheckpointFile::Elapsed() const
{
  return std::chrono::duration<double>(Clock::now() - this->Begin).count();
}

bool CheckpointFile::IsDue(bool now) const
{
  return !this->HasFailed && (now || this->Schedule.IsDue(this->Elapsed()));
}

void CheckpointFile::Write(const Content& content, bool now)
{
  const double from = this->Elapsed();
  StateFileWriter file(this->Path, CheckpointKind, this->Key);
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
  this->Schedule.Note(to, to - from);
}

bool CheckpointFile::Read(const StateContent& content)
{
  const StateLack lack = ReadStateFile(this->Path, CheckpointKind, this->Key, content);
  if (lack != StateLack::None && lack != StateLack::NoFile)
  {
    this->Warnings.push_back("the checkpoint " + this->Path + " " + ToString(lack, CheckpointKind) +
                             ": ignored, solved from the start (CheckpointFile)");
  }
  return lack == StateLack::None;
}

void CheckpointFile::Remove() const
{
  std::remove(this->Path.c_str());
}

} // namespace waft
