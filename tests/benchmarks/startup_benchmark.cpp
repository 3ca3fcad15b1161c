// SPDX-License-Identifier: GPL-3.0-or-later
// Start-up of the programs: CPU and wall time of their own first words.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>

namespace tisserand::benchmarks {
namespace {

double wall_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

void startup(benchmark::State& state, const char* program, const char* option) {
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
  if (!std::filesystem::exists(path)) {
    state.SkipWithError((path.string() + " is not built").c_str());
    return;
  }
  for (auto _ : state) {
    const double begin = wall_seconds();
    const pid_t child = ::fork();
    if (child == 0) {
      const int nowhere = ::open("/dev/null", O_WRONLY);
      ::dup2(nowhere, STDOUT_FILENO);
      ::execl(path.c_str(), program, option, static_cast<char*>(nullptr));
      ::_exit(127);
    }
    int status = 0;
    rusage usage{};
    ::wait4(child, &status, 0, &usage);
    if (status != 0) state.SkipWithError("the program failed");
    state.counters["a: CPU ms"] = 1e3 * (seconds(usage.ru_utime) + seconds(usage.ru_stime));
    state.counters["b: wall ms"] = 1e3 * (wall_seconds() - begin);
  }
}
BENCHMARK_CAPTURE(startup, mechanism_version, "mechanism", "--version")->Iterations(1)->Repetitions(15);
BENCHMARK_CAPTURE(startup, mechanism_help, "mechanism", "--help")->Iterations(1)->Repetitions(15);
BENCHMARK_CAPTURE(startup, reducer_help, "reducer", "--help")->Iterations(1)->Repetitions(15);

}  // namespace
}  // namespace tisserand::benchmarks
