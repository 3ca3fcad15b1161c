// SPDX-License-Identifier: GPL-3.0-or-later
// Last step of read_abaqus(): retained coordinates become the boundary, and supports are refused.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// *RETAINED NODAL DOFS becomes Mesh::boundary. *BOUNDARY of the model and of steps is a fault, or a warning if the
/// components have neither stiffness nor mass. One warning lists the other keywords of steps.
void read_boundary(Model& model);

}  // namespace tisserand::reducer::abaqus
