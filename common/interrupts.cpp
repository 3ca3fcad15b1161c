// SPDX-License-Identifier: GPL-3.0-or-later
// The signal handler wakes a thread through a pipe. That thread may take locks and write, a handler may not.
#include "common/interrupts.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <thread>

#include "common/console.hpp"
#include "common/temporaries.hpp"

namespace tisserand {
namespace {

constexpr int exit_interrupted = 130;
std::array<int, 2> ends{-1, -1};  // ends of the pipe

void wake(int /*signal*/) {
  const int before = errno;
  const char byte = 0;
  [[maybe_unused]] const ssize_t ignored = ::write(ends[1], &byte, 1);
  errno = before;
}

[[noreturn]] void wait_and_end(const std::string& program) {
  char byte = 0;
  while (::read(ends[0], &byte, 1) != 1)
    if (errno != EINTR) ::pause();
  const bool published = remove_temporaries();
  if (!program.empty())
    complain(program, published ? "interrupted: files that were written before are complete"
                                : "interrupted: no file was written or changed");
  ::_exit(exit_interrupted);
}

}  // namespace

void end_on_interrupt(const std::string& program) {
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
  std::thread(wait_and_end, program).detach();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;
    action.sa_handler = wake;
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace tisserand
