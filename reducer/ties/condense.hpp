// SPDX-License-Identifier: GPL-3.0-or-later
// S and M of the independent coordinates: Tᵀ S T and Tᵀ M T.
#pragma once

#include "reducer/algebra/symmetric_pair.hpp"
#include "reducer/ties/elimination.hpp"

namespace tisserand::reducer {

/// Matrices Tᵀ S T and Tᵀ M T of the independent coordinates. `full`: S and M of the first coordinates x of T; later
/// (auxiliary) ones have neither stiffness nor mass. Rows without ties are copied. The result is equal for any number
/// of threads.
SymmetricPair condense(SymmetricPair full, const Transformation& T, int threads);

}  // namespace tisserand::reducer
