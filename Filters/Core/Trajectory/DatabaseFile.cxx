// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/DatabaseFile.h"

#include "Base/StateArchive.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace waft
{
namespace
{

constexpr const char* DatabaseFormat = "Waft motion database 1";

/// A visitor that moves each member: numbers, points, rotations, matrices, structs with a Visit,
/// and lists of these.
class MemberArchive
{
public:
  explicit MemberArchive(StateArchive& stream) : Stream(stream) {}

  template <class Value>
  void operator()(Value& value) const
  {
    if constexpr (std::is_same_v<Value, bool>)
    {
      std::uint8_t flag = value;
      this->Stream.Value(flag);
      value = flag != 0;
    }
    else if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, Vec3>)
    {
      this->Stream.Value(value);
    }
    else if constexpr (std::is_same_v<Value, Quat>)
    {
      this->Stream.Raw(value.coeffs().data(), 4 * sizeof(double));
    }
    else if constexpr (std::is_base_of_v<Eigen::EigenBase<Value>, Value>)
    {
      this->Matrix(value);
    }
    else
    {
      Value::Visit(*this, value);
    }
  }
  template <class Item>
  void operator()(std::vector<Item>& items) const
  {
    if constexpr (std::is_arithmetic_v<Item> || std::is_enum_v<Item>)
    {
      this->Stream.List(items);
    }
    else
    {
      this->Stream.List(items, [this](StateArchive&, Item& item) { (*this)(item); });
    }
  }

private:
  /// As a list, whose length is not believed before it is seen, and how many rows and columns it
  /// has; empty where these do not agree.
  template <class Dense>
  void Matrix(Dense& matrix) const
  {
    std::vector<double> numbers(matrix.data(), matrix.data() + matrix.size());
    std::uint64_t rows = matrix.rows();
    std::uint64_t columns = matrix.cols();
    this->Stream.List(numbers);
    this->Stream.Value(rows);
    if constexpr (Dense::ColsAtCompileTime == Eigen::Dynamic)
    {
      this->Stream.Value(columns);
    }
    if (this->Stream.IsReading())
    {
      constexpr std::uint64_t most = std::numeric_limits<int>::max(); // of which products fit
      const bool fits = rows <= most && columns <= most && rows * columns == numbers.size();
      matrix = fits ? Dense(Eigen::Map<const Dense>(numbers.data(), static_cast<Eigen::Index>(rows),
                                                    static_cast<Eigen::Index>(columns)))
                    : Dense();
    }
  }

  StateArchive& Stream;
};

void SerialiseDatabase(StateArchive& stream, MotionDatabase& database)
{
  MotionDatabase::Visit(MemberArchive(stream), database);
  std::vector<std::pair<std::string, std::string>> rows(database.Provenance.begin(),
                                                        database.Provenance.end());
  stream.List(rows,
              [](StateArchive& s, std::pair<std::string, std::string>& row)
              {
                s.Text(row.first);
                s.Text(row.second);
              });
  database.Provenance = { rows.begin(), rows.end() };
}

bool AreForceTypesKnown(const MotionDatabase& database)
{
  const auto isKnown = [](ForceType type) { return type <= ForceType::Vortex; };
  return std::all_of(
    database.Segments.begin(), database.Segments.end(),
    [&isKnown](const Segment& segment)
    { return std::all_of(segment.ForceTypes.begin(), segment.ForceTypes.end(), isKnown); });
}

} // namespace

Result WriteDatabase(const std::string& path, const MotionDatabase& database)
{
  StateFileWriter file(path);
  std::string format = DatabaseFormat;
  file.Text(format);
  MotionDatabase written = database; // an archive takes what it could also read
  SerialiseDatabase(file, written);
  return file.Commit();
}

Result ReadDatabase(const std::string& path, MotionDatabase& database)
{
  database = MotionDatabase();
  const auto fail = [&path](const std::string& what)
  { return Result::Error(path + ": expected a motion database that Waft wrote, found " + what); };
  StateFileReader file(path);
  if (!file.IsGood())
  {
    return fail("no file of that kind");
  }
  if (!IsWholeStateFile(path))
  {
    return fail("one that is damaged or something else");
  }
  std::string format;
  file.Text(format);
  if (format != DatabaseFormat)
  {
    return fail("a file of another kind or version");
  }
  MotionDatabase read;
  SerialiseDatabase(file, read);
  if (!file.IsAtEnd() || !AreForceTypesKnown(read))
  {
    return fail("one that is incomplete");
  }
  if (const Result valid = read.Validate(); !valid)
  {
    return Result::Error(path + ": " + valid.Message());
  }
  database = std::move(read);
  return Result::Ok();
}

} // namespace waft
