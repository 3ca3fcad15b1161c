// SPDX-License-Identifier: GPL-3.0-or-later
// Largest stress of a body over a run, which pages show at their colour scale.
#pragma once

#include "formats/page/page_blocks.hpp"
#include "mechanism/view/body_shape.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// Largest equivalent stress (von Mises) over all vertices and shown instants, as JSON {"value", "place", "time"}. Its
/// "place" is the vertex of the undeformed body in the part frame. The result is null if the shape has no stress.
formats::Json largest_stress(const ViewedRun& run, const ViewedBody& body, const BodyShape& shape);

}  // namespace tisserand::mechanism
