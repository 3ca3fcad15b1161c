// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of include, parameters, assemblies and instances: the scene that they grow to, and the place of every error.
#include "formats/scene/expand/tree.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/math/rotation.hpp"
#include "formats/scene/expand/names.hpp"
#include "formats/scene/fields.hpp"
#include "formats/scene/scene.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::scene_tree_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string tail = "integrator: {step: 0.01, end: 1}\n";

struct Files {
  Folder folder;
  explicit Files(const std::vector<std::pair<std::string, std::string>>& files) {
    for (const auto& [name, text] : files) {
      std::filesystem::create_directories(std::filesystem::path(folder.path() + "/" + name).parent_path());
      (void)folder.file(name, text);
    }
  }
  Scene read(const std::vector<std::string>& changes = {}) const {
    return read_scene(folder.path() + "/scene.yaml", overrides(changes));
  }
  std::string error(const std::vector<std::string>& changes = {}) const {
    return error_of(folder, [&] { (void)read(changes); });
  }
};

Scene read(const std::string& text, const std::vector<std::string>& changes = {}) {
  return Files({{"scene.yaml", "scene: test\n" + text + tail}}).read(changes);
}
std::string error(const std::string& text, const std::vector<std::string>& changes = {}) {
  return Files({{"scene.yaml", "scene: test\n" + text + tail}}).error(changes);
}

const RigidBodySpec& rigid(const Scene& scene, const std::string& name) {
  for (const BodySpec& body : scene.bodies)
    if (const auto* spec = std::get_if<RigidBodySpec>(&body); spec != nullptr && spec->name == name) return *spec;
  throw std::logic_error("no body " + name);
}
const JointSpec& joint(const Scene& scene, const std::string& name) {
  for (const JointSpec& spec : scene.joints)
    if (spec.name == name) return spec;
  throw std::logic_error("no joint " + name);
}

// ---- parameters ---------------------------------------------------------------------------------------------------

const std::string block =
    "bodies: {block: {type: rigid, mass: $m, inertia: $J, center_of_mass: [\"${2 * c.x}\", 0, $h]}}\n";

TEST(SceneParameters, StandForNumbersListsAndText) {
  const std::string parameters = "parameters: {m: 3, J: [$m, 2, \"${m - 0.5}\"], c: [0.25, 0, 0], h: \"${-m^2}\"}\n";
  const RigidBodySpec body = rigid(read(parameters + block), "block");
  EXPECT_EQ(body.mass, 3.0);
  EXPECT_EQ(body.inertia(2, 2), 2.5);
  EXPECT_EQ(body.center_of_mass, Vector3d(0.5, 0, -9));
  EXPECT_EQ(rigid(read(parameters + block, {"parameters.m=4"}), "block").mass, 4.0);
}

TEST(SceneParameters, StandInText) {
  const Scene scene = read(
      "parameters: {size: 3, kind: steel, a: 2, b: 5}\n"
      "bodies: {rod: {type: superelement, file: \"${kind}_$size-$$.h5\"}}\n"
      "loads: {push: {type: force, at: rod/tip, value: [\"${a * b} * sin(t)\", $a, 0]}}\n");
  EXPECT_THAT(std::get<SuperelementBodySpec>(scene.bodies[0]).file, HasSubstr("/steel_3-$.h5"));
  EXPECT_EQ(std::get<TimeExpression>(scene.loads[0].components[0]).text, "10 * sin(t)");
  EXPECT_EQ(std::get<double>(scene.loads[0].components[1]), 2.0);
}

