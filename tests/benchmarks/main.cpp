// SPDX-License-Identifier: GPL-3.0-or-later
// benchmarks [--benchmark_filter=...]: prints one markdown table per kind of measurement.
#include <cstdlib>
#include <exception>
#include <iostream>

#include <benchmark/benchmark.h>

#include "tests/benchmarks/table.hpp"

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return EXIT_FAILURE;
  try {
    tisserand::benchmarks::TableReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  benchmark::Shutdown();
  return EXIT_SUCCESS;
}
