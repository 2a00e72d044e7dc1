// SPDX-License-Identifier: BSD-3-Clause
#include "Base/WindFields.h"

#include <algorithm>
#include <cctype>

namespace waft
{
namespace
{

std::string Lower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

// Fields of a file, looked up as written and, where `isLoose`, in whatever letters.
class FieldSearch
{
public:
  FieldSearch(const std::vector<NamedField>& fields, bool isLoose) :
    Fields(fields), IsLoose(isLoose)
  {
  }

  bool Find(const std::string& name, int components, std::vector<std::size_t>& found) const
  {
    for (std::size_t i = 0; i < this->Fields.size(); ++i)
    {
      const std::string& own = this->Fields[i].Name;
      if (this->Fields[i].Components == components &&
          (this->IsLoose ? Lower(own) == Lower(name) : own == name))
      {
        found.push_back(i);
        return true;
      }
    }
    return false;
  }

  /// A vector, or three numbers.
  bool FindWind(const std::string& name, std::vector<std::size_t>& found) const
  {
    found.clear();
    if (this->Find(name, 3, found))
    {
      return true;
    }
    for (const char* link : { ".", "_", "" })
    {
      found.clear();
      const std::string stem = name + link;
      if (this->Find(stem + "x", 1, found) && this->Find(stem + "y", 1, found) &&
          this->Find(stem + "z", 1, found))
      {
        return true;
      }
    }
    found.clear();
    return false;
  }

private:
  const std::vector<NamedField>& Fields;
  bool IsLoose;
};

} // namespace

std::string ListOfFields(const std::vector<NamedField>& fields)
{
  constexpr std::size_t most = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(most, fields.size()); ++i)
  {
    list +=
      (i == 0 ? "`" : ", `") + fields[i].Name + "` (" + std::to_string(fields[i].Components) + ")";
  }
  return fields.empty()         ? "none"
         : fields.size() > most ? list + " and " + std::to_string(fields.size() - most) + " more"
                                : list;
}

bool ChooseWind(const std::vector<NamedField>& fields, const std::string& name, WindFields& chosen)
{
  const std::vector<std::string> known = { "Wind", "Velocity", "vel", "U", "v" };
  const std::vector<std::string> names = name.empty() ? known : std::vector<std::string>{ name };
  for (const bool isLoose : { false, true })
  {
    for (const std::string& wanted : names)
    {
      if (FieldSearch(fields, isLoose).FindWind(wanted, chosen.Fields))
      {
        chosen.Meaning =
          Lower(wanted) == "wind" ? FieldMeaning::Acceleration : FieldMeaning::Velocity;
        return true;
      }
    }
  }
  return false;
}

Result NoWind(const std::string& name, const std::string& list)
{
  return Result::Error(
    "expected vectors " +
    (name.empty() ? std::string("`Wind` or `Velocity` (or vel, U, v)") : "`" + name + "`") +
    " or three numbers such as `" + (name.empty() ? "vel" : name) +
    ".x`, found, with their components, " + list + (name.empty() ? ": name one by `array`" : ""));
}

} // namespace waft
