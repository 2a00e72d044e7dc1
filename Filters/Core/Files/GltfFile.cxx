// SPDX-License-Identifier: BSD-3-Clause
#include "Files/GltfFile.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace waft
{
namespace
{

std::string DecodedData(std::string_view text, const std::string& location)
{
  text = text.substr(0, text.find_last_not_of('=') + 1);
  std::string bytes;
  const std::size_t taken = DecodeBase64(text, bytes);
  if (taken < text.size())
  {
    Refuse(location, "expected base64, found " + Quoted(text.substr(taken, 1)));
  }
  return bytes;
}

// Extensions that are read, and those of how a surface looks.
bool IsKnown(const std::string& extension)
{
  for (const char* looks : { "KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_",
                             "KHR_lights_", "EXT_lights_", "KHR_xmp", "KHR_animation_" })
  {
    if (extension.rfind(looks, 0) == 0)
    {
      return true;
    }
  }
  return extension == "KHR_mesh_quantization" || extension == "EXT_mesh_gpu_instancing";
}

// A name with %20 and the like as what they stand for; itself where it has other %.
std::string DecodedName(std::string_view name)
{
  constexpr std::string_view digits = "0123456789abcdefABCDEF";
  std::string decoded;
  for (std::size_t i = 0; i < name.size(); ++i)
  {
    if (name[i] != '%')
    {
      decoded += name[i];
      continue;
    }
    int byte = 0;
    const std::string_view code = name.substr(i + 1, 2);
    for (const char c : code)
    {
      const auto digit = static_cast<int>(digits.find(c));
      byte = 16 * byte + (digit > 15 ? digit - 6 : digit);
      if (digit < 0)
      {
        return std::string(name);
      }
    }
    if (code.size() < 2 || byte == 0)
    {
      return std::string(name);
    }
    decoded += static_cast<char>(byte);
    i += 2;
  }
  return decoded;
}

void OpenBytes(FileBytes& file, const std::string& path, const std::string& location)
{
  if (const Result opened = file.Open(path); !opened)
  {
    throw GltfError{ location + opened.Message() };
  }
}

} // namespace

void Refuse(const std::string& location, const std::string& what)
{
  throw GltfError{ location + ": " + what };
}

std::uint64_t IndexAt(const GltfJson& object, const char* key, const std::string& location)
{
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_unsigned())
  {
    Refuse(location + "/" + key, "expected a whole number from 0 on");
  }
  return found->get<std::uint64_t>();
}

std::uint64_t IndexAt(const GltfJson& object, const char* key, const std::string& location,
                      std::uint64_t absent)
{
  return object.contains(key) ? IndexAt(object, key, location) : absent;
}

std::vector<double> NumbersAt(const GltfJson& object, const char* key, std::vector<double> absent,
                              const std::string& location)
{
  const auto found = object.find(key);
  if (found == object.end())
  {
    return absent;
  }
  bool isGood = found->is_array() && found->size() == absent.size();
  for (std::size_t i = 0; isGood && i < absent.size(); ++i)
  {
    isGood = (*found)[i].is_number();
    absent[i] = isGood ? (*found)[i].get<double>() : 0.0;
    isGood = isGood && std::isfinite(absent[i]);
  }
  if (!isGood)
  {
    Refuse(location + "/" + key, "expected " + std::to_string(absent.size()) + " numbers");
  }
  return absent;
}

GltfFile::GltfFile(const std::string& path) : Path(path)
{
  OpenBytes(this->Whole, path, "");
  std::string_view text = this->Whole.View();
  if (text.substr(0, 4) == "glTF")
  {
    text = this->OpenChunks(text);
  }
  this->Json = GltfJson::parse(text, nullptr, false);
  if (!this->Json.is_object())
  {
    throw GltfError{ "expected a glTF 2.0 file, found no JSON object" };
  }
  this->CheckExtensions();
}

// What a file requires and is not known would leave out a part of its surface, or move it.
void GltfFile::CheckExtensions() const
{
  const GltfJson list = this->Json.value("extensionsRequired", GltfJson::array());
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    const std::string location = "/extensionsRequired/" + std::to_string(i);
    if (!list.is_array() || !list[i].is_string())
    {
      Refuse("/extensionsRequired", "expected a list of names");
    }
    const auto& name = list[i].get_ref<const std::string&>();
    if (name.find("compression") != std::string::npos)
    {
      Refuse(location, "the mesh is compressed (" + Printable(name) + "): export without it");
    }
    if (!IsKnown(name))
    {
      Refuse(location, "expected extensions that are known here, found " + Printable(name) +
                         ": export without it");
    }
  }
}

