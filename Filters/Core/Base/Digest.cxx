// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Digest.h"

#include <algorithm>
#include <cstring>

namespace waft
{

void Digest::Sums::AddWord(std::uint64_t word)
{
  this->A = (this->A ^ word) * 0xff51afd7ed558ccdull;
  this->A ^= this->A >> 33;
  this->B += word + 0x9e3779b97f4a7c15ull;
  this->B = (this->B ^ (this->B >> 30)) * 0xbf58476d1ce4e5b9ull;
  this->B ^= this->B >> 27;
}

void Digest::Add(const void* bytes, std::size_t size)
{
  if (size == 0)
  {
    return;
  }
  const auto* at = static_cast<const char*>(bytes);
  const auto hold = [&](std::size_t count)
  {
    std::memcpy(reinterpret_cast<char*>(&this->Rest) + this->Held, at, count);
    this->Held += count;
    at += count;
    size -= count;
  };
  if (this->Held > 0)
  {
    hold(std::min(size, sizeof(this->Rest) - this->Held));
    if (this->Held < sizeof(this->Rest))
    {
      return;
    }
    this->Now.AddWord(this->Rest);
    this->Rest = 0;
    this->Held = 0;
  }
  Sums sums = this->Now;
  for (; size >= sizeof(std::uint64_t); size -= sizeof(std::uint64_t), at += sizeof(std::uint64_t))
  {
    std::uint64_t word;
    std::memcpy(&word, at, sizeof(word));
    sums.AddWord(word);
  }
  this->Now = sums;
  if (size > 0)
  {
    hold(size);
  }
}

Digest::Sums Digest::Finished() const
{
  Sums sums = this->Now;
  sums.AddWord(this->Rest);
  sums.AddWord(this->Held);
  return sums;
}

std::uint64_t Digest::Sum() const
{
  return this->Finished().A;
}

std::string Digest::Text() const
{
  const Sums sums = this->Finished();
  std::string text(2 * sizeof(std::uint64_t), '\0');
  std::memcpy(&text[0], &sums.A, sizeof(sums.A));
  std::memcpy(&text[sizeof(sums.A)], &sums.B, sizeof(sums.B));
  return text;
}

} // namespace waft
