// SPDX-License-Identifier: BSD-3-Clause
// Numbers of the accessors of a glTF file (glTF 2.0, section 3.6.2).
#include "Files/GltfFile.h"
#include "Files/PolygonSurface.h"

#include <algorithm>
#include <array>

namespace waft
{
namespace
{

// Types of numbers by their codes.
struct Component
{
  std::uint64_t Code = 0;
  int Size = 0;
  double Scale = 1.0; // that is 1
  bool IsSigned = false;
};

constexpr std::array<Component, 6> Components{ {
  { 5120, 1, 127.0, true },
  { 5121, 1, 255.0, false },
  { 5122, 2, 32767.0, true },
  { 5123, 2, 65535.0, false },
  { 5125, 4, 1.0, false },
  { 5126, 4, 1.0, true },
} };

constexpr std::uint64_t Float = 5126;

Component ComponentOf(const GltfJson& entry, const std::string& location, GltfNumbers kept)
{
  const std::uint64_t code = IndexAt(entry, "componentType", location);
  const auto* found = std::find_if(Components.begin(), Components.end(),
                                   [code](const Component& c) { return c.Code == code; });
  const bool isKnown = found != Components.end();
  const bool isGood = isKnown && (kept == GltfNumbers::Whole   ? !found->IsSigned
                                  : kept == GltfNumbers::Reals ? code == Float
                                                               : code != 5125);
  if (!isGood)
  {
    Refuse(location + "/componentType", kept == GltfNumbers::Whole   ? "expected whole numbers"
                                        : kept == GltfNumbers::Reals ? "expected floats"
                                                                     : "expected floats, or whole "
                                                                       "numbers of 8 or 16 bits");
  }
  Component component = *found;
  const bool isPart = kept == GltfNumbers::Parts ||
                      (kept == GltfNumbers::Quantized && entry.value("normalized", false));
  component.Scale = isPart ? component.Scale : 1.0;
  return component;
}

double NumberAt(std::string_view bytes, std::size_t at, const Component& component)
{
  if (component.Code == Float)
  {
    return ReadReal(bytes, at, 4, ByteOrder::Little);
  }
  const std::uint64_t bits = ReadUnsigned(bytes, at, component.Size, ByteOrder::Little);
  auto number = static_cast<double>(bits);
  const double range = component.Size == 1 ? 256.0 : 65536.0;
  if (component.IsSigned && number >= 0.5 * range)
  {
    number -= range;
  }
  // The least of a signed type stands for -1 like the one after it.
  return component.Scale > 1.0 ? std::max(number / component.Scale, -1.0) : number;
}

std::size_t WidthOf(const std::string& type)
{
  return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
}

} // namespace

GltfFile::Elements GltfFile::ElementsOf(const GltfJson& owner, std::uint64_t count,
                                        std::uint64_t size, const std::string& location)
{
  const std::uint64_t index = IndexAt(owner, "bufferView", location);
  const GltfJson& entry = this->Entry("bufferViews", index, location);
  const std::string_view view = this->View(entry, "/bufferViews/" + std::to_string(index));
  const std::uint64_t stride = IndexAt(entry, "byteStride", location, size);
  const std::uint64_t start = IndexAt(owner, "byteOffset", location, 0);
  if (count < 1 || stride < size || stride > 252 || start > view.size() || count > view.size() ||
      !Holds(view, start, (count - 1) * stride + size))
  {
    Refuse(location, "expected " + std::to_string(count) + " elements within its view of " +
                       std::to_string(view.size()) + " bytes");
  }
  return { view.substr(start), stride };
}

std::vector<double> GltfFile::Read(std::uint64_t accessor, const std::string& user,
                                   const char* type, GltfNumbers kept)
{
  const GltfJson& entry = this->Entry("accessors", accessor, user);
  const std::string location = "/accessors/" + std::to_string(accessor);
  if (entry.value("type", GltfJson()) != type)
  {
    Refuse(location, std::string("expected ") + type);
  }
  const Component component = ComponentOf(entry, location, kept);
  const std::size_t width = WidthOf(type);
  const std::uint64_t size = width * static_cast<std::uint64_t>(component.Size);
  const std::uint64_t count = IndexAt(entry, "count", location);
  std::vector<double> numbers;
  const auto put = [&](const Elements& elements, std::uint64_t from, std::uint64_t to)
  {
    for (std::size_t c = 0; c < width; ++c)
    {
      const std::size_t at = from * elements.Stride + c * static_cast<std::size_t>(component.Size);
      numbers[to * width + c] = NumberAt(elements.Bytes, at, component);
    }
  };
  const auto sparse = entry.find("sparse");
  if (sparse == entry.end() || entry.contains("bufferView"))
  {
    const Elements elements = this->ElementsOf(entry, count, size, location);
    numbers.resize(count * width);
    for (std::uint64_t i = 0; i < count; ++i)
    {
      put(elements, i, i);
    }
  }
  else if (count < 1 || count > MostOfASurface)
  {
    Refuse(location + "/count", "expected 1 to " + std::to_string(MostOfASurface));
  }
  if (sparse == entry.end())
  {
    return numbers;
  }
  // Some of the elements, or of zeros, are others.
  numbers.resize(count * width);
  const std::string at = location + "/sparse";
  const GltfJson& indices = sparse->at("indices");
  const std::uint64_t changed = IndexAt(*sparse, "count", at);
  const Component whole = ComponentOf(indices, at + "/indices", GltfNumbers::Whole);
  const Elements places =
    this->ElementsOf(indices, changed, static_cast<std::uint64_t>(whole.Size), at + "/indices");
  const Elements values = this->ElementsOf(sparse->at("values"), changed, size, at + "/values");
  for (std::uint64_t i = 0; i < changed; ++i)
  {
    const auto place = static_cast<std::uint64_t>(NumberAt(places.Bytes, i * places.Stride, whole));
    if (place >= count)
    {
      Refuse(at + "/indices", "expected indices of " + std::to_string(count) + " elements, found " +
                                std::to_string(place));
    }
    put(values, i, place);
  }
  return numbers;
}

} // namespace waft
