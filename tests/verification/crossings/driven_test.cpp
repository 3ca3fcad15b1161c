// SPDX-License-Identifier: GPL-3.0-or-later
// Motions that drives prescribe: kinematics, inverse dynamics and dynamics of combined capabilities, in two
// descriptions and against each other.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/crossings/actions.hpp"
#include "tests/support/crossings/changes.hpp"
#include "tests/support/crossings/history.hpp"
#include "tests/support/crossings/ingredients.hpp"
#include "tests/support/crossings/pairs.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support::crossings::driven_test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

const std::vector<Arm> driven_arms = {Arm::rigid, Arm::use_rigid, Arm::welded};
/// Those whose coordinates are all that they let move.
const std::vector<Hinge> driven_hinges = {
    Hinge::fixed,         Hinge::revolute,  Hinge::universal, Hinge::cylindrical,
    Hinge::screw,         Hinge::prismatic, Hinge::planar,    Hinge::constant_orientation,
    Hinge::parallel_axes, Hinge::generic};
const std::vector<Action> driven_actions = {Action::nothing,     Action::world_loads,    Action::following_loads,
                                            Action::line_spring, Action::torsion_spring, Action::bushing,
                                            Action::channels,    Action::stop,           Action::friction,
                                            Action::gear,        Action::own_gravity,    Action::tables,
                                            Action::second_hinge};

struct Cell {
  Ingredients in;
  Change change;
  std::string name() const {
    return name_of(in.arm) + " on " + name_of(in.hinge) + " with " + name_of(in.action) + ", " + name_of(change);
  }
};

Cell cell_of(const Choice& c) {
  return {{driven_arms[c[0]], driven_hinges[c[1]], driven_actions[c[2]], Scheme::index_2}, static_cast<Change>(c[3])};
}

bool is_choice(const Choice& choice) {
  const Cell cell = cell_of(choice);
  if (cell.change == Change::bystander) return false;  // nothing drives it
  return cell.change != Change::kept || cell.in.arm == Arm::welded;
}

formats::Scene driven_scene(const Ingredients& in) {
  formats::Scene scene = dynamics_scene(in);
  for (formats::BodySpec& body : scene.bodies)
    std::visit(
        [](auto& spec) {
          spec.start.velocity.reset();
          spec.start.angular_velocity.reset();
        },
        body);
  scene.initial.clear();
  std::vector<std::string> coordinates = coordinates_of(in.hinge);
  if (in.hinge == Hinge::screw) coordinates.pop_back();  // the advance follows the turn
  coordinates.push_back("wrist");
  int k = 0;
  for (const std::string& coordinate : coordinates) {
    formats::MotionSpec motion =
        drive(coordinate, fmt::format("{}*t + {}*(1 - cos({}*t))", 0.5 - 0.2 * k, 0.05 + 0.02 * k, 15 + 4 * k));
    motion.name = "drive_" + std::to_string(k++);
    scene.motions.push_back(motion);
  }
  return scene;
}

History run_as(formats::AnalysisKind kind, formats::Scene scene, const formats::Scene& before, const Similarity& s) {
  scene.analysis = kind;
  return run_history(scene, before, s, arm_files());
}

void expect_alike(const Cell& cell) {
  const formats::Scene scene = driven_scene(cell.in), other = changed(scene, cell.change);
  const Similarity same, s = similarity_of(cell.change);
  for (const formats::AnalysisKind kind :
       {formats::AnalysisKind::kinematics, formats::AnalysisKind::inverse_dynamics}) {
    const History before = run_as(kind, scene, scene, same), after = run_as(kind, other, scene, s);
    EXPECT_EQ(before.refusal, "");
    EXPECT_EQ(before.report.outcome, mechanism::RunOutcome::completed) << before.report.reason;
    EXPECT_EQ(disagreement(before, after, {}), "");
  }
}

/// Positions of dynamics are those of the drives; its forces come near those of inverse dynamics with order 2, and are
/// the same at the start.
void expect_same_forces(const Ingredients& in) {
  const formats::Scene scene = driven_scene(in);
  const Similarity same;
  const History inverse = run_as(formats::AnalysisKind::inverse_dynamics, scene, scene, same);
  const History kinematics = run_as(formats::AnalysisKind::kinematics, scene, scene, same);
  EXPECT_EQ(disagreement(kinematics, inverse, {1e-9, 1e-9, 1e-9, never, never}), "");
  double error[2];
  for (int k = 0; k < 2; ++k) {
    formats::Scene finer = scene;
    finer.integrator.step /= 1 + k;
    const History dynamics = run_as(formats::AnalysisKind::dynamics, finer, scene, same);
    EXPECT_EQ(dynamics.refusal, "");
    EXPECT_EQ(disagreement(inverse, dynamics, {1e-7, 1e-6, never, never, never}), "");
    error[k] = compare_histories(inverse, dynamics, {Family::force}).largest;
    const int rows = static_cast<int>(inverse.time.size());
    EXPECT_LT(compare_histories(inverse.every(rows), dynamics.every(rows), {Family::force}).largest, 1e-8) << "start";
  }
  EXPECT_LT(error[1], 0.4 * error[0] + 1e-6) << error[0];
}

std::vector<Cell> cells() {
  const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
  std::vector<Cell> result;
  for (const Choice& choice :
       pairwise({count(driven_arms), count(driven_hinges), count(driven_actions), changes}, is_choice))
    result.push_back(cell_of(choice));
  return result;
}

void expect_right(const Cell& cell) {
  SCOPED_TRACE(cell.name());
  expect_alike(cell);
  expect_same_forces(cell.in);
}

TEST(CrossingDriven, TenCells) {
  const std::vector<Cell> all = cells();
  for (std::size_t i = 0; i < 10; ++i) expect_right(all[i * all.size() / 10]);
}

TEST(CrossingDriven, AllCells) {
  for (const Cell& cell : cells()) expect_right(cell);
}

}  // namespace
}  // namespace tisserand::test_support::crossings::driven_test
