// SPDX-License-Identifier: GPL-3.0-or-later
// Tyre property files: what is read of them, in which units, and the text of every error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/scene/scene.hpp"
#include "formats/tyres/tyre_property_file.hpp"
#include "tests/formats/yaml/text_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::formats::tyre_files_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// PAC2002 in mm, N, s.
std::string small_tyre() {
  return test_support::text_of(std::string(TISSERAND_SOURCE_DIR) + "/tests/fuzz/corpus/tyre/pac2002.tir");
}

TyreProperties read(const std::string& text, const Units& units = Units::si(),
                    const std::map<std::string, double>& scale = {}) {
  const Folder folder;
  return read_tyre_property_file(folder.file("a.tir", text), units, scale);
}

TEST(TyreFile, IsReadInItsUnits) {
  const TyreProperties tyre = read(small_tyre());
  const MagicFormula& p = tyre.coefficients;
  EXPECT_EQ(tyre.version, "a.tir (PAC2002)");
  EXPECT_EQ(p.version, MagicFormulaVersion::mf_5_2);
  EXPECT_EQ(p.forces, MagicFormulaForces::combined);
  EXPECT_TRUE(p.transient);
  EXPECT_NEAR(p.UNLOADED_RADIUS, 0.32, 1e-15);
  EXPECT_NEAR(p.VERTICAL_STIFFNESS, 200e3, 1e-9);
  EXPECT_NEAR(p.LONGVL, 16.7, 1e-14);
  EXPECT_EQ(p.FNOMIN, 4000.0);
  EXPECT_EQ(p.PDY1, 1.0);
  EXPECT_EQ(p.PKY1, -15.0);
  EXPECT_EQ(p.LMUX, 1.0);  // scaling factors are 1 where a file has none
  EXPECT_THAT(tyre.unused, ElementsAre("[SHAPE]"));
  Units units;
  units.length = length_unit("mm");
  units.mass = mass_unit("t");
  units.time = time_unit("s");  // force: N
  const MagicFormula small = read(small_tyre(), units).coefficients;
  EXPECT_NEAR(small.UNLOADED_RADIUS, 320.0, 1e-12);
  EXPECT_NEAR(small.VERTICAL_STIFFNESS, 200.0, 1e-12);
  EXPECT_EQ(read(small_tyre(), Units::consistent()).coefficients.LONGVL, read(small_tyre()).coefficients.LONGVL);
}

TEST(TyreFile, NamesWhatItDoesNotUse) {
  const std::string text =
      replaced(small_tyre(), "PTY2 = 1.7", "PTY2 = 1.7\nPKY4 = 1.9\nWIDTH = 205\nPPY1 = 0\nMC_NOTE = 'x'");
  EXPECT_THAT(read(text).unused, ElementsAre("MC_NOTE", "PKY4", "WIDTH", "[SHAPE]"));  // PPY1 = 0 says nothing
  const TyreProperties new_version = read(replaced(text, "PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = 62"));
  EXPECT_EQ(new_version.version, "a.tir (MF-Tyre 6.2)");
  EXPECT_EQ(new_version.coefficients.PKY4, 1.9);
  EXPECT_THAT(new_version.unused, ElementsAre("MC_NOTE", "WIDTH", "[SHAPE]"));
}

// Adams writes blocks of free text under headings in round brackets.
TEST(TyreFile, SkipsBlocksOfText) {
  const std::string heading = "[MDI_HEADER]\n(COMMENTS)\n{comment_string}\n'Tyre = measured, run 12'\n";
  EXPECT_THAT(read(heading + small_tyre()).unused, ElementsAre("[MDI_HEADER]", "[SHAPE]"));
  EXPECT_EQ(read(heading + small_tyre()).coefficients.PKY1, -15.0);
}

TEST(TyreFile, NamesModesThatItDoesNotSimulate) {
  const auto unused = [](const char* mode) { return read(replaced(small_tyre(), "USE_MODE = 14", mode)).unused; };
  EXPECT_THAT(unused("USE_MODE = 15"), ElementsAre("USE_MODE (turn slip)", "[SHAPE]"));
  EXPECT_THAT(unused("USE_MODE = 24"), ElementsAre("USE_MODE (dynamics of the belt)", "[SHAPE]"));
  EXPECT_THAT(unused("USE_MODE = 4"), ElementsAre("[SHAPE]"));
}

