// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes/PngImage.h"

#include <zlib.h>

namespace waft
{
namespace
{

void Append32(std::vector<std::uint8_t>& bytes, std::uint32_t value)
{
  for (int shift = 24; shift >= 0; shift -= 8)
  {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

void AppendChunk(std::vector<std::uint8_t>& bytes, const char* type,
                 const std::vector<std::uint8_t>& data)
{
  Append32(bytes, static_cast<std::uint32_t>(data.size()));
  const std::size_t start = bytes.size();
  bytes.insert(bytes.end(), type, type + 4);
  bytes.insert(bytes.end(), data.begin(), data.end());
  Append32(bytes, static_cast<std::uint32_t>(crc32(0, &bytes[start], uInt(bytes.size() - start))));
}

} // namespace

std::string WithPngText(const std::string& png, const std::string& keyword, const std::string& text)
{
  std::vector<std::uint8_t> content(keyword.begin(), keyword.end());
  content.push_back(0);
  content.insert(content.end(), text.begin(), text.end());
  std::vector<std::uint8_t> chunk, end;
  AppendChunk(chunk, "tEXt", content);
  AppendChunk(end, "IEND", {});
  return png.substr(0, png.size() - end.size()) + std::string(chunk.begin(), chunk.end()) +
         std::string(end.begin(), end.end());
}

std::string EncodePng(const std::vector<std::uint8_t>& pixels, int width, int height)
{
  std::vector<std::uint8_t> rows;
  const std::size_t stride = 4 * static_cast<std::size_t>(width);
  for (int row = 0; row < height; ++row)
  {
    const std::size_t at = stride * static_cast<std::size_t>(height - 1 - row); // top row first
    rows.push_back(2); // the filter's number
    for (std::size_t i = 0; i < stride; ++i)
    {
      const int above = row > 0 ? pixels[at + stride + i] : 0;
      rows.push_back(static_cast<std::uint8_t>(pixels[at + i] - above));
    }
  }
  std::vector<std::uint8_t> packed(compressBound(rows.size()));
  uLongf size = packed.size();
  compress2(packed.data(), &size, rows.data(), rows.size(), 6);
  packed.resize(size);
  std::vector<std::uint8_t> png = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
  std::vector<std::uint8_t> header;
  Append32(header, static_cast<std::uint32_t>(width));
  Append32(header, static_cast<std::uint32_t>(height));
  header.insert(header.end(), { 8, 6, 0, 0, 0 });
  AppendChunk(png, "IHDR", header);
  AppendChunk(png, "IDAT", packed);
  AppendChunk(png, "IEND", {});
  return std::string(png.begin(), png.end());
}

} // namespace waft
