// Memory of a reduction, told and compared with what there is before the large part of it is taken.
#pragma once

#include <string>

#include "formats/part/part.hpp"
#include "reducer/algebra/factor.hpp"
#include "reducer/report/phase_listener.hpp"
#include "reducer/system/partition.hpp"

namespace tisserand::reducer {

/// Bytes that factorisation and modes take beyond the matrices: the factor, one permuted copy of S_II while it is made,
/// then boundary modes, the basis of the iteration for `modes` modes, blocks of solutions, and `ritz_vectors` four
/// times.
double memory_need(const FactorCost& cost, double stored_entries, const Partition& p, int modes, int ritz_vectors);

/// Bytes that a program may still take: of the machine, of its control group, of its limits.
double available_memory();

/// Throws Error if `need` exceeds `available` bytes.
void require_memory(double need, double available, const Partition& p, const std::string& where);

/// Throws Error if the vectors of a search for so many modes do not fit, now that the factor is there: how many a
/// cut-off or an accuracy takes is known late.
void require_memory_of_modes(int modes, const Partition& p, const std::string& where);

/// Factors S_II after its memory has been found to suffice; begins the phase "factorisation (1.2 GB, about 12 s)",
/// which tells the need, and the time where it is seconds. Half a gigabyte and more is told at once. Of a part without
/// inside: an empty factor.
Factor factor_inside(const Blocks& blocks, const Partition& p, const formats::Part& part, const PhaseListener& begin);

}  // namespace tisserand::reducer
