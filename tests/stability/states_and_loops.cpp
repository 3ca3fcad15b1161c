// SPDX-License-Identifier: GPL-3.0-or-later
// Data: cases of equilibria, of rows that change and of loops.
#include <cmath>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "tests/stability/catalogue.hpp"

namespace tisserand::stability {
namespace {

/// Statics without a choice of bodies.
std::vector<Formulation> as_it_is() { return {{"as written", {}, ""}}; }

/// A beam of so many elements in place of the scene's.
Formulation elements(const std::string& parameters, int count, int nodes) {
  return {fmt::format("{} elements of {} nodes", count, nodes),
          {fmt::format("{}.n={}", parameters, count), fmt::format("{}.npe={}", parameters, nodes)},
          ""};
}

std::vector<Case> beams_under_load() {
  std::vector<Case> cases;
  cases.push_back(
      {.name = "catenary of beams",
       .scene = "catenary",
       .settings = {},
       .criteria = {at_end("joints/force/left/x", -33.173, 0.034)},
       .source = "catenary of 10 m between pins 8 m apart, a = 3.382 m, EA = 1e6 N",
       .formulations = {elements("parameters", 20, 2), elements("parameters", 80, 2), elements("parameters", 40, 3)},
       .takes_steps = false,
       .scales = false});
  // θ = T L/(G J − N I_p/A), N compression positive, of a cruciform of four flanges 50 x 2 mm.
  const double b = 0.05, t = 0.002, G = 7e10 / 2.6, A = 4 * b * t, J = 4 * b * t * t * t / 3,
               I = 2 * t * b * b * b * 4 / 12;
  for (const double share : {-2.0, 0.5, 0.9}) {
    const double N = share * G * J * A / (2 * I);
    cases.push_back({.name = fmt::format("twist under {:g} of the torsional buckling load", share),
                     .scene = "cruciform_twist",
                     .settings = {fmt::format("parameters.axial={:.10g}", N)},
                     .criteria = {at_end("joints/coordinate/turn/angle", 1e-3 / (G * J * (1 - share)),
                                         2e-2 * 1e-3 / (G * J * (1 - share)))},
                     .source = "Wagner's formula T L/(G J - N I_p/A)",
                     .formulations = as_it_is(),
                     .takes_steps = false,
                     .scales = false});
  }
  return cases;
}

std::vector<Case> equilibria() {
  std::vector<Case> cases;
  for (const double angle : {1.0, 30.0, 120.0, 170.0})
    cases.push_back({.name = fmt::format("hanging pendulum, {:g} degrees off", angle),
                     .scene = "fail2_hanging_statics",
                     .settings = {fmt::format("bodies.arm.pose.orientation.angle_deg={:g}", angle)},
                     .criteria = {at_end("joints/coordinate/hinge", -angle * std::numbers::pi / 180, 1e-6)},
                     .source = "the pendulum hangs straight down",
                     .formulations = as_it_is(),
                     .takes_steps = false,
                     .scales = false});
  // The elastica with shear and axial strain, 0.01 N across: where the straight column is unstable.
  for (const auto& [load, x, z] : {std::tuple{300.0, 0.627349, 0.701562}, {2000.0, 0.453514, -0.543989}})
    cases.push_back(
        {.name = fmt::format("column leaves its unstable equilibrium, {:g} N", load),
         .scene = "elastica",
         .settings = {fmt::format("parameters.weight={:g}", load)},
         .criteria = {at_end("nodes/position/rod/40/x", x, 1e-4), at_end("nodes/position/rod/40/z", z, 1e-4)},
         .source = "elastica by elliptic integrals",
         .formulations = as_it_is(),
         .takes_steps = false,
         .scales = false});
  // A block of 1 kg on a guide that turns with the scene: r = k r₀/(k − m Ω²).
  for (const double rate : {5.0, 30.0})
    cases.push_back({.name = fmt::format("steady turn with a guide, {:g} rad/s", rate),
                     .scene = "turning_guide",
                     .settings = {fmt::format("parameters.rate={:g}", rate)},
                     .criteria = {at_end("joints/coordinate/guide", rate * rate / (1e3 - rate * rate), 1e-6)},
                     .source = "balance of a spring of 1000 N/m with the centrifugal force m r W^2",
                     .formulations = as_it_is(),
                     .takes_steps = false,
                     .scales = false});
  return cases;
}

std::vector<Case> loops() {
  // A parallelogram: the coupler keeps its direction. The hinge that is out of line asks for 1e-4 m of deformation.
  const double angle = std::numbers::pi / 2 - 0.6 * 11.75;
  const auto effects = [](const std::string& which) { return std::vector<std::string>{"effects=" + which}; };
  return {{.name = "Bennett's linkage",
           .scene = "bennett",
           .settings = {},
           .criteria = {at_end("joints/coordinate/j1", 1.1044, 5e-3), balance(1e-2)},
           .source = "radau (tolerance 1e-9) and index 3 agree; the constraint rows chosen at the start become "
                     "singular at 1.504 s",
           .scales = false,
           .quick = false},
          {.name = "four-bar with a misaligned hinge",
           .scene = "four_bar_misaligned",
           .settings = {},
           .criteria = {at_end("nodes/position/coupler/tip/x", 0.24 + 0.12 * std::cos(angle), 2e-3),
                        at_end("nodes/position/coupler/tip/y", 0.12 * std::sin(angle), 2e-3), balance(1e-2)},
           .source = "geometry of the parallelogram",
           .formulations = {{"all effects", {}, ""},
                            {"flexibility auto", effects("{flexibility: auto}"), ""},
                            {"stiffening auto", effects("{stiffening: auto}"), ""},
                            {"both auto", effects("{flexibility: auto, stiffening: auto}"), ""}},
           .scales = false,
           .quick = false}};
}

}  // namespace

std::vector<Case> states_and_loops() {
  std::vector<Case> all;
  for (auto&& some : {beams_under_load(), equilibria(), loops()}) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace tisserand::stability
