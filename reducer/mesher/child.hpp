// The program that runs gmsh, as a child process: started with a request, watched until it has answered or must end.
#pragma once

#include <string>

#include "reducer/mesher/parcel.hpp"

namespace tisserand::reducer {

/// How the child ended.
enum class MesherEnding {
  answered,
  memory,          ///< its limit of memory
  processor_time,  ///< its limit of processor time
  reading_time,    ///< its limit of processor time for reading the file
  wall_time,       ///< its limit by the clock
  idle,            ///< it waited for something: a pipe in place of a file, say
  forbidden,       ///< a call of the system that only harm needs
  crashed,         ///< by a signal
  left             ///< ended by itself without an answer
};

struct MesherReport {
  MesherEnding ending = MesherEnding::left;
  int signal = 0;
  MesherPhase phase = MesherPhase::starting;
  std::string answer;
  std::string last_words;  ///< of its standard error, printable
};

/// Starts the program with nothing but the request, and waits. Its standard input is empty, its environment holds what
/// the loader needs. Throws Error if it cannot be started.
MesherReport run_mesher(const GeometryRequest& request);

}  // namespace tisserand::reducer
