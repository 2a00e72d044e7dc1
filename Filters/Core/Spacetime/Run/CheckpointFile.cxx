// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Run/CheckpointFile.h"

#include "Spacetime/Run/SpacetimeDigest.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace waft
{
namespace
{

constexpr const char* Format = "Waft spacetime checkpoint 7";
constexpr double WritingFraction = 1.0 / 30.0; // of the time, for checkpoints

} // namespace

CheckpointFile::CheckpointFile(const SpacetimeInput& input, const SpacetimeOptions& options,
                               Communicator& ranks, std::vector<std::string>& warnings) :
  Input(input),
  Options(options), Ranks(ranks), Warnings(warnings), Clock(std::chrono::steady_clock::now())
{
}

double CheckpointFile::Elapsed() const
{
  const std::chrono::duration<double> d = std::chrono::steady_clock::now() - this->Clock;
  return d.count();
}

bool CheckpointFile::IsDue(bool now) const
{
  double interval = this->Options.CheckpointInterval;
  if (interval > 0.0)
  {
    interval = std::max(interval, this->Cost / WritingFraction);
  }
  const bool isDue = now || this->Elapsed() - this->Last >= interval;
  return this->Ranks.Decide(isDue && !this->HasFailed);
}

void CheckpointFile::Write(const Content& content)
{
  const double from = this->Elapsed();
  std::unique_ptr<StateFileWriter> file;
  if (this->Ranks.IsFirst())
  {
    file = std::make_unique<StateFileWriter>(this->Path());
  }
  RankFileStream stream(this->Ranks, file.get(), false);
  std::string format = Format;
  std::uint64_t key = DigestOfRun(this->Input, this->Options);
  stream.Text(format);
  stream.Value(key);
  content(stream);
  const Result result = file ? file->Commit() : Result::Ok();
  if (!result)
  {
    this->HasFailed = true;
    this->Warnings.push_back("CheckpointFile: " + result.Message());
  }
  this->Last = this->Elapsed();
  this->Cost = this->Last - from;
}

bool CheckpointFile::Read(const Content& content, const std::function<bool()>& isSound)
{
  const std::string& path = this->Path();
  const bool isFirst = this->Ranks.IsFirst();
  if (path.empty() || !this->Ranks.Decide(isFirst && StateFileReader(path).IsGood()))
  {
    return false;
  }
  const auto ignore = [&](const char* reason)
  {
    this->Warnings.push_back("CheckpointFile: " + path + " " + reason +
                             ": ignored, solved from the start");
    return false;
  };
  if (!this->Ranks.Decide(isFirst && IsWholeStateFile(path)))
  {
    return ignore("is damaged");
  }
  std::unique_ptr<StateFileReader> file;
  if (isFirst)
  {
    file = std::make_unique<StateFileReader>(path);
  }
  RankFileStream stream(this->Ranks, file.get(), true);
  std::string format;
  std::uint64_t key = 0;
  stream.Text(format);
  if (format != Format)
  {
    return ignore("is no checkpoint of this version");
  }
  stream.Value(key);
  if (!this->Ranks.Decide(key == DigestOfRun(this->Input, this->Options)))
  {
    return ignore("belongs to other inputs or properties");
  }
  content(stream);
  if (!this->Ranks.Decide(!file || file->IsAtEnd()) || !stream.IsGood() || !isSound())
  {
    return ignore("is incomplete");
  }
  return true;
}

void CheckpointFile::Remove() const
{
  std::remove(this->Path().c_str());
}

} // namespace waft
