// What the command line asks for, between main() and the work.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/exchange/request.hpp"
#include "reducer/recover/request.hpp"
#include "reducer/solve/request.hpp"

namespace tisserand::reducer {

enum class Command { run, solve, show, mesh, view, groups, section, recover, import_matrices, export_matrices };

struct Arguments {
  Command command = Command::run;
  std::string input;
  std::string output;            ///< empty: beside the input
  std::vector<std::string> set;  ///< path=value
  formats::MeshFile::Permission permission;
  SolveRequest solve_request;
  RecoverRequest recover_request;
  exchange::ImportRequest import_request;
  exchange::ExportRequest export_request;
};

/// Returns the exit code; throws Error. Two definitions: commands.cpp does the work (program reducer-solver),
/// launch.cpp hands over to that program (program reducer), so that help and usage errors need not wait for 110 shared
/// libraries.
int perform(const Arguments& arguments, char** argv);

}  // namespace tisserand::reducer
