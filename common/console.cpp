// Standard output of the programs.
#include "common/console.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand {

void take_write_failures_as_errors() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void say(const std::string& text) {
  const bool ok = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (ok || errno == EPIPE) return;
  const int number = errno;
  throw Error(fmt::format("cannot write: {}", std::strerror(number)), "standard output", remedy_of_errno(number));
}

std::string unknown_command(const std::string& word, const std::vector<std::string>& commands) {
  const auto near = nearest(word, commands);
  return fmt::format("there is no command '{}'; {}", word.substr(0, 80),
                     near ? fmt::format("did you mean '{}'?", *near) : "the commands are " + join(commands, ", "));
}

}  // namespace tisserand
