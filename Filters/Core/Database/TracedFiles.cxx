// SPDX-License-Identifier: BSD-3-Clause
#include "Database/TracedFiles.h"

#include "Base/AtomicFile.h"
#include "Base/Digest.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <type_traits>

namespace waft
{

namespace
{

constexpr const char* Format = "Waft traced simulation 2";

// Tells a damaged file from a whole one.
std::uint64_t ChecksumOf(const char* bytes, std::size_t size)
{
  Digest digest;
  digest.Add(bytes, size);
  return digest.Sum();
}

class Writer
{
public:
  std::string Bytes;

  template <class T>
  void Value(const T& value)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    this->Bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void Vector(const Vec3& v)
  {
    this->Bytes.append(reinterpret_cast<const char*>(v.data()), 3 * sizeof(double));
  }
  template <class T>
  void List(const std::vector<T>& values)
  {
    this->Value(static_cast<std::uint64_t>(values.size()));
    this->Bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void Text(const std::string& text)
  {
    this->Value(static_cast<std::uint64_t>(text.size()));
    this->Bytes += text;
  }
};

// Once something is missing, Good is false and nothing more is read.
class Reader
{
public:
  Reader(const char* bytes, std::size_t size) : At(bytes), Left(size) {}
  bool Good = true;

  template <class T>
  T Value()
  {
    T value{};
    this->Take(&value, sizeof(T));
    return value;
  }
  Vec3 Vector()
  {
    Vec3 v = Vec3::Zero();
    this->Take(v.data(), 3 * sizeof(double));
    return v;
  }
  template <class T>
  std::vector<T> List()
  {
    const std::uint64_t count = this->Count(sizeof(T));
    std::vector<T> values(count);
    this->Take(values.data(), count * sizeof(T));
    return values;
  }
  std::string Text()
  {
    std::string text(this->Count(1), '\0');
    this->Take(text.data(), text.size());
    return text;
  }
  /// A number of things of at least this many bytes each.
  std::uint64_t Count(std::size_t bytes)
  {
    const auto count = this->Value<std::uint64_t>();
    this->Good = this->Good && count <= this->Left / bytes;
    return this->Good ? count : 0;
  }

private:
  void Take(void* target, std::size_t size)
  {
    this->Good = this->Good && size <= this->Left;
    if (this->Good && size > 0)
    {
      std::memcpy(target, this->At, size);
      this->At += size;
      this->Left -= size;
    }
  }

  const char* At;
  std::size_t Left;
};

static_assert(sizeof(Vec3) == 3 * sizeof(double));

void WriteVortex(Writer& writer, const Vortex& vortex)
{
  writer.Value(vortex.VortexId);
  writer.Vector(vortex.P1);
  writer.Vector(vortex.P2);
  for (const double value : { vortex.Strength, vortex.CenterTime, vortex.Duration,
                              vortex.CoreRadius, vortex.Confidence })
  {
    writer.Value(value);
  }
  writer.Value(vortex.ObjectCount);
}

Vortex ReadVortex(Reader& reader)
{
  Vortex vortex;
  vortex.VortexId = reader.Value<int>();
  vortex.P1 = reader.Vector();
  vortex.P2 = reader.Vector();
  for (double* value : { &vortex.Strength, &vortex.CenterTime, &vortex.Duration, &vortex.CoreRadius,
                         &vortex.Confidence })
  {
    *value = reader.Value<double>();
  }
  vortex.ObjectCount = reader.Value<int>();
  return vortex;
}

} // namespace

TracedFiles::TracedFiles(std::string folder, std::string parameters) :
  Folder(std::move(folder)), Parameters(std::move(parameters))
{
}

std::string TracedFiles::PathOf(int simulation) const
{
  return (std::filesystem::path(this->Folder) / ("simulation" + std::to_string(simulation)))
    .string();
}

bool TracedFiles::Read(int simulation, TracedSimulation& traced) const
{
  if (this->Folder.empty())
  {
    return false;
  }
  std::ifstream file(this->PathOf(simulation), std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(file), {} };
  if (bytes.size() < sizeof(std::uint64_t))
  {
    return false;
  }
  const std::size_t size = bytes.size() - sizeof(std::uint64_t);
  std::uint64_t checksum = 0;
  std::memcpy(&checksum, bytes.data() + size, sizeof(checksum));
  Reader reader(bytes.data(), size);
  if (checksum != ChecksumOf(bytes.data(), size) || reader.Text() != Format ||
      reader.Text() != this->Parameters || reader.Value<int>() != simulation)
  {
    return false;
  }
  TracedSimulation read;
  const std::uint64_t vortices = reader.Count(1);
  for (std::uint64_t v = 0; reader.Good && v < vortices; ++v)
  {
    read.Vortices.push_back(ReadVortex(reader));
  }
  const std::uint64_t tracks = reader.Count(1);
  for (std::uint64_t t = 0; reader.Good && t < tracks; ++t)
  {
    Track track;
    track.ObjectId = reader.Value<int>();
    track.Positions = reader.List<Vec3>();
    track.ForceTypes = reader.List<ForceType>();
    track.VortexIds = reader.List<int>();
    track.WindAccelerations = reader.List<Vec3>();
    read.Tracks.push_back(std::move(track));
  }
  if (!reader.Good)
  {
    return false;
  }
  traced = std::move(read);
  return true;
}

Result TracedFiles::Write(int simulation, const TracedSimulation& traced) const
{
  if (this->Folder.empty())
  {
    return Result::Ok();
  }
  std::error_code error;
  std::filesystem::create_directories(this->Folder, error);
  if (error)
  {
    return Result::Error("cannot make the folder " + this->Folder + ": " + error.message());
  }
  Writer writer;
  writer.Text(Format);
  writer.Text(this->Parameters);
  writer.Value(simulation);
  writer.Value(static_cast<std::uint64_t>(traced.Vortices.size()));
  for (const Vortex& vortex : traced.Vortices)
  {
    WriteVortex(writer, vortex);
  }
  writer.Value(static_cast<std::uint64_t>(traced.Tracks.size()));
  for (const Track& track : traced.Tracks)
  {
    writer.Value(track.ObjectId);
    writer.List(track.Positions);
    writer.List(track.ForceTypes);
    writer.List(track.VortexIds);
    writer.List(track.WindAccelerations);
  }
  writer.Value(ChecksumOf(writer.Bytes.data(), writer.Bytes.size()));
  return WriteWholeFile(this->PathOf(simulation), writer.Bytes);
}

} // namespace waft
