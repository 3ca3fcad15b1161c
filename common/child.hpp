// Another program as a child process: started without a shell, watched, ended in time; what it wrote and what it cost.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace tisserand {

struct ChildRequest {
  std::vector<std::string> words;    ///< program (a path, or a name on the PATH) and its arguments
  std::string input;                 ///< its standard input
  std::size_t most_text = 1 << 16;   ///< of what it says, in bytes
  double seconds = 0.0;              ///< by the clock; 0: as long as it takes
  std::function<bool()> is_stopped;  ///< asked ten times a second; true ends the child. Empty: never
  /// Called once, while the child runs, with a socket whose other end are the child's descriptors 3 (it reads) and 4
  /// (it writes); the socket is closed when it returns, and only then time is counted. What it throws ends the child at
  /// once. Empty: the child has no such descriptors.
  std::function<void(int socket)> talk;
};

enum class ChildEnding { left, killed, timed_out, stopped };

struct ChildReport {
  ChildEnding ending = ChildEnding::left;
  int code = 0;              ///< exit code (left) or number of the signal (killed)
  std::string text;          ///< the first most_text bytes of its standard output
  std::string complaint;     ///< the first 64 KiB of its standard error
  double cpu_seconds = 0.0;  ///< user and system, with those of its own children
};

/// Runs the program to its end; a child that must end gets SIGTERM, after five seconds SIGKILL. It does not outlive
/// this program. Throws Error if it cannot be started.
ChildReport run_child(const ChildRequest& request);

/// Whether `program` can be started: as a path, or as a name on the PATH.
bool is_program(const std::string& program);

/// Path of this program itself.
std::string own_program();

}  // namespace tisserand
