// SPDX-License-Identifier: GPL-3.0-or-later
// Memory of a reduction, reported and compared with the available memory before most of it is allocated.
#pragma once

#include <string>

#include "formats/part/part.hpp"
#include "reducer/algebra/factor.hpp"
#include "reducer/report/phase_listener.hpp"
#include "reducer/system/partition.hpp"

namespace tisserand::reducer {

/// Bytes of factorisation and modes in addition to the matrices: the factor, and a permuted copy of S_II while it is
/// made, later boundary modes, the basis of the iteration for `modes` modes, blocks of solutions, and `ritz_vectors`
/// four times.
double memory_need(const FactorCost& cost, double stored_entries, const Partition& p, int modes, int ritz_vectors);

/// Bytes that a program may still allocate, by the machine, its control group and its limits.
double available_memory();

/// Throws Error if `need` exceeds `available` bytes.
void require_memory(double need, double available, const Partition& p, const std::string& where);

/// Throws Error if the vectors of a search for `modes` modes do not fit next to the factor. The number of modes for a
/// cut-off or an accuracy is not known earlier.
void require_memory_of_modes(int modes, const Partition& p, const std::string& where);

/// Factors S_II after a check of the memory. Begins the phase "factorisation (1.2 GB, about 12 s)", whose name has the
/// memory and, from 2 s on, the time. Half a gigabyte or more is reported at once. For a part without inside: an empty
/// factor.
Factor factor_inside(const Blocks& blocks, const Partition& p, const formats::Part& part, const PhaseListener& begin);

}  // namespace tisserand::reducer
