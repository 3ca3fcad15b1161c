// Standard output of the programs.
#include "common/console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/text.hpp"

namespace tisserand {

void take_write_failures_as_errors() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void fill_standard_streams() {
  int file = ::open("/dev/null", O_RDWR);
  while (file >= 0 && file <= STDERR_FILENO) file = ::open("/dev/null", O_RDWR);
  if (file > STDERR_FILENO) ::close(file);
}

void say(const std::string& raw) {
  const std::string text = printable(raw);
  const bool ok = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (ok || errno == EPIPE) return;
  const int number = errno;
  throw Error(fmt::format("cannot write: {}", std::strerror(number)), "standard output", remedy_of_errno(number));
}

void say_of(const std::string& path, const std::string& text) {
  if (is_stream(path))
    fmt::print(stderr, "{}", printable(text));
  else
    say(text);
}

void complain(const std::string& program, const std::string& text) {
  fmt::print(stderr, "{}: {}\n", program, printable(text));
}

std::string unknown_command(const std::string& word, const std::vector<std::string>& commands) {
  const auto near = nearest(word, commands);
  return fmt::format("there is no command '{}'; {}", word.substr(0, 80),
                     near ? fmt::format("did you mean '{}'?", *near) : "the commands are " + join(commands, ", "));
}

std::optional<std::string> unknown_option(const std::vector<std::string>& words,
                                          const std::vector<std::string>& options) {
  for (const std::string& word : words) {
    if (word == "--") return {};
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || std::ranges::find(options, name) != options.end()) continue;
    const auto near = nearest(name, options);
    return fmt::format("there is no option '{}'; {}", name.substr(0, 80),
                       near ? fmt::format("did you mean '{}'?", *near) : "the options are " + join(options, ", "));
  }
  return {};
}

}  // namespace tisserand
