// SPDX-License-Identifier: GPL-3.0-or-later
// Child process that runs gmsh: started with a request, and supervised until it has answered or must end.
#pragma once

#include <string>

#include "reducer/mesher/parcel.hpp"

namespace tisserand::reducer {

/// Reason why the process that runs gmsh has ended.
enum class MesherEnding {
  answered,
  memory,          ///< it reached its limit of memory
  processor_time,  ///< it reached its limit of processor time
  reading_time,    ///< it reached its limit of processor time for reading the file
  wall_time,       ///< it reached its limit of time by the clock
  idle,            ///< it waited for something, such as a pipe in place of a file
  forbidden,       ///< a system call that only malicious files need
  crashed,         ///< a signal ended it
  left             ///< it ended by itself without an answer
};

/// Result of the process that runs gmsh: how it ended, and its answer.
struct MesherReport {
  MesherEnding ending = MesherEnding::left;
  int signal = 0;
  MesherPhase phase = MesherPhase::starting;
  std::string answer;
  std::string last_words;  ///< last line of standard error of the process, printable
};

/// Starts the program that runs gmsh with the request, and waits until it has answered or must end. Its standard input
/// is empty, and its environment has only what the loader needs. Throws Error if it cannot be started.
MesherReport run_mesher(const GeometryRequest& request);

}  // namespace tisserand::reducer
