// Clocks that measure how long things take.
#pragma once

namespace tisserand {

/// Seconds since some instant, never set back.
double wall_clock();

/// Seconds of the processor that this process has used, all threads together.
double processor_clock();

}  // namespace tisserand
