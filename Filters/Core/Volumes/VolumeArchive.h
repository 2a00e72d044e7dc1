// SPDX-License-Identifier: BSD-3-Clause
// Reading of .vdb files that may be cut or damaged. Private to this library (it shows OpenVDB).
#pragma once

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>
#include <openvdb/openvdb.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace waft
{

/// A .vdb file on a stream that throws where it ends, which openvdb::io::File's does not. Lengths
/// of texts are held against the file before memory is taken for them. Every function throws
/// std::exception on what cannot be read.
class VolumeArchive : public openvdb::io::Archive
{
public:
  explicit VolumeArchive(const std::string& path);

  const openvdb::MetaMap& Notes() const { return this->FileNotes; }
  /// The grids with their metadata and transforms, without values.
  openvdb::GridPtrVec ReadOutlines();
  /// The first grid of this name, whole; throws when there is none.
  openvdb::GridBase::Ptr ReadGrid(const std::string& name);

private:
  struct Entry
  {
    openvdb::io::GridDescriptor Descriptor;
    openvdb::GridBase::Ptr Outline;
  };

  void CheckVersion();
  std::uint64_t Left();
  void PassTexts(int count);
  void CheckNotes();
  void ReadOutline(Entry& entry);
  openvdb::GridBase::Ptr ReadWhole(const Entry& entry);

  openvdb::io::StreamMetadata::Ptr StreamNotes = std::make_shared<openvdb::io::StreamMetadata>();
  std::ifstream Stream; // has a pointer to these
  std::uint64_t Size = 0;
  openvdb::MetaMap FileNotes;
  std::vector<Entry> Entries;
};

} // namespace waft
