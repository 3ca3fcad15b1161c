// SPDX-License-Identifier: GPL-3.0-or-later
// Chains against the number of links, sparse against dense against size, and the slider-crank as steps per second.
#include <utility>

#include <benchmark/benchmark.h>

#include "tests/benchmarks/mechanisms.hpp"

namespace tisserand::benchmarks {
namespace {

void report_chain(const Case& input, double links, benchmark::State& state) {
  for (auto _ : state) {
    const Cost cost = run(input);
    const double per = 1e6 / links, steps = static_cast<double>(cost.steps);
    state.counters["a: us/step/link"] = per * cost.seconds() / steps;
    state.counters["b: us/iteration/link"] = per * cost.seconds() / static_cast<double>(cost.iterations);
    state.counters["c: iterations/step"] = static_cast<double>(cost.iterations) / steps;
    state.counters["d: factorisations/step"] = static_cast<double>(cost.factorisations) / steps;
    state.counters["e: model us/link"] = per * cost.seconds_model;
    state.counters["f: start us/link"] = per * cost.seconds_start;
  }
}

void chain_of_rigid_links(benchmark::State& state) {
  report_chain(rigid_chain(static_cast<int>(state.range(0)), static_cast<int>(state.range(1))),
               static_cast<double>(state.range(0)), state);
}
BENCHMARK(chain_of_rigid_links)
    ->Args({10, 2000})
    ->Args({100, 200})
    ->Args({1000, 50})
    ->Args({10000, 20})
    ->Iterations(1)
    ->Repetitions(3);

void chain_of_many_superelements(benchmark::State& state) {
  report_chain(chain(static_cast<int>(state.range(0)), static_cast<int>(state.range(1))),
               static_cast<double>(state.range(0)), state);
}
BENCHMARK(chain_of_many_superelements)->Args({1000, 20})->Args({10000, 10})->Iterations(1)->Repetitions(3);

void report_crank(const Case& input, benchmark::State& state) {
  for (auto _ : state) {
    const Cost cost = run(input);
    const double steps = static_cast<double>(cost.steps);
    state.counters["a: steps/s"] = steps / cost.seconds();
    state.counters["b: us/step"] = 1e6 * cost.seconds() / steps;
    state.counters["c: iterations/step"] = static_cast<double>(cost.iterations) / steps;
    state.counters["d: factorisations/step"] = static_cast<double>(cost.factorisations) / steps;
  }
}

void slider_crank_nonlinear_beams(benchmark::State& state) {
  report_crank(slider_crank_of_beams(static_cast<int>(state.range(0)), 0.12), state);
}
BENCHMARK(slider_crank_nonlinear_beams)->Arg(8)->Iterations(1)->Repetitions(5);

void slider_crank_reduced_rod(benchmark::State& state) {
  report_crank(slider_crank_reduced(static_cast<int>(state.range(0)), 0.12), state);
}
BENCHMARK(slider_crank_reduced_rod)->Arg(4)->Iterations(1)->Repetitions(5);

/// One run with each solver, in turn.
void sparse_against_dense(benchmark::State& state) {
  Case sparse = rigid_chain(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  Case dense = sparse;
  sparse.scene.integrator.linear_solver = formats::LinearSolver::klu;
  dense.scene.integrator.linear_solver = formats::LinearSolver::dense;
  for (auto _ : state) {
    const Cost a = run(sparse), b = run(dense);
    state.counters["a: sparse us/step"] = 1e6 * a.seconds() / static_cast<double>(a.steps);
    state.counters["b: dense us/step"] = 1e6 * b.seconds() / static_cast<double>(b.steps);
    state.counters["c: sparse / dense"] = a.seconds() / b.seconds();
  }
}
BENCHMARK(sparse_against_dense)
    ->Args({2, 2000})
    ->Args({5, 1000})
    ->Args({10, 500})
    ->Args({20, 200})
    ->Args({50, 50})
    ->Iterations(1)
    ->Repetitions(5);

}  // namespace
}  // namespace tisserand::benchmarks
