// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneFormat.h"

#include "Base/Characters.h"

namespace waft
{

SceneJson FormatVector(const Vec3& v)
{
  return SceneJson::array({ v.x(), v.y(), v.z() });
}

SceneJson FormatLeaving(const Leaving& leaving)
{
  SceneJson json = { { "frame", leaving.From } };
  if (!leaving.Away.isZero())
  {
    json["direction"] = FormatVector(leaving.Away);
  }
  if (leaving.HasPlace != 0)
  {
    json["place"] = FormatVector(leaving.Place);
  }
  if (leaving.Fade > 0)
  {
    json["fade"] = leaving.Fade;
  }
  return json;
}

SceneJson FormatRotation(const Quat& q)
{
  return SceneJson::array({ q.w(), q.x(), q.y(), q.z() });
}

void RequireName(const std::string& name, const std::string& owner)
{
  const std::string control = FirstControl(name);
  if (!control.empty())
  {
    throw SceneError{ owner + ": expected a name without control characters and marks that turn " +
                      "the direction of writing, found " + control };
  }
}

bool IsReadable(const std::function<void()>& read)
{
  try
  {
    read();
    return true;
  }
  catch (const SceneError&)
  {
    return false;
  }
}

} // namespace waft
