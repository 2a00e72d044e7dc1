// SPDX-License-Identifier: BSD-3-Clause
// Pictures are looked at before a decoder sees them: right ones pass, and no cut or changed byte
// does where the format can tell.
#include "Files/PictureFile.h"
#include "Files/PngFile.h"

#include <gtest/gtest.h>
#include <zlib.h>

using namespace waft;

namespace
{

std::string Big32(std::uint32_t number)
{
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
  {
    bytes += static_cast<char>(number >> shift);
  }
  return bytes;
}

std::string Little(std::uint64_t number, int size)
{
  std::string bytes;
  for (int i = 0; i < size; ++i)
  {
    bytes += static_cast<char>(number >> 8 * i);
  }
  return bytes;
}

std::string Chunk(const std::string& type, const std::string& data)
{
  const std::string body = type + data;
  const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
  return Big32(std::uint32_t(data.size())) + body + Big32(std::uint32_t(sum));
}

std::string Packed(const std::string& rows)
{
  uLongf size = compressBound(uLong(rows.size()));
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(rows.data()), uLong(rows.size()));
  packed.resize(size);
  return packed;
}

std::string Png(std::uint32_t width, std::uint32_t height, int depth, int color,
                const std::string& rows, const std::string& before = "")
{
  std::string header = Big32(width) + Big32(height);
  header += static_cast<char>(depth);
  header += static_cast<char>(color);
  header += std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + Chunk("IHDR", header) + before + Chunk("IDAT", Packed(rows)) +
         Chunk("IEND", "");
}

// Rows of 3 pixels of 3 bytes with the filter's byte in front.
std::string Rows(int count)
{
  std::string rows;
  for (int row = 0; row < count; ++row)
  {
    rows += std::string(1, '\0') + std::string(9, static_cast<char>(50 * row));
  }
  return rows;
}

std::string Bmp(std::uint32_t width, std::uint32_t height)
{
  return "BM" + Little(0, 4) + Little(0, 4) + Little(54, 4) + Little(40, 4) + Little(width, 4) +
         Little(height, 4) + Little(1, 2) + Little(24, 2) + Little(0, 4) + std::string(20, '\0') +
         std::string(24, 'x');
}

std::string PngError(const std::string& file)
{
  std::string sound;
  return SoundPng(file, sound).Message();
}

bool Has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

} // namespace

TEST(PictureFiles, PngOfEveryKind)
{
  std::string sound;
  EXPECT_TRUE(SoundPng(Png(3, 2, 8, 2, Rows(2), Chunk("tEXt", "Title\0x")), sound));
  EXPECT_EQ(sound, Png(3, 2, 8, 2, Rows(2))); // texts are left out
  EXPECT_EQ(PngError(Png(3, 2, 8, 3, std::string(8, '\0'), Chunk("PLTE", "abcdef"))), "");
  EXPECT_EQ(PngError(Png(9, 1, 1, 0, std::string(3, '\0'))), "");
}

TEST(PictureFiles, NoMoreBytesThanAMachineHas)
{
  // Whole pictures of a few bytes: all their rows are zeros.
  const auto zeros = [](std::uint32_t side, int depth, int color, std::size_t bits)
  {
    return PngError(Png(side, side, depth, color,
                        std::string(side * (1 + (std::size_t{ side } * bits + 7) / 8), '\0')));
  };
  EXPECT_EQ(zeros(6000, 1, 0, 1), "");
  EXPECT_TRUE(Has(zeros(8200, 1, 0, 1), "67108864 pixels of 1 bytes, found 8200 x 8200"));
  const std::string claim = Png(6000, 6000, 16, 6, "");
  EXPECT_TRUE(Has(PngError(claim), "33554432 pixels of 8 bytes, found 6000 x 6000"));
}

TEST(PictureFiles, NoCutOrChangedPngPasses)
{
  const std::string good = Png(3, 2, 8, 2, Rows(2));
  for (std::size_t i = 0; i < good.size(); ++i)
  {
    EXPECT_NE(PngError(good.substr(0, i)), "") << i;
    std::string changed = good;
    changed[i] = static_cast<char>(changed[i] ^ 0x20);
    EXPECT_NE(PngError(changed), "") << i;
  }
}

TEST(PictureFiles, PngErrorsNameTheChunk)
{
  EXPECT_TRUE(Has(PngError("BM"), "expected the signature of a PNG picture"));
  EXPECT_TRUE(Has(PngError(Png(20000, 20000, 8, 2, Rows(2))), "20000 x 20000"));
  EXPECT_TRUE(Has(PngError(Png(3, 2, 3, 2, Rows(2))), "chunk IHDR"));
  EXPECT_TRUE(Has(PngError(Png(3, 2, 8, 2, Rows(1))), "chunk IDAT"));               // too little
  EXPECT_TRUE(Has(PngError(Png(3, 2, 8, 2, Rows(3))), "chunk IDAT"));               // too much
  EXPECT_TRUE(Has(PngError(Png(3, 2, 8, 2, std::string(20, '\7'))), "chunk IDAT")); // no filter
  EXPECT_TRUE(Has(PngError(Png(3, 2, 8, 3, std::string(8, '\0'))), "chunk PLTE"));
  EXPECT_TRUE(Has(PngError(Png(3, 2, 8, 2, Rows(2), Chunk("ABCD", ""))), "\"ABCD\""));
}

TEST(PictureFiles, BmpWithAllItsPixels)
{
  EXPECT_EQ(CheckBmp(Bmp(3, 2)).Message(), "");
  EXPECT_NE(CheckBmp(Bmp(3, 2).substr(0, 77)).Message(), "");
  EXPECT_NE(CheckBmp(Bmp(4, 4)).Message(), "");
  EXPECT_TRUE(Has(CheckBmp(Bmp(0x7fffffff, 0x7fffffff)).Message(), "expected a picture of 1 to"));
}

TEST(PictureFiles, JpegByItsFrameHeader)
{
  const std::string start = "\xff\xd8";
  const auto frame = [](int width, int height)
  {
    return std::string("\xff\xc0\x00\x0b\x08", 5) + Big32(std::uint32_t(height)).substr(2) +
           Big32(std::uint32_t(width)).substr(2) + std::string("\x01\x01\x11\x00", 4);
  };
  EXPECT_EQ(CheckJpeg(start + frame(30, 20)).Message(), "");
  EXPECT_TRUE(Has(CheckJpeg(start + frame(65535, 65535)).Message(), "65535 x 65535"));
  std::string scans;
  for (int i = 0; i < 100; ++i)
  {
    scans += "\xff\xda";
  }
  EXPECT_EQ(CheckJpeg(start + frame(4000, 4000) + scans).Message(), "");
  EXPECT_TRUE(Has(CheckJpeg(start + frame(8000, 8000) + scans).Message(), "33 scans"));
  std::string inks = start + frame(30, 20);
  inks[2 + 9] = 4;
  EXPECT_TRUE(Has(CheckJpeg(inks).Message(), "found inks (CMYK)"));
  EXPECT_TRUE(Has(CheckJpeg(start).Message(), "header"));
  EXPECT_TRUE(Has(CheckJpeg("GIF").Message(), "signature of a JPEG"));
  EXPECT_TRUE(
    Has(CheckJpeg(start + std::string("\xff\xda\x00\x08......", 10)).Message(), "frame header"));
}