TEST(TyreFile, ScalesByTheScene) {
  EXPECT_EQ(read(small_tyre(), Units::si(), {{"LMUX", 0.5}, {"lky", 0.9}}).coefficients.LMUX, 0.5);
  EXPECT_EQ(read(small_tyre(), Units::si(), {{"LMUX", 0.5}, {"lky", 0.9}}).coefficients.LKY, 0.9);
  for (const char* key : {"PCX1", "LMUZ", "LONGVL", "LKYC", ""})  // LKYC is one of 6.1
    EXPECT_THROW(read(small_tyre(), Units::si(), {{key, 1.0}}), Error) << key;
}

struct BadFile {
  const char* name;
  std::string from, to, what;
};
void PrintTo(const BadFile& one, std::ostream* out) { *out << one.name; }

class BadFiles : public ::testing::TestWithParam<BadFile> {};

TEST_P(BadFiles, AreReported) {
  const Folder folder;
  const std::string path = folder.file("a.tir", replaced(small_tyre(), GetParam().from, GetParam().to));
  EXPECT_THAT(error_of(folder, [&] { read_tyre_property_file(path, Units::si(), {}); }), HasSubstr(GetParam().what));
}

INSTANTIATE_TEST_SUITE_P(
    Every, BadFiles,
    ::testing::Values(
        BadFile{"Kind", "'PAC2002'", "'FTIRE'",
                "a.tir:10: describes a kind of tyre that is not supported: PROPERTY_FILE_FORMAT = FTIRE"},
        BadFile{"Version", "PROPERTY_FILE_FORMAT = 'PAC2002'", "FITTYP = 60",
                "describes a kind of tyre that is not supported: FITTYP = 60"},
        BadFile{"NoKind", "PROPERTY_FILE_FORMAT = 'PAC2002'\n", "", "no FITTYP and no PROPERTY_FILE_FORMAT"},
        BadFile{"Missing", "PKY1 = -15\n", "", "lacks the coefficients PKY1"},
        BadFile{"MissingTwo", "RBX1 = 12\nRCX1 = 1\n", "", "lacks the coefficients RBX1, RCX1"},
        BadFile{"Number", "PCX1 = 1.6", "PCX1 = 1,6", "a.tir:24: PCX1 = '1,6' is not a finite number"},
        BadFile{"NotFinite", "PCX1 = 1.6", "PCX1 = 1e999", "is not a finite number"},
        BadFile{"Twice", "PCX1 = 1.6", "PCX1 = 1.6\nPCX1 = 1.7", "a.tir:25: PCX1 is given twice (first in line 24)"},
        BadFile{"NoKey", "PCX1 = 1.6", "PCX1 1.6", "'PCX1 1.6' does not have the form `KEY = value`"},
        BadFile{"Section", "[VERTICAL]", "[VERTICAL", "does not end with ]"},
        BadFile{"Unit", "LENGTH = 'mm'", "LENGTH = 'ell'",
                "a.tir:5: unit 'ell' of LENGTH is not known; use one of METER"},
        BadFile{"Degrees", "ANGLE = 'radians'", "ANGLE = 'degrees'", "angles are in 'degrees'"},
        BadFile{"Mode", "USE_MODE = 14", "USE_MODE = 19", "USE_MODE = 19 is not a mode"},
        BadFile{"Radius", "UNLOADED_RADIUS = 320", "UNLOADED_RADIUS = 0", "UNLOADED_RADIUS = 0 must be positive"},
        BadFile{"Cornering", "PKY1 = -15", "PKY1 = 0", "PKY1 is zero: the tyre has no cornering stiffness"},
        BadFile{"AxesOfSae", "PKY1 = -15", "PKY1 = 15", "cornering stiffness PKY1 sin(PKY4 atan(1/PKY2))"},
        BadFile{"Range", "PTX1 = 2", "KPUMIN = 0.1\nKPUMAX = 1", "the range from 0.1 to 1 does not enclose zero"},
        BadFile{"Loads", "PTX1 = 2", "FZMIN = 5000\nFZMAX = 100",
                "the range of loads FZMIN = 5000, FZMAX = 100 is not valid"}),
    [](const ::testing::TestParamInfo<BadFile>& given) { return given.param.name; });

