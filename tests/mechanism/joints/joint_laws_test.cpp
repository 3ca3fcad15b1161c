// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of the joint kinds against the keys that a scene may give for them.
#include "mechanism/joints/joint_laws.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include <gtest/gtest.h>

#include "mechanism/joints/joint.hpp"

namespace tisserand::mechanism::joint_laws_test {
namespace {

bool same(const Relation& a, const Relation& b) { return a.kind == b.kind && a.i == b.i && a.j == b.j; }

TEST(JointLaws, AgreeWithTheRowsOfTheScene) {
  for (const formats::JointKindRow& row : formats::joint_kinds()) {
    SCOPED_TRACE(row.word);
    const JointLaw& law = joint_law(row.kind);
    EXPECT_EQ(law.kind, row.kind);
    EXPECT_EQ(law.holds.size() + law.threaded, row.equations);
    EXPECT_EQ(law.chosen, row.key == formats::JointKey::hold);
    EXPECT_EQ(law.threaded, row.key == formats::JointKey::pitch);
    Joint joint;
    set_relations(row.kind, {}, joint);
    EXPECT_EQ(keeps_distance(joint), row.key == formats::JointKey::length);
    EXPECT_EQ(keeps_distance(joint), row.axes == formats::JointAxes::unused);
  }
}

TEST(JointLaws, CoordinatesAreWhatTheirNamesSay) {
  const std::map<std::string_view, Relation> meaning{
      {"x", {RelationKind::along, 0, 0}},       {"y", {RelationKind::along, 1, 0}},
      {"z", {RelationKind::along, 2, 0}},       {"angle", {RelationKind::angle, 2, 0}},
      {"angle_x", {RelationKind::angle, 0, 0}}, {"angle_y", {RelationKind::angle, 1, 0}}};
  for (const formats::JointKindRow& row : formats::joint_kinds()) {
    SCOPED_TRACE(row.word);
    const Relations& coordinates = joint_law(row.kind).coordinates;
    ASSERT_EQ(coordinates.count, row.coordinates.count);
    for (int k = 0; k < coordinates.count; ++k)
      EXPECT_TRUE(same(coordinates.list[k], meaning.at(row.coordinates.names[k]))) << row.coordinates.names[k];
  }
}

// A radius is needed if the slip has a rotation, an arm if some relation of axes takes a moment. Displacements along
// axes of A are those of B's origin, about which their forces have no moment.
TEST(JointLaws, FrictionNeedsWhatTheSurfacesDo) {
  for (const formats::JointKindRow& row : formats::joint_kinds()) {
    SCOPED_TRACE(row.word);
    const JointLaw& law = joint_law(row.kind);
    EXPECT_EQ(row.friction.has_friction, law.slip != SlipKind::none);
    if (law.slip == SlipKind::none) continue;
    const bool turns = std::ranges::any_of(law.coordinates, [](const Relation& r) { return !is_length(r); });
    EXPECT_EQ(row.friction.radius, turns || law.slip == SlipKind::ball);
    EXPECT_EQ(row.friction.arm, std::ranges::any_of(law.holds.relations, [](const Relation& r) {
                return r.kind == RelationKind::normal || r.kind == RelationKind::twist;
              }));
  }
}

// Each of the 64 choices has as many equations as held directions. Its coordinates are those of SCENE.md: the free ones
// of x, y, z, and `angle` if rx and ry are held and rz is free.
TEST(JointLaws, ChosenDirectionsAreHeldAndTheOthersFree) {
  for (unsigned choice = 0; choice < 64; ++choice) {
    SCOPED_TRACE(choice);
    std::array<bool, 6> held{};
    int count = 0;
    for (int i = 0; i < 6; ++i) {
      held[i] = (choice >> i & 1u) != 0;
      count += held[i];
    }
    Joint joint;
    set_relations(JointKind::generic, held, joint);
    EXPECT_EQ(joint.size(), count);
    std::vector<std::string> expected, found;
    for (int i = 0; i < 3; ++i)
      if (!held[i]) expected.emplace_back(1, "xyz"[i]);
    if (held[3] && held[4] && !held[5]) expected.emplace_back("angle");
    for (const NamedRelation& free : free_coordinates(joint)) found.push_back(free.name);
    EXPECT_EQ(found, expected);
  }
}

/// Motion of a node with a random position and a random rotation.
NodeMotion random_node() {
  NodeMotion node;
  node.x.setRandom();
  node.R = Eigen::Quaterniond::UnitRandom().toRotationMatrix();
  return node;
}

// With markers at the origins of the nodes, the gradients show what a joint needs. A node may lack the rotations and
// translations whose columns are zero in every state. All kinds and all 63 choices of `hold`.
TEST(JointLaws, DependOnWhatTheirGradientsFeel) {
  const auto expect = [](const Joint& joint) {
    Eigen::Matrix<double, 1, 12> felt = Eigen::Matrix<double, 1, 12>::Zero();
    for (int i = 0; i < 5; ++i) {
      const NodeMotion a = random_node(), b = random_node();
      JointTerms terms;
      joint_constraints(joint, a, b, terms);
      felt = felt.cwiseMax(terms.B.topRows(joint.size()).cwiseAbs().colwise().maxCoeff());
    }
    const Dependence found = depends_on(joint);
    const auto feels = [&](int first) { return felt.segment<3>(first).maxCoeff() > 1e-12; };
    EXPECT_EQ(found.places, feels(0));
    EXPECT_EQ(found.places, feels(6));
    EXPECT_EQ(found.axes_a, feels(3));
    EXPECT_EQ(found.axes_b, feels(9));
  };
  for (const formats::JointKindRow& row : formats::joint_kinds()) {
    SCOPED_TRACE(row.word);
    if (row.key == formats::JointKey::hold) continue;
    Joint joint;
    set_relations(row.kind, {}, joint);
    expect(joint);
  }
  for (unsigned choice = 1; choice < 64; ++choice) {
    SCOPED_TRACE(choice);
    Joint joint;
    std::array<bool, 6> held{};
    for (int i = 0; i < 6; ++i) held[i] = (choice >> i & 1u) != 0;
    set_relations(JointKind::generic, held, joint);
    expect(joint);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::joint_laws_test
