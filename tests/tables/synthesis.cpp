// Component mode synthesis of the page of verification: the truss in two components, and the laws of the reduction.
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/reducer/parts.hpp"
#include "tests/reducer/reduction_laws.hpp"
#include "tests/reducer/truss.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/tables/page.hpp"

namespace tisserand::tables {
namespace {

using test_support::reference_rows;
using testing::assembled_frequencies;

const std::string truss_source =
    "48 grids, 117 bars without shear, four boundary grids (pyYeti, BSD-3, commit 034fb7b); one element per bar. ";

Problem full_truss(const Eigen::VectorXd& full) {
  Problem problem{
      "Truss, both components as one part",
      truss_source +
          "Frequencies [Hz]. Targets: an independent program with ordinary consistent mass, computed, eight "
          "decimals; NASTRAN (no torsional inertia) differs by up to 1.2e-4.",
      {"117 bars"},
      {},
      ""};
  const auto expected = reference_rows("truss/full_consistent_frequencies.csv");
  for (std::size_t k = 6; k < 26; ++k)
    problem.rows.push_back({fmt::format("mode {}", k + 1),
                            "beam",
                            expected[k][1],
                            Target::published,
                            {full[static_cast<Eigen::Index>(k)]}});
  return problem;
}

Problem held_components() {
  Problem problem{"Truss, components with held boundary",
                  truss_source +
                      "Fixed-interface frequencies below 50 Hz [Hz]. Targets: NASTRAN, read; its bars have no "
                      "torsional inertia, which makes up to 2e-4.",
                  {"components"},
                  {},
                  ""};
  std::ifstream file(TISSERAND_REFERENCES "/truss/frequencies.json");
  const nlohmann::json expected = nlohmann::json::parse(file);
  for (const auto& [component, modes] : {std::pair{"inboard", 3}, std::pair{"outboard", 16}}) {
    const auto f = testing::reduce(testing::truss({component}, modes)).file.fixed_frequency;
    const nlohmann::json& nastran = expected.at(std::string(component) + "_fixed_interface_below_50_Hz");
    for (std::size_t k = 0; k < f.size(); ++k)
      problem.rows.push_back(
          {fmt::format("{} {}", component, k + 1), "beam", nastran[k].get<double>(), Target::published, {f[k]}});
  }
  return problem;
}

/// The largest error of the modes 7 to 15 and 7 to 25 where they exist.
Problem truss_errors(const Eigen::VectorXd& full) {
  Problem problem{"Truss, error of the reduction",
                  truss_source +
                      "Largest relative error of the joined frequencies when each component keeps its modes "
                      "below a cut-off. Targets: an independent program, computed.",
                  {"reduced"},
                  {},
                  ""};
  for (const std::vector<double>& row : reference_rows("truss/craig_bampton_errors.csv")) {
    const Eigen::VectorXd f = assembled_frequencies(static_cast<int>(row[1]), static_cast<int>(row[2]));
    for (const int last : {15, 25}) {
      if (f.size() < last || row[0] < 12.0 || (row[0] < 50.0 && last == 25)) continue;
      double ours = 0.0, expected = 0.0;
      for (int mode = 7; mode <= last; ++mode) {
        ours = std::max(ours, f[mode - 1] / full[mode - 1] - 1.0);
        expected = std::max(expected, row[static_cast<std::size_t>(mode) - 4]);
      }
      problem.rows.push_back(
          {fmt::format("below {:g} Hz ({:g} + {:g} modes): modes 7 to {}", row[0], row[1], row[2], last),
           "beam",
           expected,
           Target::published,
           {ours}});
    }
  }
  return problem;
}

}  // namespace

std::vector<Problem> synthesis_problems() {
  const Eigen::VectorXd full = testing::full_frequencies();
  return {full_truss(full), held_components(), truss_errors(full)};
}

Laws synthesis_laws() {
  const testing::RitzLaws ritz = testing::ritz_laws();
  const testing::BoundaryLaws boundary = testing::boundary_laws();
  const std::string frame = "space frame, 18 boundary coordinates";
  return {
      "Properties of the reduction",
      "Craig-Bampton must have them exactly ([CB68]; the bound: Elssel and Voss 2006). Twelve elastic modes, floating, "
      "with 0, 1, 4, 10, 20, 40 and all internal modes. Limits: round-off, and 1 for the share of the bound.",
      {{"a) squared frequencies below the full ones", frame, std::max(ritz.below_full, 0.0), 1e-10},
       {"a) growth when modes are added", frame, std::max(ritz.growth, 0.0), 1e-10},
       {"b) all modes kept: difference from the full model", frame, ritz.all_modes, 1e-9},
       {"c) rigid mass matrix, no modes", frame, boundary.rigid_mass, 1e-12},
       {"c) reduced stiffness times rigid motions", frame, boundary.rigid_stiffness, 1e-12},
       {"d) static flexibility of the boundary, no modes", frame, boundary.flexibility, 1e-9},
       {"e) effective mass of all modes", frame, boundary.effective_mass, 1e-8},
       {"f) largest error over its a-priori bound", frame, ritz.share_of_bound, 1.0}}};
}

}  // namespace tisserand::tables
