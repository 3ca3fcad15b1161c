// What this process may still do once it reads a stranger's file: limits, no paths but the file's, no calls but those
// that computing needs.
#pragma once

#include <string>

namespace tisserand::reducer {

/// Limits of processor time [s] and memory [bytes], no core files, the end together with the parent. An allocation
/// beyond the limit ends this process with out_of_memory_code. Sanitizers reserve terabytes:
/// in a build with them memory is not limited.
void set_limits(double seconds, double bytes);

/// Landlock: from here on only `file` can be read, or all in its folder and below. False if the kernel has no Landlock,
/// or another thread runs already, which it would not hold.
[[nodiscard]] bool close_paths(const std::string& file, bool whole_folder);

/// seccomp: reading and computing go on, and writing to what is open. Starting programs, making, renaming and removing
/// files end this process (SIGSYS). All else, also opening a file for writing and sockets: ENOSYS. False if the
/// kernel has no seccomp.
[[nodiscard]] bool close_calls();

}  // namespace tisserand::reducer