TEST(SceneParameters, ErrorsNameThem) {
  const std::string rest = "bodies: {block: {type: rigid, mass: 1, inertia: [1, 1, 1]}}\n";
  EXPECT_EQ(error("parameters: {track: 1}\ngravity: [0, 0, $trakc]\n" + rest),
            "scene.yaml:3:17: there is no parameter 'trakc'; did you mean 'track'?");
  EXPECT_EQ(error("parameters: {a: 1}\n" + rest),
            "scene.yaml:2:14: parameter 'a' is never used; remove it, or use it as $a");
  EXPECT_EQ(error("parameters: {a: 1}\ngravity: [0, 0, $a]\n" + rest, {"parameters.b=1"}),
            "--set parameters.b=1: parameter 'b' is never used; remove it, or use it as $b");
  EXPECT_EQ(error("parameters: {a: $b, b: $a}\ngravity: [0, 0, $a]\n" + rest),
            "scene.yaml:2:14: parameter 'a' refers to itself; give it a value that does not depend on this parameter");
  EXPECT_EQ(error("parameters: {a: 0}\ngravity: [0, 0, \"${1 / a}\"]\n" + rest),
            "scene.yaml:3:17: expression '1 / a' is inf, not a finite number");
  EXPECT_THAT(error("parameters: {a: 0}\ngravity: [0, 0, \"${1 + b + a}\"]\n" + rest),
              ::testing::AllOf(::testing::StartsWith("scene.yaml:3:17: expression '1 + b + a': "), HasSubstr("\"b\""),
                               ::testing::EndsWith("; parameters here are a")));
  EXPECT_EQ(error("parameters: {a: x}\ngravity: [0, 0, \"${2 * a}\"]\n" + rest),
            "scene.yaml:3:17: parameter 'a' is 'x', not a number");
  EXPECT_EQ(error("parameters: {a: -1}\nbodies: {block: {type: rigid, mass: $a, inertia: [1, 1, 1]}}\n"),
            "scene.yaml:2:17: body 'block': mass -1 must be positive");
  EXPECT_THAT(error("gravity: [0, 0, \"${1\"]\n" + rest), HasSubstr("is not followed by a name or a {formula}"));
  EXPECT_THAT(error("gravity: [0, 0, \"${2,5 * 2}\"]\n" + rest), HasSubstr("expression '2,5 * 2': a comma"));
}

TEST(SceneParameters, GrowthIsBounded) {
  std::string text = "parameters:\n  a0: [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    text += fmt::format("  a{}: [", i);
    for (int k = 0; k < 10; ++k) text += fmt::format("{}$a{}", k == 0 ? "" : ", ", i - 1);
    text += "]\n";
  }
  EXPECT_THAT(error(text + "gravity: $a11\nbodies: {}\n"),
              HasSubstr("the scene has more than 3000000 values after its instances are expanded"));
  std::string chain = "parameters:\n  a0: 1\n";
  for (int i = 1; i < 1000; ++i) chain += fmt::format("  a{}: $a{}\n", i, i - 1);
  EXPECT_THAT(error(chain + "gravity: [0, 0, $a999]\nbodies: {}\n"), HasSubstr("more than 50 levels deep"));
}

// ---- include --------------------------------------------------------------------------------------------------------

// A scene whose files are named in another folder is written with their way from its own: places of bodies are not
// ways.
TEST(Include, TextOfASceneNamesFilesFromItsOwnFolder) {
  const Files files({{"scene.yaml", "scene: test\ninclude: [parts/bodies.yaml]\n" + tail},
                     {"parts/bodies.yaml",
                      "bodies:\n  frame: {type: rigid, from: frame.superelement.h5}\n"
                      "  arm: {type: superelement, file: ../arm.superelement.h5}\n"
                      "  cable: {type: rigid, mass: 1, inertia: [1, 1, 1], shape: {type: cylinder, from: [0, 0, 0], "
                      "to: [1, 0, 0], radius: 0.1}}\n"}});
  const std::string text = scene_text(files.folder.path() + "/scene.yaml", {}, scene_key_sets());
  EXPECT_THAT(text, HasSubstr("from: parts/frame.superelement.h5"));
  EXPECT_THAT(text, HasSubstr("file: arm.superelement.h5"));
}

