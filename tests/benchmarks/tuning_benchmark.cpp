// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers that steer a step (mechanism/step/tuning.hpp), one by one around their values: what each costs in time.
// Their values are where these tables are flat or lowest.
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "tests/benchmarks/mechanisms.hpp"

namespace tisserand::benchmarks {
namespace {

using mechanism::StepTuning;

struct Mechanism {
  const char* name;
  Case (*make)();
};

const std::vector<Mechanism>& mechanisms() {
  static const std::vector<Mechanism> list{
      {"a: hinged beam", [] { return hinged_beam(4, formats::Formulation::stabilised_index2); }},
      {"b: nonlinear beams", [] { return nonlinear_beam(10, 2); }},
      {"c: crank, reduced", [] { return slider_crank_reduced(4, 0.12); }},
      {"d: crank, beams", [] { return slider_crank_of_beams(8, 0.12); }},
      {"e: 100 links", [] { return rigid_chain(100, 200); }},
      {"f: 100 superelements", [] { return chain(100, 100); }}};
  return list;
}

/// us per step of each mechanism with these numbers.
void measure(const StepTuning& tuning, benchmark::State& state) {
  for (auto _ : state)
    for (const Mechanism& mechanism : mechanisms()) {
      Case input = mechanism.make();
      input.tuning = tuning;
      const Cost cost = run(input);
      state.counters[mechanism.name] = 1e6 * cost.seconds_steps / static_cast<double>(cost.steps);
    }
}

template <class T>
void vary(const std::string& name, T StepTuning::*number, const std::vector<T>& values) {
  for (const T value : values) {
    StepTuning tuning;
    tuning.*number = value;
    const bool own = value == StepTuning{}.*number;
    benchmark::RegisterBenchmark(fmt::format("tuning/{}/{}{}", name, value, own ? " (chosen)" : "").c_str(),
                                 [tuning](benchmark::State& state) { measure(tuning, state); })
        ->Iterations(1)
        ->Repetitions(3);
  }
}

const bool registered = [] {
  vary("slow_rate", &StepTuning::slow_rate, {0.05, 0.1, 0.25, 0.5, 0.8});
  vary("quick_rate", &StepTuning::quick_rate, {0.0, 0.005, 0.02, 0.1, 0.3});
  vary("smooth_rate", &StepTuning::smooth_rate, {0.0, 0.25, 0.5, 0.9});
  vary("loss", &StepTuning::loss, {1.0, 1.25, 1.5, 2.0, 4.0});
  vary("longest_pause", &StepTuning::longest_pause, {0, 7, 63, 255});
  vary("farthest_turn", &StepTuning::farthest_turn, {0.02, 0.05, 0.1, 0.2});
  vary("most_steps", &StepTuning::most_steps, {1.0, 4.0, 16.0, 64.0});
  vary("open_share", &StepTuning::open_share, {0.01, 0.05, 0.15, 0.5});
  vary("most_projections", &StepTuning::most_projections, {1, 2, 4});
  return true;
}();

}  // namespace
}  // namespace tisserand::benchmarks
