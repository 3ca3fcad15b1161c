// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of a scene on nodes that have the coordinates for them.
#pragma once

#include "mechanism/build/bodies.hpp"

namespace tisserand::mechanism {

/// Adds a load to the model under construction. Throws Error for a load on ground or on a node without the coordinates
/// on which it acts.
void add_load(const formats::LoadSpec& spec, Construction& c);

}  // namespace tisserand::mechanism