TEST(SceneInclude, JoinsEntriesAndFillsInSettings) {
  const Files files({{"scene.yaml", "scene: whole\ninclude: [parts/arm.yaml, base.yaml]\nintegrator: {step: 0.5}\n"},
                     {"base.yaml",
                      "scene: base\ngravity: [0, 0, -9]\nintegrator: {step: 0.1, end: 3}\n"
                      "joints: {hinge: {type: spherical, a: ground, b: arm/base}}\n"},
                     {"parts/arm.yaml",
                      "include: ../base.yaml\nparameters: {unused: 3, n: arm}\n"
                      "bodies: {arm: {type: superelement, file: $n.superelement.h5}}\n"}});
  const Scene scene = files.read();
  EXPECT_EQ(scene.name, "whole");
  EXPECT_EQ(scene.gravity.z(), -9.0);
  EXPECT_EQ(scene.integrator.step, 0.5);
  EXPECT_EQ(scene.integrator.end, 3.0);
  ASSERT_EQ(scene.joints.size(), 1u);
  EXPECT_EQ(std::get<SuperelementBodySpec>(scene.bodies.at(0)).file,
            files.folder.path() + "/parts/arm.superelement.h5");
}

TEST(SceneInclude, CanBeExchanged) {
  const Files files({{"scene.yaml", "scene: a\ninclude: light.yaml\n" + tail},
                     {"light.yaml", "bodies: {b: {type: rigid, mass: 1, inertia: [1, 1, 1]}}\n"},
                     {"heavy.yaml", "bodies: {b: {type: rigid, mass: 9, inertia: [1, 1, 1]}}\n"}});
  EXPECT_EQ(rigid(files.read(), "b").mass, 1.0);
  EXPECT_EQ(rigid(files.read({"include=heavy.yaml"}), "b").mass, 9.0);
  EXPECT_EQ(rigid(files.read({"include=[heavy.yaml]", "bodies.b.mass=7"}), "b").mass, 7.0);
  EXPECT_THAT(files.error({"include=none.yaml"}), HasSubstr("none.yaml: cannot open the file"));
}

TEST(SceneInclude, ErrorsNameTheFile) {
  const std::string body = "bodies: {block: {type: rigid, mass: 1, inertia: [1, 1, 1]}}\n";
  EXPECT_EQ(Files({{"scene.yaml", "scene: a\ninclude: b.yaml\n" + tail}, {"b.yaml", "include:\n  - c.yaml\n"}}).error(),
            "c.yaml: cannot open the file: No such file or directory; check path and permission; included from "
            "b.yaml:2:5");
  EXPECT_EQ(Files({{"scene.yaml", "scene: a\ninclude: b.yaml\n" + tail}, {"b.yaml", "include: scene.yaml\n"}}).error(),
            "b.yaml:1:10: 'scene.yaml' includes itself, included from scene.yaml:2:10; remove this include");
  EXPECT_EQ(Files({{"scene.yaml", "scene: a\ninclude: b.yaml\n" + body + tail}, {"b.yaml", body}}).error(),
            "b.yaml:1:10: 'block' of 'bodies' is given twice (first in scene.yaml:3:10); rename or remove one");
  EXPECT_EQ(Files({{"scene.yaml", "scene: a\ninclude: b.yaml\n" + tail},
                   {"b.yaml", "bodies:\n  block: {type: rigid, mass: -1, inertia: [1, 1, 1]}\n"}})
                .error(),
            "b.yaml:2:30: body 'block': mass -1 must be positive");
  EXPECT_EQ(
      Files({{"scene.yaml", "scene: a\ninclude: b.yaml\n" + tail}, {"b.yaml", "[1, 2]\n"}}).error(),
      "b.yaml:1:1: the file must be a map of keys and values, not a list of 2, included from scene.yaml:2:10; write "
      "keys such as `bodies:`");
  EXPECT_EQ(error("include: {a: b}\n"),
            "scene.yaml:2:10: a file name is needed, not a map; write it relative to this file");
}

TEST(SceneInclude, ChainsAreBounded) {
  std::vector<std::pair<std::string, std::string>> files{{"scene.yaml", "scene: a\ninclude: f0.yaml\n" + tail}};
  for (int i = 0; i < 30; ++i)
    files.emplace_back(fmt::format("f{}.yaml", i), fmt::format("include: f{}.yaml\n", i + 1));
  EXPECT_THAT(Files(files).error(), HasSubstr("included files are nested more than 20 levels deep"));
}

// ---- instances ------------------------------------------------------------------------------------------------------

