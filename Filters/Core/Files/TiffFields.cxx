// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TiffFields.h"

#include <string>

namespace waft
{
namespace
{

// Sizes of the types of a TIFF by their numbers; 0: no number that is needed here.
int TiffSize(std::uint64_t type)
{
  return type == 1 ? 1 : type == 3 ? 2 : type == 4 ? 4 : 0;
}

Result CutOff(const std::string& where)
{
  return Result::Error(where + ": expected more, found the end of the file");
}

} // namespace

bool IsTiff(std::string_view file, ByteOrder& order)
{
  const bool isLittle = file.substr(0, 4) == std::string_view("II*\0", 4);
  order = isLittle ? ByteOrder::Little : ByteOrder::Big;
  return isLittle || file.substr(0, 4) == std::string_view("MM\0*", 4);
}

Result TiffFields::Read(std::string_view file)
{
  if (!IsTiff(file, this->Bytes))
  {
    return Result::Error("expected the signature of a .tif picture, found another file");
  }
  if (file.size() < 8)
  {
    return CutOff("header");
  }
  const ByteOrder order = this->Bytes;
  const std::uint64_t directory = ReadUnsigned(file, 4, 4, order);
  if (!Holds(file, directory, 2))
  {
    return CutOff("directory");
  }
  const std::uint64_t count = ReadUnsigned(file, directory, 2, order);
  if (count == 0 || !Holds(file, directory + 2, 12 * count + 4))
  {
    return CutOff("directory");
  }
  std::uint64_t total = 0; // of fields that do not lie one upon the other
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const std::uint64_t entry = directory + 2 + 12 * i;
    const int tag = static_cast<int>(ReadUnsigned(file, entry, 2, order));
    const int size = TiffSize(ReadUnsigned(file, entry + 2, 2, order));
    const std::uint64_t length = ReadUnsigned(file, entry + 4, 4, order);
    if (size == 0)
    {
      continue;
    }
    const std::uint64_t bytes = static_cast<std::uint64_t>(size) * length;
    const std::uint64_t offset = bytes <= 4 ? entry + 8 : ReadUnsigned(file, entry + 8, 4, order);
    total += bytes;
    if (!Holds(file, offset, bytes) || total > file.size())
    {
      return CutOff("field " + std::to_string(tag));
    }
    for (std::uint64_t k = 0; k < length; ++k)
    {
      this->Fields[tag].push_back(
        ReadUnsigned(file, offset + k * static_cast<std::uint64_t>(size), size, order));
    }
  }
  return Result::Ok();
}

std::uint64_t TiffFields::Number(int tag, std::uint64_t absent) const
{
  const std::vector<std::uint64_t>& numbers = this->Numbers(tag);
  return numbers.empty() ? absent : numbers[0];
}

const std::vector<std::uint64_t>& TiffFields::Numbers(int tag) const
{
  static const std::vector<std::uint64_t> none;
  const auto found = this->Fields.find(tag);
  return found == this->Fields.end() ? none : found->second;
}

} // namespace waft
