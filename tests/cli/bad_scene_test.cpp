// SPDX-License-Identifier: GPL-3.0-or-later
// Every fault of a scene that the issue of this slice lists: exit code, place, quantity, remedy, and nothing left
// behind.
#include <algorithm>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::bad_scene_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

struct Fault {
  const char* name;
  std::vector<std::string> settings;
  std::vector<std::string> words;  ///< of the message
};

void PrintTo(const Fault& fault, std::ostream* stream) { *stream << fault.name; }

class BadScene : public Folder, public ::testing::WithParamInterface<Fault> {};

TEST_P(BadScene, IsReportedByCheckAndRunAndLeavesNothing) {
  const std::vector<std::string> before = names();
  expect_error(with("check", GetParam().settings), GetParam().words);
  expect_error(with("run", GetParam().settings), GetParam().words);
  std::vector<std::string> after = names();
  std::erase_if(after, [](const std::string& name) { return name == ".out" || name == ".err"; });
  EXPECT_EQ(after, before);
}

const Fault faults[] = {
    {"UnknownKey",
     {"bodies.rod.elemnts=5"},
     {"unknown key 'elemnts'", "did you mean 'elements'?", "--set bodies.rod.elemnts=5"}},
    {"WrongType", {"integrator.step=abc"}, {"step must be a number, not 'abc'"}},
    {"WrongOverride", {"integrator"}, {"has no '='"}},
    {"ManyAtOnce", {"bodies.block.mass=-2", "integrator.stpe=1"}, {"mass -2", "unknown key 'stpe'"}},
    {"MissingFile", {"bodies.se.file=none.superelement.h5"}, {"none.superelement.h5", "No such file"}},
    {"FolderAsFile", {"bodies.se.file=."}, {"is not an ordinary file"}},
    {"TextAsFile", {"bodies.se.file=arm.scene.yaml"}, {"arm.scene.yaml", "is not an HDF5 file"}},
    {"MissingTable", {"loads.push.value.2={file: none.csv}"}, {"none.csv", "No such file", "push"}},
    {"UnnamedUnits", {"units=consistent"}, {"se.superelement.h5", "units", "name the units in both files"}},
    {"UnknownBeamNode", {"joints.hinge.b=rod/strat"}, {"no node 'strat'", "did you mean 'start'?"}},
    {"UnknownBody", {"loads.push.at=rood/end"}, {"'rood'", "did you mean 'rod'?"}},
    {"UnknownBoundaryNode", {"joints.hinge.b=se/bse"}, {"there is no node 'se/bse'", "did you mean 'se/"}},
    {"SelfJoint", {"joints.hinge.a=rod/start"}, {"joins 'rod/start' to itself", "two different nodes"}},
    {"SelfJointByTwoNames", {"joints.hinge.a=rod/0"}, {"'rod/0' and 'rod/start'", "on the same node"}},
    {"SelfJointOnOneBody", {"joints.weld.a=block"}, {"'block' and 'block/hook'", "on the same node"}},
    {"ZeroAxis", {"joints.hinge.axis=[0, 0, 0]"}, {"axis has zero length", "give a direction"}},
    {"NegativeMass", {"bodies.block.mass=-1"}, {"body 'block'", "mass -1", "must be positive"}},
    {"NegativeSection", {"sections.bar.radius=-0.01"}, {"radius -0.01 m must be positive"}},
    {"ZeroLengthElement", {"bodies.rod.to=[0, 0, 0]"}, {"body 'rod'", "zero length", "move one end"}},
    {"TooManyModes", {"bodies.se.modes=7"}, {"7 modes are requested", "the superelement has 0"}},
    {"NegativeModes", {"bodies.se.modes=-1"}, {"modes -1 must not be negative"}},
    {"RigidWithModes",
     {"bodies.se.use=rigid", "bodies.se.modes=0"},
     {"body 'se'", "'modes' has no effect with use: rigid", "--set bodies.se.modes=0"}},
    {"UnknownEffect", {"effects.frction=off"}, {"no effect 'frction'", "did you mean 'friction'?"}},
    {"EffectOnItsOwn",
     {"effects.gravity=auto"},
     {"'gravity' cannot be 'auto'", "auto is allowed for flexibility, stiffening"}},
    {"PlanarBesideAutomaticEffects",
     {"effects.planar=on", "effects.flexibility=auto"},
     {"planar cannot be combined with 'auto'", "or remove planar", "--set effects.planar=on"}},
    {"EffectOfNoBody", {"effects.rood.gravity=off"}, {"there is no body 'rood'", "did you mean 'rod'?"}},
    {"UnknownEffectOfABody", {"effects.rod.dampng=off"}, {"unknown key 'dampng'", "did you mean 'damping'?"}},
    {"EffectThatIsNotThere",
     {"effects.friction=off"},
     {"nothing in the scene has friction", "give a joint 'friction'"}},
    {"EffectThatTheBodyHasNot",
     {"effects.se.stiffening=off"},
     {"body 'se' has no stiffening to switch off", "companion file", "--set effects.se.stiffening=off"}},
    {"HhtWithRho",
     {"integrator.method=hht", "integrator.rho=0.5"},
     {"'rho' has no effect with method: hht", "give alpha"}},
    {"StoredAfterTheEnd", {"output.from=0.2"}, {"from 0.2 is later than the end 0.1", "give an earlier time"}},
    {"UnknownFrameNode", {"bodies.se.frame={node: bse}"}, {"has no node 'bse'", "its nodes are"}},
    {"InconsistentVelocity",
     {"bodies.block.velocity=[1, 0, 0]", "bodies.rod.velocity=[0, 0, 0]", "bodies.rod.angular_velocity=[0, 0, 0]"},
     {"initial velocities violate joint 'weld", "initial_tolerance", "omit those that should follow"}},
    {"OpenJoint",
     {"joints.weld={type: fixed, a: {node: rod/end, position: [0, 0, 0]}, b: {node: block/hook, position: [0, 0.2, "
      "0]}}"},
     {"joint 'weld", "not closed at the start", "initial_tolerance"}},
    {"Massless",
     {"bodies.block.inertia=[0, 0, 0]", "joints.weld.type=spherical"},
     {"block, rotation", "no mass, no stiffness"}},
    {"FreeStatics", {"analysis=statics"}, {"can move freely", "nothing holds", "hold it with a joint"}},
    {"UnknownChannel",
     {"output.channels=[nodes/positon]"},
     {"'nodes/positon' does not exist", "did you mean 'nodes/position'?"}},
    {"NoRows", {"output.every=0"}, {"every 0 must be 1 or more"}},
    {"TwoRhythms", {"output={every: 2, interval: 0.1}"}, {"both 'every' and 'interval'"}},
    {"ExpressionSyntax", {"loads.push.value.2=\"sin(t\""}, {"'sin(t'", "arenthesis", "write a formula in t"}},
    {"ExpressionName",
     {"loads.push.value.2=\"foo(t)\""},
     {"there is no function 'foo'; use one of abs, acos, ", "write a formula in t"}},
    {"ExpressionAtStart", {"loads.push.value.2=\"1/t\""}, {"load 'push', z component '1/t'", "t = 0 s is inf"}},
    {"EndBeforeStart", {"integrator.end=-1"}, {"end -1 must be later than start 0"}},
};

