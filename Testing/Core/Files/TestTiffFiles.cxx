// SPDX-License-Identifier: BSD-3-Clause
// TIFF pictures of all kinds, and how pictures were held.
#include "Files/PictureOrientation.h"
#include "Files/TiffFile.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <map>

using namespace waft;

namespace
{

std::string Number(std::uint64_t number, int size, bool isLittle)
{
  std::string bytes;
  for (int i = 0; i < size; ++i)
  {
    bytes += static_cast<char>(number >> 8 * (isLittle ? i : size - 1 - i));
  }
  return bytes;
}

// A TIFF of fields by their numbers and of strips or tiles, whose places it knows itself.
struct Tiff
{
  std::map<int, std::vector<std::uint64_t>> Fields;
  std::vector<std::string> Parts;
  bool IsLittle = true;

  std::string File() const
  {
    auto fields = this->Fields;
    const bool isTiled = fields.count(322) > 0;
    for (const std::string& part : this->Parts)
    {
      fields[isTiled ? 324 : 273].push_back(0);
      fields[isTiled ? 325 : 279].push_back(part.size());
    }
    std::uint64_t end = 8 + 2 + 12 * fields.size() + 4;
    std::string longer; // fields of more than four bytes
    const std::uint64_t begin = end;
    for (const auto& [tag, numbers] : fields)
    {
      end += numbers.size() > 1 ? 4 * numbers.size() : 0;
    }
    std::vector<std::uint64_t>& offsets = fields[isTiled ? 324 : 273];
    std::uint64_t at = end;
    for (std::size_t i = 0; i < this->Parts.size(); ++i)
    {
      offsets[i] = at;
      at += this->Parts[i].size();
    }
    const auto number = [&](std::uint64_t value, int size)
    { return Number(value, size, this->IsLittle); };
    std::string file = (this->IsLittle ? std::string("II*\0", 4) : std::string("MM\0*", 4)) +
                       number(8, 4) + number(fields.size(), 2);
    for (const auto& [tag, numbers] : fields)
    {
      const bool isShort = tag == 274 || tag == 258; // as Exif has it
      file += number(static_cast<std::uint64_t>(tag), 2);
      file += number(isShort && numbers.size() == 1 ? 3 : 4, 2) + number(numbers.size(), 4);
      if (numbers.size() == 1)
      {
        file += isShort ? number(numbers[0], 2) + number(0, 2) : number(numbers[0], 4);
        continue;
      }
      file += number(begin + longer.size(), 4);
      for (const std::uint64_t value : numbers)
      {
        longer += number(value, 4);
      }
    }
    file += number(0, 4) + longer;
    for (const std::string& part : this->Parts)
    {
      file += part;
    }
    return file;
  }
};

// One strip of pixels; kind: 0 grey that is white at 0, 1 grey, 2 colour.
Tiff Strip(int width, int height, int channels, int kind, const std::string& pixels)
{
  const auto number = [](int value) { return static_cast<std::uint64_t>(value); };
  Tiff tiff;
  tiff.Fields = {
    { 256, { number(width) } }, { 257, { number(height) } },  { 258, { 8 } }, { 259, { 1 } },
    { 262, { number(kind) } },  { 277, { number(channels) } }
  };
  tiff.Parts = { pixels };
  return tiff;
}

// LZW as TIFF 6.0, section 13, writes it.
std::string LzwPacked(const std::string& bytes)
{
  std::string packed;
  std::uint32_t waiting = 0;
  int bits = 0;
  std::map<std::string, unsigned> words;
  unsigned next = 0;
  const auto write = [&](unsigned code)
  {
    const int width = next > 2047 ? 12 : next > 1023 ? 11 : next > 511 ? 10 : 9;
    waiting = waiting << width | code;
    for (bits += width; bits >= 8; bits -= 8)
    {
      packed += static_cast<char>(waiting >> (bits - 8));
    }
  };
  const auto begin = [&]
  {
    words.clear();
    for (unsigned i = 0; i < 256; ++i)
    {
      words[std::string(1, static_cast<char>(i))] = i;
    }
    next = 258;
  };
  write(256);
  begin();
  std::string word;
  for (const char byte : bytes)
  {
    if (words.count(word + byte) > 0)
    {
      word += byte;
      continue;
    }
    write(words[word]);
    words[word + byte] = next++;
    word = std::string(1, byte);
    if (next == 4095)
    {
      write(256);
      begin();
    }
  }
  write(words[word]);
  ++next;
  write(257);
  packed += static_cast<char>(waiting << (8 - bits));
  return packed;
}

std::string Read(const std::string& file)
{
  PictureBytes picture;
  const Result result = ReadTiff(file, picture);
  EXPECT_TRUE(result) << result.Message();
  return std::string(picture.Values.begin(), picture.Values.end());
}

std::string Error(const std::string& file)
{
  PictureBytes picture;
  return ReadTiff(file, picture).Message();
}

} // namespace

