// SPDX-License-Identifier: BSD-3-Clause
// Images as volumes of OpenVDB files.
#pragma once

#include "Base/Result.h"
#include "Volumes/VolumeFile.h"

class vtkImageData;

namespace waft
{

/// The point data of one or three components; others are left out, and so are ghost arrays. Fails
/// when the image is turned, or has no points or no such array.
Result VolumeFromImage(vtkImageData* data, Volume& volume);

/// The fields as float arrays, the lattice as the image's, from extent 0 on.
void VolumeToImage(const Volume& volume, const SceneInfo& info, vtkImageData* data);

} // namespace waft
