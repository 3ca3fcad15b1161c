// SPDX-License-Identifier: GPL-3.0-or-later
// Largest stress of a body over a run, which pages show at their colour scale.
#pragma once

#include "formats/page/page_blocks.hpp"
#include "mechanism/view/body_shape.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// JSON {"value", "place", "time"}: largest equivalent stress (von Mises) of all vertices and shown instants. "place"
/// is the vertex of the undeformed body in its part frame. null: the shape has no stress.
formats::Json largest_stress(const ViewedRun& run, const ViewedBody& body, const BodyShape& shape);

}  // namespace tisserand::mechanism
