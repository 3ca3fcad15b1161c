// SPDX-License-Identifier: GPL-3.0-or-later
// Start and messages of gmsh.
#include "reducer/gmsh/session.hpp"

#include <gmsh.h>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::reducer {

void start_gmsh() {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 1);
  gmsh::option::setNumber("General.Verbosity", gmsh_verbosity);
  gmsh::logger::start();
}

std::vector<std::string> gmsh_messages(const std::string& kind) {
  std::vector<std::string> log, result;
  gmsh::logger::get(log);
  constexpr std::size_t most = 5;
  for (const std::string& line : log)
    if (line.starts_with(kind + ": ") && result.size() < most) result.push_back(line.substr(kind.size() + 2));
  return result;
}

void check_gmsh_messages(const std::string& where, const std::string& remedy) {
  const std::vector<std::string> errors = gmsh_messages("Error");
  if (!errors.empty()) throw Error("gmsh: " + join(errors, "; "), where, remedy);
}

}  // namespace tisserand::reducer
