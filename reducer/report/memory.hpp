// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of a reduction, reported and compared with the available memory before most of it is allocated.
#pragma once

#include <string>

#include "formats/part/part.hpp"
#include "reducer/algebra/factor.hpp"
#include "reducer/report/phase_listener.hpp"
#include "reducer/system/partition.hpp"

namespace tisserand::reducer {

/// Memory that factorisation and modes need in addition to the matrices [bytes]. It is that of the factor, and the
/// larger of two needs: a permuted copy of S_II during the factorisation, or the vectors after it. The vectors are the
/// boundary modes, the basis of the iteration for `modes` modes, blocks of solutions, and four times `ritz_vectors`.
/// `stored_entries`: number of stored entries of S_II.
double memory_need(const FactorCost& cost, double stored_entries, const Partition& p, int modes, int ritz_vectors);

/// Memory that the program may still allocate [bytes], by the machine, its control group and its limits.
double available_memory();

/// Throws Error if `need` exceeds `available` [bytes].
void require_memory(double need, double available, const Partition& p, const std::string& where);

/// Throws Error if the vectors of a search for `modes` modes do not fit into the memory beside the factor. For a
/// cut-off or an accuracy the number of modes is not known earlier.
void require_memory_of_modes(int modes, const Partition& p, const std::string& where);

/// Factors S_II after a check of the memory. It begins the phase "factorisation (1.2 GB, about 12 s)", whose name has
/// the memory and, from 2 s on, the time. A need of half a gigabyte or more is reported at once. The factor is empty
/// for a part without interior coordinates.
Factor factor_inside(const Blocks& blocks, const Partition& p, const formats::Part& part, const PhaseListener& begin);

}  // namespace tisserand::reducer
