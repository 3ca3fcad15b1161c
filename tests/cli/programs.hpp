// SPDX-License-Identifier: GPL-3.0-or-later
// The built programs as child processes with captured streams, for the tests of the command lines.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace tisserand::cli {

inline std::string program(const std::string& name) { return std::string(TISSERAND_BINARY_DIR "/bin/") + name; }

inline std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

struct Outcome {
  int code = -1;  ///< exit code; 1000 + number of the signal that ended the program
  std::string out;
  std::string error;
};

/// Limits and redirections of a child.
struct Surroundings {
  std::string folder;                ///< working folder
  std::string standard_output;       ///< empty: captured
  rlim_t file_size = RLIM_INFINITY;  ///< bytes
  uid_t user = 0;                    ///< other than 0: the child runs as this user
};

/// Starts a program; its streams go to files in `folder`.
inline pid_t start(const std::vector<std::string>& words, const Surroundings& surroundings) {
  const std::string out =
      surroundings.standard_output.empty() ? surroundings.folder + "/.out" : surroundings.standard_output;
  const std::string error = surroundings.folder + "/.err";
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = ::fork();
  if (child != 0) return child;
  const auto redirect = [](const std::string& path, int to, int mode) {
    const int file = ::open(path.c_str(), mode, 0644);
    if (file < 0 || ::dup2(file, to) < 0) ::_exit(126);
  };
  redirect("/dev/null", 0, O_RDONLY);
  redirect(out, 1, O_WRONLY | O_CREAT | O_TRUNC);
  redirect(error, 2, O_WRONLY | O_CREAT | O_TRUNC);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_DFL);
  if (surroundings.file_size != RLIM_INFINITY) {
    const struct rlimit limit { surroundings.file_size, surroundings.file_size };
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (surroundings.user != 0 && (::setgid(surroundings.user) != 0 || ::setuid(surroundings.user) != 0)) ::_exit(126);
  if (::chdir(surroundings.folder.c_str()) != 0) ::_exit(126);
  ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

inline Outcome finish(pid_t child, const Surroundings& surroundings) {
  int status = 0;
  ::waitpid(child, &status, 0);
  Outcome outcome;
  outcome.code = WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : WEXITSTATUS(status);
  if (surroundings.standard_output.empty()) outcome.out = read_text(surroundings.folder + "/.out");
  outcome.error = read_text(surroundings.folder + "/.err");
  return outcome;
}

inline Outcome call(const std::vector<std::string>& words, const Surroundings& surroundings) {
  return finish(start(words, surroundings), surroundings);
}

}  // namespace tisserand::cli
