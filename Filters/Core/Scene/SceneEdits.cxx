// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneEdits.h"

#include "Scene/JsonText.h"
#include "Scene/SceneNode.h"

#include <optional>

namespace waft
{
namespace
{

/// Where something stands in a text.
struct Span
{
  std::size_t Begin = 0, End = 0;
};

/// A value in a text of JSON that was parsed before: nothing in it is malformed.
class TextValue
{
public:
  TextValue(const std::string& text, std::size_t begin) : Text(text), Begin(SkipBlanks(begin)) {}

  void MoveTo(std::size_t begin) { this->Begin = this->SkipBlanks(begin); }
  bool IsList() const { return this->Text[this->Begin] == '['; }
  bool IsObject() const { return this->Text[this->Begin] == '{'; }
  Span Whole() const { return { this->Begin, this->Skip(this->Begin) }; }

  /// A member of an object with its name, or an element of a list.
  struct Entry
  {
    std::string Name;
    Span Whole;
    std::size_t Value = 0;
  };
  std::vector<Entry> Entries() const
  {
    std::vector<Entry> entries;
    std::size_t at = this->SkipBlanks(this->Begin + 1);
    while (this->Text[at] != ']' && this->Text[at] != '}')
    {
      Entry entry;
      entry.Whole.Begin = at;
      entry.Name = std::to_string(entries.size());
      if (this->IsObject())
      {
        const std::size_t end = this->SkipString(at);
        entry.Name = SceneJson::parse(this->Text.substr(at, end - at)).get<std::string>();
        at = this->SkipBlanks(this->SkipBlanks(end) + 1); // the colon
      }
      entry.Value = at;
      at = entry.Whole.End = this->Skip(at);
      entries.push_back(std::move(entry));
      at = this->SkipBlanks(at);
      if (this->Text[at] == ',')
      {
        at = this->SkipBlanks(at + 1);
      }
    }
    return entries;
  }

private:
  std::size_t SkipBlanks(std::size_t at) const
  {
    return std::min(this->Text.find_first_not_of(" \t\r\n", at), this->Text.size());
  }
  std::size_t SkipString(std::size_t at) const
  {
    for (++at; this->Text[at] != '"'; ++at)
    {
      at += this->Text[at] == '\\' ? 1 : 0;
    }
    return at + 1;
  }
  std::size_t Skip(std::size_t at) const
  {
    int depth = 0;
    do
    {
      const char here = this->Text[at];
      depth += here == '[' || here == '{' ? 1 : (here == ']' || here == '}' ? -1 : 0);
      if (here == '"')
      {
        at = this->SkipString(at);
      }
      else if (std::string("[]{},: \t\r\n").find(here) != std::string::npos)
      {
        ++at;
      }
      else // a number or a word
      {
        at = std::min(this->Text.find_first_of("]},: \t\r\n", at), this->Text.size());
      }
    } while (depth > 0);
    return at;
  }

  const std::string& Text;
  std::size_t Begin;
};

/// A text of JSON that is changed in places.
class TextEdit
{
public:
  TextEdit(std::string& text, SceneNode edit) : Text(text), Edit(std::move(edit)) {}

  void Apply()
  {
    const std::string operation = this->Edit.At("op", Operations).Text();
    const SceneNode pathNode = this->Edit.At("path", "a JSON pointer");
    std::vector<std::string> path;
    try
    {
      for (auto pointer = SceneJson::json_pointer(pathNode.Text()); !pointer.empty();
           pointer.pop_back())
      {
        path.insert(path.begin(), pointer.back());
      }
    }
    catch (const SceneJson::exception&)
    {
      pathNode.Fail("a JSON pointer");
    }
    if (path.empty())
    {
      pathNode.Fail("a place within the scene");
    }
    const std::string last = path.back();
    path.pop_back();
    const std::optional<TextValue> holder = this->Find(path);
    if (!holder || !(holder->IsList() || holder->IsObject()))
    {
      pathNode.Fail("a place that the scene has");
    }
    if (operation == "add")
    {
      this->Add(*holder, last, pathNode);
      return;
    }
    const std::vector<TextValue::Entry> entries = holder->Entries();
    const std::size_t index = IndexOf(entries, last);
    if (index == entries.size())
    {
      pathNode.Fail("a place that the scene has");
    }
    if (operation == "replace")
    {
      const Span old = TextValue(this->Text, entries[index].Value).Whole();
      this->Replace(old, this->Written());
    }
    else if (operation == "remove")
    {
      this->Remove(entries, index);
    }
    else
    {
      this->Edit.At("op", Operations).Fail(Operations);
    }
  }

private:
  static constexpr const char* Operations = "add, replace or remove";

