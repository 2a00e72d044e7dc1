// SPDX-License-Identifier: BSD-3-Clause
#include "Volumes/VolumeArchive.h"

#include <algorithm>

namespace waft
{

VolumeArchive::VolumeArchive(const std::string& path) :
  Stream(path, std::ios::binary | std::ios::ate)
{
  this->Stream.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
  this->Size = static_cast<std::uint64_t>(this->Stream.tellg());
  this->CheckVersion();
  this->readHeader(this->Stream);
  openvdb::io::setStreamMetadataPtr(this->Stream, this->StreamNotes, false);
  this->setFormatVersion(this->Stream);
  this->setLibraryVersion(this->Stream);
  this->setDataCompression(this->Stream);
  if (!this->inputHasGridOffsets())
  {
    OPENVDB_THROW(openvdb::IoError, "grids without their offsets in the file");
  }
  this->CheckNotes();
  this->FileNotes.readMeta(this->Stream);
  const int grids = readGridCount(this->Stream);
  for (int i = 0; i < grids; ++i)
  {
    const std::streampos at = this->Stream.tellg();
    this->PassTexts(3);
    this->Stream.seekg(at);
    Entry entry;
    entry.Outline = entry.Descriptor.read(this->Stream);
    for (const std::int64_t position :
         { entry.Descriptor.getGridPos(), entry.Descriptor.getEndPos() })
    {
      if (position < at || static_cast<std::uint64_t>(position) > this->Size)
      {
        OPENVDB_THROW(openvdb::IoError, "the end of the file before that of a grid");
      }
    }
    entry.Descriptor.seekToEnd(this->Stream);
    this->Entries.push_back(std::move(entry));
  }
}

// Of a newer version the library would say on the console that it cannot read it, and go on.
void VolumeArchive::CheckVersion()
{
  constexpr std::streamoff offset = 8; // behind the magic number
  std::uint32_t version = 0;
  this->Stream.seekg(offset);
  this->Stream.read(reinterpret_cast<char*>(&version), sizeof(version));
  this->Stream.seekg(0);
  if (version > openvdb::OPENVDB_FILE_VERSION)
  {
    OPENVDB_THROW(openvdb::IoError, "version " << version << " of the format, which is unknown");
  }
}

std::uint64_t VolumeArchive::Left()
{
  return this->Size - static_cast<std::uint64_t>(this->Stream.tellg());
}

// Steps over texts, each a length of 32 bits and so many bytes.
void VolumeArchive::PassTexts(int count)
{
  for (int i = 0; i < count; ++i)
  {
    std::uint32_t length = 0;
    this->Stream.read(reinterpret_cast<char*>(&length), sizeof(length));
    if (length > this->Left())
    {
      OPENVDB_THROW(openvdb::IoError, "a text that is longer than the file");
    }
    this->Stream.seekg(length, std::ios::cur);
  }
}

// Looks at the metadata that are read next: their number, and a name, a type and a value of each.
void VolumeArchive::CheckNotes()
{
  const std::streampos at = this->Stream.tellg();
  std::uint32_t count = 0;
  this->Stream.read(reinterpret_cast<char*>(&count), sizeof(count));
  for (std::uint32_t i = 0; i < count; ++i)
  {
    this->PassTexts(3);
  }
  this->Stream.seekg(at);
}

void VolumeArchive::ReadOutline(Entry& entry)
{
  entry.Descriptor.seekToGrid(this->Stream);
  readGridCompression(this->Stream);
  this->CheckNotes();
  entry.Outline->readMeta(this->Stream);
  const std::streampos at = this->Stream.tellg();
  this->PassTexts(1); // the name of the transform's kind
  this->Stream.seekg(at);
  entry.Outline->readTransform(this->Stream);
}

openvdb::GridPtrVec VolumeArchive::ReadOutlines()
{
  openvdb::GridPtrVec grids;
  for (Entry& entry : this->Entries)
  {
    this->ReadOutline(entry);
    grids.push_back(entry.Outline);
  }
  return grids;
}

openvdb::GridBase::Ptr VolumeArchive::ReadWhole(const Entry& entry)
{
  const openvdb::GridBase::Ptr grid = entry.Outline->copyGridWithNewTree();
  entry.Descriptor.seekToGrid(this->Stream);
  readGrid(grid, entry.Descriptor, this->Stream);
  return grid;
}

openvdb::GridBase::Ptr VolumeArchive::ReadGrid(const std::string& name)
{
  for (Entry& entry : this->Entries)
  {
    this->ReadOutline(entry);
    if (entry.Outline->getName() != name)
    {
      continue;
    }
    const openvdb::GridBase::Ptr grid = this->ReadWhole(entry);
    const auto& parent = entry.Descriptor.instanceParentName();
    const auto found =
      std::find_if(this->Entries.begin(), this->Entries.end(),
                   [&](const Entry& e) { return e.Descriptor.uniqueName() == parent; });
    if (!parent.empty() && found != this->Entries.end() && !found->Descriptor.isInstance())
    {
      grid->setTree(this->ReadWhole(*found)->baseTreePtr());
    }
    return grid;
  }
  OPENVDB_THROW(openvdb::KeyError, "no grid of the name " << name);
}

} // namespace waft
