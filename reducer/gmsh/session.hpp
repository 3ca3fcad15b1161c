// The library gmsh, which is one global state of this process: start and messages.
#pragma once

#include <string>
#include <vector>

namespace tisserand::reducer {

inline constexpr int gmsh_verbosity = 2;  ///< errors and warnings

/// Without ~/.gmshrc; errors and warnings go to standard error, too, where they outlive a crash. It never ends: the
/// process does.
void start_gmsh();

/// The first messages of a kind ("Error", "Warning") since the start, without the kind.
std::vector<std::string> gmsh_messages(const std::string& kind);

/// Throws what gmsh has reported as an error although its functions returned.
void check_gmsh_messages(const std::string& where, const std::string& remedy);

}  // namespace tisserand::reducer
