// Ctrl-C of programs that have nothing to finish: no file is left half-written, and a line says so.
#pragma once

#include <string>

namespace tisserand {

/// Ends this program on Ctrl-C, `kill` or a closed terminal, whatever its threads are doing: files under temporary
/// names are removed, files that are taking their names do so first, one line says what became of them, and the exit
/// status is 130. `program`: begins the line; empty: says nothing. A signal that the caller ignores stays ignored. Call
/// it once.
void end_on_interrupt(const std::string& program);

}  // namespace tisserand
