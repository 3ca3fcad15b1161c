// SPDX-License-Identifier: GPL-3.0-or-later
// Last step of read_abaqus(): retained coordinates become the boundary, and supports are refused.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// Makes the coordinates of *RETAINED NODAL DOFS the boundary of the mesh. Adds a fault for *BOUNDARY of the model and
/// of steps, or a warning if the components have neither stiffness nor mass. Adds one warning that lists the other
/// keywords of steps.
void read_boundary(Model& model);

}  // namespace tisserand::reducer::abaqus
