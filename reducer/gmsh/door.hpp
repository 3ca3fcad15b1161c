// SPDX-License-Identifier: GPL-3.0-or-later
// Sandbox of this process for untrusted files: limits, no paths except the file's, and no system calls except those
// that computing needs.
#pragma once

#include <string>

namespace tisserand::reducer {

/// Sets limits of processor time [s] and memory [bytes], no core files, and the end together with the parent. An
/// allocation beyond the limit ends this process with out_of_memory_code. Sanitizers reserve terabytes, so a build with
/// them has no limit of memory.
void set_limits(double seconds, double bytes);

/// Landlock: from here on only `file` can be read, or everything in its folder and below. False if the kernel has no
/// Landlock, or if another thread already runs, which it would not restrict.
[[nodiscard]] bool close_paths(const std::string& file, bool whole_folder);

/// seccomp: reading, computing and writing to open files continue. Starting programs, and making, renaming and removing
/// files, end this process (SIGSYS). All other calls, such as opening a file for writing and sockets, fail with ENOSYS.
/// False if the kernel has no seccomp.
[[nodiscard]] bool close_calls();

}  // namespace tisserand::reducer
