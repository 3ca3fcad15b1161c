// Loads of a scene on nodes that can bear them.
#pragma once

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// Throws Error for loads on ground and on nodes without the coordinates that they act on.
void add_load(const formats::LoadSpec& spec, Construction& c);

}  // namespace tisserand::mechanism
