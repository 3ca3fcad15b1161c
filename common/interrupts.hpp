// SPDX-License-Identifier: GPL-3.0-or-later
// Clean end of a program on Ctrl-C: no file is left incomplete, and a line reports it.
#pragma once

#include <string>

namespace tisserand {

/// Makes this program end with status 130 on Ctrl-C, `kill` or a closed terminal, whatever its threads do. Then
/// incomplete files are removed, renames in progress are completed first, and one line reports the result. `program`:
/// begins this line; if empty, there is no line. A signal that the caller ignores stays ignored. Requires that it is
/// called once.
void end_on_interrupt(const std::string& program);

}  // namespace tisserand
