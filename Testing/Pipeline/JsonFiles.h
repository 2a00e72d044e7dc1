// SPDX-License-Identifier: BSD-3-Clause
// What pipeline tests ask of JSON files. Headers of VTK 9.3 bring a renamed copy of nlohmann's
// library that does not stand in one unit with the library itself: no header of VTK here, none of
// the library where VTK is.
#pragma once

#include <string>

/// The value at a JSON pointer ("/winds/0"), as compact text.
std::string JsonAt(const std::string& file, const std::string& pointer);

/// Two scene files say the same; the names of files in each are relative to its folder.
void ExpectSameFields(const std::string& authored, const std::string& folder,
                      const std::string& written, const std::string& folderOfWritten);