TEST(TiffFiles, GreysAndColours)
{
  EXPECT_EQ(Read(Strip(3, 2, 1, 1, "abcdef").File()), "abcdef");
  EXPECT_EQ(Read(Strip(2, 1, 1, 0, std::string("\xff\x01", 2)).File()), std::string("\x00\xfe", 2));
  EXPECT_EQ(Read(Strip(2, 1, 3, 2, "abcdef").File()), "abcdef");
  Tiff big = Strip(1, 1, 3, 2, "abc");
  big.IsLittle = false;
  EXPECT_EQ(Read(big.File()), "abc");
}

TEST(TiffFiles, AlphaIsWhatTheFileSaysItIs)
{
  const auto rgba = [](std::vector<std::uint64_t> extra)
  {
    Tiff tiff = Strip(2, 1, 4, 2,
                      std::string("\x40\x20\x10\x80"
                                  "abc\x00",
                                  8));
    if (!extra.empty())
    {
      tiff.Fields[338] = std::move(extra);
    }
    return Read(tiff.File());
  };
  EXPECT_EQ(rgba({}), std::string("\x40\x20\x10\x80"
                                  "abc\x00",
                                  8));
  EXPECT_EQ(rgba({ 2 }), rgba({}));
  EXPECT_EQ(rgba({ 0 }), "\x40\x20\x10"
                         "abc")
    << "another channel";
  EXPECT_EQ(rgba({ 1 }), std::string("\x80\x40\x20\x80"
                                     "abc\x00",
                                     8))
    << "colours times alpha";
  EXPECT_EQ(Read(Strip(1, 2, 2, 1, "gaGA").File()), "gaGA") << "grey with alpha";
}

TEST(TiffFiles, SixteenBitsPalettesPlanesAndTiles)
{
  Tiff wide = Strip(1, 1, 3, 2, "1a2b3c");
  wide.Fields[258] = { 16, 16, 16 };
  EXPECT_EQ(Read(wide.File()), "abc");
  wide.IsLittle = false;
  EXPECT_EQ(Read(wide.File()), "123");
  Tiff palette = Strip(2, 1, 1, 3, std::string("\x00\x02", 2));
  palette.Fields[320].assign(3 * 256, 0);
  palette.Fields[320][2] = 'r' << 8;
  palette.Fields[320][256 + 2] = 'g' << 8;
  palette.Fields[320][512 + 2] = 'b' << 8;
  EXPECT_EQ(Read(palette.File()), std::string("\0\0\0rgb", 6));
  Tiff planes = Strip(2, 1, 3, 2, "rR");
  planes.Fields[284] = { 2 };
  planes.Parts = { "rR", "gG", "bB" };
  EXPECT_EQ(Read(planes.File()), "rgbRGB");
  Tiff tiles = Strip(3, 3, 1, 1, "");
  tiles.Fields[322] = { 2 };
  tiles.Fields[323] = { 2 };
  tiles.Parts = { "abde", "c.f.", "gh..", "i..." };
  EXPECT_EQ(Read(tiles.File()), "abcdefghi");
  Tiff strips = Strip(2, 3, 1, 1, "");
  strips.Fields[278] = { 2 };
  strips.Parts = { "abcd", "ef" };
  EXPECT_EQ(Read(strips.File()), "abcdef");
}

