// SPDX-License-Identifier: GPL-3.0-or-later
// Uses of superelement files: which of them share a body.
#include "mechanism/build/superelements.hpp"

#include <gtest/gtest.h>

#include "mechanism/build/build_model.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::build_superelement_test {
namespace {

using formats::SuperelementBodySpec;

/// A use of the file with one option changed.
template <class Change>
SuperelementBodySpec use(const std::string& name, const std::string& file, Change change) {
  SuperelementBodySpec spec = test_support::superelement_body(name, file);
  change(spec);
  return spec;
}

// Place, name and gravity are a use's own; file and options make the body.
TEST(UsesOfSuperelements, ShareABodyWhereFileAndOptionsAreTheSame) {
  SuperelementFiles files;
  for (const std::string name : {"frame", "copy"})
    test_support::add_file(name, test_support::test_superelement("frame"), files);
  const auto as_it_is = [](SuperelementBodySpec&) {};
  const std::vector<SuperelementBodySpec> uses = {
      use("first", "frame", as_it_is),
      use("second", "frame", [](SuperelementBodySpec& s) { s.start.pose.position.x() = 5.0; }),
      use("of_other_file", "copy", as_it_is),
      use("modes", "frame", [](SuperelementBodySpec& s) { s.modes = 1; }),
      use("inertia", "frame", [](SuperelementBodySpec& s) { s.inertia = formats::InertiaOption::A; }),
      use("damping", "frame", [](SuperelementBodySpec& s) { s.damping.ratio = 0.01; }),
      use("frame", "frame", [](SuperelementBodySpec& s) { s.frame = formats::FrameKind::paper; }),
      use("weights", "frame",
          [](SuperelementBodySpec& s) {
            s.position_weights = {{"n0", 1.0}};
          }),
      use("image", "frame",
          [](SuperelementBodySpec& s) {
            s.mirror = {1, -1, 1};
          }),
      use("same_image", "frame",
          [](SuperelementBodySpec& s) {
            s.mirror = {1, -1, 1};
          }),
      use("last", "frame", [](SuperelementBodySpec& s) { s.gravity = Eigen::Vector3d(1.0, 0.0, 0.0); }),
  };
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  for (const SuperelementBodySpec& spec : uses) scene.bodies.push_back(spec);
  const BuiltModel built = build_model(scene, files);
  std::vector<int> bodies;
  for (const SuperelementUse& superelement : built.model.superelements) bodies.push_back(superelement.body);
  EXPECT_EQ(bodies, (std::vector<int>{0, 0, 1, 2, 3, 4, 5, 6, 7, 7, 0}));
  EXPECT_EQ(built.model.superelement_bodies.size(), 8u);
  EXPECT_EQ(body_of(built.model, 3).modes, 1);
  EXPECT_EQ(built.model.superelements[10].gravity.x(), 1.0);
  EXPECT_EQ(built.model.superelements[10].name, "last");
  EXPECT_NE(built.model.superelements[0].nodes, built.model.superelements[1].nodes);
}

}  // namespace
}  // namespace tisserand::mechanism::build_superelement_test
