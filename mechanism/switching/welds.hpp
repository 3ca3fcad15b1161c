// Pieces of one part: bodies that deform and are welded together.
#pragma once

#include <vector>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Number of the part that each body that deforms (deformation.hpp) is a piece of: welded_beams(), and fixed joints
/// with modal bodies.
std::vector<int> welded_parts(const Model& model);

}  // namespace tisserand::mechanism
