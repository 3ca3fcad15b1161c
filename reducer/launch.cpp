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

/// reducer-solver in the folder of this program.
std::string solver_path() {
  std::array<char, PATH_MAX> buffer{};
  const ssize_t length = readlink("/proc/self/exe", buffer.data(), buffer.size() - 1);
  const std::string self(buffer.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
  return self.substr(0, self.rfind('/') + 1) + "reducer-solver";
}

}  // namespace

int perform(const Arguments&, char** argv) {
  prepare_environment();
  const std::string solver = solver_path();
  execv(solver.c_str(), argv);
  throw Error(std::string("cannot start the solver: ") + std::strerror(errno), solver,
              "keep reducer-solver in the folder of reducer");
}

}  // namespace tisserand::reducer
