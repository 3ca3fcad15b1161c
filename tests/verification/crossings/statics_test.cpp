// SPDX-License-Identifier: GPL-3.0-or-later
// Equilibria of combined capabilities and the small motions about them: the same in another description; dynamics that
// starts there rests; modes at rest do not depend on the floating frame or the inertia of a superelement.
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/crossings/changes.hpp"
#include "tests/support/crossings/history.hpp"
#include "tests/support/crossings/ingredients.hpp"
#include "tests/support/crossings/pairs.hpp"
#include "tests/support/crossings/small_motions.hpp"

namespace tisserand::test_support::crossings::statics_test {
namespace {

struct Cell {
  Ingredients in;
  Change change;
  std::string name() const {
    return name_of(in.arm) + " on " + name_of(in.hinge) + " with " + name_of(in.action) + ", " + name_of(change);
  }
};

Cell cell_of(const Choice& c) {
  return {{static_cast<Arm>(c[0]), static_cast<Hinge>(c[1]), static_cast<Action>(c[2]), Scheme::index_2},
          static_cast<Change>(c[3])};
}

bool is_choice(const Choice& choice) {
  const Cell cell = cell_of(choice);
  return is_sensible(cell.in) && (cell.change != Change::kept || cell.in.arm == Arm::welded);
}

std::vector<Cell> cells() {
  std::vector<Cell> result;
  for (const Choice& choice : pairwise({arms, hinges, actions, changes}, is_choice)) result.push_back(cell_of(choice));
  return result;
}

/// Loads, springs and drives of these change with time.
bool is_constant(Action action) {
  switch (action) {
    case Action::nothing:
    case Action::torsion_spring:
    case Action::bushing:
    case Action::unsymmetric_bushing:
    case Action::channels:
    case Action::stop:
    case Action::gear:
    case Action::own_gravity:
      return true;
    default:
      return false;
  }
}

/// Nothing moves from the equilibrium: Newton leaves 1e-11 of the forces. The incremental frame of the paper depends on
/// the path, so that after the load step it pulls otherwise by terms of second order in it.
void expect_rest(const Cell& cell, formats::Scene scene, const mechanism::State& end) {
  if (!is_constant(cell.in.action) || cell.in.arm == Arm::paper_B) return;
  scene.analysis = formats::AnalysisKind::dynamics;
  scene.initial.clear();
  const History moved = run_history(scene, scene, {}, arm_files(), &end);
  ASSERT_EQ(moved.refusal, "");
  EXPECT_EQ(moved.report.outcome, mechanism::RunOutcome::completed) << moved.report.reason;
  double fastest = 0.0;
  for (const auto& [name, quantity] : moved.quantities)
    if (quantity.family == Family::rate) fastest = std::max(fastest, quantity.rows.cwiseAbs().maxCoeff());
  EXPECT_LT(fastest, 1e-7);
}

void expect_alike(const Cell& cell) {
  SCOPED_TRACE(cell.name());
  const formats::Scene scene = held_scene(cell.in);
  const Similarity same, s = similarity_of(cell.change);
  const formats::Scene other = changed(scene, cell.change);
  std::optional<mechanism::State> end, other_end;
  const History before = run_history(scene, scene, same, arm_files(), nullptr, &end);
  const History after = run_history(other, scene, s, arm_files(), nullptr, &other_end);
  EXPECT_EQ(before.refusal, "");
  EXPECT_TRUE(before.refusal.empty() && mechanism::is_finished(before.report.outcome)) << before.report.reason;
  EXPECT_EQ(disagreement(before, after, {}), "");
  if (!end || !other_end) return;
  const std::vector<std::complex<double>> modes = eigenvalues(scene, arm_files(), &*end),
                                          others = eigenvalues(other, arm_files(), &*other_end);
  if (cell.change != Change::bystander) {
    EXPECT_LT(mode_difference(modes, others, s.time), 1e-6);
  }
  expect_rest(cell, scene, *end);
}

TEST(CrossingStatics, TenCells) {
  const std::vector<Cell> all = cells();
  for (std::size_t i = 0; i < 10; ++i) expect_alike(all[i * all.size() / 10]);
}

TEST(CrossingStatics, AllCells) {
  for (const Cell& cell : cells()) expect_alike(cell);
}

/// Modes of the undeformed scene with this damping of the arm, without gravity.
std::vector<std::complex<double>> modes_with(Arm arm, Hinge hinge, const formats::Damping& damping) {
  formats::Scene scene = held_scene({arm, hinge, Action::nothing, Scheme::index_2});
  scene.gravity.setZero();
  std::get<formats::SuperelementBodySpec>(scene.bodies.front()).damping = damping;
  return eigenvalues(scene, arm_files(), nullptr);
}

// Small motions about the undeformed state at rest know no frame: all of these options have the same equations.
TEST(CrossingStatics, ModesAtRestKnowNoFloatingFrame) {
  std::vector<formats::Damping> dampings(6);
  dampings[1].mass = 0.4;
  dampings[2].stiffness = 2e-3;
  dampings[3].ratio = 0.05;
  dampings[4].ratios = {0.1, 0.02, 0.3};
  dampings[5].ratio_internal = 0.05;
  for (int hinge = 0; hinge < hinges; ++hinge)
    for (std::size_t k = 0; k < dampings.size(); ++k) {
      const Hinge on = static_cast<Hinge>(hinge);
      const std::vector<std::complex<double>> first = modes_with(Arm::karcher_B, on, dampings[k]);
      for (const Arm arm : {Arm::node_A, Arm::paper_B, Arm::weighted_M})
        EXPECT_LT(mode_difference(first, modes_with(arm, on, dampings[k]), 1.0), 1e-7)
            << name_of(on) << ", " << name_of(arm) << ", damping " << k;
    }
}

}  // namespace
}  // namespace tisserand::test_support::crossings::statics_test
