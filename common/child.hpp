// SPDX-License-Identifier: GPL-3.0-or-later
// Runs another program as a child process without a shell, limits its time, and returns its output and processor time.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace tisserand {

/// Request to run a program as a child process.
struct ChildRequest {
  std::vector<std::string> words;    ///< program (a path, or a name on the PATH) and its arguments
  std::string input;                 ///< text that the child gets as standard input
  std::size_t most_text = 1 << 16;   ///< limit of the captured standard output [bytes]
  double seconds = 0.0;              ///< limit of the elapsed time [s]; 0: no limit
  std::function<bool()> is_stopped;  ///< called ten times a second; `true` ends the child; empty: not called
  /// Function that exchanges data with the child, called once while the child runs. The other end of `socket` is
  /// descriptor 3 (read) and 4 (write) of the child. When the function returns, the socket closes and the time limit
  /// starts. An exception of the function kills the child. Empty: the child gets no such descriptors.
  std::function<void(int socket)> talk;
};

enum class ChildEnding { left, killed, timed_out, stopped };

/// Result of a child process.
struct ChildReport {
  ChildEnding ending = ChildEnding::left;
  int code = 0;              ///< exit code (left) or number of the signal (killed)
  std::string text;          ///< the first ChildRequest::most_text bytes of its standard output
  std::string complaint;     ///< the first 64 KiB of its standard error
  double cpu_seconds = 0.0;  ///< user and system time of the child and its own children [s]
};

/// Runs a program as a child process to its end. A child that must end gets SIGTERM and five seconds later SIGKILL. The
/// child does not outlive this program. Throws Error if the program cannot be started.
ChildReport run_child(const ChildRequest& request);

/// Whether `program` can be started: as a path, or as a name on the PATH.
bool is_program(const std::string& program);

/// Path of the executable of this process.
std::string own_program();

}  // namespace tisserand
