// SPDX-License-Identifier: GPL-3.0-or-later
// What second-order terms of a superelement cost against the linear body: per iteration, per step, and term by term.
#include <algorithm>
#include <array>

#include <benchmark/benchmark.h>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/bodies/superelement/tangent/internal_factor.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/step/step.hpp"
#include "tests/benchmarks/scenes.hpp"

namespace tisserand::benchmarks {
namespace {

using formats::InertiaOption;
using formats::StiffeningOption;

constexpr double kTime = 4.0;  // of the hinged beam of [Car00] 8.1: 400 steps, while it is bent most

constexpr SecondOrderTerms kLinear{InertiaOption::B, StiffeningOption::off};
constexpr SecondOrderTerms kLinearM{InertiaOption::M, StiffeningOption::off};
constexpr SecondOrderTerms kStressM{InertiaOption::M, StiffeningOption::stress};
constexpr SecondOrderTerms kInertia{InertiaOption::F, StiffeningOption::off};
constexpr SecondOrderTerms kStressF{InertiaOption::F, StiffeningOption::stress};
constexpr SecondOrderTerms kFull{InertiaOption::F, StiffeningOption::full};

/// CPU time of one call [us], the least of several groups.
template <class Action>
double microseconds(Action action) {
  double least = 1e30;
  for (int group = 0; group < 5; ++group) {
    constexpr double long_enough = 4e-3;  // [s]
    for (long count = 1;; count *= 2) {
      const double begin = cpu_seconds();
      for (long i = 0; i < count; ++i) {
        action();
        benchmark::ClobberMemory();
      }
      const double seconds = cpu_seconds() - begin;
      if (seconds < long_enough) continue;
      least = std::min(least, 1e6 * seconds / static_cast<double>(count));
      break;
    }
  }
  return least;
}

double per_iteration(const Cost& cost) { return 1e6 * cost.seconds_steps / static_cast<double>(cost.iterations); }

/// Runs of the linear body with inertia B and of this one in turn.
void second_order_runs(benchmark::State& state, SecondOrderTerms terms) {
  const int modes = static_cast<int>(state.range(0));
  Case linear = hinged_beam(modes, kLinear), body = hinged_beam(modes, terms);
  linear.scene.integrator.end = body.scene.integrator.end = kTime;
  for (auto _ : state) {
    const Cost a = run(linear), b = run(body);
    const double steps = static_cast<double>(b.steps);
    state.counters["a: coordinates"] = 12 + modes;
    state.counters["b: us/iteration"] = per_iteration(b);
    state.counters["c: relative to B"] = per_iteration(b) / per_iteration(a);
    state.counters["d: us/step"] = 1e6 * b.seconds_steps / steps;
    state.counters["e: relative to B"] = b.seconds_steps / a.seconds_steps;
    state.counters["f: iterations/step"] = static_cast<double>(b.iterations) / steps;
    state.counters["g: of B"] = static_cast<double>(a.iterations) / static_cast<double>(a.steps);
    state.counters["h: factorisations/step"] = static_cast<double>(b.factorisations) / steps;
    state.counters["i: steps/s"] = steps / b.seconds_steps;
  }
}
#define SECOND_ORDER_RUNS(name, terms) \
  BENCHMARK_CAPTURE(second_order_runs, name, terms)->Arg(4)->Arg(24)->Arg(48)->Arg(98)->Iterations(1)->Repetitions(5)
SECOND_ORDER_RUNS(inertia_B, kLinear);
SECOND_ORDER_RUNS(inertia_M, kLinearM);
SECOND_ORDER_RUNS(inertia_M_stress, kStressM);
SECOND_ORDER_RUNS(inertia_F, kInertia);
SECOND_ORDER_RUNS(inertia_F_stress, kStressF);
SECOND_ORDER_RUNS(inertia_F_full, kFull);

/// One superelement of a model that has run, for its kernels.
struct BodyKernels {
  explicit BodyKernels(const Case& input)
      : stopped(input, kTime),
        c(mechanism::step_coefficients(mechanism::alpha_parameters(stopped.scene.integrator),
                                       stopped.scene.integrator.step)) {
    mechanism::evaluate(stopped.built.model, stopped.built.state, stopped.workspace.now);
  }
  const mechanism::SuperelementBody& body() { return body_of(stopped.built.model, 0); }
  mechanism::SuperelementScratch& scratch() { return stopped.workspace.now.superelements[0]; }

  double residual() {
    return microseconds([&] { mechanism::residual(body(), scratch(), stopped.built.model.gravity); });
  }
  double tangent() {
    return microseconds(
        [&] { mechanism::tangent(body(), c, scratch(), work_of(stopped.built.model, 0, stopped.workspace.now)); });
  }

  Stopped stopped;
  mechanism::TangentCoefficients c;
};

/// Forces and step tangents of one body: each term as the difference between bodies with and without it, the
/// elimination of the internal coordinates apart.
void second_order_terms(benchmark::State& state) {
  const int modes = static_cast<int>(state.range(0));
  const std::array<SecondOrderTerms, 4> kinds{kLinear, kInertia, kStressF, kFull};
  std::array<double, 4> forces{}, tangents{};
  for (auto _ : state) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      Case input = hinged_beam(modes, kinds[i]);
      input.scene.integrator.end = 2.0 * kTime;
      BodyKernels kernels(input);
      forces[i] = kernels.residual();
      tangents[i] = kernels.tangent();
    }
    const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(modes, modes);
    Eigen::MatrixXd B = Eigen::MatrixXd::Ones(modes, 18), S = Eigen::MatrixXd::Zero(18, 18);
    mechanism::InternalFactor factor;
    factor.resize(modes);
    state.counters["a: coordinates"] = 12 + modes;
    state.counters["b: forces, linear us"] = forces[0];
    state.counters["c: + C, E"] = forces[1] - forces[0];
    state.counters["d: + Gamma"] = forces[2] - forces[1];
    state.counters["e: + N, T"] = forces[3] - forces[2];
    state.counters["f: tangent, linear us"] = tangents[0];
    state.counters["g: + M_q, dense block, pull-back"] = tangents[1] - tangents[0];
    state.counters["h: of which elimination"] = microseconds([&] {
      factor.factor_symmetric(A);
      factor.subtract_schur(B, S);
    });
    state.counters["i: + K_y, K_f"] = tangents[2] - tangents[1];
    state.counters["j: + N, T"] = tangents[3] - tangents[2];
  }
}
BENCHMARK(second_order_terms)->Arg(4)->Arg(24)->Arg(48)->Arg(98)->Iterations(1)->Repetitions(5);

}  // namespace
}  // namespace tisserand::benchmarks
