// Between the programs and the terminal: standard output that may be closed or full, and words that are no commands.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tisserand {

/// A reader that leaves early (`| head -1`) and files over a limit of size then fail as writes, not as signals.
void take_write_failures_as_errors();

/// Opens /dev/null in the place of closed standard streams (`program <&- >&- 2>&-`), before any file takes their
/// numbers and with them what is meant for the terminal.
void fill_standard_streams();

/// Writes to standard output and flushes, printable(). A reader that has left is no error; a full disk throws Error.
void say(const std::string& text);
/// The same about the output `path`: on the error stream where the output itself is a stream.
void say_of(const std::string& path, const std::string& text);
/// "mechanism: text" on the error stream, printable().
void complain(const std::string& program, const std::string& text);

/// The message for `word` in the place of a command, with the nearest one or the list of all.
std::string unknown_command(const std::string& word, const std::vector<std::string>& commands);

/// The message for the first of the `words` that begins with "--" and is none of the options ("--set"), with the nearest
/// one or the list of all; nothing: all are.
std::optional<std::string> unknown_option(const std::vector<std::string>& words, const std::vector<std::string>& options);

}  // namespace tisserand
