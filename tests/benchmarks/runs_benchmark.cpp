// SPDX-License-Identifier: GPL-3.0-or-later
// Whole runs: the hinged beam in all models, chains.
#include <benchmark/benchmark.h>

#include "tests/benchmarks/scenes.hpp"

namespace tisserand::benchmarks {
namespace {

using formats::Formulation;

void report(const Cost& cost, benchmark::State& state) {
  const auto steps = static_cast<double>(cost.steps);
  state.counters["a: steps/s"] = steps / cost.seconds();
  state.counters["b: us/step"] = 1e6 * cost.seconds() / steps;
  state.counters["c: us/iteration"] = 1e6 * cost.seconds() / static_cast<double>(cost.iterations);
  state.counters["d: iterations/step"] = static_cast<double>(cost.iterations) / steps;
  state.counters["e: factorisations/step"] = static_cast<double>(cost.factorisations) / steps;
}

void run_beam(const Case& input, const char* base, benchmark::State& state) {
  for (auto _ : state) {
    const Cost cost = run_hinged_beam(input, base);
    report(cost, state);
    state.counters["f: max error"] = cost.error;
    state.counters["g: RMS error"] = cost.error_rms;
  }
}

void hinged_beam_4_modes(benchmark::State& state, Formulation formulation) {
  run_beam(hinged_beam(4, formulation), "beam/base", state);
}
BENCHMARK_CAPTURE(hinged_beam_4_modes, index3, Formulation::index3)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(hinged_beam_4_modes, stabilised_index2, Formulation::stabilised_index2)
    ->Iterations(1)
    ->Repetitions(5);

void nonlinear_beams_of_2_nodes(benchmark::State& state) {
  run_beam(nonlinear_beam(static_cast<int>(state.range(0)), 2), "beam/0", state);
}
BENCHMARK(nonlinear_beams_of_2_nodes)->Arg(10)->Arg(20)->Iterations(1)->Repetitions(5);

void nonlinear_beams_of_3_nodes(benchmark::State& state) {
  run_beam(nonlinear_beam(static_cast<int>(state.range(0)), 3), "beam/0", state);
}
BENCHMARK(nonlinear_beams_of_3_nodes)->Arg(5)->Iterations(1)->Repetitions(5);

void chain_of_superelements(benchmark::State& state) {
  const auto elements = static_cast<double>(state.range(0));
  const Case input = chain(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) {
    const Cost cost = run(input);
    const double per = 1e6 / elements;
    state.counters["a: us/step/element"] = per * cost.seconds() / static_cast<double>(cost.steps);
    state.counters["b: us/iteration/element"] = per * cost.seconds() / static_cast<double>(cost.iterations);
    state.counters["c: iterations/step"] = static_cast<double>(cost.iterations) / static_cast<double>(cost.steps);
    state.counters["d: factorisations/step"] =
        static_cast<double>(cost.factorisations) / static_cast<double>(cost.steps);
    state.counters["e: model us/element"] = per * cost.seconds_model;
    state.counters["f: start us/element"] = per * cost.seconds_start;
  }
}
BENCHMARK(chain_of_superelements)->Args({10, 500})->Args({100, 100})->Args({1000, 20})->Iterations(1)->Repetitions(5);

}  // namespace
}  // namespace tisserand::benchmarks
