// SPDX-License-Identifier: GPL-3.0-or-later
// Clean end of a program on Ctrl-C: no file is left incomplete, and a line reports it.
#pragma once

#include <string>

namespace tisserand {

/// Ends this program with status 130 on Ctrl-C, `kill` or a closed terminal, whatever its threads do. Incomplete files
/// are removed, and files that are being renamed are completed first. One line reports the result. `program` begins
/// this line; if it is empty, there is no line. A signal that the caller ignores stays ignored. Call it once.
void end_on_interrupt(const std::string& program);

}  // namespace tisserand
