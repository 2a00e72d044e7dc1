// SPDX-License-Identifier: BSD-3-Clause
#include "Files/XmlTags.h"

#include <algorithm>

namespace waft
{
namespace
{

constexpr std::string_view Blanks = " \t\r\n";

void SkipBlanks(std::string_view& text)
{
  text.remove_prefix(std::min(text.find_first_not_of(Blanks), text.size()));
}

std::string_view TakeName(std::string_view& text)
{
  const std::string_view name = text.substr(0, text.find_first_of(" \t\r\n=/><\"'"));
  text.remove_prefix(name.size());
  return name;
}

// ` name="value"` or ` name='value'`.
bool TakeAttribute(std::string_view& text, XmlTag& tag)
{
  const std::string_view name = TakeName(text);
  SkipBlanks(text);
  if (name.empty() || text.empty() || text[0] != '=')
  {
    return false;
  }
  text.remove_prefix(1);
  SkipBlanks(text);
  if (text.empty() || (text[0] != '"' && text[0] != '\''))
  {
    return false;
  }
  const std::size_t end = text.find(text[0], 1);
  if (end == std::string_view::npos)
  {
    return false;
  }
  tag.Attributes.emplace_back(name, text.substr(1, end - 1));
  text.remove_prefix(end + 1);
  return true;
}

} // namespace

bool XmlTag::Has(std::string_view name) const
{
  return this->Attribute(name).data() != nullptr;
}

std::string_view XmlTag::Attribute(std::string_view name) const
{
  for (const auto& [key, value] : this->Attributes)
  {
    if (key == name)
    {
      return value;
    }
  }
  return {};
}

std::string Unescaped(std::string_view value)
{
  constexpr std::pair<std::string_view, char> entities[] = {
    { "&amp;", '&' }, { "&lt;", '<' }, { "&gt;", '>' }, { "&quot;", '"' }, { "&apos;", '\'' }
  };
  std::string text;
  while (!value.empty())
  {
    std::size_t size = 1;
    char character = value[0];
    for (const auto& [entity, meant] : entities)
    {
      if (value.substr(0, entity.size()) == entity)
      {
        size = entity.size();
        character = meant;
      }
    }
    text += character;
    value.remove_prefix(size);
  }
  return text;
}

std::size_t XmlTags::SkipTo(std::string_view end) const
{
  const std::size_t found = this->Text.find(end, this->At);
  return found == std::string_view::npos ? this->Text.size() : found + end.size();
}

bool XmlTags::Next(XmlTag& tag)
{
  for (;;)
  {
    this->At = std::min(this->Text.find('<', this->At), this->Text.size());
    const std::string_view here = this->Text.substr(this->At);
    if (here.empty())
    {
      return false;
    }
    if (here.substr(0, 4) == "<!--")
    {
      this->At = this->SkipTo("-->");
    }
    else if (here.substr(0, 2) == "<?")
    {
      this->At = this->SkipTo("?>");
    }
    else
    {
      break;
    }
  }
  tag = XmlTag();
  tag.Begin = this->At;
  std::string_view rest = this->Text.substr(this->At + 1);
  tag.IsClosing = !rest.empty() && rest[0] == '/';
  tag.IsOpening = !tag.IsClosing;
  rest.remove_prefix(tag.IsClosing ? 1 : 0);
  tag.Name = TakeName(rest);
  this->Broken = tag.Name.empty();
  SkipBlanks(rest);
  while (!this->Broken && !rest.empty() && rest[0] != '>' && rest[0] != '/')
  {
    this->Broken = tag.IsClosing || !TakeAttribute(rest, tag);
    SkipBlanks(rest);
  }
  if (!rest.empty() && rest[0] == '/' && tag.IsOpening)
  {
    tag.IsClosing = true;
    rest.remove_prefix(1);
  }
  this->Broken = this->Broken || rest.empty() || rest[0] != '>';
  this->At = this->Text.size() - rest.size() + 1;
  tag.End = this->At;
  return !this->Broken;
}

} // namespace waft