const std::string corner = R"yaml(assemblies:
  corner:
    parameters: {mass: 2}
    bodies:
      arm:
        type: rigid
        mass: $mass
        center_of_mass: [0.1, 0.2, 0.3]
        inertia: [1, 2, 2.5, 0.1, 0.2, 0.3]
        nodes: {ball: {position: [0, 0.5, 0], orientation: {axis: [1, 0, 0], angle_deg: 30}}}
        pose: {position: [1, 2, 3], orientation: {axis: [0, 0, 1], angle_deg: 20}}
        velocity: [1, 2, 3]
        angular_velocity: [4, 5, 6]
      hub: {type: rigid, mass: 1, inertia: [1, 1, 1]}
    joints:
      hinge: {type: revolute, a: {node: ground, position: [1, 2, 0]}, b: arm, axis: [1, 1, 0], position: [1, 2, 3]}
      slide: {type: prismatic, a: {node: arm/ball, position: [0, 1, 0]}, b: hub, axis: [0, 1, 1]}
      ball: {type: spherical, a: body, b: hub}
    springs: {stop: {coordinate: hinge, stiffness: 3}}
    initial: {hinge: {rate: 2}}
    loads:
      push: {type: force, at: arm/ball, value: [1, 2, 3]}
      twist: {type: moment, at: hub, axes: body, value: [1, "sin(t)", {table: [[0, 1], [1, 2]]}]
}
)yaml";
const std::string around = "bodies: {body: {type: rigid, mass: 1, inertia: [1, 1, 1]}}\n";

Matrix3d rotation_of(const InitialMotion& motion) { return motion.pose.orientation.toRotationMatrix(); }

TEST(SceneInstances, ArePlacedWithPathsForNames) {
  const Scene scene =
      read(around + corner +
           "instances:\n  fl:\n    use: corner\n    parameters: {mass: 5}\n    pose: {position: [10, 0, 0], "
           "orientation: {axis: [0, 0, 1], angle_deg: 90}}\n");
  const RigidBodySpec& arm = rigid(scene, "fl/arm");
  EXPECT_EQ(arm.mass, 5.0);
  const Matrix3d R = exp_so3<double>(Vector3d(0, 0, 0.5 * M_PI));
  EXPECT_LT((arm.start.pose.position - Vector3d(8, 1, 3)).norm(), 1e-14);
  EXPECT_LT((rotation_of(arm.start) - R * exp_so3<double>(Vector3d(0, 0, M_PI / 9))).norm(), 1e-14);
  EXPECT_LT((*arm.start.velocity - Vector3d(-2, 1, 3)).norm(), 1e-14);
  EXPECT_LT((*arm.start.angular_velocity - Vector3d(-5, 4, 6)).norm(), 1e-14);
  EXPECT_EQ(arm.center_of_mass, Vector3d(0.1, 0.2, 0.3));
  ASSERT_EQ(scene.initial.size(), 1u);
  EXPECT_EQ(scene.initial[0].coordinate.name, "fl/hinge");
  const JointSpec& hinge = joint(scene, "fl/hinge");
  EXPECT_EQ(hinge.b.node, "fl/arm");
  EXPECT_LT((*hinge.axis - Vector3d(-1, 1, 0)).norm(), 1e-14);
  EXPECT_LT((*hinge.position - Vector3d(8, 1, 3)).norm(), 1e-14);
  EXPECT_LT((*hinge.a.position - Vector3d(8, 1, 0)).norm(), 1e-14);
  EXPECT_EQ(joint(scene, "fl/slide").a.node, "fl/arm/ball");
  EXPECT_EQ(*joint(scene, "fl/slide").a.position, Vector3d(0, 1, 0));
  EXPECT_EQ(joint(scene, "fl/ball").a.node, "body");
  EXPECT_EQ(scene.springs.at(0).name, "fl/stop");
  EXPECT_EQ(scene.springs.at(0).coordinate->name, "fl/hinge");
  EXPECT_EQ(scene.loads.at(0).at.node, "fl/arm/ball");
  EXPECT_NEAR(std::get<double>(scene.loads.at(0).components[0]), -2.0, 1e-14);
  EXPECT_NEAR(std::get<double>(scene.loads.at(0).components[1]), 1.0, 1e-14);
  EXPECT_EQ(std::get<TimeExpression>(scene.loads.at(1).components[1]).text, "sin(t)");
}

