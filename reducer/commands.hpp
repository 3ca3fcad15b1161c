// SPDX-License-Identifier: GPL-3.0-or-later
// Arguments of the command line, passed from main() to the commands.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/exchange/request.hpp"
#include "reducer/recover/request.hpp"
#include "reducer/solve/request.hpp"

namespace tisserand::reducer {

enum class Command { run, solve, show, mesh, view, groups, section, recover, import_matrices, export_matrices };

/// Arguments of a command line of `reducer`.
struct Arguments {
  Command command = Command::run;
  std::string input;
  std::string output;            ///< empty: next to the input
  std::vector<std::string> set;  ///< path=value
  formats::MeshFile::Permission permission;
  SolveRequest solve_request;
  RecoverRequest recover_request;
  exchange::ImportRequest import_request;
  exchange::ExportRequest export_request;
};

/// Runs a command and returns the exit code. Throws Error. The function has two definitions. The one in commands.cpp
/// does the work (program reducer-solver). The one in launch.cpp starts that program (program reducer). So help and
/// usage errors need not load 110 shared libraries.
int perform(const Arguments& arguments, char** argv);

}  // namespace tisserand::reducer
