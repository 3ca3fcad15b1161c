// SPDX-License-Identifier: GPL-3.0-or-later
// The library gmsh, a global state of this process: start and messages.
#pragma once

#include <string>
#include <vector>

namespace tisserand::reducer {

inline constexpr int gmsh_verbosity = 2;  ///< errors and warnings

/// Starts gmsh without ~/.gmshrc. Errors and warnings also go to standard error, where they survive a crash. gmsh is
/// never stopped, the process ends.
void start_gmsh();

/// The first messages of a kind ("Error", "Warning") since the start, without the kind.
std::vector<std::string> gmsh_messages(const std::string& kind);

/// Throws Error if gmsh has reported an error although its functions returned.
void check_gmsh_messages(const std::string& where, const std::string& remedy);

}  // namespace tisserand::reducer
