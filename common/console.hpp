// SPDX-License-Identifier: GPL-3.0-or-later
// Standard output that may be closed or full, messages on the terminal, and messages about unknown words.
#pragma once

#include <string>
#include <vector>

namespace tisserand {

/// Makes writes fail with an error instead of ending the program by a signal, if the reader has left (`| head -1`) or a
/// file grows too large.
void take_write_failures_as_errors();

/// Opens /dev/null for closed standard streams (`program <&- >&- 2>&-`). Otherwise the next opened files would get the
/// numbers of these streams, and output for the terminal would go into the files.
void fill_standard_streams();

/// Writes `text` as printable() returns it to standard output and flushes. A reader that has left is no error. Throws
/// Error if the disk is full.
void say(const std::string& text);
/// Writes a message about the output `path` to standard output, or to the error stream if the output itself goes
/// to standard output.
void say_of(const std::string& path, const std::string& text);
/// Writes "program: text" to the error stream, with control characters replaced by printable().
void complain(const std::string& program, const std::string& text);

/// Message for an unknown command `word`, with the nearest of `commands`, or all of them if none is near.
std::string unknown_command(const std::string& word, const std::vector<std::string>& commands);
/// Message about unknown options ("... not expected: --setx"), completed with the nearest of `options` for each of
/// them.
std::string with_nearest_options(const std::string& message, const std::vector<std::string>& options);

/// Writes the text of the current exception as complain() does, and removes incomplete files. Requires a call in the
/// last catch clause of a program. A message about short memory needs no memory.
void complain_of_exception(const char* program) noexcept;

}  // namespace tisserand
