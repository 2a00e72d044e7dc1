// SPDX-License-Identifier: BSD-3-Clause
// What sources are called in the window's pipeline.
#pragma once

class pqPipelineSource;

namespace waft
{

/// A finished flight is called as the scene that its report names, or as its folder: each report
/// has the same name.
void NameByScene(pqPipelineSource* source);

} // namespace waft
