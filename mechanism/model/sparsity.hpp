// SPDX-License-Identifier: GPL-3.0-or-later
// Entries of the local matrices of rigid bodies and joints that are zero in every state. The iteration matrix does not
// store them.
#pragma once

#include <vector>

#include "mechanism/joints/joint.hpp"

namespace tisserand::mechanism {

/// Flags of a local matrix, one per entry, column by column: whether the entry can be nonzero. Empty: all can.
using EntryFlags = std::vector<bool>;

/// Flags of the matrix of a rigid body (6 x 6): masses on the diagonal, full inertia.
EntryFlags rigid_entries();

/// Flags of the geometric stiffness of a joint (12 x 12), columns [x_A Θ_A x_B Θ_B].
EntryFlags stiffness_entries(const Joint& joint);

/// Flags of the Jacobian B of a joint (size() x 12). They also hold for B T(θ), T of THEORY (3), and for B plus the
/// derivative of its rates.
EntryFlags gradient_entries(const Joint& joint);

}  // namespace tisserand::mechanism
