// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneFields.h"

#include <algorithm>
#include <utility>

namespace waft
{

SceneField& SceneField::Required()
{
  this->IsRequired = true;
  return *this;
}

SceneField& SceneField::Or(const char* json)
{
  this->Default = json;
  return *this;
}

SceneField& SceneField::Of(const char* part)
{
  this->Part = part;
  return *this;
}

SceneField& SceneField::Among(std::vector<std::string> words)
{
  this->Words = std::move(words);
  return *this;
}

SceneField& SceneField::Letters(std::size_t most)
{
  this->MostLetters = most;
  return *this;
}

SceneField& SceneField::List(std::size_t most, std::size_t fewest)
{
  this->Count = SceneCount::List;
  this->Most = most;
  this->Fewest = fewest;
  return *this;
}

SceneField& SceneField::OrList(std::size_t most)
{
  this->Count = SceneCount::OneOrList;
  this->Most = most;
  return *this;
}

SceneField& SceneField::Named(std::size_t most)
{
  this->Count = SceneCount::Named;
  this->Most = most;
  return *this;
}

const SceneField* SceneFieldTable::Find(const std::string& field) const
{
  const auto found = std::find_if(this->Fields.begin(), this->Fields.end(),
                                  [&](const SceneField& known) { return known.Name == field; });
  return found == this->Fields.end() ? nullptr : &*found;
}

const SceneFieldTable& SceneFieldsOf(const std::string& name)
{
  static const SceneFieldTable none;
  for (const SceneFieldTable& table : SceneFieldTables())
  {
    if (table.Name == name)
    {
      return table;
    }
  }
  return none;
}

} // namespace waft