  static std::size_t IndexOf(const std::vector<TextValue::Entry>& entries, const std::string& name)
  {
    std::size_t index = 0;
    while (index < entries.size() && entries[index].Name != name)
    {
      ++index;
    }
    return index;
  }

  std::optional<TextValue> Find(const std::vector<std::string>& path) const
  {
    TextValue value(this->Text, 0);
    for (const std::string& name : path)
    {
      if (!value.IsList() && !value.IsObject())
      {
        return {};
      }
      const std::vector<TextValue::Entry> entries = value.Entries();
      const std::size_t index = IndexOf(entries, name);
      if (index == entries.size())
      {
        return {};
      }
      value.MoveTo(entries[index].Value);
    }
    return value;
  }

  void Add(const TextValue& holder, const std::string& name, const SceneNode& pathNode)
  {
    const std::vector<TextValue::Entry> entries = holder.Entries();
    const std::size_t index =
      holder.IsList() && name == "-" ? entries.size() : IndexOf(entries, name);
    std::string written = this->Written();
    if (holder.IsObject())
    {
      if (index < entries.size())
      {
        this->Replace(TextValue(this->Text, entries[index].Value).Whole(), written);
        return;
      }
      written = SceneJson(name).dump() + ": " + written;
    }
    else if (index == entries.size() && name != "-" && name != std::to_string(index))
    {
      pathNode.Fail("a place that the scene has");
    }
    const std::size_t begin = holder.Whole().Begin + 1;
    if (entries.empty())
    {
      this->Replace({ begin, holder.Whole().End - 1 }, written);
      return;
    }
    // What parts an entry from the one before it.
    std::string between =
      entries.size() > 1
        ? this->Text.substr(entries[0].Whole.End, entries[1].Whole.Begin - entries[0].Whole.End)
        : "," + this->Text.substr(begin, entries[0].Whole.Begin - begin);
    between += between == "," ? " " : "";
    if (index == entries.size())
    {
      const std::size_t end = entries.back().Whole.End;
      this->Replace({ end, end }, between + written);
    }
    else
    {
      const std::size_t at = entries[index].Whole.Begin;
      this->Replace({ at, at }, written + between);
    }
  }

  void Remove(const std::vector<TextValue::Entry>& entries, std::size_t index)
  {
    Span gone = entries[index].Whole;
    if (index > 0)
    {
      gone.Begin = entries[index - 1].Whole.End;
    }
    else if (entries.size() > 1)
    {
      gone.End = entries[1].Whole.Begin;
    }
    this->Replace(gone, "");
  }

  std::string Written() const { return OneLine(this->Edit.At("value", "a value").Json()); }
  void Replace(const Span& span, const std::string& by)
  {
    this->Text.replace(span.Begin, span.End - span.Begin, by);
  }

  std::string& Text;
  SceneNode Edit;
};

} // namespace

Result EditSceneText(const std::string& edits, const std::string& name, std::string& text)
{
  if (edits.empty())
  {
    return Result::Ok();
  }
  try
  {
    (void)ParseText(text, name); // from here on it is JSON
    const SceneJson list = ParseText(edits, name + ": Edits");
    const SceneNode node(list, "");
    std::string edited = text;
    try
    {
      const std::size_t count = node.Size("a list of edits");
      for (std::size_t i = 0; i < count; ++i)
      {
        TextEdit(edited, node.Item(i)).Apply();
      }
    }
    catch (const SceneError& error)
    {
      return Result::Error(name + ": Edits: " + error.Message);
    }
    text = std::move(edited);
    return Result::Ok();
  }
  catch (const SceneError& error)
  {
    return Result::Error(error.Message);
  }
  catch (const std::exception& error)
  {
    return Result::Error(name + ": Edits: " + error.what());
  }
}

} // namespace waft
