// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace waft
{
namespace
{

// Threads that stay: a simulation has thousands of loops that are shorter than a thread takes to
// begin. Lives as long as the process.
class ThreadPool
{
public:
  using Body = std::function<void(std::size_t, std::size_t)>;

  // One loop at a time; false where another one is under way, which may be the caller's own.
  bool Run(std::size_t threads, std::size_t count, const Body& body)
  {
    if (this->IsTaken.exchange(true))
    {
      return false;
    }
    {
      const std::lock_guard<std::mutex> lock(this->Guard);
      for (; this->Workers + 1 < threads; ++this->Workers)
      {
        std::thread([this] { this->Serve(); }).detach();
      }
      this->Current = &body;
      this->Count = count;
      this->Chunk = std::max<std::size_t>(1, count / (ChunksPerThread * threads));
      this->Next = 0;
      this->Wanted = threads - 1;
      ++this->Loop;
    }
    this->Wake.notify_all();
    this->Work();
    std::unique_lock<std::mutex> lock(this->Guard);
    this->Wanted = 0;
    this->Idle.wait(lock, [this] { return this->Working == 0; });
    lock.unlock();
    this->IsTaken = false;
    return true;
  }

private:
  static constexpr std::size_t ChunksPerThread = 4; // so that the slow ones are shared out
  static constexpr int Glances = 100;               // some tens of microseconds

  void Work()
  {
    for (std::size_t begin = this->Next.fetch_add(this->Chunk); begin < this->Count;
         begin = this->Next.fetch_add(this->Chunk))
    {
      (*this->Current)(begin, std::min(begin + this->Chunk, this->Count));
    }
  }

  void Serve()
  {
    std::uint64_t seen = 0;
    while (true)
    {
      for (int k = 0; k < Glances && this->Loop == seen; ++k)
      {
        std::this_thread::yield();
      }
      std::unique_lock<std::mutex> lock(this->Guard);
      this->Wake.wait(lock, [&] { return this->Loop != seen; });
      seen = this->Loop;
      if (this->Wanted == 0)
      {
        continue;
      }
      --this->Wanted;
      ++this->Working;
      lock.unlock();
      this->Work();
      lock.lock();
      if (--this->Working == 0)
      {
        this->Idle.notify_one();
      }
    }
  }

  std::atomic<bool> IsTaken{ false };
  std::mutex Guard; // of all that is not atomic
  std::condition_variable Wake, Idle;
  std::atomic<std::uint64_t> Loop{ 0 };
  std::atomic<std::size_t> Next{ 0 };
  const Body* Current = nullptr;
  std::size_t Count = 0, Chunk = 1, Wanted = 0, Working = 0, Workers = 0;
};

} // namespace

ParallelFor ThreadedFor(int numberOfThreads)
{
  return ThreadedFor([numberOfThreads] { return numberOfThreads; });
}

ParallelFor ThreadedFor(const std::function<int()>& numberOfThreads)
{
  static ThreadPool* const pool = new ThreadPool; // its threads may outlive whatever would end it
  return [numberOfThreads](std::size_t count, const ThreadPool::Body& body)
  {
    const auto threads = static_cast<std::size_t>(std::max(1, numberOfThreads()));
    if (count > 0 && (threads == 1 || count == 1 || !pool->Run(threads, count, body)))
    {
      body(0, count);
    }
  };
}

} // namespace waft
