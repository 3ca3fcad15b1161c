// SPDX-License-Identifier: GPL-3.0-or-later
// Beams of the verification page: NAFEMS problems and exact solutions of Euler and Timoshenko.
#include <functional>

#include "tests/problems/beam_vibration.hpp"
#include "tests/tables/page.hpp"

namespace tisserand::tables {
namespace {

using namespace reducer;

struct Mode {
  std::string quantity;
  int place;
  double target;
};

void add_rows(Problem& problem, Target kind, const std::vector<int>& elements,
              const std::function<Eigen::VectorXd(int)>& ours, const std::vector<Mode>& modes) {
  std::vector<Eigen::VectorXd> values;
  for (const int n : elements) values.push_back(ours(n));
  for (const Mode& mode : modes) {
    Row row{mode.quantity, "", mode.target, kind, {}};
    for (const Eigen::VectorXd& v : values) row.ours.push_back(v[mode.place]);
    problem.rows.push_back(row);
  }
}

Problem deep_beam_problem(const std::string& title, DeepBeamTorsion torsion, const std::string& targets) {
  Problem problem{
      title,
      "Frequencies [Hz]; columns: elements. 10 x 2 x 2 m, E 200e9, nu 0.3, rho 8000. End A is held along x, y and z "
      "and about x, end B along y and z. Targets: exact Timoshenko beam (shear factor 5/6), recomputed. " +
          targets,
      {"10", "20", "40"},
      {},
      ""};
  const Eigen::VectorXd exact = deep_beam_exact(torsion);
  std::vector<Mode> modes{{"3, torsion", 2, exact[2]}, {"7, torsion", 6, exact[6]}};
  if (torsion == DeepBeamTorsion::polar_moment)  // the others do not depend on it
    modes = {{"1 and 2, bending", 0, exact[0]}, modes[0], {"4, axial", 3, exact[3]},
             {"5 and 6, bending", 4, exact[4]}, modes[1], {"8 and 9, bending", 7, exact[7]}};
  add_rows(
      problem, Target::exact, {10, 20, 40}, [&](int n) { return deep_beam(torsion, n); }, modes);
  return problem;
}

}  // namespace

std::vector<Problem> beam_problems() {
  Problem frame{"NAFEMS FV3, free square frame",
                "Frequencies in the plane [Hz]; columns: elements per side. Sides of 10 m, square section of 0.25 m, E "
                "200e9, nu 0.3, rho 8000; Euler beams with rotary inertia. Targets: results of another program with 10 "
                "Euler beams per side. NAFEMS (from memory): 3.261 5.668 11.136 12.849 24.570 28.695.",
                {"5", "10", "20"},
                {},
                ""};
  add_rows(frame, Target::published, {5, 10, 20}, free_square_frame,
           {{"4", 3, 3.262},
            {"5", 4, 5.665},
            {"6 and 7", 5, 11.143},
            {"8", 7, 12.821},
            {"9", 8, 24.603},
            {"10 and 11", 9, 28.671}});
  Problem euler{"Euler beams",
                "Values of beta L without rotary inertia, beta^4 = rho A omega^2/(E I); columns: elements. Targets: "
                "exact roots of cos(beta L) cosh(beta L) = -1 (clamped-free) or 1.",
                {"4", "8", "16"},
                {},
                ""};
  const auto roots = [](BeamEnds ends) { return [ends](int n) { return euler_beam_roots(ends, n); }; };
  add_rows(euler, Target::exact, {4, 8, 16}, roots(BeamEnds::clamped_free),
           {{"clamped-free 1", 0, 1.8751040687},
            {"clamped-free 2", 1, 4.6940911330},
            {"clamped-free 3", 2, 7.8547574382},
            {"clamped-free 4", 3, 10.9955407349}});
  add_rows(euler, Target::exact, {4, 8, 16}, roots(BeamEnds::clamped_clamped),
           {{"clamped-clamped 1", 0, 4.7300407449},
            {"clamped-clamped 2", 1, 7.8532046241},
            {"clamped-clamped 3", 2, 10.9956078380}});
  add_rows(euler, Target::exact, {4, 8, 16}, roots(BeamEnds::free_free),
           {{"free-free 1", 0, 4.7300407449}, {"free-free 2", 1, 7.8532046241}, {"free-free 3", 2, 10.9956078380}});
  Problem timoshenko{"Timoshenko beam, simply supported",
                     "Frequencies [rad/s]; columns: elements. Steel, 1 x 0.1 x 0.1 m. Targets: the smaller "
                     "root of Timoshenko's frequency equation, exact.",
                     {"10", "20", "40"},
                     {},
                     ""};
  const Eigen::VectorXd exact = pinned_timoshenko_exact();
  add_rows(timoshenko, Target::exact, {10, 20, 40}, pinned_timoshenko_beam,
           {{"1", 0, exact[0]}, {"2", 1, exact[1]}, {"3", 2, exact[2]}});
  return {
      frame,
      deep_beam_problem("NAFEMS FV5, deep simply supported beam", DeepBeamTorsion::polar_moment,
                        "The torsion constant is Iy + Iz, as NAFEMS assumes. NAFEMS prints 42.649 77.542 125.00 148.31 "
                        "233.10 284.55. Its bending frequencies are 0.1, 0.35 and 0.8 % above the exact ones."),
      deep_beam_problem("R0016 test 5, deep beam with the true torsion constant", DeepBeamTorsion::torsion_constant,
                        "The torsion constant is 0.140577 a^4 for a square of side a. Only the torsion modes differ "
                        "from FV5. R0016 prints 42.650 71.200 125.00 148.15 213.61 283.47."),
      euler, timoshenko};
}

}  // namespace tisserand::tables