bool GltfFile::Uses(const std::string& extension) const
{
  const GltfJson list = this->Json.value("extensionsUsed", GltfJson::array());
  return std::find(list.begin(), list.end(), extension) != list.end();
}

const GltfJson& GltfFile::Entry(const char* list, std::uint64_t index,
                                const std::string& user) const
{
  const auto found = this->Json.find(list);
  if (found == this->Json.end() || !found->is_array() || index >= found->size() ||
      !(*found)[index].is_object())
  {
    Refuse(user, "expected an index of /" + std::string(list) + ", found " + std::to_string(index));
  }
  return (*found)[index];
}

std::string_view GltfFile::OpenChunks(std::string_view file)
{
  const std::uint64_t size = Holds(file, 0, 12) ? ReadUnsigned(file, 8, 4, ByteOrder::Little) : 0;
  if (size == 0 || size > file.size() || ReadUnsigned(file, 4, 4, ByteOrder::Little) != 2)
  {
    throw GltfError{ "byte 4: expected version 2 and a length of at most " +
                     std::to_string(file.size()) + " bytes, found others" };
  }
  file = file.substr(0, size);
  std::string_view text;
  for (std::uint64_t at = 12; at < file.size();)
  {
    if (!Holds(file, at, 8) || !Holds(file, at + 8, ReadUnsigned(file, at, 4, ByteOrder::Little)))
    {
      throw GltfError{ "byte " + std::to_string(at) +
                       ": expected a whole chunk, found the end of the file" };
    }
    const std::uint64_t length = ReadUnsigned(file, at, 4, ByteOrder::Little);
    const std::string_view type = file.substr(at + 4, 4);
    if (at == 12)
    {
      text = type == "JSON" ? file.substr(at + 8, length) : text;
    }
    else if (type == std::string_view("BIN\0", 4) && this->Binary.empty())
    {
      this->Binary = file.substr(at + 8, length);
    }
    at += 8 + length;
  }
  return text;
}

void GltfFile::OpenBuffer(Buffer& buffer, const GltfJson& entry, bool isFirst,
                          const std::string& location)
{
  const auto uri = entry.find("uri");
  if (uri == entry.end())
  {
    buffer.Bytes = isFirst ? this->Binary : std::string_view();
  }
  else if (!uri->is_string())
  {
    Refuse(location + "/uri", "expected a text");
  }
  else if (const auto& name = uri->get_ref<const std::string&>(); name.rfind("data:", 0) == 0)
  {
    const std::size_t comma = name.find(";base64,");
    if (comma == std::string::npos)
    {
      Refuse(location + "/uri", "expected base64, found other data");
    }
    buffer.Decoded = DecodedData(std::string_view(name).substr(comma + 8), location + "/uri");
    buffer.Bytes = buffer.Decoded;
  }
  else
  {
    buffer.File = std::make_unique<FileBytes>();
    const std::filesystem::path folder = std::filesystem::path(this->Path).parent_path();
    std::filesystem::path file = folder / DecodedName(name).c_str();
    std::error_code none;
    // Some write a name that has a % as it is.
    file = std::filesystem::exists(file, none) ? file : folder / name.c_str();
    OpenBytes(*buffer.File, file.string(), location + "/uri: ");
    buffer.Bytes = buffer.File->View();
  }
}

std::string_view GltfFile::BufferBytes(std::uint64_t index, const std::string& user)
{
  const GltfJson& entry = this->Entry("buffers", index, user);
  const std::string location = "/buffers/" + std::to_string(index);
  this->Buffers.resize(this->Json.at("buffers").size());
  Buffer& buffer = this->Buffers[index];
  if (buffer.IsOpen)
  {
    return buffer.Bytes;
  }
  this->OpenBuffer(buffer, entry, index == 0, location);
  const std::uint64_t size = IndexAt(entry, "byteLength", location);
  if (size > buffer.Bytes.size())
  {
    Refuse(location + "/byteLength", "expected at most the " + std::to_string(buffer.Bytes.size()) +
                                       " bytes that are there, found " + std::to_string(size));
  }
  buffer.Bytes = buffer.Bytes.substr(0, size);
  buffer.IsOpen = true;
  return buffer.Bytes;
}

std::string_view GltfFile::View(const GltfJson& entry, const std::string& location)
{
  const std::string_view bytes = this->BufferBytes(IndexAt(entry, "buffer", location), location);
  const std::uint64_t start = IndexAt(entry, "byteOffset", location, 0);
  const std::uint64_t size = IndexAt(entry, "byteLength", location);
  if (!Holds(bytes, start, size))
  {
    Refuse(location, "expected bytes within its buffer of " + std::to_string(bytes.size()) +
                       ", found " + std::to_string(size) + " from " + std::to_string(start));
  }
  return bytes.substr(start, size);
}

} // namespace waft
