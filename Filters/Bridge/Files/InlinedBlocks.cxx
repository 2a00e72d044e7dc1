// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/InlinedBlocks.h"

#include "Files/FileBytes.h"
#include "Files/InlineData.h"
#include "Files/XmlTags.h"

#include <fstream>
#include <stdlib.h>

namespace waft
{
namespace
{

std::string Escaped(const std::string& name)
{
  std::string text;
  for (const char c : name)
  {
    text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return text;
}

Result Write(const std::string& path, const std::string& content)
{
  std::ofstream stream(path, std::ios::binary);
  stream << content;
  stream.close();
  return stream ? Result::Ok() : Result::Error("cannot write " + path);
}

} // namespace

InlinedBlocks::~InlinedBlocks()
{
  if (!this->Folder.empty())
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Folder, ignored);
  }
}

Result InlinedBlocks::Make(const std::string& path)
{
  this->File = path;
  FileBytes file;
  WAFT_RETURN_IF_FAILED(file.Open(path));
  XmlTags tags(file.View());
  XmlTag tag;
  std::string index;
  std::size_t done = 0;
  while (tags.Next(tag))
  {
    const std::string_view name = tag.Attribute("file");
    if (!tag.IsOpening || tag.Name != "DataSet" || name.empty())
    {
      continue;
    }
    auto block =
      std::filesystem::absolute(path).parent_path() / std::filesystem::path(Unescaped(name));
    WAFT_RETURN_IF_FAILED(this->Keep(block));
    const auto at = static_cast<std::size_t>(name.data() - file.View().data());
    index += file.View().substr(done, at - done);
    index += Escaped(block.string());
    done = at + name.size();
  }
  if (this->Folder.empty())
  {
    return Result::Ok();
  }
  index += file.View().substr(done);
  this->File = (this->Folder / "blocks.vtm").string();
  return Write(this->File, index);
}

Result InlinedBlocks::Keep(std::filesystem::path& block)
{
  FileBytes file;
  WAFT_RETURN_IF_FAILED(file.Open(block.string()));
  const std::string made = WithInlineData(file.View());
  if (made.empty())
  {
    return Result::Ok();
  }
  if (this->Folder.empty())
  {
    std::string name = (std::filesystem::temp_directory_path() / "waft-blocks-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
    {
      return Result::Error("cannot make the folder " + name);
    }
    this->Folder = name;
  }
  block = this->Folder / (std::to_string(this->Copies++) + block.extension().string());
  return Write(block.string(), made);
}

} // namespace waft
