// SPDX-License-Identifier: GPL-3.0-or-later
// Sandbox of this process for untrusted files: limits, no paths except the file's, and no system calls except those
// that computing needs.
#pragma once

#include <string>

namespace tisserand::reducer {

/// Sets limits of this process: processor time [s], memory [bytes], no core files, and its end together with the
/// parent. An allocation beyond the limit ends the process with out_of_memory_code. Sanitizers reserve terabytes, so a
/// build with them has no limit of memory.
void set_limits(double seconds, double bytes);

/// Restricts the files that this process can read, by Landlock. From here on these are only `file`, or everything in
/// its folder and below if `whole_folder`. Returns false if the kernel has no Landlock, or if another thread already
/// runs, which Landlock would not restrict.
[[nodiscard]] bool close_paths(const std::string& file, bool whole_folder);

/// Restricts the system calls of this process, by seccomp. Reading, computing and writing to open files continue.
/// Starting programs, and making, renaming and removing files, end the process (SIGSYS). All other calls, such as
/// opening a file for writing and sockets, fail with ENOSYS. Returns false if the kernel has no seccomp.
[[nodiscard]] bool close_calls();

}  // namespace tisserand::reducer
