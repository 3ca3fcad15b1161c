// SPDX-License-Identifier: GPL-3.0-or-later
// Surface of a part from its recovery file, deformed by the coordinates of its superelement.
#pragma once

#include <optional>

#include "mechanism/view/body_shape.hpp"

namespace tisserand::mechanism {

/// Shape of a superelement, or of a rigid body made of one, from its recovery file. The file is sought in the options,
/// and in the folders of the superelement and of the results. Absent if there is none. If these folders hold a file of
/// another superelement, a note of the run reports it. The surface is thinned before shapes are read.
std::optional<BodyShape> recovered_shape(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options);

/// Throws Error for a recovery file in the options that belongs to none of the bodies.
void require_used_recovery(const ViewedRun& run, const ShapeOptions& options);

}  // namespace tisserand::mechanism
