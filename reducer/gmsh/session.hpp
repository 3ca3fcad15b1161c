// The library gmsh as one owned session: from initialize to finalize, its messages kept, its exceptions translated.
#pragma once

#include <string>
#include <vector>

#include "common/error.hpp"

namespace tisserand::reducer {

/// gmsh is one global state: this owns it, silent and without ~/.gmshrc. One at a time.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  /// The first messages of a kind ("Error", "Warning") since the session began, without the kind.
  std::vector<std::string> messages(const std::string& kind) const;
};

/// Throws what gmsh has reported as an error although its functions returned.
void check_gmsh_messages(const GmshSession& session, const std::string& where, const std::string& remedy);

/// gmsh throws std::string; the rest of the project throws Error.
template <class Work>
auto with_gmsh(const std::string& where, const std::string& remedy, Work work) {
  try {
    return work();
  } catch (const std::string& text) {
    throw Error("gmsh: " + text, where, remedy);
  }
}

}  // namespace tisserand::reducer
