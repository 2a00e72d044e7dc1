// SPDX-License-Identifier: BSD-3-Clause
#include "Base/SharedLoop.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace waft
{
namespace
{

using std::chrono::milliseconds;

constexpr milliseconds Glance{ 50 };      // between two looks at what goes on here
constexpr milliseconds GlanceAround{ 5 }; // the same where other ranks wait for answers
constexpr milliseconds GlanceBack{ 20 };  // of another rank, at whether it is still wanted

/// Runs the work in a thread of its own; the caller's begins with `first`, and looks every now and
/// then, which tells whether something is done elsewhere still.
void RunBeside(const std::function<void()>& work, const std::function<void()>& first,
               const std::function<bool()>& look, milliseconds period)
{
  std::mutex mutex;
  std::condition_variable ended;
  bool hasEnded = false;
  std::thread worker(
    [&]()
    {
      work();
      const std::lock_guard<std::mutex> lock(mutex);
      hasEnded = true;
      ended.notify_one();
    });
  first();
  std::unique_lock<std::mutex> lock(mutex);
  bool isElsewhere = false;
  while (!ended.wait_for(lock, period, [&]() { return hasEnded && !isElsewhere; }))
  {
    isElsewhere = look();
  }
  lock.unlock();
  worker.join();
}

/// Items handed out from the first to the last to threads and ranks.
class Queue
{
public:
  explicit Queue(const std::vector<std::size_t>& items) : Items(items) {}
  std::size_t Size() const { return this->Items.size(); }
  bool Next(std::size_t& item)
  {
    const std::size_t k = this->Begun++;
    if (k < this->Items.size())
    {
      item = this->Items[k];
    }
    return k < this->Items.size();
  }
  /// Fewer towards the end, so that all ranks end together.
  std::vector<std::int64_t> Some(std::int64_t most, int ranks)
  {
    const auto begun = static_cast<std::int64_t>(std::min(this->Begun.load(), this->Size()));
    const std::int64_t left = static_cast<std::int64_t>(this->Size()) - begun;
    const std::int64_t count = std::clamp<std::int64_t>(left / (2 * ranks), 1, most);
    std::vector<std::int64_t> some;
    for (std::size_t item = 0; static_cast<std::int64_t>(some.size()) < count && this->Next(item);)
    {
      some.push_back(static_cast<std::int64_t>(item));
    }
    return some;
  }

private:
  const std::vector<std::size_t>& Items;
  std::atomic<std::size_t> Begun{ 0 };
};

} // namespace

Result RunShared(const SharedLoop& loop, Communicator* ranks, const ParallelFor& parallel,
                 std::atomic<bool>& stop)
{
  if (loop.Items.empty())
  {
    return Result::Ok();
  }
  Queue queue(loop.Items);
  const auto work = [&]()
  {
    parallel(queue.Size(),
             [&](std::size_t begin, std::size_t end)
             {
               std::size_t item = 0;
               for (std::size_t k = begin; k < end && !stop && queue.Next(item); ++k)
               {
                 loop.Work(item);
               }
             });
  };
  SingleRank alone;
  Communicator& all = ranks != nullptr && queue.Size() > 1 ? *ranks : alone;
  if (all.Size() == 1 && !loop.IsWatched)
  {
    work();
    return Result::Ok();
  }
  MemoryStream job;
  if (all.Size() > 1)
  {
    loop.Tell(job);
  }
  WorkSharing others(all, loop.Kind, job);
  job = MemoryStream(); // which they have now
  const auto send = [&]()
  {
    if (loop.Send && all.Size() > 1)
    {
      loop.Send(all);
    }
  };
  Result shared = Result::Ok();
  const auto look = [&]()
  {
    if (shared) // else it is known why all ends
    {
      shared = others.Look([&](std::int64_t most) { return queue.Some(most, all.Size()); },
                           [&](std::int64_t item, ReadingStream& result)
                           {
                             loop.Take(static_cast<std::size_t>(item), result);
                             return Result::Ok();
                           });
    }
    stop = stop || !shared;
    if (loop.Watch && !stop) // of a loop that is to end nobody is asked again
    {
      loop.Watch();
    }
    return others.Away() > 0 && !stop;
  };
  RunBeside(work, send, look, all.Size() > 1 ? GlanceAround : Glance);
  return shared;
}

void ServeLoop(SharedItems& items, int most, const ParallelFor& parallel,
               const std::function<void(std::size_t item, StateArchive& result)>& work,
               std::atomic<bool>& stop)
{
  while (!stop)
  {
    const std::vector<std::int64_t> some = items.Take(most, true);
    if (some.empty())
    {
      break;
    }
    std::vector<MemoryStream> results(some.size());
    const auto workSome = [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end && !stop; ++k)
      {
        work(static_cast<std::size_t>(some[k]), results[k]);
      }
    };
    RunBeside([&]() { parallel(some.size(), workSome); }, [] {},
              [&]()
              {
                stop = items.IsOver();
                return false;
              },
              GlanceBack);
    stop = stop || items.IsOver();
    std::vector<ItemResult> given;
    for (std::size_t k = 0; k < some.size() && !stop; ++k)
    {
      given.push_back({ some[k], std::move(results[k].Content) });
    }
    if (!given.empty())
    {
      items.Give(given);
    }
  }
}

} // namespace waft
