// SPDX-License-Identifier: BSD-3-Clause
#include "Files/GltfFile.h"

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

std::vector<double> GltfFile::Read(std::uint64_t accessor, const std::string& user,
                                   const std::string& type, std::size_t components)
{
  const GltfJson& entry = this->Entry("accessors", accessor, user);
  const std::string location = "/accessors/" + std::to_string(accessor);
  if (entry.value("type", GltfJson()) != type || entry.contains("sparse"))
  {
    Refuse(location, "expected " + type + ", not sparse");
  }
  const std::uint64_t kind = IndexAt(entry, "componentType", location);
  const int size = kind == 5126 || kind == 5125 ? 4 : kind == 5123 ? 2 : kind == 5121 ? 1 : 0;
  const bool isIndex = components == 1;
  if (size == 0 || (isIndex ? kind == 5126 : components == 3 && kind != 5126))
  {
    Refuse(location + "/componentType", isIndex ? "expected whole numbers" : "expected floats");
  }
  const std::uint64_t viewIndex = IndexAt(entry, "bufferView", location);
  const GltfJson& viewEntry = this->Entry("bufferViews", viewIndex, location);
  const std::string_view view = this->View(viewEntry, "/bufferViews/" + std::to_string(viewIndex));
  const std::uint64_t element = components * static_cast<std::uint64_t>(size);
  const std::uint64_t stride = IndexAt(viewEntry, "byteStride", location, element);
  const std::uint64_t start = IndexAt(entry, "byteOffset", location, 0);
  const std::uint64_t count = IndexAt(entry, "count", location);
  if (count < 1 || stride < element || stride > 252 || start > view.size() || count > view.size() ||
      !Holds(view, start, (count - 1) * stride + element))
  {
    Refuse(location, "expected " + std::to_string(count) + " elements within its view of " +
                       std::to_string(view.size()) + " bytes");
  }
  const double scale = kind == 5123 ? 65535.0 : kind == 5121 ? 255.0 : 1.0;
  std::vector<double> numbers;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    for (std::size_t c = 0; c < components; ++c)
    {
      const std::size_t at = start + i * stride + c * static_cast<std::size_t>(size);
      const double number =
        kind == 5126 ? ReadReal(view, at, size, ByteOrder::Little)
                     : static_cast<double>(ReadUnsigned(view, at, size, ByteOrder::Little));
      numbers.push_back(isIndex ? number : number / scale);
    }
  }
  return numbers;
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
    OpenBytes(*buffer.File,
              (std::filesystem::path(this->Path).parent_path() / name.c_str()).string(),
              location + "/uri: ");
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
