// Which entries of the local matrices of rigid bodies and joints are zero in every state, so that the iteration matrix
// does not store them.
#pragma once

#include <vector>

#include "mechanism/joints/joint.hpp"

namespace tisserand::mechanism {

/// One flag per entry of a local matrix, column by column; empty: all entries may be nonzero.
using EntryFlags = std::vector<bool>;

/// 6 x 6 of a rigid body: masses on the diagonal, full inertia.
EntryFlags rigid_entries();

/// 12 x 12 of a joint's geometric stiffness, [x_A Θ_A x_B Θ_B].
EntryFlags stiffness_entries(const Joint& joint);

/// size() x 12 of its B, also turned by T(dΘ) or with its rate gradient added.
EntryFlags gradient_entries(const Joint& joint);

}  // namespace tisserand::mechanism
