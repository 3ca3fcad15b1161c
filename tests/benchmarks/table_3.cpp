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

#include "formats/override.hpp"
#include "mechanism/newton.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/solver/back_ends.hpp"
#include "tests/support/scenes.hpp"

namespace tisserand::benchmarks {
namespace {

constexpr int kRepetitions = 7;

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::array<double, kRepetitions> values) {
  std::sort(values.begin(), values.end());
  return values[kRepetitions / 2];
}

/// CPU time of one call [s], the median of several measurements of a millisecond or more.
template <class Action>
double seconds_of(Action action) {
  std::array<double, kRepetitions> times{};
  for (double& time : times)
    for (long count = 64;; count *= 2) {
      const double begin = cpu_seconds();
      for (long i = 0; i < count; ++i) action();
      const double seconds = cpu_seconds() - begin;
      if (seconds < 2e-3) continue;
      time = seconds / static_cast<double>(count);
      break;
    }
  return median(times);
}

struct Model {
  std::string label;
  std::string scene;
  std::string virtual_bodies;
  std::array<double, 4> paper{};  ///< analysis sparse, full; solution sparse, full; 0: not in the paper
};

struct Cost {
  int unknowns = 0, nonzeros = 0;
  long iterations = 0, factorisations = 0;
  double flops = 0.0;     ///< of all factorisations and solutions
  double analysis = 0.0;  ///< CPU seconds of all steps
  double solution = 0.0;  ///< of them in factorisations and solutions
};

/// Factorisation: 2/3 n³ (dense), counted on the pattern (KLU); solution 2 n², 2 entries of L and U.
double flops(const mechanism::Model& model, const Cost& cost, bool sparse, double solutions) {
  const double n = model.pattern->size(), count = static_cast<double>(cost.factorisations);
  if (!sparse) return count * 2.0 / 3.0 * n * n * n + solutions * 2.0 * n * n;
  const mechanism::back_end::Effort effort = mechanism::back_end::klu_effort(*model.pattern);
  return count * effort.flops + solutions * 2.0 * effort.entries;
}

Cost measure(const std::string& folder, const Model& what, const std::string& solver) {
  std::vector<formats::Override> overrides;
  for (const std::string& setting : {"virtual_bodies=" + what.virtual_bodies, "integrator.linear_solver=" + solver})
    overrides.push_back(formats::parse_override(setting));
  const formats::Scene scene = formats::read_scene(folder + "/" + what.scene + ".scene.yaml", overrides);
  const mechanism::BodyFiles files = mechanism::read_body_files(scene);
  Cost cost;
  std::array<double, kRepetitions> times{};
  for (int repetition = 0; repetition < kRepetitions; ++repetition) {
    test_support::Simulation run(scene, files);
    run.start();
    const double begin = cpu_seconds();
    run.run(scene.integrator.end);
    times[static_cast<std::size_t>(repetition)] = cpu_seconds() - begin;
    if (repetition + 1 < kRepetitions) continue;
    const mechanism::Model& model = run.model();
    mechanism::Workspace& workspace = run.workspace;
    const auto c = mechanism::step_coefficients(mechanism::alpha_parameters(scene.integrator), scene.integrator.step);
    mechanism::evaluate(model, run.state(), workspace);
    mechanism::evaluate_tangent(model, run.state(), c, mechanism::TangentKind::step, {}, workspace);
    const double factor = seconds_of([&] {
      if (!workspace.solver.numeric(workspace.values).regular) throw std::runtime_error("singular");
    });
    Eigen::VectorXd right = Eigen::VectorXd::Ones(model.pattern->size());
    const double solve = seconds_of([&] {
      right.setOnes();
      workspace.solver.solve({right.data(), static_cast<std::size_t>(right.size())});
    });
    cost.unknowns = model.pattern->size();
    cost.nonzeros = model.pattern->nonzeros();
    cost.iterations = run.iterations;
    cost.factorisations = run.factorisations;
    // Stabilised index 2: one more solution per iteration, the correction of the positions.
    const double solutions = 2.0 * static_cast<double>(run.iterations);
    cost.solution = static_cast<double>(run.factorisations) * factor + solutions * solve;
    cost.flops = flops(model, cost, solver == "klu", solutions);
  }
  cost.analysis = median(times);
  return cost;
}

void print(const std::string& folder) {
  const std::vector<Model> models = {
      {"no virtual body", "virtual_0", "keep", {1.00, 1.19, 1.00, 1.17}},
      {"one, kept", "virtual_1", "keep", {1.08, 1.86, 1.03, 1.50}},
      {"two, kept", "virtual_2", "keep", {1.33, 2.40, 1.14, 2.04}},
      {"one, eliminated", "virtual_1", "eliminate", {}},
      {"two, eliminated", "virtual_2", "eliminate", {}},
  };
  std::vector<std::array<Cost, 2>> costs;
  for (const Model& model : models) costs.push_back({measure(folder, model, "klu"), measure(folder, model, "dense")});
  const Cost& first = costs.front()[0];
  fmt::print(
      "| virtual bodies | analysis, sparse | full | solution, sparse | full | paper: analysis, sparse | full | "
      "solution, "
      "sparse | full |\n| --- | --: | --: | --: | --: | --: | --: | --: | --: |\n");
  for (std::size_t i = 0; i < models.size(); ++i) {
    const auto& [sparse, full] = costs[i];
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |", models[i].label, sparse.analysis / first.analysis,
               full.analysis / first.analysis, sparse.solution / first.solution, full.solution / first.solution);
    for (const double value : models[i].paper)
      fmt::print("{}", value > 0.0 ? fmt::format(" {:.2f} |", value) : std::string(" |"));
    fmt::print("\n");
  }
  fmt::print(
      "\n| virtual bodies | solver | unknowns | nonzeros | iterations | factorisations | Mflop | analysis [ms] | "
      "solution "
      "[ms] |\n| --- | --- | --: | --: | --: | --: | --: | --: | --: |\n");
  for (std::size_t i = 0; i < models.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) {
      const Cost& c = costs[i][k];
      fmt::print("| {} | {} | {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} |\n", models[i].label,
                 k == 0 ? "sparse (KLU)" : "full LU", c.unknowns, c.nonzeros, c.iterations, c.factorisations,
                 1e-6 * c.flops, 1e3 * c.analysis, 1e3 * c.solution);
    }
}

}  // namespace
}  // namespace tisserand::benchmarks

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "Usage: table_3 <folder with virtual_*.scene.yaml and rod.superelement.h5>\n");
    return 2;
  }
  try {
    tisserand::benchmarks::print(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "table_3: {}\n", error.what());
    return 1;
  }
}
