// SPDX-License-Identifier: BSD-3-Clause
// What a computation needs to go on later, as a stream of bytes: one function of a class both
// writes it and reads it back, so that the two cannot differ.
#pragma once

#include "Base/AtomicFile.h"
#include "Base/Digest.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>
#include <vector>

namespace waft
{

/// Bytes in the machine's own order. Writing leaves what is named as it is. Once anything fails
/// nothing more is moved and IsGood is false.
class StateArchive
{
public:
  virtual ~StateArchive() = default;
  virtual bool IsReading() const = 0;
  bool IsGood() const { return this->Good; }
  /// Bytes that may still be read: a damaged number of elements is not believed.
  virtual std::uint64_t Left() const { return UINT64_MAX; }

  template <class T>
  void Value(T& value)
  {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    this->Move(&value, sizeof(T));
  }
  void Value(Vec3& value) { this->Move(value.data(), 3 * sizeof(double)); }
  template <class... T>
  void Values(T&... values)
  {
    (this->Value(values), ...);
  }
  void Text(std::string& text)
  {
    text.resize(this->Count(text.size(), 1));
    this->Move(text.data(), text.size());
  }
  /// Bytes whose number both sides know.
  void Raw(void* bytes, std::size_t size) { this->Move(bytes, size); }
  /// Of numbers, points or arrays of numbers.
  template <class T>
  void List(std::vector<T>& values)
  {
    static_assert(std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3>);
    this->Resize(values, sizeof(T));
    this->Move(values.data(), values.size() * sizeof(T));
  }
  /// Of anything: serialise(stream, element) moves one.
  template <class T, class Serialiser>
  void List(std::vector<T>& values, const Serialiser& serialise)
  {
    this->Resize(values, 1);
    for (T& value : values)
    {
      serialise(*this, value);
    }
  }

protected:
  virtual bool Bytes(void* bytes, std::size_t size) = 0;
  void Fail() { this->Good = false; }

private:
  void Move(void* bytes, std::size_t size)
  {
    this->Good = this->Good && (size == 0 || this->Bytes(bytes, size));
  }
  std::size_t Count(std::size_t count, std::size_t bytes)
  {
    std::uint64_t moved = count;
    this->Value(moved);
    this->Good = this->Good && (!this->IsReading() || moved <= this->Left() / bytes);
    return this->IsReading() && !this->Good ? 0 : static_cast<std::size_t>(moved);
  }
  template <class T>
  void Resize(std::vector<T>& values, std::size_t bytes)
  {
    const std::size_t count = this->Count(values.size(), bytes);
    if (this->IsReading())
    {
      values.resize(count);
    }
  }

  bool Good = true;
};

/// Keeps nothing but the digest.
class DigestStream : public StateArchive
{
public:
  bool IsReading() const override { return false; }
  std::uint64_t Sum() const { return this->Checks.Sum(); }

protected:
  bool Bytes(void* bytes, std::size_t size) override
  {
    this->Checks.Add(bytes, size);
    return true;
  }

private:
  Digest Checks;
};

/// Keeps what is written, in memory.
class MemoryStream : public StateArchive
{
public:
  bool IsReading() const override { return false; }
  std::vector<char> Content;

protected:
  bool Bytes(void* bytes, std::size_t size) override
  {
    const char* first = static_cast<const char*>(bytes);
    this->Content.insert(this->Content.end(), first, first + size);
    return true;
  }
};

/// Writes a file whole or not at all.
class StateFileWriter : public StateArchive
{
public:
  explicit StateFileWriter(const std::string& path);

  bool IsReading() const override { return false; }
  /// The file takes its place, its checksum at the end. Errors name the path and the reason; what
  /// stood there before is then untouched and nothing is left beside it.
  Result Commit();

protected:
  bool Bytes(void* bytes, std::size_t size) override;

private:
  PartFile File;
  Digest Checks;
};

/// True when there is a file that StateFileWriter wrote, and it is whole.
bool IsWholeStateFile(const std::string& path);

/// Reads what StateFileWriter wrote.
class StateFileReader : public StateArchive
{
public:
  explicit StateFileReader(const std::string& path);
  ~StateFileReader() override;
  StateFileReader(const StateFileReader&) = delete;
  void operator=(const StateFileReader&) = delete;

  bool IsReading() const override { return true; }
  /// Nothing is left over.
  bool IsAtEnd() const { return this->IsGood() && this->Rest == 0; }
  std::uint64_t Left() const override { return this->Rest; }

protected:
  bool Bytes(void* bytes, std::size_t size) override;

private:
  friend bool IsWholeStateFile(const std::string& path);
  std::FILE* File = nullptr;
  std::uint64_t Rest = 0; // bytes before the checksum
};

} // namespace waft
