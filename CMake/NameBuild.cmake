# A name for what was built: cmake "-DFILES=A;B" -DVERSION=V -DOUTPUT=FILE -P NameBuild.cmake writes a header with it, by the
# content of the files, and leaves one that says the same alone.
set(sums)
foreach(file IN LISTS FILES)
  file(SHA256 "${file}" sum)
  string(APPEND sums "${sum}")
endforeach()
string(SHA256 name "${sums}")
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace waft
{

inline constexpr const char* WaftVersion = \"${VERSION}\";
inline constexpr const char* BuildName = \"${name}\"; // another one where Core is another

} // namespace waft
")
