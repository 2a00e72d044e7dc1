// SPDX-License-Identifier: BSD-3-Clause
// Ranks that are threads of this process, for tests.
#pragma once

#include "Base/Communicator.h"

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <functional>
#include <map>
#include <mutex>
#include <queue>
#include <thread>
#include <utility>
#include <vector>

namespace waft
{

/// What was sent from one rank to another and is not yet received.
class ThreadMail
{
public:
  void Put(int from, int to, const void* bytes, std::size_t size)
  {
    const char* first = static_cast<const char*>(bytes);
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Messages[{ from, to }].emplace(first, first + size);
    this->Arrived.notify_all();
  }
  std::vector<char> Take(int from, int to)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    auto& messages = this->Messages[{ from, to }];
    this->Arrived.wait(lock, [&] { return !messages.empty(); });
    std::vector<char> message = std::move(messages.front());
    messages.pop();
    return message;
  }
  bool IsThere(int from, int to)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return !this->Messages[{ from, to }].empty();
  }
  bool IsEmpty() const
  {
    for (const auto& entry : this->Messages)
    {
      if (!entry.second.empty())
      {
        return false;
      }
    }
    return true;
  }

private:
  std::mutex Mutex;
  std::condition_variable Arrived;
  std::map<std::pair<int, int>, std::queue<std::vector<char>>> Messages;
};

class ThreadCommunicator : public Communicator
{
public:
  ThreadCommunicator(int rank, int size, ThreadMail& mail) : Own(rank), Count(size), Mail(mail) {}
  int Rank() const override { return this->Own; }
  int Size() const override { return this->Count; }
  void SendReceive(int other, const void* sent, std::size_t sentSize, void* received,
                   std::size_t receivedSize) override
  {
    if (sentSize > 0)
    {
      this->Mail.Put(this->Own, other, sent, sentSize);
    }
    if (receivedSize > 0)
    {
      const std::vector<char> message = this->Mail.Take(other, this->Own);
      this->AllFit = this->AllFit && message.size() == receivedSize;
      std::memcpy(received, message.data(), std::min(message.size(), receivedSize));
    }
  }
  bool HasMessage(int from) override { return this->Mail.IsThere(from, this->Own); }
  bool AllFit = true; // what came had the size that was expected

private:
  int Own, Count;
  ThreadMail& Mail;
};

/// Runs body(communicator) on so many ranks at once. False when a message was left over or of
/// another size than expected.
inline bool RunRanks(int size, const std::function<void(ThreadCommunicator&)>& body)
{
  ThreadMail mail;
  std::vector<ThreadCommunicator> ranks;
  for (int r = 0; r < size; ++r)
  {
    ranks.emplace_back(r, size, mail);
  }
  std::vector<std::thread> threads;
  for (ThreadCommunicator& rank : ranks)
  {
    threads.emplace_back([&body, &rank] { body(rank); });
  }
  bool isGood = true;
  for (int r = 0; r < size; ++r)
  {
    threads[r].join();
    isGood = isGood && ranks[r].AllFit;
  }
  return isGood && mail.IsEmpty();
}

} // namespace waft
