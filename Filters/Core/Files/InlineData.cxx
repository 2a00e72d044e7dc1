// SPDX-License-Identifier: BSD-3-Clause
#include "Files/InlineData.h"

#include "Files/FileBytes.h"
#include "Files/XmlTags.h"

#include <algorithm>

namespace waft
{
namespace
{

constexpr std::string_view AppendedEnd = "</AppendedData>";

// How the values of all arrays are kept.
struct Layout
{
  bool IsPacked = false, IsRaw = false;
  std::size_t Word = 4; // bytes of a number in the header of an array
  ByteOrder Order = ByteOrder::Little;
};

void EncodeBase64(std::string_view bytes, std::string& text)
{
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  text.reserve(text.size() + Base64Size(bytes.size()));
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    const std::string_view three = bytes.substr(i, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      bits = bits << 8U | (k < three.size() ? static_cast<unsigned char>(three[k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      text += k <= three.size() ? digits[bits >> (18U - 6U * k) & 63U] : '=';
    }
  }
}

// The values of an array as base64: its header, and what the header says that follows. Of an
// array that has none there nothing.
class InlineValues
{
public:
  InlineValues(const Layout& layout, std::string_view appended) : Of(layout), Values(appended) {}

  std::string Text() const
  {
    const std::size_t word = this->Of.Word;
    const std::string first = this->First((this->Of.IsPacked ? 3 : 1) * word);
    if (first.size() < word)
    {
      return {};
    }
    const std::uint64_t number = this->Number(first, 0);
    if (!this->Of.IsPacked)
    {
      return this->Part(0, word + number);
    }
    const std::size_t header = (3 + number) * word;
    const std::string sizes = number < this->Values.size() ? this->First(header) : std::string();
    std::size_t packed = 0;
    for (std::size_t k = 3; (k + 1) * word <= sizes.size(); ++k)
    {
      packed += this->Number(sizes, k);
    }
    const std::size_t after = this->Of.IsRaw ? header : Base64Size(header);
    return this->Part(0, header) + this->Part(after, packed);
  }

private:
  std::string First(std::size_t bytes) const
  {
    if (this->Of.IsRaw)
    {
      return std::string(this->Values.substr(0, bytes));
    }
    std::string decoded;
    DecodeBase64(this->Values, decoded, bytes);
    return decoded;
  }
  std::uint64_t Number(const std::string& words, std::size_t k) const
  {
    return ReadUnsigned(words, k * this->Of.Word, static_cast<int>(this->Of.Word), this->Of.Order);
  }
  /// So many bytes from a place in the file on.
  std::string Part(std::size_t at, std::size_t bytes) const
  {
    const std::string_view rest = this->Values.substr(std::min(at, this->Values.size()));
    if (!this->Of.IsRaw)
    {
      return std::string(rest.substr(0, Base64Size(bytes)));
    }
    std::string text;
    EncodeBase64(rest.substr(0, bytes), text);
    return text;
  }

  const Layout& Of;
  std::string_view Values; // from the array's own on
};

} // namespace

std::string WithInlineData(std::string_view text)
{
  XmlTags tags(text);
  XmlTag tag;
  Layout layout;
  std::vector<XmlTag> arrays;
  while (tags.Next(tag) && tag.Name != "AppendedData")
  {
    if (tag.Name == "VTKFile" && tag.IsOpening)
    {
      layout.IsPacked = !tag.Attribute("compressor").empty();
      layout.Word = tag.Attribute("header_type") == "UInt64" ? 8 : 4;
      layout.Order =
        tag.Attribute("byte_order") == "BigEndian" ? ByteOrder::Big : ByteOrder::Little;
    }
    if (tag.IsOpening && tag.Attribute("format") == "appended")
    {
      arrays.push_back(tag);
    }
  }
  const std::size_t mark = text.find('_', tag.End);
  const std::size_t end = text.rfind(AppendedEnd);
  if (tag.Name != "AppendedData" || mark == std::string_view::npos || end < mark)
  {
    return {};
  }
  layout.IsRaw = tag.Attribute("encoding") == "raw";
  const std::string_view appended = text.substr(mark + 1, end - mark - 1);
  std::string made;
  std::size_t done = 0;
  for (const XmlTag& array : arrays)
  {
    made += text.substr(done, array.Begin - done);
    made += "<" + std::string(array.Name);
    for (const auto& [name, value] : array.Attributes)
    {
      if (name != "offset")
      {
        made += " " + std::string(name) + "=\"" +
                std::string(name == "format" ? std::string_view("binary") : value) + "\"";
      }
    }
    long long offset = 0;
    (void)ParseInteger(array.Attribute("offset"), offset);
    const auto from = std::min(static_cast<std::size_t>(std::max(0LL, offset)), appended.size());
    made += ">\n" + InlineValues(layout, appended.substr(from)).Text() + "\n";
    made += array.IsClosing ? "</" + std::string(array.Name) + ">" : std::string();
    done = array.End;
  }
  made += text.substr(done, tag.Begin - done);
  made += text.substr(end + AppendedEnd.size());
  return made;
}

} // namespace waft
