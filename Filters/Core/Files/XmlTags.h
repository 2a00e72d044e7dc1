// SPDX-License-Identifier: BSD-3-Clause
// The tags of an XML file, one after the other.
#pragma once

#include "Base/Result.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace waft
{

struct XmlTag
{
  std::string_view Name;
  std::vector<std::pair<std::string_view, std::string_view>> Attributes;
  bool IsOpening = false; // `<Name ...>` or `<Name .../>`
  bool IsClosing = false; // `</Name>` or `<Name .../>`
  std::size_t Begin = 0;  // byte of its `<`
  std::size_t End = 0;    // byte behind its `>`

  bool Has(std::string_view name) const;
  /// Empty when there is none of this name.
  std::string_view Attribute(std::string_view name) const;
};

/// An attribute's value with the five entities of XML as what they stand for.
std::string Unescaped(std::string_view value);

/// Steps over text, comments and declarations. What the file calls entities stays as it is.
class XmlTags
{
public:
  explicit XmlTags(std::string_view text) : Text(text) {}

  /// The next tag; false at the end of the text or where a tag is none.
  bool Next(XmlTag& tag);
  bool IsBroken() const { return this->Broken; }
  /// Goes on at another byte.
  void Seek(std::size_t at) { this->At = at; }

private:
  std::size_t SkipTo(std::string_view end) const;

  std::string_view Text;
  std::size_t At = 0;
  bool Broken = false;
};

} // namespace waft