TEST(TiffFiles, PackedInTheUsualWays)
{
  Tiff bits = Strip(4, 2, 1, 1,
                    "\x03"
                    "abcd"
                    "\xfd"
                    "x");
  bits.Fields[259] = { 32773 };
  EXPECT_EQ(Read(bits.File()), "abcdxxxx");

  std::string pattern;
  for (int y = 0; y < 16; ++y)
  {
    for (int x = 0; x < 16; ++x)
    {
      pattern += static_cast<char>((x + y) / 3 % 4 * 60);
    }
  }
  std::string packed(compressBound(uLong(pattern.size())), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(pattern.data()), uLong(pattern.size()));
  for (const std::uint64_t packing : { 8u, 32946u })
  {
    Tiff deflated = Strip(16, 16, 1, 1, packed.substr(0, size));
    deflated.Fields[259] = { packing };
    EXPECT_EQ(Read(deflated.File()), pattern);
  }
  Tiff lzw = Strip(16, 16, 1, 1, LzwPacked(pattern));
  lzw.Fields[259] = { 5 };
  EXPECT_EQ(Read(lzw.File()), pattern);
  std::string noise; // codes grow to 12 bits and begin again
  for (unsigned i = 0, seed = 1; i < 128 * 128; ++i)
  {
    seed = seed * 1664525 + 1013904223;
    noise += static_cast<char>(seed >> 24);
  }
  Tiff longer = Strip(128, 128, 1, 1, LzwPacked(noise));
  longer.Fields[259] = { 5 };
  EXPECT_EQ(Read(longer.File()), noise);

  Tiff differences = Strip(3, 1, 1, 1, std::string("a\x01\xff", 3));
  differences.Fields[317] = { 2 };
  EXPECT_EQ(Read(differences.File()), "aba");
}

TEST(TiffFiles, CutAndDamagedOnes)
{
  const std::string good = Strip(3, 2, 1, 1, "abcdef").File();
  for (std::size_t i = 0; i < good.size(); ++i)
  {
    EXPECT_NE(Error(good.substr(0, i)), "") << i;
  }
  EXPECT_NE(Error(Strip(3, 2, 1, 1, "abcde").File()), "");
  EXPECT_NE(Error(Strip(1 << 30, 2, 1, 1, "abcdef").File()), "");
  EXPECT_NE(Error(Strip(8000, 8000, 1, 1, "abcdef").File()).find("cannot unpack to so many"),
            std::string::npos);
  EXPECT_NE(Error(Strip(1, 1, 4, 5, "cmyk").File()).find("found inks (CMYK)"), std::string::npos);
  Tiff jpeg = Strip(3, 2, 1, 1, "abcdef");
  jpeg.Fields[259] = { 7 };
  EXPECT_NE(Error(jpeg.File()).find("found packing 7"), std::string::npos);
  Tiff lzw = Strip(3, 2, 1, 1, "\xff\xff\xff\xff");
  lzw.Fields[259] = { 5 };
  EXPECT_NE(Error(lzw.File()).find("fewer or damaged"), std::string::npos);
}

TEST(PictureOrientation, OfTiffJpegAndPng)
{
  for (const bool isLittle : { true, false })
  {
    Tiff tiff = Strip(1, 1, 1, 1, "a");
    tiff.IsLittle = isLittle;
    EXPECT_EQ(PictureOrientation(tiff.File()), 1);
    tiff.Fields[274] = { 6 };
    EXPECT_EQ(PictureOrientation(tiff.File()), 6);
    const std::string exif = std::string("Exif\0\0", 6) + tiff.File();
    const std::string jpeg = "\xff\xd8" + std::string("\xff\xe0\x00\x04xx", 6) + "\xff\xe1" +
                             Number(exif.size() + 2, 2, false) + exif + "\xff\xda";
    EXPECT_EQ(PictureOrientation(jpeg), 6);
    EXPECT_EQ(PictureOrientation(jpeg.substr(0, 40)), 1);
    const std::string chunk = tiff.File();
    EXPECT_EQ(PictureOrientation("\x89PNG\r\n\x1a\n" + Number(chunk.size(), 4, false) + "eXIf" +
                                 chunk + "sums"),
              6);
    tiff.Fields[274] = { 9 };
    EXPECT_EQ(PictureOrientation(tiff.File()), 1);
  }
  EXPECT_EQ(PictureOrientation(""), 1);
  EXPECT_EQ(PictureOrientation("BM"), 1);
}
