// SPDX-License-Identifier: GPL-3.0-or-later
// Surface of a part from its recovery file, deformed by the coordinates of its superelement.
#pragma once

#include <optional>

#include "mechanism/view/body_shape.hpp"

namespace tisserand::mechanism {

/// Shape of a superelement, or of a rigid body made of one. Absent if no recovery file is found: in the options, or in
/// the folder of the superelement or the results. A note of the run reports a file of another superelement in these
/// folders. The surface is thinned before shapes are read.
std::optional<BodyShape> recovered_shape(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options);

/// Throws Error for a file of the options that belongs to none of the bodies.
void require_used_recovery(const ViewedRun& run, const ShapeOptions& options);

}  // namespace tisserand::mechanism