TEST(TyreFile, MustBeThereAndOfItsSize) {
  EXPECT_THROW(read_tyre_property_file("/no/such.tir", Units::si(), {}), Error);
  EXPECT_THROW(read(std::string(2 << 20, '\n')), Error);
}

const std::string car = R"(scene: car
bodies:
  hub: {type: rigid, mass: 1, inertia: [1, 1, 1]}
roads: {flat: {type: plane}}
tyres:
  tyre: {type: magic_formula, wheel: hub, axis: [0, 1, 0], road: flat, file: a.tir}
integrator: {step: 0.01, end: 1}
)";

Scene scene_with(const std::string& from, const std::string& to) {
  const Folder folder;
  folder.file("a.tir", small_tyre());
  return read_scene(folder.file("scene.yaml", replaced(car, from, to)), {});
}

std::string scene_error(const std::string& from, const std::string& to) {
  const Folder folder;
  folder.file("a.tir", small_tyre());
  const std::string path = folder.file("scene.yaml", replaced(car, from, to));
  return error_of(folder, [&] { read_scene(path, {}); });
}

TEST(SceneTyreFiles, TakeWhatTheSceneLeavesOpen) {
  const Scene scene = scene_with("file: a.tir", "file: a.tir");
  const TyreSpec& tyre = scene.tyres.at(0);
  EXPECT_NEAR(tyre.radius, 0.32, 1e-15);  // pictures draw it
  EXPECT_NEAR(tyre.low_speed, 16.7 / 200.0, 1e-12);
  EXPECT_TRUE(tyre.relaxation);  // USE_MODE 14
  EXPECT_FALSE(tyre.mirrored);
  const TyreSpec reported =
      scene_with("file: a.tir", "file: a.tir, relaxation: no, mirrored: yes, low_speed: 0.3, scale: {LMUX: 0.7}")
          .tyres.at(0);
  EXPECT_FALSE(reported.relaxation);
  EXPECT_TRUE(reported.mirrored);
  EXPECT_EQ(reported.low_speed, 0.3);
  EXPECT_EQ(reported.properties->coefficients.LMUX, 0.7);
}

TEST(SceneTyreFiles, AreRefusedWithTheirPlace) {
  EXPECT_THAT(scene_error("file: a.tir", "file: b.tir"), HasSubstr("no such tyre property file"));
  EXPECT_THAT(scene_error(", file: a.tir", ""), HasSubstr("missing key 'file'"));
  EXPECT_THAT(scene_error("file: a.tir", "file: a.tir, friction: 1"),
              HasSubstr("'friction' has no effect: the tyre property file gives its value"));
  EXPECT_THAT(scene_error("file: a.tir", "file: a.tir, pressure: 2e5"),
              HasSubstr("its file has no inflation pressure"));
  EXPECT_THAT(scene_error("file: a.tir", "file: a.tir, scale: {LMUX: -1}"),
              HasSubstr("a.tir: scale: LMUX = -1 must be positive"));
  EXPECT_THAT(scene_error("file: a.tir", "file: a.tir, scale: 3"), HasSubstr("scale must be a map"));
  EXPECT_THAT(scene_error("type: magic_formula", "type: comprehensive_slip, radius: 1"),
              HasSubstr("'file' has no effect on a tyre of type comprehensive_slip"));
}

// A mirrored assembly mounts the tyre of its file on the other side.
TEST(SceneTyreFiles, AreMirroredWithTheirAssembly) {
  const Folder folder;
  folder.file("a.tir", small_tyre());
  const Scene scene = read_scene(folder.file("scene.yaml", R"(scene: car
roads: {flat: {type: plane}}
assemblies:
  corner:
    bodies: {wheel: {type: rigid, mass: 1, inertia: [1, 1, 1]}}
    tyres: {tyre: {type: magic_formula, wheel: wheel, axis: [0, 1, 0], road: flat, file: a.tir}}
instances: {left: {use: corner}, right: {use: corner, mirror: xz}}
integrator: {step: 0.01, end: 1}
)"),
                                 {});
  EXPECT_FALSE(scene.tyres.at(0).mirrored);
  EXPECT_TRUE(scene.tyres.at(1).mirrored);
}

}  // namespace
}  // namespace tisserand::formats::tyre_files_test
