// SPDX-License-Identifier: GPL-3.0-or-later
// Load cases of a part end to end: statics of the reduced body in a mechanism against `reducer solve` on the same part.
#include <gtest/gtest.h>

#include "tests/preload/preloaded_scenes.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/solve/solving.hpp"

namespace tisserand::preload::part_load_test {
namespace {

using Eigen::Vector3d;
using test_support::Simulation;

/// A bent sheet with a rib, clamped at its hub, of which the mechanism sees hub, tip and a corner.
const std::string sheet = R"(part: sheet
materials: {m: {E: 7e10, nu: 0.3, density: 2700}}
sections: {bar: {shape: rectangle, width: 0.02, height: 0.03}}
points: {corner: [0.8, 0.3, 0.0], tip: [0.8, 0.0, 0.0]}
plates:
  deck: {corners: [[0, 0, 0], [0.8, 0, 0], [0.8, 0.3, 0], [0, 0.3, 0]], elements: [8, 3], thickness: 0.004, material: m}
  wall: {corners: [[0, 0, 0], [0.8, 0, 0], [0.8, 0, 0.1], [0, 0, 0.1]], elements: [8, 2], thickness: 0.003, material: m}
spiders: {hub: {kind: rigid, on: [deck/edge4, wall/edge4]}}
boundary: [hub, tip, corner]
supports: {hub: all}
load_cases:
  press: {pressures: {deck: 10, wall: -20}}
  edge: {line_loads: {deck/edge3: [1, -2, 3]}}
  fall: {gravity: [0.5, 0, -9.81]}
modes: 4
second_order: yes
)";

struct Motion {
  Vector3d tip, corner;
};

/// In a mechanism, clamped at the hub, under `factor` times the load case.
Motion in_mechanism(const formats::Part& part, const testing::ReducedPart& reduced, const std::string& load_case,
                    double factor, bool second_order) {
  formats::Scene scene = static_scene(second_order);
  const auto place = [&](int node) { return Vector3d(reduced.element.node_position.row(node).transpose()); };
  scene.units = part.units;
  scene.joints = {support("hub", place(0), {true, true, true, true, true, true})};
  scene.part_loads = {{"load", "part", load_case, factor, "test"}};
  Simulation run(scene, files_of(reduced));
  solve(run);
  return {run.position("part/tip") - place(1), run.position("part/corner") - place(2)};
}

double difference(const Motion& a, const Motion& b) {
  return std::max((a.tip - b.tip).norm(), (a.corner - b.corner).norm()) / std::max(b.tip.norm(), b.corner.norm());
}

// Static modes of the boundary and Φᵀ f are exact at the boundary, whatever the modes: what is left of the linear body
// is the turn of its frame, and of the second-order one the stiffening, both of the order of the load.
TEST(PartLoads, StaticsOfTheReducedBodyAreThoseOfTheSolvedPart) {
  const formats::Part part = testing::part_of_text(sheet);
  const reducer::Solution solution = testing::solved(part, 0);
  const reducer::Reduction reduction = testing::reduce(part);
  testing::ReducedPart reduced{reduction.superelement, *reduction.companion};
  reduced.element.content_id = formats::content_id(reduced.element);
  for (int c = 0; c < 3; ++c) {
    const std::string name = part.load_cases[static_cast<std::size_t>(c)].name;
    const Motion full{testing::motion_of(solution, "tip", c).head<3>(),
                      testing::motion_of(solution, "corner", c).head<3>()};
    for (const bool second_order : {false, true}) {
      const auto error = [&](double factor) {
        Motion m = in_mechanism(part, reduced, name, factor, second_order);
        m.tip /= factor, m.corner /= factor;
        return difference(m, full);
      };
      const double small = error(0.01);
      EXPECT_LT(small, 1e-4) << name << second_order;
      EXPECT_NEAR(error(0.1) / small, 10.0, 0.2) << name << second_order;
    }
  }
}

}  // namespace
}  // namespace tisserand::preload::part_load_test
