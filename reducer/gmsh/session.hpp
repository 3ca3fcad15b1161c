// SPDX-License-Identifier: GPL-3.0-or-later
// The library gmsh, a global state of this process: start and messages.
#pragma once

#include <string>
#include <vector>

namespace tisserand::reducer {

inline constexpr int gmsh_verbosity = 2;  ///< errors and warnings

/// Starts gmsh without ~/.gmshrc. Its errors and warnings also go to standard error, where they survive a crash. gmsh
/// is never stopped; the process ends.
void start_gmsh();

/// First messages of gmsh of one kind ("Error", "Warning") since its start, without the word for the kind.
std::vector<std::string> gmsh_messages(const std::string& kind);

/// Throws Error if gmsh has reported an error although its functions returned.
void check_gmsh_messages(const std::string& where, const std::string& remedy);

}  // namespace tisserand::reducer
