// SPDX-License-Identifier: BSD-3-Clause
#include "Files/DataFileArrays.h"

#include <algorithm>

namespace waft
{
namespace
{

// Bytes that one byte of a compressed array may stand for: 1032 of zlib, and a little.
constexpr double MostPacked = 1100.0;

// The first bytes of an array's values and how many there can be in all.
struct Values
{
  std::string_view Text;
  bool IsRaw = false;

  double Most() const
  {
    return this->IsRaw ? double(this->Text.size()) : 0.75 * double(this->Text.size());
  }
  // `count` bytes from the beginning; what is not there is left out.
  std::string First(std::size_t count) const
  {
    if (this->IsRaw)
    {
      return std::string(this->Text.substr(0, count));
    }
    std::string bytes;
    DecodeBase64(this->Text, bytes, count);
    return bytes;
  }
};

// Each of the two: do the values agree with their header? How many bytes does it say?
bool PlainBytes(const DataFileArrays& file, const Values& values, ArrayBytes& bytes)
{
  const std::string head = values.First(static_cast<std::size_t>(file.WordSize));
  if (!Holds(head, 0, static_cast<std::uint64_t>(file.WordSize)))
  {
    return false;
  }
  bytes.InMemory = static_cast<double>(ReadUnsigned(head, 0, file.WordSize, file.Order));
  bytes.InFile = bytes.InMemory + file.WordSize;
  return bytes.InMemory <= values.Most();
}

// Number of blocks, bytes of a block and of the last when it is smaller, packed bytes of each.
bool PackedBytes(const DataFileArrays& file, const Values& values, ArrayBytes& bytes)
{
  const auto word = static_cast<std::size_t>(file.WordSize);
  const std::string head = values.First(3 * word);
  if (head.size() < 3 * word)
  {
    return head.size() >= word && ReadUnsigned(head, 0, file.WordSize, file.Order) == 0;
  }
  const std::uint64_t blocks = ReadUnsigned(head, 0, file.WordSize, file.Order);
  const auto size = static_cast<double>(ReadUnsigned(head, word, file.WordSize, file.Order));
  const auto last = static_cast<double>(ReadUnsigned(head, 2 * word, file.WordSize, file.Order));
  const auto count = static_cast<double>(blocks);
  bytes.InMemory = last > 0.0 ? (count - 1.0) * size + last : count * size;
  if (count * static_cast<double>(word) > values.Most() || last > size ||
      (blocks > 0 && size > std::max(file.Most(), 1e8)) || bytes.InMemory > file.Most())
  {
    return false;
  }
  const std::string sizes = values.First((3 + static_cast<std::size_t>(blocks)) * word);
  double packed = static_cast<double>(sizes.size());
  bool isWhole = sizes.size() == (3 + static_cast<std::size_t>(blocks)) * word;
  for (std::size_t i = 3; isWhole && i < 3 + blocks; ++i)
  {
    packed += static_cast<double>(ReadUnsigned(sizes, i * word, file.WordSize, file.Order));
  }
  bytes.InFile = packed;
  return isWhole && packed <= values.Most() + 3.0;
}

} // namespace

double DataFileArrays::Most() const
{
  return static_cast<double>(this->Text.size()) * (this->IsPacked ? MostPacked : 1.0);
}

Result DataFileArrays::Check(const ArrayClaim& claim, ArrayBytes& bytes) const
{
  if (claim.Format == "ascii")
  {
    bytes.InMemory += std::max(claim.Bytes, 0.0);
    return Result::Ok(); // the count was held against the size of the file
  }
  Values values{ {}, claim.Format == "appended" && this->IsRaw };
  if (claim.Format == "appended")
  {
    values.Text = this->Appended.substr(std::min(claim.At, this->Appended.size()));
  }
  else
  {
    const std::size_t begin =
      std::min(this->Text.find_first_not_of(" \t\r\n", claim.At), this->Text.size());
    values.Text = this->Text.substr(begin, this->Text.find('<', begin) - begin);
  }
  ArrayBytes own;
  const bool isGood =
    this->IsPacked ? PackedBytes(*this, values, own) : PlainBytes(*this, values, own);
  // A reader does not look at the values of an array without any.
  if (claim.Bytes == 0.0)
  {
    return Result::Ok();
  }
  if (!isGood)
  {
    return Result::Error(claim.Location +
                         "expected its values, found that they are cut or damaged");
  }
  if (claim.Bytes > 0.0 && own.InMemory != claim.Bytes)
  {
    return Result::Error(
      claim.Location + "expected " + std::to_string(static_cast<long long>(claim.Bytes)) +
      " bytes of values, found " + std::to_string(static_cast<long long>(own.InMemory)));
  }
  bytes.InMemory += own.InMemory;
  bytes.InFile += own.InFile;
  return Result::Ok();
}

} // namespace waft
