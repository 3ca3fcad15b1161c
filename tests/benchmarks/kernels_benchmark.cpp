// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of an iteration, their share of a step, and the two linear solvers.
#include <utility>

#include <benchmark/benchmark.h>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/step/step.hpp"
#include "tests/benchmarks/mechanisms.hpp"
#include "tests/benchmarks/scenes.hpp"

namespace tisserand::benchmarks {
namespace {

using formats::Formulation;
using mechanism::TangentKind;

/// CPU time of one call [us].
template <class Action>
double microseconds(Action action) {
  for (long count = 1;; count *= 2) {
    const double begin = cpu_seconds();
    for (long i = 0; i < count; ++i) {
      action();
      benchmark::ClobberMemory();
    }
    const double seconds = cpu_seconds() - begin;
    if (seconds > 5e-3 || count > 10'000'000)
      return 1e6 * seconds / static_cast<double>(count);  // an empty action takes no time
  }
}

/// CPU times of one call each [us].
struct Kernels {
  double element = 0.0;          ///< kinematics and forces of the elements
  double element_tangent = 0.0;  ///< their tangents
  double evaluate = 0.0;         ///< all of evaluate(), elements included
  double tangent = 0.0;          ///< all of evaluate_tangent(), elements included
  double factor = 0.0;
  double solve = 0.0;       ///< with condensation and expansion of internal coordinates
  double correction = 0.0;  ///< of the positions, the second solution of stabilised index 2; else 0
};

Kernels measure(Stopped& run) {
  const mechanism::Model& model = run.built.model;
  mechanism::Workspace& workspace = run.workspace;
  const mechanism::State& state = run.built.state;
  const formats::IntegratorSpec& options = run.scene.integrator;
  const auto c = mechanism::step_coefficients(mechanism::alpha_parameters(options), options.step);
  const Eigen::VectorXd rows = Eigen::VectorXd::Zero(model.sizes.constraints);
  mechanism::SaddleSystem system(model);
  Kernels time;
  time.evaluate = microseconds([&] { mechanism::evaluate(model, state, workspace.now); });
  time.tangent = microseconds([&] { mechanism::evaluate_tangent(model, state, {c}, workspace.now, system.matrix); });
  // Factoring scales the values in place: they are evaluated before each one.
  time.factor = microseconds([&] {
    mechanism::evaluate_tangent(model, state, {c}, workspace.now, system.matrix);
    benchmark::DoNotOptimize(system.factor(model));
  });
  time.factor -= time.tangent;
  if (!workspace.matrix.factor(model, state, {c}, workspace.now).regular) throw std::runtime_error("singular");
  time.solve = microseconds([&] { workspace.matrix.solve_increment(model, rows, workspace.now); });
  if (options.formulation == Formulation::stabilised_index2)
    time.correction = microseconds([&] { workspace.matrix.solve_projection(model, rows, workspace.now); });
  time.element = microseconds([&] {
    for (std::size_t i = 0; i < model.superelements.size(); ++i) {
      const int internal = model.internal_offset[i], first = model.sizes.boundary + internal;
      mechanism::update_kinematics(body_of(model, i), nodes_of(model, i, workspace.now), state.y().data() + internal,
                                   state.v().data() + first, state.vdot().data() + first,
                                   Eigen::Matrix3d(workspace.now.superelements[i].R0_reference),
                                   workspace.now.superelements[i]);
      mechanism::residual(body_of(model, i), workspace.now.superelements[i], model.gravity);
    }
  });
  time.element += microseconds([&] {
    Eigen::Matrix<double, 12, 1> r;
    for (const auto& beam : model.beams2) mechanism::residual(beam, workspace.now.motion, model.gravity, r);
    benchmark::DoNotOptimize(r);
  });
  time.element_tangent = microseconds([&] {
    for (std::size_t i = 0; i < model.superelements.size(); ++i)
      mechanism::tangent(body_of(model, i), c, workspace.now.superelements[i], work_of(model, i, workspace.now));
  });
  time.element_tangent += microseconds([&] {
    Eigen::Matrix<double, 12, 1> r;
    Eigen::Matrix<double, 12, 12> A;
    for (const auto& beam : model.beams2)
      mechanism::residual_and_tangent(beam, workspace.now.motion, model.gravity, c, r, A);
    benchmark::DoNotOptimize(A);
  });
  return time;
}

using MakeCase = Case (*)();
Case hinged_index3() { return hinged_beam(4, Formulation::index3); }
Case hinged_index2() { return hinged_beam(4, Formulation::stabilised_index2); }
Case ten_beams() { return nonlinear_beam(10, 2); }
template <int links>
Case superelement_links() {
  return chain(links, links > 1000 ? 10 : 20);
}
template <int links>
Case rigid_links() {
  return rigid_chain(links, links > 1000 ? 20 : 50);
}
Case crank_of_beams() { return slider_crank_of_beams(8, 0.12); }
Case crank_reduced() { return slider_crank_reduced(4, 0.12); }

double half_time(const Case& input) { return 0.5 * input.scene.integrator.end; }

void kernels(benchmark::State& state, MakeCase make) {
  const Case input = make();
  Stopped stopped(input, half_time(input));
  for (auto _ : state) {
    const Kernels time = measure(stopped);
    state.counters["a: unknowns"] = stopped.built.model.pattern->size();
    state.counters["b: evaluate us"] = time.evaluate;
    state.counters["c: tangent us"] = time.tangent;
    state.counters["d: factor us"] = time.factor;
    state.counters["e: solve us"] = time.solve;
  }
}
BENCHMARK_CAPTURE(kernels, hinged_beam_4_modes, hinged_index2)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(kernels, ten_nonlinear_beams, ten_beams)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(kernels, chain_of_100, superelement_links<100>)->Iterations(1)->Repetitions(5);

/// Times of the kernels by how often a run calls them; `rest` is the integrator's own work.
void shares(benchmark::State& state, MakeCase make) {
  const Case input = make();
  Stopped stopped(input, half_time(input));
  for (auto _ : state) {
    const Kernels time = measure(stopped);
    const Cost cost = run(input);
    const double steps = static_cast<double>(cost.steps), iterations = static_cast<double>(cost.iterations) / steps;
    const double factorisations = static_cast<double>(cost.factorisations) / steps, all = 1e6 * cost.seconds() / steps;
    const double evaluations = iterations + 1.0;
    const double element = evaluations * time.element + factorisations * time.element_tangent;
    const double assembly =
        evaluations * (time.evaluate - time.element) + factorisations * (time.tangent - time.element_tangent);
    const double factor = factorisations * time.factor, solve = iterations * (time.solve + time.correction);
    const double output = 1e6 * cost.seconds_output / steps;
    state.counters["a: us/step"] = all;
    state.counters["b: element %"] = 100.0 * element / all;
    state.counters["c: assembly and joints %"] = 100.0 * assembly / all;
    state.counters["d: factor %"] = 100.0 * factor / all;
    state.counters["e: solve %"] = 100.0 * solve / all;
    state.counters["f: output %"] = 100.0 * output / all;
    state.counters["g: rest %"] = 100.0 * (all - element - assembly - factor - solve - output) / all;
  }
}
BENCHMARK_CAPTURE(shares, hinged_beam_index3, hinged_index3)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(shares, hinged_beam_stabilised_index2, hinged_index2)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(shares, ten_nonlinear_beams, ten_beams)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(shares, slider_crank_of_8_beams, crank_of_beams)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(shares, slider_crank_reduced_rod, crank_reduced)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(shares, rigid_chain_of_100, rigid_links<100>)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(shares, rigid_chain_of_10000, rigid_links<10000>)->Iterations(1)->Repetitions(3);
BENCHMARK_CAPTURE(shares, chain_of_100, superelement_links<100>)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(shares, chain_of_1000, superelement_links<1000>)->Iterations(1)->Repetitions(5);
BENCHMARK_CAPTURE(shares, chain_of_10000, superelement_links<10000>)->Iterations(1)->Repetitions(3);

/// Both models in turn, so that the ratios see one machine. Runs differ in how often they factor; the kernels of one
/// iteration with new factors do not.
void internal_modes(benchmark::State& state) {
  const Case none = hinged_beam(0, Formulation::stabilised_index2);
  const Case some = hinged_beam(static_cast<int>(state.range(0)), Formulation::stabilised_index2);
  Stopped stopped_none(none, half_time(none)), stopped_some(some, half_time(some));
  const auto iteration = [](const Kernels& time) {
    return time.evaluate + time.tangent + time.factor + 2.0 * time.solve;
  };
  for (auto _ : state) {
    const Cost a = run(none), b = run(some);
    const Kernels kernels_a = measure(stopped_none), kernels_b = measure(stopped_some);
    state.counters["a: us/step"] = 1e6 * b.seconds() / static_cast<double>(b.steps);
    state.counters["b: step, relative to 0 modes"] = b.seconds() / a.seconds();
    state.counters["c: iteration with new factors, relative to 0 modes"] = iteration(kernels_b) / iteration(kernels_a);
    state.counters["d: iterations/step"] = static_cast<double>(b.iterations) / static_cast<double>(b.steps);
    state.counters["e: factorisations/step"] = static_cast<double>(b.factorisations) / static_cast<double>(b.steps);
  }
}
BENCHMARK(internal_modes)->Arg(0)->Arg(8)->Arg(32)->Arg(100)->Iterations(1)->Repetitions(5);

/// Factorisation and solution with both solvers, for the limit in mechanism/model/model.cpp.
void compare_solvers(Case input, benchmark::State& state) {
  input.scene.integrator.linear_solver = formats::LinearSolver::klu;
  Stopped sparse(input, half_time(input));
  input.scene.integrator.linear_solver = formats::LinearSolver::dense;
  Stopped dense(input, half_time(input));
  for (auto _ : state) {
    const Kernels a = measure(sparse), b = measure(dense);
    state.counters["a: unknowns"] = sparse.built.model.pattern->size();
    state.counters["b: KLU factor us"] = a.factor;
    state.counters["c: dense factor us"] = b.factor;
    state.counters["d: KLU solve us"] = a.solve;
    state.counters["e: dense solve us"] = b.solve;
    // An iteration of stabilised index 2 with new factors: one tangent, one factorisation, two solutions.
    state.counters["f: KLU / dense"] = (a.tangent + a.factor + 2.0 * a.solve) / (b.tangent + b.factor + 2.0 * b.solve);
  }
}

void solvers_chain(benchmark::State& state) {
  Case input = chain(static_cast<int>(state.range(0)), 4);
  input.scene.output.every = 1;
  compare_solvers(std::move(input), state);
}
BENCHMARK(solvers_chain)->DenseRange(1, 6)->Iterations(1)->Repetitions(5);

void solvers_nonlinear_beams(benchmark::State& state) {
  Case input = nonlinear_beam(static_cast<int>(state.range(0)), 2);
  input.scene.integrator.end = 0.1;
  compare_solvers(std::move(input), state);
}
BENCHMARK(solvers_nonlinear_beams)->DenseRange(1, 10)->Iterations(1)->Repetitions(5);

}  // namespace
}  // namespace tisserand::benchmarks
