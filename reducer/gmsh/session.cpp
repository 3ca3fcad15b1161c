// Start, messages and end of gmsh.
#include "reducer/gmsh/session.hpp"

#include <gmsh.h>

#include "common/text.hpp"

namespace tisserand::reducer {

GmshSession::GmshSession() {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.Binary", 0);
  gmsh::logger::start();
}

GmshSession::~GmshSession() {
  gmsh::logger::stop();
  gmsh::finalize();
}

std::vector<std::string> GmshSession::messages(const std::string& kind) const {
  std::vector<std::string> log, result;
  gmsh::logger::get(log);
  constexpr std::size_t most = 5;
  for (const std::string& line : log)
    if (line.starts_with(kind + ": ") && result.size() < most) result.push_back(line.substr(kind.size() + 2));
  return result;
}

void check_gmsh_messages(const GmshSession& session, const std::string& where, const std::string& remedy) {
  const std::vector<std::string> errors = session.messages("Error");
  if (!errors.empty()) throw Error("gmsh: " + join(errors, "; "), where, remedy);
}

}  // namespace tisserand::reducer
