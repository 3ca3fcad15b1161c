// S and M of the independent coordinates: Tᵀ S T and Tᵀ M T.
#pragma once

#include "reducer/algebra/symmetric_pair.hpp"
#include "reducer/ties/elimination.hpp"

namespace tisserand::reducer {

/// `full` has rows for the first coordinates x of T; later (auxiliary) ones have neither stiffness nor mass. Rows that
/// no tie touches are copied. Same result for any number of threads.
SymmetricPair condense(SymmetricPair full, const Transformation& T, int threads);

}  // namespace tisserand::reducer
