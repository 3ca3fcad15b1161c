// SPDX-License-Identifier: GPL-3.0-or-later
// Child process that runs gmsh: started with a request, and supervised until it has answered or must end.
#pragma once

#include <string>

#include "reducer/mesher/parcel.hpp"

namespace tisserand::reducer {

/// Reason for the end of the child.
enum class MesherEnding {
  answered,
  memory,          ///< its limit of memory
  processor_time,  ///< its limit of processor time
  reading_time,    ///< its limit of processor time for reading the file
  wall_time,       ///< its limit by the clock
  idle,            ///< it waited for something, such as a pipe in place of a file
  forbidden,       ///< a system call that only malicious files need
  crashed,         ///< by a signal
  left             ///< ended by itself without an answer
};

struct MesherReport {
  MesherEnding ending = MesherEnding::left;
  int signal = 0;
  MesherPhase phase = MesherPhase::starting;
  std::string answer;
  std::string last_words;  ///< last line of its standard error, printable
};

/// Starts the program with only the request, and waits. Its standard input is empty, its environment has what the
/// loader needs. Throws Error if it cannot be started.
MesherReport run_mesher(const GeometryRequest& request);

}  // namespace tisserand::reducer
