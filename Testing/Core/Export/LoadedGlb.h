// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <tiny_gltf.h>

namespace waft
{

/// The model of a .glb, which has nothing to warn of.
inline void LoadGlb(const std::string& bytes, tinygltf::Model& model)
{
  tinygltf::TinyGLTF reader;
  std::string error, warning;
  ASSERT_TRUE(reader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<unsigned int>(bytes.size())))
    << error;
  EXPECT_TRUE(warning.empty()) << warning;
}

} // namespace waft
