// SPDX-License-Identifier: BSD-3-Clause
// Values as a stream of bytes: to a file and back, to other ranks, to a digest that tells them from
// others. What a type consists of is said once, by its Visit, so that writing, reading and
// comparing cannot differ.
#pragma once

#include "Base/Digest.h"
#include "Base/Types.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace waft
{

struct OptionField;

/// Values that are moved as the bytes that they are in memory, lists of them at once.
template <class T>
inline constexpr bool IsFlat =
  (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_enum_v<T>;
template <class T, std::size_t N>
inline constexpr bool IsFlat<std::array<T, N>> = IsFlat<T>;
template <>
inline constexpr bool IsFlat<Vec3> = sizeof(Vec3) == 3 * sizeof(double);

/// Has as many items as it is given.
template <class T>
inline constexpr bool IsSequence = false;
template <class T>
inline constexpr bool IsSequence<std::vector<T>> = true;
template <>
inline constexpr bool IsSequence<std::string> = true;
template <class T>
inline constexpr bool IsArray = false;
template <class T, std::size_t N>
inline constexpr bool IsArray<std::array<T, N>> = true;

/// A visitor that writes what it is given, or reads it: numbers, texts, points, rotations,
/// matrices, structs with a Visit, and lists and arrays of these; bytes in the machine's own order.
/// What is const can be written alone, and writing leaves all as it is. Once anything fails nothing
/// more is moved and IsGood is false.
class StateArchive
{
public:
  virtual ~StateArchive() = default;
  virtual bool IsReading() const = 0;
  bool IsGood() const { return this->Good; }
  /// What was read cannot be.
  void Refuse() { this->Good = false; }
  /// Bytes that may still be read: a damaged number of items is not believed.
  virtual std::uint64_t Left() const { return UINT64_MAX; }

  template <class... T>
  void Values(T&... values)
  {
    ((*this)(values), ...);
  }
  template <class T>
  void operator()(T& value)
  {
    using Plain = std::remove_const_t<T>;
    if constexpr (IsFlat<Plain>)
    {
      this->Raw(&value, sizeof(T));
    }
    else if constexpr (std::is_same_v<Plain, bool>)
    {
      this->Flag(value);
    }
    else if constexpr (std::is_same_v<Plain, Quat>)
    {
      this->Raw(value.coeffs().data(), 4 * sizeof(double));
    }
    else if constexpr (std::is_base_of_v<Eigen::EigenBase<Plain>, Plain>)
    {
      this->Matrix(value);
    }
    else if constexpr (IsSequence<Plain>)
    {
      this->Length(value);
      this->Items(value);
    }
    else if constexpr (IsArray<Plain>)
    {
      this->Items(value);
    }
    else
    {
      Plain::Visit(*this, value);
    }
  }
  /// Of options, whose Visit says more of each field.
  template <class T>
  void operator()(const OptionField&, T& value)
  {
    (*this)(value);
  }

  /// Bytes whose number both sides know.
  void Raw(void* bytes, std::size_t size)
  {
    this->Good =
      this->Good &&
      (size == 0 || (this->IsReading() ? this->Get(bytes, size) : this->Put(bytes, size)));
  }
  void Raw(const void* bytes, std::size_t size)
  {
    this->Good = this->Good && !this->IsReading() && (size == 0 || this->Put(bytes, size));
  }
  /// How many items a list has: it is made as long when it is read.
  template <class List>
  void Length(List& list)
  {
    using Item = typename List::value_type;
    auto length = static_cast<std::uint64_t>(list.size());
    this->Values(length);
    if (this->IsReading())
    {
      this->Good = this->Good && length <= this->Left() / (IsFlat<Item> ? sizeof(Item) : 1);
      if constexpr (!std::is_const_v<List>)
      {
        list.resize(this->Good ? static_cast<std::size_t>(length) : 0);
      }
    }
  }

protected:
  virtual bool Put(const void*, std::size_t) { return false; }
  virtual bool Get(void*, std::size_t) { return false; }

private:
  template <class List>
  void Items(List& list)
  {
    using Item = typename List::value_type;
    if constexpr (IsFlat<Item>)
    {
      this->Raw(list.data(), list.size() * sizeof(Item));
    }
    else
    {
      for (auto& item : list)
      {
        (*this)(item);
      }
    }
  }
  // Any byte may have been read.
  template <class T>
  void Flag(T& flag)
  {
    std::uint8_t byte = flag ? 1 : 0;
    this->Values(byte);
    if constexpr (!std::is_const_v<T>)
    {
      flag = byte != 0;
    }
  }
  template <class Dense>
  void Matrix(Dense& matrix)
  {
    auto rows = static_cast<std::uint64_t>(matrix.rows());
    auto columns = static_cast<std::uint64_t>(matrix.cols());
    this->Values(rows, columns);
    if constexpr (!std::is_const_v<Dense>)
    {
      if (this->IsReading())
      {
        constexpr std::uint64_t most = std::numeric_limits<int>::max(); // of which products fit
        constexpr int fixed = Dense::ColsAtCompileTime;
        const bool fits = rows <= most && columns <= most &&
                          rows * columns <= this->Left() / sizeof(double) &&
                          (fixed == Eigen::Dynamic || columns == std::uint64_t(fixed));
        this->Good = this->Good && fits;
        if (!this->Good)
        {
          return;
        }
        matrix.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
      }
    }
    this->Raw(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
  }

  bool Good = true;
};

/// Keeps nothing but the digest: of inputs and options it is the key of what follows from them.
class DigestStream : public StateArchive
{
public:
  bool IsReading() const override { return false; }
  /// As Digest's.
  std::uint64_t Sum() const { return this->Checks.Sum(); }
  std::string Text() const { return this->Checks.Text(); }

protected:
  bool Put(const void* bytes, std::size_t size) override
  {
    this->Checks.Add(bytes, size);
    return true;
  }

private:
  Digest Checks;
};

template <class... T>
std::uint64_t DigestOf(const T&... values)
{
  DigestStream sum;
  sum.Values(values...);
  return sum.Sum();
}

/// Keeps what is written, in memory.
class MemoryStream : public StateArchive
{
public:
  bool IsReading() const override { return false; }
  std::vector<char> Content;

protected:
  bool Put(const void* bytes, std::size_t size) override
  {
    const char* first = static_cast<const char*>(bytes);
    this->Content.insert(this->Content.end(), first, first + size);
    return true;
  }
};

} // namespace waft
