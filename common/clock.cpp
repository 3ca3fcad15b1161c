// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the steady clock of the library and the processor time of the system.
#include "common/clock.hpp"

#include <chrono>
#include <ctime>

namespace tisserand {

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double processor_clock() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace tisserand
