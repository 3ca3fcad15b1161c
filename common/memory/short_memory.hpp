// SPDX-License-Identifier: GPL-3.0-or-later
// Behaviour of a program that runs out of memory.
#pragma once

#include <cstddef>

namespace tisserand {

/// Keeps a reserve of 8 MB, which the first failed C++ allocation frees, so that the error can be printed and files
/// closed. If memory is short, a crash is reported as "mechanism: out of memory" with exit status 1, and temporary
/// files are removed. Other crashes are unchanged. `program`: name in the report; requires that it stays valid.
void report_short_memory(const char* program);

/// Throws std::bad_alloc if `bytes` of address space are not available even with the reserve of report_short_memory().
/// Call it before a library starts that ends the program, or crashes, when it gets no memory.
void require_addresses(std::size_t bytes);

/// Whether 64 MB more of address space are available to the process.
bool is_memory_left();

}  // namespace tisserand
