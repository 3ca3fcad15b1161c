// SPDX-License-Identifier: GPL-3.0-or-later
// `shape` of bodies in scene.yaml: values, errors, mirrored assemblies; and the scene as text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"
#include "formats/yaml/emit.hpp"
#include "formats/yaml/reader.hpp"
#include "formats/yaml/tree.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::shapes_test {
namespace {

using ::testing::HasSubstr;

std::string scene_with(const std::string& shape) {
  return "scene: a\nbodies:\n  stone: {type: rigid, mass: 1, inertia: [1, 1, 1], shape: " + shape +
         "}\nintegrator: {step: 0.1, end: 1}\n";
}

std::vector<ShapeSpec> shapes(const std::string& shape) {
  const Folder folder;
  const Scene scene = read_scene(folder.file("scene.yaml", scene_with(shape)), {});
  return std::get<RigidBodySpec>(scene.bodies[0]).shapes;
}

std::string error(const std::string& shape) {
  const Folder folder;
  const std::string path = folder.file("scene.yaml", scene_with(shape));
  return error_of(folder, [&] { read_scene(path, {}); });
}

TEST(Shapes, AreReadOneOrMany) {
  const std::vector<ShapeSpec> list = shapes(
      "[{type: box, size: [1, 2, 3], orientation: {axis: [0, 0, 1], angle_deg: 90}}, {type: sphere, radius: 0.5, "
      "position: [0, 0, 1]},"
      " {type: cylinder, from: [0, 0, 0], to: [0, 0, 1], radius: 0.1}, {type: cone, from: [0, 0, 0], to: [0, 0, 1], "
      "radius: 0.1},"
      " {type: tube, points: [[0, 0, 0], [1, 0, 0], [1, 1, 0]], radius: 0.2}]");
  ASSERT_EQ(list.size(), 5u);
  EXPECT_EQ(list[0].kind, ShapeKind::box);
  EXPECT_EQ(list[0].size, Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((list[0].orientation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_EQ(list[1].position, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(list[2].end_radius, 0.1);
  EXPECT_EQ(list[3].end_radius, 0.0);
  EXPECT_EQ(list[4].points.size(), 3u);
  EXPECT_EQ(shapes("{type: mesh, file: a.STL, scale: 0.001}")[0].scale, Eigen::Vector3d::Constant(0.001));
  EXPECT_THAT(shapes("{type: mesh, file: a.obj, scale: [1, -1, 1]}")[0].file, HasSubstr("/a.obj"));
}

TEST(Shapes, ErrorsNameTheBodyAndTheValue) {
  EXPECT_THAT(error("{type: bxo, size: [1, 1, 1]}"), HasSubstr("did you mean 'box'"));
  EXPECT_THAT(error("{size: [1, 1, 1]}"), HasSubstr("missing key 'type'"));
  EXPECT_THAT(error("box"), HasSubstr("must be a map"));
  EXPECT_THAT(error("{type: box}"), HasSubstr("missing key 'size'"));
  EXPECT_THAT(error("{type: box, size: [1, 0, 1]}"), ::testing::AllOf(HasSubstr("'stone'"), HasSubstr("size 0")));
  EXPECT_THAT(error("{type: box, size: [1, 1, 1], radius: 2}"), HasSubstr("radius"));
  EXPECT_THAT(error("{type: cylinder, from: [1, 0, 0], to: [1, 0, 0], radius: 1}"), HasSubstr("two points coincide"));
  EXPECT_THAT(error("{type: sphere, radius: -1}"), HasSubstr("radius -1 must be positive"));
  EXPECT_THAT(error("{type: cone, from: [0, 0, 0], to: [1, 0, 0], radius: 0}"), HasSubstr("radii 0 and 0"));
  EXPECT_THAT(error("{type: tube, points: [[0, 0, 0]], radius: 1}"), HasSubstr("2 to 100000 points"));
  EXPECT_THAT(error("{type: mesh, file: a.step}"), HasSubstr("is not an .stl, .obj or .recovery.h5 file"));
  EXPECT_THAT(error("{type: mesh, file: a.stl, scale: 0}"), HasSubstr("scale 0 must not be 0"));
}

const std::string mirrored = R"(scene: pair
assemblies:
  arm:
    bodies:
      stone:
        type: rigid
        mass: 1
        inertia: [1, 1, 1]
        shape:
          - {type: cylinder, from: [0, 1, 0], to: [0, 2, 0], radius: 0.1}
          - {type: mesh, file: a.stl, position: [1, 2, 3], orientation: {axis: [0, 0, 1], angle_deg: 90}}
instances:
  right: {use: arm, mirror: xz}
integrator: {step: 0.1, end: 1}
)";

TEST(Shapes, FollowAMirroredAssembly) {
  const Folder folder;
  const Scene scene = read_scene(folder.file("scene.yaml", mirrored), {});
  const RigidBodySpec& body = std::get<RigidBodySpec>(scene.bodies[0]);
  const Eigen::Matrix3d R = body.start.pose.orientation.toRotationMatrix();
  const auto in_world = [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(body.start.pose.position + R * p); };
  // Mirrored at the xz plane: y changes its sign.
  EXPECT_LT((in_world(body.shapes[0].to) - Eigen::Vector3d(0, -2, 0)).norm(), 1e-12);
  const ShapeSpec& mesh = body.shapes[1];
  const auto vertex = [&](const Eigen::Vector3d& v) {
    return in_world(mesh.position + mesh.orientation * v.cwiseProduct(mesh.scale));
  };
  // The vertex (1, 0, 0) of the file is at (1, 3, 3), (0, 1, 0) at (0, 2, 3); then their images.
  EXPECT_LT((vertex({1, 0, 0}) - Eigen::Vector3d(1, -3, 3)).norm(), 1e-12);
  EXPECT_LT((vertex({0, 1, 0}) - Eigen::Vector3d(0, -2, 3)).norm(), 1e-12);
  EXPECT_LT((vertex({0, 0, 1}) - Eigen::Vector3d(1, -2, 4)).norm(), 1e-12);
}

TEST(SceneText, IsReadToTheSameBodies) {
  const Folder folder;
  const std::string path = folder.file("scene.yaml", mirrored);
  const Scene scene = read_scene(path, {});
  const std::vector<BodySpec> bodies = read_drawn_scene(block_text(*scene.tree), path).bodies;
  ASSERT_EQ(bodies.size(), 1u);
  const RigidBodySpec &a = std::get<RigidBodySpec>(scene.bodies[0]), &b = std::get<RigidBodySpec>(bodies[0]);
  EXPECT_EQ(b.name, "right/stone");
  EXPECT_LT((b.inertia - a.inertia).norm(), 1e-12);
  EXPECT_LT((b.shapes[1].position - a.shapes[1].position).norm(), 1e-12);
  EXPECT_EQ(b.shapes[1].file, a.shapes[1].file);
}

TEST(SceneText, KeepsTextsThatLookLikeSomethingElse) {
  const std::string text = "a: \"12\"\nb: [1, two, \"x: y\", \"# no\"]\nc: {d: , e: \"line\\nend\", \"f: g\": 1e-3}\n";
  const YamlDocument first = parse_yaml(text, "a"), second = parse_yaml(block_text(first.root), "b");
  const auto flat = [](const YamlNode& root) {
    std::string all;
    const auto walk = [&](const auto& self, const YamlNode& node) -> void {
      all += fmt::format("{}|{}|{}|{};", static_cast<int>(node.kind), node.quoted && looks_like_number(node), node.key,
                         node.text);
      for (const YamlNode& child : node.children) self(self, child);
    };
    walk(walk, root);
    return all;
  };
  EXPECT_EQ(flat(second.root), flat(first.root));
}

}  // namespace
}  // namespace tisserand::formats::shapes_test
