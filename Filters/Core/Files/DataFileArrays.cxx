// SPDX-License-Identifier: BSD-3-Clause
#include "Files/DataFileArrays.h"

#include "Base/NumberText.h"

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
  bytes.InMemory = blocks == 0 ? 0.0 : last > 0.0 ? (count - 1.0) * size + last : count * size;
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

Values ValuesOf(const DataFileArrays& file, const ArrayClaim& claim)
{
  if (claim.Format == "appended")
  {
    return { file.Appended.substr(std::min(claim.At, file.Appended.size())), file.IsRaw };
  }
  const std::size_t begin =
    std::min(file.Text.find_first_not_of(" \t\r\n", claim.At), file.Text.size());
  return { file.Text.substr(begin, file.Text.find('<', begin) - begin), false };
}

// Each of the three: how many texts are there? A zero ends one. -1: the values are no letters.
double WrittenTexts(std::string_view codes)
{
  constexpr std::string_view blanks = " \t\r\n";
  double count = 0.0;
  for (std::size_t at = codes.find_first_not_of(blanks); at != std::string_view::npos;)
  {
    const std::size_t end = std::min(codes.find_first_of(blanks, at), codes.size());
    long long code = 0;
    if (!ParseInteger(codes.substr(at, end - at), code) || code < -128 || code > 255)
    {
      return -1.0;
    }
    count += code == 0 ? 1.0 : 0.0;
    at = codes.find_first_not_of(blanks, end);
  }
  return count;
}

double PlainTexts(const DataFileArrays& file, const Values& values)
{
  const auto word = static_cast<std::size_t>(file.WordSize);
  const std::string head = values.First(word);
  const std::string bytes = values.First(word + ReadUnsigned(head, 0, file.WordSize, file.Order));
  return static_cast<double>(std::count(bytes.begin() + file.WordSize, bytes.end(), '\0'));
}

double PackedTexts(const DataFileArrays& file, const Values& values, const BlockUnpacker& unpack)
{
  const auto word = static_cast<std::size_t>(file.WordSize);
  const auto number = [&](const std::string& words, std::size_t k)
  { return ReadUnsigned(words, k * word, file.WordSize, file.Order); };
  const std::string first = values.First(3 * word);
  if (first.size() < 3 * word)
  {
    return 0.0;
  }
  const std::uint64_t blocks = number(first, 0);
  const std::string head = values.First((3 + blocks) * word);
  const std::size_t after = values.IsRaw ? head.size() : Base64Size(head.size());
  const Values rest{ values.Text.substr(std::min(after, values.Text.size())), values.IsRaw };
  std::uint64_t all = 0;
  for (std::size_t k = 3; k < 3 + blocks; ++k)
  {
    all += number(head, k);
  }
  const std::string packed = rest.First(all);
  double count = 0.0;
  std::size_t at = 0;
  for (std::size_t k = 3; k < 3 + blocks; ++k)
  {
    const bool isLast = k == 2 + blocks && number(head, 2) > 0;
    std::string bytes(number(head, isLast ? 2 : 1), '\0');
    const std::string block = packed.substr(std::min(at, packed.size()), number(head, k));
    if (!unpack || !unpack(std::string(file.Packer), block, bytes))
    {
      return -1.0;
    }
    count += static_cast<double>(std::count(bytes.begin(), bytes.end(), '\0'));
    at += block.size();
  }
  return count;
}

} // namespace

int BytesOfType(std::string_view type)
{
  const auto is = [type](std::string_view a, std::string_view b) { return type == a || type == b; };
  return is("Int8", "UInt8") || is("String", "Bit")   ? 1
         : is("Int16", "UInt16")                      ? 2
         : is("Int32", "UInt32") || type == "Float32" ? 4
         : is("Int64", "UInt64") || type == "Float64" ? 8
                                                      : 0;
}

double DataFileArrays::Most() const
{
  return static_cast<double>(this->Text.size()) * (this->IsPacked() ? MostPacked : 1.0);
}

Result DataFileArrays::Check(const ArrayClaim& claim, ArrayBytes& bytes) const
{
  if (claim.Format == "ascii")
  {
    bytes.InMemory += std::max(claim.Bytes, 0.0);
    return Result::Ok(); // the count was held against the size of the file
  }
  const Values values = ValuesOf(*this, claim);
  ArrayBytes own;
  const bool isGood =
    this->IsPacked() ? PackedBytes(*this, values, own) : PlainBytes(*this, values, own);
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
    return Result::Error(claim.Location + "expected " + NumberText(claim.Bytes, 15) +
                         " bytes of values, found " + NumberText(own.InMemory, 15));
  }
  bytes.InMemory += own.InMemory;
  bytes.InFile += own.InFile;
  return Result::Ok();
}

Result DataFileArrays::CheckTexts(const ArrayClaim& claim, const BlockUnpacker& unpack) const
{
  if (claim.Texts <= 0.0) // none of which a reader looks at
  {
    return Result::Ok();
  }
  const Values values = ValuesOf(*this, claim);
  const double texts = claim.Format == "ascii" ? WrittenTexts(values.Text)
                       : this->IsPacked()      ? PackedTexts(*this, values, unpack)
                                               : PlainTexts(*this, values);
  if (texts < 0.0)
  {
    return Result::Error(claim.Location + "expected the letters of texts, found others");
  }
  return texts <= claim.Texts
           ? Result::Ok()
           : Result::Error(claim.Location + "expected " + NumberText(claim.Texts, 15) +
                           " texts, found " + NumberText(texts, 15));
}

} // namespace waft