/// World position, in the mirrored body, of the mirror image of a point of the original.
TEST(SceneInstances, AreMirroredProperly) {
  const Scene scene = read(around + corner + "instances:\n  l: {use: corner}\n  r: {use: corner, mirror: xz}\n");
  const Matrix3d M = Vector3d(1, -1, 1).asDiagonal();
  const RigidBodySpec &l = rigid(scene, "l/arm"), &r = rigid(scene, "r/arm");
  const Matrix3d R_l = rotation_of(l.start), R_r = rotation_of(r.start);
  EXPECT_NEAR(R_r.determinant(), 1.0, 1e-14);
  const auto world = [](const RigidBodySpec& body, const Vector3d& p) {
    return Vector3d(body.start.pose.position + rotation_of(body.start) * p);
  };
  EXPECT_LT((world(r, r.center_of_mass) - M * world(l, l.center_of_mass)).norm(), 1e-14);
  EXPECT_LT((world(r, r.nodes[0].pose.position) - M * world(l, l.nodes[0].pose.position)).norm(), 1e-14);
  // The inertia tensor in world axes is mirrored; velocities of points too: v + ω × a.
  EXPECT_LT((R_r * r.inertia * R_r.transpose() - M * R_l * l.inertia * R_l.transpose() * M).norm(), 1e-14);
  const Vector3d arm(0.3, -0.2, 0.7);
  EXPECT_LT((*r.start.velocity + r.start.angular_velocity->cross(M * arm) -
             M * (*l.start.velocity + l.start.angular_velocity->cross(arm)))
                .norm(),
            1e-14);
  // A right-handed turn of b about the axis of the hinge: the mirror image of the motion of the other side.
  const Vector3d a_l = joint(scene, "l/hinge").axis->normalized(), a_r = joint(scene, "r/hinge").axis->normalized();
  EXPECT_LT((a_r.cross(M * arm) - M * a_l.cross(arm)).norm(), 1e-14);
  EXPECT_LT((*joint(scene, "r/hinge").position - M * *joint(scene, "l/hinge").position).norm(), 1e-14);
  // A slide moves along the mirrored axis.
  EXPECT_LT((*joint(scene, "r/slide").axis - M * Vector3d(0, 1, 1)).norm(), 1e-14);
  EXPECT_EQ(*joint(scene, "r/slide").a.position, Vector3d(0, -1, 0));
  // Forces are mirrored, moments as cross products; the components of the second load are in mirrored part axes.
  const auto number = [&](std::size_t load, std::size_t k) {
    return std::get<double>(scene.loads[load].components[k]);
  };
  EXPECT_THAT((std::vector{number(2, 0), number(2, 1), number(2, 2)}), ElementsAre(1.0, -2.0, 3.0));
  EXPECT_EQ(number(3, 0), -1.0);
  EXPECT_EQ(std::get<TimeExpression>(scene.loads[3].components[1]).text, "sin(t)");
  EXPECT_THAT(std::get<TimeTable>(scene.loads[3].components[2]).value, ElementsAre(-1.0, -2.0));
}

TEST(SceneInstances, TwoMirrorsAreATurn) {
  const Scene scene = read(
      "assemblies:\n  one:\n    bodies:\n      b: {type: rigid, mass: 1, inertia: [1, 2, 2.5, 0.1, 0, 0], "
      "center_of_mass: [1, 2, 3]}\n  two:\n    instances: {o: {use: one, mirror: xz}}\n"
      "instances: {t: {use: two, mirror: yz}}\n");
  const RigidBodySpec& body = rigid(scene, "t/o/b");
  EXPECT_EQ(body.center_of_mass, Vector3d(1, 2, 3));
  EXPECT_EQ(body.inertia(0, 1), 0.1);
  EXPECT_LT((rotation_of(body.start) - Matrix3d(Vector3d(-1, -1, 1).asDiagonal())).norm(), 1e-15);
}

