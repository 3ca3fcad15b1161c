// Last step of read_abaqus(): retained coordinates become the boundary; supports are refused.
#pragma once

#include "reducer/decks/abaqus/model.hpp"

namespace tisserand::reducer::abaqus {

/// *RETAINED NODAL DOFS -> Mesh::boundary; *BOUNDARY of the model and of steps: a fault unless the components have
/// neither stiffness nor mass, then a warning. Other keywords of steps: one warning that lists them.
void read_boundary(Model& model);

}  // namespace tisserand::reducer::abaqus
