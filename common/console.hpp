// SPDX-License-Identifier: GPL-3.0-or-later
// Standard output that may be closed or full, messages on the terminal, and messages about unknown words.
#pragma once

#include <string>
#include <vector>

namespace tisserand {

/// Makes writes fail with an error instead of a signal if the reader has left (`| head -1`) or a file grows too large.
void take_write_failures_as_errors();

/// Opens /dev/null for closed standard streams (`program <&- >&- 2>&-`). Otherwise the next opened file would get
/// their numbers, and output for the terminal would go into it.
void fill_standard_streams();

/// Writes to standard output and flushes, printable(). A reader that has left is no error. A full disk throws Error.
void say(const std::string& text);
/// Writes a message about the output `path`. It goes to the error stream if the output itself is a stream.
void say_of(const std::string& path, const std::string& text);
/// Writes "program: text" to the error stream, printable().
void complain(const std::string& program, const std::string& text);

/// Message for an unknown command `word`, with the nearest command or the list of all.
std::string unknown_command(const std::string& word, const std::vector<std::string>& commands);
/// The message about options ("... not expected: --setx"), with the nearest of `options` for each unknown one.
std::string with_nearest_options(const std::string& message, const std::vector<std::string>& options);

/// Writes the text of the current exception as complain() does and removes incomplete files. Call it in the last catch
/// clause of a program. A message about short memory needs no memory.
void complain_of_exception(const char* program) noexcept;

}  // namespace tisserand