INSTANTIATE_TEST_SUITE_P(Faults, BadScene, ::testing::ValuesIn(faults), [](const auto& one) { return one.param.name; });

using Scene = Folder;

TEST_F(Scene, OfAnotherKindIsNamed) {
  write_text(file("beam.part.yaml"), "part: beam\npoints: {a: [0, 0, 0]}\n");
  expect_error(mechanism({"check", "beam.part.yaml"}), {"beam.part.yaml:1:", "a part, not a scene"});
  write_text(file("picture.png"), "\x89PNG\r\n\x1a\n0000");
  expect_error(mechanism({"run", "picture.png"}), {"picture.png:1:1", "0x89", "check that this is a text file"});
  expect_error(mechanism({"run", "none.yaml"}), {"none.yaml", "No such file"});
  expect_error(mechanism({"run", "."}), {"is a folder"});
  write_text(file("open.yaml"), "scene: [1,\n");
  expect_error(mechanism({"run", "open.yaml"}), {"open.yaml:"});
}

TEST_F(Scene, CheckCountsAndWritesNothing) {
  const Outcome outcome = with("check", {});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  // Three beam nodes, one block, two boundary nodes, six each; hinge 5 and weld 6.
  EXPECT_THAT(outcome.out, HasSubstr("25 degrees of freedom: 36 coordinates, 11 constraints of rank 11"));
  EXPECT_THAT(names(), Not(Contains(HasSubstr("results"))));
}

TEST_F(Scene, CheckNamesRedundantEquations) {
  const Outcome outcome = with("check", {"joints.again={type: fixed, a: ground, b: rod/start}"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_THAT(outcome.out, HasSubstr("5 of 17 constraint equations are redundant"));
  EXPECT_THAT(outcome.out, HasSubstr("again, translation x"));
  EXPECT_THAT(outcome.out, HasSubstr("reactions of hinge, again are not unique"));
}

TEST_F(Scene, PathsMayHoldBlanksQuotesAndUnicode) {
  const std::string odd = "a 'quoted\" földer";
  std::filesystem::create_directory(file(odd));
  std::filesystem::copy_file(file("arm.scene.yaml"), file(odd + "/my scene ü.yaml"));
  std::filesystem::copy_file(file("se.superelement.h5"), file(odd + "/se.superelement.h5"));
  const Outcome outcome = mechanism({"run", odd + "/my scene ü.yaml", "-o", odd + "/out ü.h5"});
  EXPECT_EQ(outcome.code, 0) << outcome.error;
  EXPECT_EQ(mechanism({"export", odd + "/out ü.h5", "-c", "energy/total", "-o", odd + "/out 'ü'.csv"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(file(odd + "/out 'ü'.csv")));
  EXPECT_EQ(mechanism({"plot", odd + "/out ü.h5", "-c", "energy/total", "-o", odd + "/out 'ü'.svg"}).code, 0);
}

TEST_F(Scene, FilesInOverridesCountFromTheFolderOfTheScene) {
  std::filesystem::create_directory(file("sub"));
  std::filesystem::rename(file("arm.scene.yaml"), file("sub/arm.scene.yaml"));
  EXPECT_EQ(mechanism({"check", "sub/arm.scene.yaml", "--set", "bodies.se.file=../se.superelement.h5"}).code, 0);
  EXPECT_EQ(mechanism({"check", "sub/arm.scene.yaml", "--set", "bodies.se.file=se.superelement.h5"}).code, 1);
}

}  // namespace
}  // namespace tisserand::cli::bad_scene_test
