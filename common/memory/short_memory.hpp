// What a program does where memory ends.
#pragma once

namespace tisserand {

/// Keeps 8 MB back, which the first failed allocation of C++ code sets free, so that the error finds memory for its
/// message and files are closed. A crash of a library that got no memory, or a stack that cannot grow, is reported as
/// such: "mechanism: out of memory", exit status 1, no temporary files. Other crashes are as before.
/// `program` must stay.
void report_short_memory(const char* program);

/// Whether the process may have 64 MB more of addresses.
bool is_memory_left();

}  // namespace tisserand
