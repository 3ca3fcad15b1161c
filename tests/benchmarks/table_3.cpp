// SPDX-License-Identifier: GPL-3.0-or-later
// Table 3 of [GA00] with the slider-crank of examples/slider_crank: what virtual bodies cost, sparse and full LU, as
// markdown. Argument: the folder with the scenes and rod.superelement.h5 (scripts/table_3 makes it).
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "formats/yaml/override.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/iteration_matrix.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/solver/back_ends.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::benchmarks {
namespace {

constexpr int kRepetitions = 7;
using Times = std::array<double, kRepetitions>;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(Times values) {
  std::sort(values.begin(), values.end());
  return values[kRepetitions / 2];
}

/// Median of the ratios of measurements taken one after the other: the speed of the machine drops out.
double relative(Times times, const Times& first) {
  for (std::size_t i = 0; i < times.size(); ++i) times[i] /= first[i];
  return median(times);
}

/// CPU time of one call [s], over 2 ms or more.
template <class Action>
double seconds_of(Action action) {
  for (long count = 64;; count *= 2) {
    const double begin = cpu_seconds();
    for (long i = 0; i < count; ++i) action();
    const double seconds = cpu_seconds() - begin;
    if (seconds > 2e-3) return seconds / static_cast<double>(count);
  }
}

struct Case {
  std::string label;
  std::string scene;
  std::string virtual_bodies;
  bool sparse = true;
  double paper_analysis = 0.0, paper_solution = 0.0;  ///< relative times; 0: not in the paper
};

struct Cost {
  int unknowns = 0, nonzeros = 0;
  long iterations = 0, factorisations = 0, solutions = 0;
  double flops = 0.0;  ///< of all factorisations and solutions
  Times analysis{};    ///< CPU seconds of all steps
  Times solution{};    ///< of them in factorisations and solutions
};

/// Inertia B, whose tangent is that of the element: the same iterations in every model.
formats::Scene read(const std::string& folder, const Case& input) {
  std::vector<formats::Override> overrides;
  for (const std::string& setting : {"virtual_bodies=" + input.virtual_bodies,
                                     std::string("integrator.linear_solver=") + (input.sparse ? "klu" : "dense"),
                                     std::string("bodies.rod.inertia=B"), std::string("integrator.end=0.6")})
    overrides.push_back(formats::parse_override(setting));
  return formats::read_scene(folder + "/" + input.scene + ".scene.yaml", overrides);
}

/// Factorisation: 2/3 n³ (dense), counted on the pattern (KLU); solution 2 n², 2 entries of L and U.
double flops(const mechanism::SparsePattern& pattern, const Cost& cost, bool sparse) {
  const double n = pattern.size();
  const auto factorisations = static_cast<double>(cost.factorisations), solutions = static_cast<double>(cost.solutions);
  if (!sparse) return factorisations * 2.0 / 3.0 * n * n * n + solutions * 2.0 * n * n;
  const mechanism::back_end::Effort effort = mechanism::back_end::klu_effort(pattern);
  return factorisations * effort.flops + solutions * 2.0 * effort.entries;
}

/// Factorisations and solutions at the end of a run, times their number.
double solution_seconds(test_support::Simulation& run, const formats::IntegratorSpec& integrator, const Cost& cost) {
  mechanism::Workspace& workspace = run.workspace;
  const auto c = mechanism::step_coefficients(mechanism::alpha_parameters(integrator), integrator.step);
  mechanism::evaluate(run.model(), run.state(), workspace.now);
  mechanism::SaddleSystem system(run.model());
  // Factoring scales the values in place: they are evaluated before each one.
  const auto fill = [&] { mechanism::evaluate_tangent(run.model(), run.state(), {c}, workspace.now, system.matrix); };
  const double tangent = seconds_of(fill);
  const double factor = seconds_of([&] {
                          fill();
                          if (!system.factor(run.model()).regular) throw std::runtime_error("singular");
                        }) -
                        tangent;
  const double solve = seconds_of([&] {
    system.unknowns.setOnes();
    system.solve(run.model());
  });
  return static_cast<double>(cost.factorisations) * factor + static_cast<double>(cost.solutions) * solve;
}

void measure(const std::string& folder, const Case& input, std::size_t repetition, Cost& cost) {
  const formats::Scene scene = read(folder, input);
  const mechanism::BodyFiles files = mechanism::read_body_files(scene);
  test_support::Simulation run(scene, files);
  run.start();
  const double begin = cpu_seconds();
  run.run(scene.integrator.end);
  cost.analysis[repetition] = cpu_seconds() - begin;
  const mechanism::SparsePattern& pattern = *run.model().pattern;
  cost.unknowns = pattern.size();
  cost.nonzeros = pattern.nonzeros();
  cost.iterations = run.iterations;
  cost.factorisations = run.factorisations;
  cost.solutions = 2 * run.iterations;  // stabilised index 2: one more, the correction of the positions
  cost.flops = flops(pattern, cost, input.sparse);
  cost.solution[repetition] = solution_seconds(run, scene.integrator, cost);
}

std::string of_paper(double value) { return value > 0.0 ? fmt::format("{:.2f}", value) : std::string(); }

void print(const std::vector<Case>& cases, const std::vector<Cost>& costs) {
  fmt::print(
      "| virtual bodies | LU | unknowns | nonzeros | iterations | factorisations | Mflop | analysis [ms] | relative | "
      "paper | solution [ms] | relative | paper |\n"
      "| --- | --- | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: | --: |\n");
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Cost &cost = costs[i], &first = costs.front();
    fmt::print("| {} | {} | {} | {} | {} | {} | {:.0f} | {:.0f} | {:.2f} | {} | {:.0f} | {:.2f} | {} |\n",
               cases[i].label, cases[i].sparse ? "sparse" : "full", cost.unknowns, cost.nonzeros, cost.iterations,
               cost.factorisations, 1e-6 * cost.flops, 1e3 * median(cost.analysis),
               relative(cost.analysis, first.analysis), of_paper(cases[i].paper_analysis), 1e3 * median(cost.solution),
               relative(cost.solution, first.solution), of_paper(cases[i].paper_solution));
  }
}

void table(const std::string& folder) {
  const std::vector<Case> cases = {
      {"none", "virtual_0", "keep", true, 1.00, 1.00},      {"one kept", "virtual_1", "keep", true, 1.08, 1.03},
      {"two kept", "virtual_2", "keep", true, 1.33, 1.14},  {"none", "virtual_0", "keep", false, 1.19, 1.17},
      {"one kept", "virtual_1", "keep", false, 1.86, 1.50}, {"two kept", "virtual_2", "keep", false, 2.40, 2.04},
      {"one eliminated", "virtual_1", "eliminate", true},   {"two eliminated", "virtual_2", "eliminate", true},
      {"one eliminated", "virtual_1", "eliminate", false},  {"two eliminated", "virtual_2", "eliminate", false},
  };
  std::vector<Cost> costs(cases.size());
  for (std::size_t repetition = 0; repetition < kRepetitions; ++repetition)
    for (std::size_t i = 0; i < cases.size(); ++i) measure(folder, cases[i], repetition, costs[i]);
  print(cases, costs);
}

}  // namespace
}  // namespace tisserand::benchmarks

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "Usage: table_3 <folder with virtual_*.scene.yaml and rod.superelement.h5>\n");
    return 2;
  }
  try {
    tisserand::benchmarks::table(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "table_3: {}\n", error.what());
    return 1;
  }
}
