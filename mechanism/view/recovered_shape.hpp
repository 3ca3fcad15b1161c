// The surface of a part from its recovery file, deformed by the coordinates of its superelement.
#pragma once

#include <optional>

#include "mechanism/view/body_shape.hpp"

namespace tisserand::mechanism {

/// Of a superelement, or of a rigid body made of one. Nothing where no recovery file is found: named in the options, or
/// beside the superelement or the results. A file beside them that belongs to another superelement is told in a note of
/// the run. Thinned before shapes are read.
std::optional<BodyShape> recovered_shape(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options);

/// Throws Error for a file of the options that belongs to none of the bodies.
void require_used_recovery(const ViewedRun& run, const ShapeOptions& options);

}  // namespace tisserand::mechanism
