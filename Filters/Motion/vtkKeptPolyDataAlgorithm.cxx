// SPDX-License-Identifier: BSD-3-Clause
#include "vtkKeptPolyDataAlgorithm.h"

vtkKeptPolyDataAlgorithm::~vtkKeptPolyDataAlgorithm() = default;
