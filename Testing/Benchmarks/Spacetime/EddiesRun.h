// SPDX-License-Identifier: BSD-3-Clause
// How long the gas keeps its eddies: shear waves and Taylor and Green's vortices.
#pragma once

namespace waft
{

/// Prints a row a wave length: viscosity by a shear wave; how long Taylor and Green's vortices keep
/// half their energy in gas alone with that artificial viscosity, and the share of it that is left
/// after three and eight seconds there and in a sampled air of these vortices. Returns a process'
/// exit status.
int RunEddies(double viscosity);

} // namespace waft
