// SPDX-License-Identifier: GPL-3.0-or-later
// Clocks that measure how long things take.
#pragma once

namespace tisserand {

/// Elapsed time since a fixed instant [s]. It never decreases.
double wall_clock();

/// Processor time of this process, summed over all threads [s].
double processor_clock();

}  // namespace tisserand
