// SPDX-License-Identifier: BSD-3-Clause
// The JSON of a glTF 2.0 file and the numbers in its buffers. Private to this library (it shows the
// JSON library).
#pragma once

#include "Files/FileBytes.h"

#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace waft
{

using GltfJson = nlohmann::json;

/// What is wrong with a file. Thrown inside this library only; ReadGltf turns it into a Result.
struct GltfError
{
  std::string Text; // "/json/pointer: expected ..., found ..."
};

/// Throws "place: what".
[[noreturn]] void Refuse(const std::string& location, const std::string& what);

/// A whole number from 0 on in `object`, which stands at `place`.
std::uint64_t IndexAt(const GltfJson& object, const char* key, const std::string& location);
/// The same, or `absent` where there is none.
std::uint64_t IndexAt(const GltfJson& object, const char* key, const std::string& location,
                      std::uint64_t absent);
/// As many finite numbers as `absent` has, which is given where there are none.
std::vector<double> NumbersAt(const GltfJson& object, const char* key, std::vector<double> absent,
                              const std::string& location);

/// How numbers of an accessor may be kept.
enum class GltfNumbers
{
  Whole,    // bytes, 16 or 32 bits, from 0 on
  Reals,    // floats
  Parts,    // floats, or whole ones of 8 or 16 bits as parts of 1
  Quantized // the same, parts of 1 only where the accessor is normalized
};

/// All of this throws GltfError, and what the JSON library throws.
class GltfFile
{
public:
  /// A .glb, or a .gltf with its buffers inside or in files beside it.
  explicit GltfFile(const std::string& path);

  /// The whole JSON, an object.
  const GltfJson& Root() const { return this->Json; }
  /// An entry of one of the lists of the file, an object; user: the place that speaks of it.
  const GltfJson& Entry(const char* list, std::uint64_t index, const std::string& user) const;
  /// Does it say that it uses this extension?
  bool Uses(const std::string& extension) const;
  /// Numbers of an accessor of this type ("VEC3"), sparse ones included.
  std::vector<double> Read(std::uint64_t accessor, const std::string& user, const char* type,
                           GltfNumbers kept);

private:
  struct Buffer
  {
    std::unique_ptr<FileBytes> File; // beside this one
    std::string Decoded;             // from inside this one
    std::string_view Bytes;
    bool IsOpen = false;
  };

  void CheckExtensions() const;
  // The JSON of a .glb; its binary chunk is kept.
  std::string_view OpenChunks(std::string_view file);
  // Bytes of `buffers[index]`, opened once.
  std::string_view BufferBytes(std::uint64_t index, const std::string& user);
  void OpenBuffer(Buffer& buffer, const GltfJson& entry, bool isFirst, const std::string& location);
  // Bytes of a view of a buffer.
  std::string_view View(const GltfJson& entry, const std::string& location);
  // Where elements of `size` bytes lie in the view that `owner` names.
  struct Elements
  {
    std::string_view Bytes;
    std::uint64_t Stride = 0;
  };
  Elements ElementsOf(const GltfJson& owner, std::uint64_t count, std::uint64_t size,
                      const std::string& location);

  std::string Path;
  FileBytes Whole;
  GltfJson Json;
  std::string_view Binary;
  std::vector<Buffer> Buffers;
};

} // namespace waft