const std::string chain = R"(parameters: {n: 3, d: 0.5}
assemblies:
  link:
    parameters: {hang: ground}
    bodies:
      bar: {type: rigid, mass: "${1 + index}", inertia: [1, 1, 1], nodes: {tip: {position: [$d, 0, 0]}}}
    joints:
      pin: {type: spherical, a: $hang, b: bar}
instances:
  link:
    use: link
    count: $n
    pose: {position: [1, 0, 0]}
    step: {position: [0, $d, 0], orientation: {axis: [0, 0, 1], angle_deg: 90}}
    parameters: {hang: $previous/bar/tip}
    first: {hang: ground}
)";

TEST(SceneInstances, AreRepeatedAndChained) {
  const Scene scene = read(chain);
  EXPECT_EQ(scene.bodies.size(), 3u);
  EXPECT_EQ(joint(scene, "link[0]/pin").a.node, "ground");
  EXPECT_EQ(joint(scene, "link[2]/pin").a.node, "link[1]/bar/tip");
  EXPECT_EQ(rigid(scene, "link[2]/bar").mass, 3.0);
  EXPECT_LT((rigid(scene, "link[1]/bar").start.pose.position - Vector3d(1, 0.5, 0)).norm(), 1e-15);
  EXPECT_LT((rigid(scene, "link[2]/bar").start.pose.position - Vector3d(0.5, 0.5, 0)).norm(), 1e-15);
  EXPECT_EQ(read(chain, {"parameters.n=50"}).bodies.size(), 50u);
  EXPECT_EQ(rigid(read(chain, {"bodies.link[1]/bar.mass=7"}), "link[1]/bar").mass, 7.0);
}

TEST(SceneInstances, MayStandInAFileOfTheirOwn) {
  const Files files(
      {{"scene.yaml",
        "scene: a\nassemblies: {rod: lib/rod.yaml}\ninstances: {a: {use: rod}, b: {use: rod, mirror: "
        "xy, parameters: {file: other.h5}}}\n" +
            tail},
       {"lib/rod.yaml",
        "assembly: rod\nparameters: {file: rod.h5}\nbodies: {rod: {type: superelement, file: $file}}\n"}});
  const Scene scene = files.read();
  EXPECT_EQ(std::get<SuperelementBodySpec>(scene.bodies[0]).file, files.folder.path() + "/lib/rod.h5");
  EXPECT_EQ(std::get<SuperelementBodySpec>(scene.bodies[1]).file, files.folder.path() + "/other.h5");
}

TEST(SceneInstances, MirrorFilesAtTheirPlaneAndThatOfTheBody) {
  const Scene scene = read(
      "assemblies:\n  side:\n    parameters: {plane: xz}\n    bodies:\n      s: {type: superelement, file: s.h5}\n"
      "      m: {type: modal, file: m.h5, mirror: $plane}\n      r: {type: rigid, from: s.h5, mirror: [yz, xy]}\n"
      "instances: {l: {use: side}, r: {use: side, mirror: xz}, t: {use: side, pose: {position: [1, 2, 3]}}}\n");
  const auto expect_mirror = [&](std::size_t first, const Vector3d& s, const Vector3d& m, const Vector3d& r) {
    EXPECT_EQ(std::get<SuperelementBodySpec>(scene.bodies.at(first)).mirror, s);
    EXPECT_EQ(std::get<ModalBodySpec>(scene.bodies.at(first + 1)).mirror, m);
    EXPECT_EQ(std::get<SuperelementBodySpec>(scene.bodies.at(first + 2)).mirror, r);
  };
  expect_mirror(0, {1, 1, 1}, {1, -1, 1}, {-1, 1, -1});
  expect_mirror(3, {1, -1, 1}, {1, 1, 1}, {-1, -1, -1});
  expect_mirror(6, {1, 1, 1}, {1, -1, 1}, {-1, 1, -1});
  EXPECT_THAT(error("bodies: {b: {type: superelement, file: b.h5, mirror: [xz, xyz]}}\n"),
              HasSubstr("scene.yaml:2:59: body 'b': unknown mirror plane 'xyz'"));
}

