// SPDX-License-Identifier: BSD-3-Clause
// What a VTK XML file takes in memory. Private to this library.
#pragma once

#include "Base/NumberText.h"
#include "Base/Result.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace waft
{

/// Of all files of a data set together.
struct DataSetBytes
{
  double InFiles = 0.0;
  double InMemory = 0.0;
  std::set<std::filesystem::path> Blocks; // the files that were named

  /// Fails where files stand for far more than they are: packed zeros are a thousandth of what they
  /// unpack to, and a count is nothing.
  Result Check() const
  {
    constexpr double mostUnpacking = 8.0;
    constexpr double mostOfSmallFiles = 512.0 * 1024.0 * 1024.0;
    const double most = std::max(mostOfSmallFiles, mostUnpacking * this->InFiles);
    return this->InMemory <= most
             ? Result::Ok()
             : Result::Error("expected values of at most " + NumberText(most, 15) +
                             " bytes in memory, found " + NumberText(this->InMemory, 15));
  }
};

/// Of the arrays of points, cells and rows: readers make room for those of the first piece, and for
/// the tuples of all pieces at once.
class DataFileRoom
{
public:
  void AddPiece() { ++this->Pieces; }
  void AddTuples(double points, double cells, double rows)
  {
    this->Parts["Points"].Tuples += points;
    this->Parts["PointData"].Tuples += points;
    this->Parts["CellData"].Tuples += cells;
    this->Parts["RowData"].Tuples += rows;
  }
  void AddArray(std::string_view parent, double tupleBytes)
  {
    if (this->Pieces == 1)
    {
      this->Parts[parent].TupleBytes += tupleBytes;
    }
  }
  double Bytes() const
  {
    double bytes = 0.0;
    for (const auto& [parent, part] : this->Parts)
    {
      bytes += part.Tuples * part.TupleBytes;
    }
    return bytes;
  }

private:
  struct Part
  {
    double Tuples = 0.0;
    double TupleBytes = 0.0;
  };

  std::map<std::string_view, Part> Parts;
  int Pieces = 0;
};

} // namespace waft
