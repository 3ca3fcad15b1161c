// SPDX-License-Identifier: GPL-3.0-or-later
// Data: the cases.
#include "tests/stability/catalogue.hpp"

#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "tests/support/bodies/lumped_bodies.hpp"

namespace tisserand::stability {
namespace {

using Kind = Criterion::Kind;
constexpr double g = 9.81;
constexpr double pi = std::numbers::pi;

/// θ at `time` of θ̈ = −k cos θ by Runge and Kutta's scheme in 20000 steps: exact to 1e-10.
double swing(double k, double angle, double rate, double time) {
  const int steps = 20000;
  const double h = time / steps;
  for (int i = 0; i < steps; ++i) {
    const auto a = [k](double theta) { return -k * std::cos(theta); };
    const double k1 = rate, l1 = a(angle);
    const double k2 = rate + h / 2 * l1, l2 = a(angle + h / 2 * k1);
    const double k3 = rate + h / 2 * l2, l3 = a(angle + h / 2 * k2);
    const double k4 = rate + h * l3, l4 = a(angle + h * k3);
    angle += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    rate += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
  }
  return angle;
}

Criterion length_at_end(const std::string& channel, double expected, double tolerance) {
  return {Kind::end, {{1.0, channel}}, expected, tolerance, true};
}

/// The rod of the flexible cases, of the given nodes.
std::string superelement(const std::string& file, const std::string& rest) {
  return fmt::format("bodies.rod={{type: superelement, file: {}.superelement.h5, {}}}", file, rest);
}

const std::string rigid_rod =
    "bodies.rod={type: rigid, mass: 2.450442270, center_of_mass: [0.5, 0, 0], inertia: [1.2252e-4, 0.204265, "
    "0.204265], "
    "nodes: {start: {position: [0, 0, 0]}, end: {position: [1, 0, 0]}}}";
const std::string beam_rod =
    "bodies.rod={type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 8, section: {shape: circle, radius: 0.01}, "
    "material: {E: 2.1e11, nu: 0.3, density: 7800}}";

std::vector<Formulation> rods(const std::string& rigid_is_impossible) {
  return {{"B", {}, ""},
          {"A", {superelement("rod", "inertia: A")}, ""},
          {"M", {superelement("rod", "inertia: M")}, ""},
          {"second order", {superelement("rod", "second_order: on")}, ""},
          {"beams", {beam_rod}, ""},
          {"modal", {"bodies.rod={type: modal, file: rod.modal.h5}"}, ""},
          {"rigid", {rigid_rod}, rigid_is_impossible}};
}

/// Frames, weights and boundary nodes, of inertia B.
std::vector<Formulation> boundaries() {
  return {{"two nodes", {}, ""},
          {"frame: paper", {superelement("rod", "frame: paper, second_order: off")}, ""},
          {"frame at a node", {superelement("rod", "frame: {node: start}, inertia: B")}, ""},
          {"negative weight",
           {superelement(
               "rod", "inertia: B, weights: {positions: {start: 1.5, end: -0.5}, rotations: {start: 1.5, end: -0.5}}")},
           ""},
          {"five nodes in a line", {superelement("rod_line", "inertia: B")}, ""},
          {"two close nodes", {superelement("rod_near", "inertia: B")}, ""},
          {"mass far from the nodes", {superelement("rod_base", "inertia: B")}, ""},
          {"one node", {superelement("rod_one", "inertia: B")}, ""}};
}

std::vector<Case> four_bars() {
  std::vector<Case> cases;
  for (const auto& [windows, angle] : {std::pair{2, -12.68425959}, std::pair{10, -12.64416097}})
    cases.push_back(
        {.name = fmt::format("four-bar, {} windows", windows),
         .scene = "four_bar",
         .settings = {fmt::format("parameters.windows={}", windows)},
         .criteria = {at_end("joints/coordinate/upright[0]/foot", angle, 2e-2), balance(1e-3)},
         .source = "IFToMM library A02: angle of the uprights from an exact equation of motion of one coordinate",
         .quick = windows == 2});
  const double n = 80;
  cases.push_back({.name = "four-bar, 80 windows",
                   .scene = "four_bar",
                   .settings = {"parameters.windows=80", "integrator.end=1"},
                   .criteria = {at_end("joints/coordinate/upright[0]/foot",
                                       swing(g * ((n + 1) / 2 + n) / ((n + 1) / 3 + n), pi / 2, -1, 1) - pi / 2, 2e-2),
                                balance(1e-3)},
                   .source = "exact equation of motion of one coordinate, integrated by a Runge-Kutta method",
                   .quick = false});
  cases.push_back({.name = "Bricard's mechanism",
                   .scene = "bricard",
                   .settings = {},
                   .criteria = {at_end("nodes/position/bar2/P3/x", -0.967200, 2e-3),
                                at_end("nodes/position/bar2/P3/y", -1.228020, 2e-3),
                                at_end("nodes/position/bar2/P3/z", 0.745983, 2e-3), balance(1e-3)},
                   .source = "IFToMM library A04: run of an independent program with a finer step",
                   .scales = false});
  return cases;
}

std::vector<Case> slider_cranks() {
  std::vector<Case> cases;
  for (const double longer : {0.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const double rod = 1 + longer;
    const double x =
        longer == 0.0 ? 2 * std::cos(3.0) : std::cos(3.0) + std::sqrt(rod * rod - std::pow(std::sin(3.0), 2));
    cases.push_back(
        {.name = longer == 0.0 ? "slider-crank, l = r" : fmt::format("slider-crank, l = r (1 + {:g})", longer),
         .scene = "slider_crank",
         .settings = {fmt::format("parameters.longer={:g}", longer)},
         .criteria = {length_at_end("nodes/position/slider/x", x, 1e-3)},
         .source = longer == 0.0 ? "geometry: inertia carries the slider past the singular position"
                                 : "geometry: the longer rod cannot turn over",
         .quick = longer == 0.0 || longer == 1e-2});
  }
  return cases;
}

std::vector<Case> pendulums() {
  std::vector<Case> cases;
  cases.push_back({.name = "pendulum",
                   .scene = "pendulum",
                   .settings = {},
                   .criteria = {length_at_end("nodes/position/bob/x", -0.27508746, 2e-3),
                                length_at_end("nodes/position/bob/y", -0.96141921, 2e-3), balance(1e-3)},
                   .source = "IFToMM library A01"});
  for (const double step : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const double end = 100 * step, angle = swing(-g, 0, 0, end);
    cases.push_back({.name = fmt::format("pendulum, step {:g}, index 3", step),
                     .scene = "pendulum",
                     .settings = {fmt::format("integrator.step={:g}", step), fmt::format("integrator.end={:g}", end),
                                  "integrator.formulation=index3", "output={channels: [nodes, energy]}"},
                     .criteria = {length_at_end("nodes/position/bob/x", -std::cos(angle), 2e-3),
                                  length_at_end("nodes/acceleration/bob/y", -g * (1 - 3 * std::pow(std::sin(angle), 2)),
                                                step > 1e-3 ? 0.1 : 1e-2)},
                     .source = "pendulum equation; the acceleration shows how 1/h^2 amplifies round-off"});
  }
  for (const auto& [steps, thousands] : {std::pair{"100 000", 100}, {"1 000 000", 1000}})
    cases.push_back(
        {.name = fmt::format("pendulum, {} steps", steps),
         .scene = "pendulum",
         .settings = {fmt::format("integrator.end={}", 2 * thousands), "output.interval=1"},
         .criteria = {balance(1e-2),
                      {Kind::length, {{1.0, "nodes/position/bob/x"}, {1.0, "nodes/position/bob/y"}}, 1.0, 1e-8}},
         .source = "conservation of energy; constant length of the rod",
         .scales = false,
         .quick = false});
  cases.push_back({.name = "massless chain",
                   .scene = "virtual_chain",
                   .settings = {},
                   .criteria = {at_end("joints/coordinate/hinge", swing(0.75 * g, 0, 0, 2), 2e-3), balance(1e-3)},
                   .source = "physical pendulum: the chain moves like a rigid body"});
  const double heavy = swing(g / 1.1, 0, 0, 2);
  for (const double ratio : {1e-10, 1e-5})
    cases.push_back({.name = fmt::format("mass ratio {:g}", ratio),
                     .scene = "mass_ratio",
                     .settings = {fmt::format("parameters.ratio={:g}", ratio)},
                     .criteria = {at_end("joints/coordinate/hinge", heavy, 2e-3), balance(1e-3)},
                     .source = "the heavy pendulum moves as if it were alone"});
  cases.push_back({.name = "axis without inertia",
                   .scene = "needle",
                   .settings = {},
                   .criteria = {length_at_end("nodes/position/rod/x", 0.5 * std::cos(swing(1.5 * g, 0, 0, 2)), 2e-3),
                                balance(1e-3)},
                   .source = "physical pendulum"});
  cases.push_back({.name = "whip",
                   .scene = "whip",
                   .settings = {},
                   .criteria = {balance(1e-2)},
                   .source = "conservation of energy",
                   .quick = false});
  return cases;
}

std::vector<Case> free_flights() {
  std::vector<Case> cases;
  const auto add = [&](const char* name, double end, bool quick) {
    cases.push_back(
        {.name = fmt::format("top in free flight, {}", name),
         .scene = "top",
         .settings = {fmt::format("integrator.end={:g}", end), fmt::format("output.interval={:g}", end / 100)},
         .criteria = {length_at_end("nodes/position/top/x", 0.01 * end, 1e-8 * end),
                      length_at_end("nodes/position/top/tip/z", std::sqrt(0.75), 1e-3), balance(1e-3)},
         .source = "conservation of momentum; constant angle between axis and angular momentum",
         .quick = quick});
    std::vector<Criterion> momentum;
    for (const auto& [direction, value, place] : {std::tuple{'x', 6.0, 5.0}, {'y', 19.5, 3.0}, {'z', -5.0, 0.0}})
      for (const auto& [channel, expected] :
           {std::pair{"nodes/velocity", value}, std::pair{"nodes/position", place + value * end}}) {
        Criterion& sum = momentum.emplace_back(Kind::end, std::vector<Criterion::Term>{}, expected, 1e-6 * end, true);
        for (const auto& [mass, body] : {std::pair{1.0, "one"}, {2.0, "two"}, {3.0, "three"}})
          sum.terms.push_back({mass, fmt::format("{}/{}/{}", channel, body, direction)});
      }
    momentum.push_back(balance(1e-2));
    cases.push_back(
        {.name = fmt::format("chain in free flight, {}", name),
         .scene = "flying_chain",
         .settings = {fmt::format("integrator.end={:g}", end), fmt::format("output.interval={:g}", end / 100)},
         .criteria = momentum,
         .source = "conservation of momentum; straight path of the centre of mass",
         .quick = quick});
  };
  add("1000 steps", 2, true);
  add("100 000 steps", 200, false);
  return cases;
}

std::vector<Case> springs_and_contacts() {
  const std::string half_swings =
      "each half swing is shorter by 2 mu g/omega^2; the block sticks at the end of the fifth, within mu g/omega^2 of "
      "the middle";
  std::vector<Case> cases;
  cases.push_back({.name = "stiffness ratio 1e12",
                   .scene = "stiff_spring",
                   .settings = {},
                   .criteria = {length_at_end("nodes/position/a/x", 0, 2e-3), balance(1e-2)},
                   .source = "both masses move as one at 1 rad/s; the mode at 1.4e6 rad/s is at rest"});
  cases.push_back(
      {.name = "mode at 1.4e6 rad/s that moves",
       .scene = "stiff_spring",
       .settings = {"parameters.kick=1e-6"},
       .criteria = {length_at_end("nodes/position/a/x", 0, 2e-3), balance(1e-2)},
       .source = "the mode at 1.4e6 rad/s has as much energy as the slow one; a step of 1e-3 s cannot preserve it"});
  cases.push_back({.name = "159 turns",
                   .scene = "rotor",
                   .settings = {},
                   .criteria = {at_end("joints/coordinate/axle", 1000, 0.1), balance(1e-3)},
                   .source = "constant angular velocity"});
  cases.push_back({.name = "3.1 rad per step",
                   .scene = "rotor",
                   .settings = {"parameters.rate=310", "integrator.step=0.01"},
                   .criteria = {at_end("joints/coordinate/axle", 3100, 0.3), balance(1e-3)},
                   .source = "constant angular velocity"});
  cases.push_back({.name = "4 rad per step",
                   .scene = "rotor",
                   .settings = {"parameters.rate=400", "integrator.step=0.01"},
                   .criteria = {at_end("joints/coordinate/axle", 4000, 0.4), balance(1e-3)},
                   .source = "constant angular velocity"});
  cases.push_back({.name = "friction that reverses and sticks",
                   .scene = "friction",
                   .settings = {},
                   .criteria = {length_at_end("nodes/position/block/x", 0.1019, 5e-4), balance(1e-2)},
                   .source = half_swings});
  cases.push_back({.name = "friction, step 0.05",
                   .scene = "friction",
                   .settings = {"parameters.step=0.05"},
                   .criteria = {length_at_end("nodes/position/block/x", 0.1019, 5e-4), balance(1e-2)},
                   .source = half_swings});
  cases.push_back({.name = "ball that bounces",
                   .scene = "bounce",
                   .settings = {},
                   .criteria = {length_at_end("nodes/position/ball/z", 0.5, 2e-3), balance(1e-2)},
                   .source = "the ball returns to the height from which it fell"});
  cases.push_back({.name = "ball that bounces, step 0.01",
                   .scene = "bounce",
                   .settings = {"integrator.step=0.01"},
                   .criteria = {length_at_end("nodes/position/ball/z", 0.5, 2e-3), balance(1e-2)},
                   .source = "the ball returns to the height from which it fell; the contact lasts 3 ms"});
  cases.push_back({.name = "impulse and jump of loads",
                   .scene = "impulse",
                   .settings = {},
                   .criteria = {length_at_end("nodes/velocity/hit/x", 1, 2e-3),
                                length_at_end("nodes/position/pushed/x", 0.25, 1e-3), balance(1e-2)},
                   .source = "conservation of momentum; constant acceleration"});
  return cases;
}

std::vector<Case> rods_in_motion() {
  constexpr double E = 2.1e11, I = pi / 4 * 1e-8, critical = pi * pi * E * I / 4;
  std::vector<Case> cases;
  const double angle = swing(1.5 * g, 0, 0, 2);
  cases.push_back({.name = "rod pendulum",
                   .scene = "rod_pendulum",
                   .settings = {},
                   .criteria = {at_end("joints/coordinate/hinge", angle, 2e-2), balance(1e-2)},
                   .source = "motion of a rigid rod; the real rod bends by only 1e-3 of its length",
                   .formulations = rods(""),
                   .scales = false});
  cases.push_back({.name = "rod pendulum, boundaries",
                   .scene = "rod_pendulum",
                   .settings = {},
                   .criteria = {at_end("joints/coordinate/hinge", angle, 2e-2), balance(1e-2)},
                   .source = "motion of a rigid rod; the real rod bends by only 1e-3 of its length",
                   .formulations = boundaries(),
                   .scales = false});
  const std::string gate = "bodies.gate={type: superelement, file: gate";
  cases.push_back(
      {.name = "gate, coplanar nodes",
       .scene = "gate",
       .settings = {},
       // Sides of mass m/4 about one of them: J = 5/12 m a^2, mass centre at a/2.
       .criteria = {at_end("energy/potential", 4 * 7800 * pi * 1e-4 * g / 2 * std::sin(swing(1.2 * g, 0, 0, 2)),
                           4 * 7800 * pi * 1e-4 * g / 2 * 2e-2),
                    balance(1e-2)},
       .source = "physical pendulum about one side; the gate bends by only 1e-3 of its side",
       .formulations = {{"B", {}, ""},
                        {"A", {gate + ".superelement.h5, inertia: A}"}, ""},
                        {"M", {gate + ".superelement.h5, inertia: M}"}, ""},
                        {"translations only", {gate + "_points.superelement.h5, inertia: B}"}, ""},
                        {"one node with rotations only", {gate + "_apart.superelement.h5, inertia: B}"}, ""}},
       .scales = false});
  cases.push_back({.name = "drive that moves at the start",
                   .scene = "driven_rod",
                   .settings = {},
                   .criteria = {at_end("nodes/position/rod/end/x", std::cos(5.0), 5e-3), balance(1e-2)},
                   .source = "the rod turns like a rigid rod, from the start on",
                   .formulations = rods(""),
                   .scales = false});
  // A cantilever of length 1 under P along and F across: δ = F (tan k − k)/(k P), k² = P/EI.
  for (const double share : {0.01, 0.5, 0.9}) {
    const double P = share * critical, k = std::sqrt(P / (E * I)), deflection = 10 * (std::tan(k) - k) / (k * P);
    cases.push_back({.name = fmt::format("column, {:g} of its buckling load", share),
                     .scene = "column",
                     .settings = {fmt::format("parameters.axial={:.10g}", P)},
                     .criteria = {at_end("nodes/position/rod/end/y", deflection, 0.03 * deflection)},
                     .source = "Euler's beam-column: F (tan kL - kL)/(k P)",
                     .formulations = rods("a rigid body does not bend"),
                     .takes_steps = false,
                     .scales = false});
  }
  const double weight = 7800 * pi * 1e-4 * g;
  for (const double rate : {2.0, 50.0, 200.0}) {
    const double sag = weight / (8 * E * I);
    // Converged sag: 0.9.. of the resting one is left by centrifugal stiffening; Southwell's quotient for the mode of
    // the resting sag, ω₁² = 12.46 EI/(m L⁴) and 1.193 Ω², differs from beams by less than 3 %.
    const double omega2 = 12.362 * E * I / (7800 * pi * 1e-4);
    cases.push_back({.name = fmt::format("spinning rod, {:g} rad/s", rate),
                     .scene = "spinning_rod",
                     .settings = {fmt::format("parameters.rate={:g}", rate)},
                     .criteria = {at_end("nodes/position/rod/end/z", -sag / (1 + 1.193 * rate * rate / omega2),
                                         0.1 * sag / (1 + 1.193 * rate * rate / omega2))},
                     .source = "Southwell's formula with the factor 1.193; the first frequency is 55 rad/s",
                     .formulations = rods("a rigid body does not bend"),
                     .takes_steps = false,
                     .scales = false});
  }
  return cases;
}

/// Both halves with the rest of the keys of a superelement.
std::vector<std::string> halves(const std::string& rest) {
  return {
      fmt::format("bodies.inner={{type: superelement, file: soft_half.superelement.h5, {}}}", rest),
      fmt::format("bodies.outer={{type: superelement, file: soft_half.superelement.h5, pose: {{position: [5, 0, 0]}}, "
                  "{}}}",
                  rest)};
}

std::vector<Case> beyond_the_linear_range() {
  std::vector<Case> cases;
  cases.push_back({.name = "blade of two halves, soft in torsion",
                   .scene = "soft_blade",
                   .settings = {},
                   .criteria = {at_end("nodes/position/outer/tip/x", 10 * std::cos(75.0), 0.05),
                                at_end("nodes/position/outer/tip/y", 10 * std::sin(75.0), 0.05),
                                at_end("nodes/position/outer/tip/z", 0, 1e-3), balance(1e-2)},
                   .source = "beam of Simo and Vu-Quoc at 6 rad/s: it stays in its plane, within 0.0037 of the line "
                             "that turns with its root",
                   .formulations = {{"B", {}, ""},
                                    {"A", halves("inertia: A"), ""},
                                    {"M", halves("inertia: M"), ""},
                                    {"second order", halves("second_order: on"), ""}},
                   .scales = false,
                   .quick = false});
  cases.push_back(
      {.name = "rod rolled up by a moment",
       .scene = "roll_up",
       .settings = {},
       .criteria = {at_end("nodes/position/rod/end/x", 0, 2e-2), at_end("nodes/position/rod/end/y", 0, 2e-2)},
       .source = "full circle at the moment 2 pi EI/L",
       .formulations = rods("a rigid body does not bend"),
       .takes_steps = false,
       .scales = false});
  return cases;
}

}  // namespace

Criterion balance(double tolerance) { return {Kind::balance, {}, 0.0, tolerance, false}; }
Criterion at_end(const std::string& channel, double expected, double tolerance) {
  return {Kind::end, {{1.0, channel}}, expected, tolerance, false};
}

std::vector<Case> catalogue() {
  std::vector<Case> all;
  for (auto&& some : {four_bars(), slider_cranks(), pendulums(), free_flights(), springs_and_contacts(),
                      rods_in_motion(), beyond_the_linear_range(), states_and_loops()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

std::vector<Part> parts() {
  return {{"rod", "rod", {}},
          {"rod_line", "rod", {"boundary=[start, near, quarter, middle, end]"}},
          {"rod_near", "rod", {"boundary=[start, near, end]"}},
          {"rod_base", "rod", {"boundary=[start, near]"}},
          {"rod_one", "rod", {"boundary=[start]"}},
          {"gate", "gate", {}},
          {"gate_points", "gate", {"boundary={a: translations, b: translations, c: translations, d: translations}"}},
          {"gate_apart", "gate", {"boundary={a: translations, b: translations, c: rotations, d: translations}"}},
          {"soft_half", "soft_half", {}},
          {"four_bar_crank", "four_bar_crank", {}},
          {"four_bar_coupler", "four_bar_coupler", {}},
          {"four_bar_rocker", "four_bar_rocker", {}}};
}

void write_modal_rod(const std::string& path) {
  test_support::Rod rod;
  rod.area = pi * 1e-4;
  rod.I = pi / 4 * 1e-8;
  rod.E = 2.1e11;
  rod.G = rod.E / 2.6;
  rod.density = 7800;
  rod.elements = 16;
  test_support::LumpedModel model = test_support::lumped_rod(rod);
  model.name.front() = "start";
  model.name.back() = "end";
  formats::write_modal_body(path, test_support::modal_body(model, {{0, 0, 0, 0, 0, 0}, {0, 1, 2, 3, 4, 5}}, 8));
}

}  // namespace tisserand::stability
