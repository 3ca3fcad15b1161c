// What the command line asks for, between main() and the work.
#pragma once

#include <string>
#include <vector>

namespace tisserand::reducer {

enum class Command { run, show, mesh };

struct Arguments {
  Command command = Command::run;
  std::string input;
  std::string output;            ///< empty: beside the input
  std::vector<std::string> set;  ///< path=value
};

/// Returns the exit code; throws Error. Two definitions: commands.cpp does the work (program reducer-solver),
/// launch.cpp hands over to that program (program reducer), so that help and usage errors need not wait for 180 shared
/// libraries.
int perform(const Arguments& arguments, char** argv);

}  // namespace tisserand::reducer
