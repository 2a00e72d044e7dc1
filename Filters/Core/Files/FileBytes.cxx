// SPDX-License-Identifier: BSD-3-Clause
#include "Files/FileBytes.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace waft
{

FileBytes::~FileBytes()
{
  if (this->Bytes)
  {
    ::munmap(const_cast<char*>(this->Bytes), this->Size);
  }
}

Result FileBytes::Open(const std::string& path)
{
  // Without O_NONBLOCK a pipe that nobody writes to would be waited for.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat status = {};
  if (file < 0 || ::fstat(file, &status) != 0 || !S_ISREG(status.st_mode))
  {
    if (file >= 0)
    {
      ::close(file);
    }
    return Result::Error("expected a file that can be read, found none");
  }
  void* mapped = nullptr;
  if (status.st_size > 0)
  {
    mapped =
      ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, file, 0);
  }
  ::close(file);
  if (mapped == MAP_FAILED)
  {
    return Result::Error("expected a file that can be read whole, found one of " +
                         std::to_string(status.st_size) + " bytes");
  }
  this->Bytes = static_cast<const char*>(mapped);
  this->Size = static_cast<std::size_t>(status.st_size);
  return Result::Ok();
}

std::uint64_t ReadUnsigned(std::string_view bytes, std::size_t at, int size, ByteOrder order)
{
  std::uint64_t value = 0;
  for (int i = 0; i < size; ++i)
  {
    const int index = order == ByteOrder::Big ? i : size - 1 - i;
    value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(index)]);
  }
  return value;
}

double ReadReal(std::string_view bytes, std::size_t at, int size, ByteOrder order)
{
  const std::uint64_t bits = ReadUnsigned(bytes, at, size, order);
  if (size == 4)
  {
    const auto half = static_cast<std::uint32_t>(bits);
    float value;
    std::memcpy(&value, &half, sizeof(value));
    return value;
  }
  double value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

bool ParseNumber(std::string_view text, double& number)
{
  const char* first = text.data() + (!text.empty() && text.front() == '+' ? 1 : 0);
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, number);
  return error == std::errc() && end == last && std::isfinite(number);
}

bool ParseInteger(std::string_view text, long long& number)
{
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last;
}

std::size_t DecodeBase64(std::string_view text, std::string& bytes, std::size_t most)
{
  constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  bytes.clear();
  std::uint32_t bits = 0;
  int held = 0;
  std::size_t at = 0;
  for (; at < text.size() && bytes.size() < most; ++at)
  {
    const std::size_t digit = digits.find(text[at]);
    if (digit == std::string_view::npos)
    {
      break;
    }
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held >= 8)
    {
      held -= 8;
      bytes += static_cast<char>(bits >> held & 0xff);
    }
  }
  return at;
}

std::string Printable(std::string_view text)
{
  constexpr std::size_t most = 40;
  std::string printable;
  for (const char c : text.substr(0, most))
  {
    printable += c >= ' ' && c <= '~' ? c : '?';
  }
  return printable + (text.size() > most ? "..." : "");
}

std::string Quoted(std::string_view text)
{
  return '"' + Printable(text) + '"';
}

} // namespace waft
