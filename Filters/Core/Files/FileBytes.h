// SPDX-License-Identifier: BSD-3-Clause
// Files as bytes, for those who look at them before a library reads them.
#pragma once

#include "Base/Result.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace waft
{

/// The bytes of a file, mapped into memory for as long as this lives.
class FileBytes
{
public:
  FileBytes() = default;
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  /// Fails on what is no file or cannot be read. Once only.
  Result Open(const std::string& path);
  std::string_view View() const { return { this->Bytes, this->Size }; }

private:
  const char* Bytes = nullptr;
  std::size_t Size = 0;
};

enum class ByteOrder
{
  Little,
  Big
};

/// An unsigned number of 1 to 8 bytes at an offset; the caller has seen that they are there.
std::uint64_t ReadUnsigned(std::string_view bytes, std::size_t at, int size, ByteOrder order);
/// The same as a float (4) or a double (8).
double ReadReal(std::string_view bytes, std::size_t at, int size, ByteOrder order);

/// Are there `size` bytes from `at` on? No sum overflows.
inline bool Holds(std::string_view bytes, std::uint64_t at, std::uint64_t size)
{
  return at <= bytes.size() && size <= bytes.size() - at;
}

/// The whole of a text as a number; false for anything else, NaN and infinity included.
bool ParseNumber(std::string_view text, double& number);
bool ParseInteger(std::string_view text, long long& number);

/// Decodes base64 up to the first character that is none of its digits, to at most `most` bytes.
/// Returns how many characters it took.
std::size_t DecodeBase64(std::string_view text, std::string& bytes,
                         std::size_t most = std::string::npos);
/// Characters that stand for so many bytes.
inline std::size_t Base64Size(std::size_t bytes)
{
  return (bytes + 2) / 3 * 4;
}

/// A text of a file for a message: at most 40 bytes, those that are not printable as ?.
std::string Printable(std::string_view text);
/// The same in quotation marks.
std::string Quoted(std::string_view text);

} // namespace waft
