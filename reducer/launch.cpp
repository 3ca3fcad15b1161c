// SPDX-License-Identifier: GPL-3.0-or-later
// Fast front program: sets the environment that the solver's libraries read while they are loaded, then replaces itself
// by the solver.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "common/error.hpp"
#include "reducer/commands.hpp"
#include "reducer/startup.hpp"

namespace tisserand::reducer {
namespace {

/// Path of the solver: next to this program in a build tree, otherwise in the installed place relative to it, so that a
/// prefix may be moved.
std::string solver_path() {
  const std::string folder = program_folder();
  const std::string built = folder + "reducer-solver";
  return access(built.c_str(), X_OK) == 0 ? built : folder + TISSERAND_SOLVER_INSTALLED;
}

}  // namespace

int perform(const Arguments&, char** argv) {
  prepare_environment();
  const std::string solver = solver_path();
  execv(solver.c_str(), argv);
  throw Error(std::string("cannot start the solver: ") + std::strerror(errno), solver,
              "keep reducer-solver in the folder of reducer, or install both programs again");
}

}  // namespace tisserand::reducer
