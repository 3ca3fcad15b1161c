// The quick front: sets the environment that the libraries of the solver read while they are loaded, then becomes the
// solver.
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <string>

#include "common/error.hpp"
#include "reducer/commands.hpp"
#include "reducer/startup.hpp"

namespace tisserand::reducer {
namespace {

/// The folder of this program, with / at its end.
std::string own_folder() {
  std::array<char, PATH_MAX> buffer{};
  const ssize_t length = readlink("/proc/self/exe", buffer.data(), buffer.size() - 1);
  const std::string self(buffer.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
  return self.substr(0, self.rfind('/') + 1);
}

/// Beside this program, as built; else where it is installed, relative to this program: a prefix may be moved as a
/// whole.
std::string solver_path() {
  const std::string folder = own_folder();
  const std::string built = folder + "reducer-solver";
  return access(built.c_str(), X_OK) == 0 ? built : folder + TISSERAND_SOLVER_INSTALLED;
}

}  // namespace

int perform(const Arguments&, char** argv) {
  prepare_environment();
  const std::string solver = solver_path();
  execv(solver.c_str(), argv);
  throw Error(std::string("cannot start the solver: ") + std::strerror(errno), solver,
              "keep reducer-solver in the folder of reducer, or install anew");
}

}  // namespace tisserand::reducer