TEST(SceneInstances, ErrorsNameThem) {
  const auto bad = [](const std::string& instances) { return error(around + corner + "instances:\n" + instances); };
  EXPECT_THAT(bad("  fl: {use: cornr}\n"), HasSubstr(": there is no assembly 'cornr'; did you mean 'corner'?"));
  EXPECT_THAT(bad("  fl: {use: corner, parameters: {mas: 1}}\n"),
              HasSubstr(": assembly 'corner' has no parameter 'mas'; did you mean 'mass'?"));
  EXPECT_THAT(bad("  fl: {use: corner, mirror: x}\n"), HasSubstr("instance 'fl': unknown mirror plane 'x'"));
  EXPECT_THAT(bad("  fl: {use: corner, step: {}}\n"), HasSubstr("belong to instances that are repeated; give count"));
  EXPECT_THAT(bad("  fl: {use: corner, count: 2000000}\n"), HasSubstr("count 2000000 must lie between 0 and 200000"));
  EXPECT_THAT(bad("  body: {use: corner}\n"), HasSubstr("instance 'body': a body or joint has the same name"));
  EXPECT_THAT(bad("  fl: {use: corner, parameters: {mass: -1}}\n"),
              HasSubstr("body 'fl/arm': mass -1 must be positive"));
  EXPECT_THAT(error("assemblies: {a: {instances: {b: {use: a}}}}\ninstances: {a: {use: a}}\n"),
              HasSubstr("assemblies are nested more than 50 levels deep"));
  EXPECT_THAT(error("assemblies: {a: {bodies: {b: {type: rigid}}, color: red}}\ninstances: {a: {use: a}}\n"),
              HasSubstr("assembly 'a': unknown key 'color'"));
  EXPECT_THAT(error(chain, {"instances.link.first={}"}), HasSubstr("there is no parameter 'previous'"));
}

TEST(SceneInstances, ReversedCoordinatesAreRefused) {
  const std::string text =
      "assemblies:\n  a:\n    bodies:\n      b: {type: rigid, mass: 1, inertia: [1, 1, 1]}\n    joints:\n"
      "      c: {type: cylindrical, a: ground, b: b, axis: [0, 0, 1]}\n"
      "    springs: {s: {coordinate: c/z, stiffness: 1}}\n";
  EXPECT_EQ(error(text + "instances: {a: {use: a}}\n"), "");
  EXPECT_THAT(error(text + "instances: {a: {use: a, mirror: xy}}\n"),
              HasSubstr("'s': the coordinate 'c/z' changes its sign in a mirrored assembly"));
}

TEST(SceneInstances, ReversedCoordinatesOfInstancesWithinAreRefused) {
  const std::string text =
      "assemblies:\n  a:\n    bodies:\n      b: {type: rigid, mass: 1, inertia: [1, 1, 1]}\n    joints:\n"
      "      c: {type: cylindrical, a: ground, b: b, axis: [0, 0, 1]}\n  d:\n    instances: {i: {use: a}}\n"
      "    channels: {far: {type: coordinate, of: i/c/z}}\n";
  EXPECT_EQ(error(text + "instances: {d: {use: d}}\n"), "");
  EXPECT_THAT(error(text + "instances: {d: {use: d, mirror: xy}}\n"),
              HasSubstr("'far': the coordinate 'i/c/z' changes its sign in a mirrored assembly"));
}

