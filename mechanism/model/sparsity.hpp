// SPDX-License-Identifier: GPL-3.0-or-later
// Entries of the local matrices of rigid bodies and joints that are zero in every state. The iteration matrix does not
// store them.
#pragma once

#include <vector>

#include "mechanism/joints/joint.hpp"

namespace tisserand::mechanism {

/// One flag per entry of a local matrix, column by column; empty: all entries may be nonzero.
using EntryFlags = std::vector<bool>;

/// Flags of the 6 x 6 matrix of a rigid body: masses on the diagonal, full inertia.
EntryFlags rigid_entries();

/// Flags of the 12 x 12 geometric stiffness of a joint, [x_A Θ_A x_B Θ_B].
EntryFlags stiffness_entries(const Joint& joint);

/// Flags of B (size() x 12) of a joint. They hold also for B T(dΘ) and for B plus its rate gradient.
EntryFlags gradient_entries(const Joint& joint);

}  // namespace tisserand::mechanism
