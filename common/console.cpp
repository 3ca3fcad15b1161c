// SPDX-License-Identifier: GPL-3.0-or-later
// Output and error messages on the terminal.
#include "common/console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <sstream>
#include <string_view>
#include <system_error>

#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/temporaries.hpp"
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

std::string with_nearest_options(const std::string& message, const std::vector<std::string>& options) {
  std::string text = message;
  std::istringstream words(message);
  for (std::string word; words >> word;) {
    word = word.substr(0, word.find('='));
    if (!word.starts_with("--") || std::ranges::find(options, word) != options.end()) continue;
    if (const auto near = nearest(word, options)) text += fmt::format("; did you mean {}?", *near);
  }
  return text;
}

void complain_of_exception(const char* program) noexcept {
  (void)remove_temporaries();
  const auto put = [](std::string_view text) {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
  };
  try {
    try {
      throw;
    } catch (const Error& error) {
      complain(program, error.what());
    } catch (const std::bad_alloc&) {
      put(program);
      put(": out of memory; close other programs, raise the limit (`ulimit -v`), or make the model smaller\n");
    } catch (const std::system_error& error) {
      const bool is_short = error.code() == std::errc::resource_unavailable_try_again ||
                            error.code() == std::errc::not_enough_memory;
      if (is_short) {
        put(program);
        put(": out of memory or threads; close other programs, or raise the limits (`ulimit -v`, `ulimit -u`)\n");
      } else {
        complain(program, fmt::format("internal error: {}", error.what()));
      }
    } catch (const std::exception& error) {
      complain(program, fmt::format("internal error: {}", error.what()));
    }
  } catch (...) {  // no memory for the message
    put(program);
    put(": out of memory\n");
  }
}

}  // namespace tisserand