TEST(SceneInstances, NamesInExpressionsAreThoseOfTheInnermostLevel) {
  const Scene scene = read(
      "bodies: {block: {type: rigid, mass: 1, inertia: [1, 1, 1]}}\n"
      "joints: {h: {type: revolute, a: ground, b: block, axis: [0, 0, 1]}}\n"
      "channels: {speed: {type: rate, of: h}, wind: {type: position, of: block, axis: x}}\n"
      "assemblies:\n  m:\n    bodies: {b: {type: rigid, mass: 1, inertia: [1, 1, 1]}}\n"
      "    channels: {speed: {type: velocity, of: b, axis: y}}\n"
      "    loads: {f: {type: force, at: b, value: [\"sin(speed) + 1e5*wind*t\", {expression: \"-speed\"}, 0]}}\n"
      "  n:\n    instances: {k: {use: m, count: 2}}\n"
      "    loads: {g: {type: force, at: block, value: [\"k[1].speed\", 0, 0]}}\n"
      "instances: {w: {use: n, pose: {position: [1, 2, 3]}}}\n");
  ASSERT_EQ(scene.channels.size(), 4u);
  EXPECT_EQ(scene.channels[3].name, "w/k[1]/speed");
  EXPECT_EQ(scene.channels[3].a.node, "w/k[1]/b");
  const auto text = [&](std::size_t load, std::size_t k) {
    return std::get<TimeExpression>(scene.loads.at(load).components[k]).text;
  };
  EXPECT_EQ(text(0, 0), "w.k[1].speed");
  EXPECT_EQ(text(2, 0), "sin(w.k[1].speed) + 1e5*wind*t");
  EXPECT_EQ(text(2, 1), "-w.k[1].speed");
}

TEST(SceneInstances, BeamsTakeMaterialsAndSectionsOfTheirAssembly) {
  const Scene scene = read(
      "materials: {steel: {E: 2e11, nu: 0.3, density: 7800}}\n"
      "assemblies:\n  rod:\n    parameters: {r: 0.01}\n    sections: {round: {shape: circle, radius: $r}}\n"
      "    bodies: {b: {type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 1, section: round, material: steel}}\n"
      "instances: {thin: {use: rod}, thick: {use: rod, parameters: {r: 0.02}}}\n");
  const auto area = [&](std::size_t i) { return std::get<BeamBodySpec>(scene.bodies.at(i)).section.area; };
  EXPECT_NEAR(area(0), M_PI * 1e-4, 1e-15);
  EXPECT_NEAR(area(1), M_PI * 4e-4, 1e-15);
  EXPECT_EQ(std::get<BeamBodySpec>(scene.bodies[0]).material.name, "steel");
}

TEST(SceneInstances, ChannelsAndBodyGravityArePlaced) {
  const Scene scene = read(
      "assemblies:\n  m:\n    bodies: {b: {type: rigid, mass: 1, inertia: [1, 1, 1], gravity: [1, 2, 3]}}\n"
      "    channels: {far: {type: position, of: b, axis: x, origin: [0, 1, 0]}}\n"
      "instances: {w: {use: m, mirror: yz, pose: {position: [5, 0, 0], orientation: {axis: [0, 0, 1], angle_deg: "
      "90}}}}\n");
  EXPECT_LT((scene.channels.at(0).axis - Vector3d(0, -1, 0)).norm(), 1e-15);
  EXPECT_LT((scene.channels.at(0).origin - Vector3d(4, 0, 0)).norm(), 1e-15);
  EXPECT_LT((*rigid(scene, "w/b").gravity - Vector3d(-2, -1, 3)).norm(), 1e-15);
}

// Keys of an assembly are those of the scene, so that a new collection is accepted there by itself.
TEST(SceneInstances, EveryCollectionOfAnAssemblyIsCopiedOrServesAllCopies) {
  const std::vector<KeySet> sets = scene_key_sets();
  const auto assembly = std::ranges::find(sets, "assembly", &KeySet::noun);
  ASSERT_NE(assembly, sets.end());
  std::vector<std::string> not_copied;
  for (const Field& field : assembly->fields)
    if (field.type.starts_with("{") && !is_instantiated(std::string(field.key))) not_copied.emplace_back(field.key);
  EXPECT_THAT(not_copied, ElementsAre("parameters", "assemblies", "instances", "materials", "sections"));
}

TEST(SceneInstances, GrowthIsBounded) {
  const std::string text =
      "assemblies:\n  a: {bodies: {}}\n  b:\n    instances: {x: {use: a, count: 1000}}\n"
      "instances: {y: {use: b, count: 1000}}\n";
  EXPECT_THAT(error(text), HasSubstr("the scene has more than 200000 instances"));
}

}  // namespace
}  // namespace tisserand::formats::scene_tree_test
