// SPDX-License-Identifier: BSD-3-Clause
// Reads back what a MemoryStream kept, of this rank or of another.
#pragma once

#include "Base/StateArchive.h"

#include <cstring>
#include <utility>
#include <vector>

namespace waft
{

class ReadingStream : public StateArchive
{
public:
  explicit ReadingStream(std::vector<char> content) : Content(std::move(content)) {}
  bool IsReading() const override { return true; }
  std::uint64_t Left() const override { return this->Content.size() - this->At; }

protected:
  bool Get(void* bytes, std::size_t size) override
  {
    if (size > this->Left())
    {
      return false;
    }
    std::memcpy(bytes, this->Content.data() + this->At, size);
    this->At += size;
    return true;
  }

private:
  std::vector<char> Content;
  std::size_t At = 0;
};

} // namespace waft
