// What a program does where memory ends.
#pragma once

#include <cstddef>

namespace tisserand {

/// Keeps 8 MB back, which the first failed allocation of C++ code sets free, so that the error finds memory for its
/// message and files are closed. A crash of a library that got no memory, or a stack that cannot grow, is reported as
/// such: "mechanism: out of memory", exit status 1, no temporary files. Other crashes are as before.
/// `program` must stay.
void report_short_memory(const char* program);

/// Throws std::bad_alloc if `bytes` of addresses cannot be had, not even with that reserve: before a library begins that
/// ends the program, or crashes, where it gets no memory.
void require_addresses(std::size_t bytes);

/// Whether the process may have 64 MB more of addresses.
bool is_memory_left();

}  // namespace tisserand
