// SPDX-License-Identifier: GPL-3.0-or-later
// Geometry of strangers: commands that a .geo file must not run, limits, damaged CAD files, answers that make no sense.
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reducer/mesh/mesh_file.hpp"
#include "reducer/mesher/child.hpp"
#include "reducer/mesher/import.hpp"
#include "tests/reducer/sources/part_text.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::untrusted_file_test {
namespace {

namespace fs = std::filesystem;
using test_support::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Permission = formats::MeshFile::Permission;

const std::string meshes = std::string(TISSERAND_SOURCE_DIR) + "/meshes/";

std::string content(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

constexpr const char* not_tested = "not tested: this kernel lacks Landlock or seccomp";
bool has_seccomp() { return ::prctl(PR_GET_SECCOMP) >= 0; }

/// A folder with a folder `in`, where strange.geo and its part lie, and a folder `out`.
class UntrustedFile {
 public:
  explicit UntrustedFile(const std::string& commands) {
    fs::create_directories(folder_.path() / "in");
    fs::create_directories(folder_.path() / "out");
    write("in/strange.geo", content(meshes + "plate.geo") + commands + "\n");
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  void write(const std::string& name, const std::string& text) const { write_text_file(path(name), text); }

  /// What reading a file of the folder says, or "read" with the notes.
  std::string read(const std::string& name, const Permission& permission) const {
    const Units units = Units::consistent();
    formats::MeshFile settings;
    settings.file = path(name);
    settings.permission = permission;
    try {
      const reducer::CellMesh mesh = reducer::import_with_gmsh({settings, units, 2, {}});
      EXPECT_FALSE(mesh.position.empty());
      return "read; " + join(mesh.warnings, "; ");
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr(settings.file));
      return error.what();
    }
  }
  std::string read() const { return read("in/strange.geo", {}); }

  std::set<std::string> files() const {
    std::set<std::string> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_.path()))
      found.insert(entry.path().string() + (entry.is_regular_file() ? content(entry.path().string()) : ""));
    return found;
  }

 private:
  test_support::TemporaryFolder folder_;
};

// --- commands ------------------------------------------------------------------------------------------------------

struct Trick {
  const char* name;
  const char* commands;  ///< @ stands for the folder
  const char* message;
};

class Tricks : public ::testing::TestWithParam<Trick> {};

TEST_P(Tricks, DoNothingAndAreReported) {
  if (!has_landlock() || !has_seccomp()) GTEST_SKIP() << not_tested;
  std::string commands = GetParam().commands;
  const UntrustedFile plain("");
  for (std::size_t at = 0; (at = commands.find('@')) != std::string::npos;) commands.replace(at, 1, plain.path("out"));
  plain.write("out/secret.geo", "secret = 1;\n");
  plain.write("in/strange.geo", content(meshes + "plate.geo") + commands + "\n");
  fs::create_symlink(plain.path("out/secret.geo"), plain.path("in/link.geo"));
  fs::create_directory_symlink(plain.path("out"), plain.path("in/door"));
  const std::set<std::string> before = plain.files();
  EXPECT_THAT(plain.read(), HasSubstr(GetParam().message));
  EXPECT_EQ(plain.files(), before) << "files were made, changed or removed";
}

constexpr const char* starts = "tries to start a program, to wait, or to create, rename or remove files";
constexpr const char* opens = "a geometry may read only files of its own folder";
INSTANTIATE_TEST_SUITE_P(
    Geo, Tricks,
    ::testing::Values(
        Trick{"System", "System \"touch @/made\";", starts},
        Trick{"SystemCall", "SystemCall \"touch @/made\";", starts},
        Trick{"NonBlockingSystemCall", "NonBlockingSystemCall \"touch @/made\";", starts},
        Trick{"OnelabRun", "OnelabRun(\"x\", \"touch @/made\");", starts},
        Trick{"Solver", "Solver.Name0 = \"x\"; Solver.Executable0 = \"touch @/made\"; OnelabRun(\"x\");", starts},
        Trick{"Sleep", "Sleep(100000);", starts}, Trick{"SleepShort", "Sleep(0.001);", starts},
        Trick{"CreateDir", "CreateDir \"@/made\";", starts}, Trick{"CreateDirHere", "CreateDir \"made\";", starts},
        Trick{"Printf", "Printf(\"x\") > \"@/made\";", opens}, Trick{"PrintfHere", "Printf(\"x\") > \"made\";", opens},
        Trick{"PrintfOver", "Printf(\"x\") > \"@/secret.geo\";", opens},
        Trick{"PrintfBehind", "Printf(\"x\") >> \"strange.geo\";", opens},
        Trick{"Save", "Mesh 2; Save \"@/made.msh\";", opens}, Trick{"Print", "Print \"made.msh\";", opens},
        Trick{"IncludeAbsolute", "Include \"@/secret.geo\";", opens},
        Trick{"IncludeAbove", "Include \"../out/secret.geo\";", opens},
        Trick{"IncludeLink", "Include \"link.geo\";", opens},
        Trick{"IncludeFolderLink", "Include \"door/secret.geo\";", opens},
        Trick{"IncludePassword", "Include \"/etc/passwd\";", opens},
        Trick{"MergePassword", "Merge \"/etc/passwd\";", opens},
        Trick{"MergeEnvironment", "Merge \"/proc/self/environ\";", opens},
        Trick{"MergeComputed", "name = Str(\"/etc/\", \"passwd\"); Merge StrCat(\"/etc/pass\", \"wd\");", opens},
        Trick{"IncludedSystem", "Include \"more.txt\";", "Unable to open file"},
        Trick{"Plugin", "View \"v\" { SP(0,0,0){1}; }; Save View[0] \"@/made.pos\";", opens},
        Trick{"Exit", "Exit;", "and gave no mesh"},
        Trick{"SaveOptions", "General.OptionsFileName = \"@/made\"; General.SaveOptions = 1; Exit;", "gave no mesh"}),
    [](const auto& trick) { return std::string(trick.param.name); });

TEST(UntrustedFiles, FilesOfTheFolderAreReadWhateverTheirEnding) {
  if (!has_landlock() || !has_seccomp()) GTEST_SKIP() << not_tested;
  const UntrustedFile geo("Include \"more.txt\";\nInclude \"below/more.geo\";\nPoint(101) = {width, height, 0};");
  geo.write("in/more.txt", "width = 1;\n");
  fs::create_directories(geo.path("in/below"));
  geo.write("in/below/more.geo", "height = 1;\n");
  EXPECT_THAT(geo.read(), HasSubstr("read;"));
  geo.write("in/more.txt", "SystemCall \"touch made\";\n");
  EXPECT_THAT(geo.read(), HasSubstr(starts)) << "commands of other endings are commands";
}

TEST(UntrustedFiles, TheNamedFileMayBeALink) {
  const UntrustedFile geo("");
  geo.write("out/plate.msh", content(meshes + "plate-4.1.msh"));
  fs::create_symlink(geo.path("out/plate.msh"), geo.path("in/link.msh"));
  EXPECT_THAT(geo.read("in/link.msh", {}), HasSubstr("read;"));
}

TEST(UntrustedFiles, TrustOpensOtherFoldersForReadingOnly) {
  const UntrustedFile geo("Include \"../out/more.geo\";\nPoint(101) = {width, 0, 0};");
  geo.write("out/more.geo", "width = 1;\n");
  EXPECT_THAT(geo.read("in/strange.geo", {true, 0.0, 0.0}), HasSubstr("read;"));
  if (!has_seccomp()) GTEST_SKIP() << "not tested: this kernel lacks seccomp";
  geo.write("out/more.geo", "width = 1; Printf(\"x\") > \"made\";\n");
  EXPECT_THAT(geo.read("in/strange.geo", {true, 0.0, 0.0}), HasSubstr("and write none"));
  EXPECT_FALSE(fs::exists(geo.path("in/made")));
  EXPECT_FALSE(fs::exists(geo.path("out/made")));
}

/// gmsh runs name.opt beside a file of any kind.
TEST(UntrustedFiles, CommandsBesideACadFileHarmNothing) {
  if (!has_landlock() || !has_seccomp()) GTEST_SKIP() << not_tested;
  const UntrustedFile step("");
  step.write("in/square.step", content(meshes + "square.step"));
  step.write("in/square.step.opt", "SystemCall \"touch made\";\n");
  EXPECT_THAT(step.read("in/square.step", {}), HasSubstr(starts));
}

TEST(UntrustedFiles, EnvironmentAndHomeAreNotThere) {
  if (!has_landlock() || !has_seccomp()) GTEST_SKIP() << not_tested;
  const UntrustedFile geo(
      "If (StrCmp(GetEnv(\"TISSERAND_PROBE\"), \"\") != 0) Error(\"saw a variable\"); EndIf\n"
      "If (StrCmp(GetEnv(\"HOME\"), \"\") != 0) Error(\"saw a home\"); EndIf");
  ::setenv("TISSERAND_PROBE", "seen", 1);
  EXPECT_THAT(geo.read(), HasSubstr("read;"));
  ::unsetenv("TISSERAND_PROBE");
}

TEST(UntrustedFiles, TextsReachNoTerminalAsTheyAre) {
  if (!has_landlock() || !has_seccomp()) GTEST_SKIP() << not_tested;
  const UntrustedFile geo("Error(\"\x1b[31mred\x07\");");
  EXPECT_THAT(geo.read(), AllOf(HasSubstr("\\x1b[31mred\\x07"), Not(HasSubstr("\x1b"))));
}

// --- limits --------------------------------------------------------------------------------------------------------

TEST(Limits, OfTimeAreNamed) {
  const UntrustedFile loop("For i In {1:1000000000000}\nEndFor");
  reducer::GeometryRequest request;
  request.file = loop.path("in/strange.geo");
  request.is_program = request.is_trusted = true;
  request.seconds = 1.0;
  request.wall_seconds = 500.0;  // the processor may have other work
  request.bytes = 1e9;
  EXPECT_EQ(reducer::run_mesher(request).ending, reducer::MesherEnding::processor_time);
  EXPECT_THAT(loop.read("in/strange.geo", {true, 0.0, 1.0}), HasSubstr("--geometry-time 2"));
  request.seconds = 500.0;
  request.reading_seconds = 1.0;
  EXPECT_EQ(reducer::run_mesher(request).ending, reducer::MesherEnding::reading_time);
  request.reading_seconds = 500.0;
  request.wall_seconds = 1.0;
  EXPECT_EQ(reducer::run_mesher(request).ending, reducer::MesherEnding::wall_time);
}

// A pipe that nobody writes: whoever opens it waits.
TEST(Limits, WaitingIsNoWork) {
  const UntrustedFile waits("Include \"pipe\";");
  ASSERT_EQ(::mkfifo(waits.path("in/pipe").c_str(), 0600), 0);
  reducer::GeometryRequest request;
  request.file = waits.path("in/strange.geo");
  request.is_program = request.is_trusted = true;
  request.seconds = request.wall_seconds = 500.0;
  request.idle_seconds = 1.0;
  request.bytes = 1e9;
  EXPECT_EQ(reducer::run_mesher(request).ending, reducer::MesherEnding::idle);
  fs::rename(waits.path("in/pipe"), waits.path("in/pipe.step"));
  EXPECT_THAT(error_of([&] { reducer::check_mesh_file(waits.path("in/pipe.step"), "p.yaml"); }),
              HasSubstr("is a pipe or a device"));
}

// The trials' square.igs with one number changed: gmsh meshes it without end.
TEST(Limits, DamagedCadFilesEndInSeconds) {
  const std::string damaged = TISSERAND_SOURCE_DIR "/tests/verification/references/trials/damaged.igs";
  formats::MeshFile settings;
  settings.file = damaged;
  const std::string text = error_of([&] { reducer::import_with_gmsh({settings, Units::consistent(), 2, {}}); });
  EXPECT_THAT(text, AllOf(HasSubstr("damaged.igs: gmsh was stopped while meshing the geometry: it needed more than"),
                          HasSubstr("the file is probably damaged")));
}

TEST(Limits, OfMemoryAreNamed) {
#if defined(TISSERAND_SANITIZED)
  GTEST_SKIP() << "not tested: sanitizers reserve terabytes";
#endif
  for (const char* bomb : {"l() = {1:1000000000};", "l() = {};\nFor i In {0:1000}\nl() += {1:1000000};\nEndFor"})
    EXPECT_THAT(UntrustedFile(bomb).read("in/strange.geo", {true, 0.3, 0.0}),
                AllOf(HasSubstr("more than 0.3 GB of memory"), HasSubstr("--geometry-memory 0.6")))
        << bomb;
}

// --- a kernel without Landlock -------------------------------------------------------------------------------------

/// Answers ENOSYS to landlock_create_ruleset, here and in what this process starts.
bool take_landlock_away() {
  std::array<sock_filter, 4> code{sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                                  sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_landlock_create_ruleset, 0, 1),
                                  sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOSYS),
                                  sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0 &&
         !has_landlock();
}

/// What `work` says in a process from which Landlock has been taken; empty if that cannot be done.
std::string without_landlock(const UntrustedFile& place, const std::function<std::string()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (take_landlock_away()) write_text_file(place.path("said"), work());
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return fs::exists(place.path("said")) ? content(place.path("said")) : "";
}

TEST(WithoutLandlock, OnlyTrustedProgramsAreRead) {
  const UntrustedFile files("Printf(\"x\") > \"made\";");
  files.write("in/plate.geo", content(meshes + "plate.geo"));
  files.write("in/square.step", content(meshes + "square.step"));
  files.write("in/opt.step", content(meshes + "square.step"));
  files.write("in/opt.step.opt", "x = 1;\n");
  files.write("in/Mixed.Step", content(meshes + "square.step"));
  const Permission trusted{true, 0.0, 0.0};
  const auto said = [&](const std::string& name, const Permission& permission) {
    return without_landlock(files, [&] { return files.read(name, permission); });
  };
  const std::string refused = said("in/plate.geo", {});
  if (refused.empty()) GTEST_SKIP() << "not tested: this kernel lacks seccomp, with which the test takes Landlock away";
  EXPECT_THAT(refused,
              AllOf(HasSubstr("a .geo file is a program"), HasSubstr("lacks Landlock"), HasSubstr("--trust-geometry")));
  EXPECT_EQ(said("in/plate.geo", trusted), "read; ");
  EXPECT_THAT(said("in/square.step", {}), AllOf(HasSubstr("read; "), HasSubstr("this kernel lacks Landlock")));
  EXPECT_THAT(said("in/opt.step", {}), HasSubstr("--trust-geometry"));
  EXPECT_THAT(said("in/Mixed.Step", {}), HasSubstr("--trust-geometry"));
  EXPECT_THAT(said("in/strange.geo", trusted), HasSubstr("Unable to open file"));
  EXPECT_FALSE(fs::exists(files.path("in/made")));
}

// --- damaged files -------------------------------------------------------------------------------------------------

class DamagedCad : public ::testing::TestWithParam<const char*> {};

/// OpenCASCADE and gmsh crash on about half of these; a process without a child would die with them.
TEST_P(DamagedCad, IsReadOrNamed) {
  const UntrustedFile place("");
  const std::string name = std::string("in/") + GetParam(), whole = content(meshes + GetParam());
  const std::string digits = "0123456789";
  int crashes = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    std::string text = whole;
    if (seed % 5 == 4) text.erase(random() % text.size());
    for (unsigned k = 0; k <= seed % 5 && !text.empty(); ++k) {
      const std::size_t at = random() % text.size();
      const std::size_t digit = seed % 2 == 0 ? text.find_first_of(digits, at) : at;
      if (digit == std::string::npos) continue;
      text[digit] = seed % 2 == 0 ? digits[random() % 10] : static_cast<char>(33 + random() % 94);
    }
    place.write(name, text);
    const std::string reported = place.read(name, {false, 0.0, 5.0});
    EXPECT_THAT(reported, AllOf(Not(HasSubstr("starting")), Not(HasSubstr("tries to start")))) << "seed " << seed;
    crashes += reported.find("gmsh crashed while") != std::string::npos ? 1 : 0;
  }
  RecordProperty("crashes", crashes);
}

INSTANTIATE_TEST_SUITE_P(Files, DamagedCad,
                         ::testing::Values("bracket.step", "crank.step", "square.igs", "bracket.brep"));

// --- answers that make no sense ------------------------------------------------------------------------------------

reducer::CellMesh small_mesh() {
  reducer::CellMesh mesh;
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.node_id = {1, 2, 3};
  reducer::Cell cell{reducer::CellShape::triangle3, 7, {0, 1, 2}};
  mesh.cells[2] = {cell};
  mesh.entities = {{2, 1, "top", 0, 1}};
  mesh.groups = {{"deck", 2, {0}}};
  mesh.geometry = {{0.5, {0.3, 0.3, 0}, {{0, 0, 0}}, {{0, 0, 1}}, {4}}};
  mesh.warnings = {"note"};
  return mesh;
}

std::string reported_by(const reducer::CellMesh& mesh) {
  try {
    reducer::unpack_answer(pack(mesh), "strange.geo");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Answers, ThatDoNotFitAreRefused) {
  EXPECT_EQ(reported_by(small_mesh()), "accepted");
  const auto broken = [](const std::function<void(reducer::CellMesh&)>& harm) {
    reducer::CellMesh mesh = small_mesh();
    harm(mesh);
    return reported_by(mesh);
  };
  EXPECT_THAT(broken([](auto& m) { m.cells[2][0].nodes[1] = 3; }),
              HasSubstr("strange.geo: gmsh returned an invalid mesh"));
  EXPECT_THAT(broken([](auto& m) { m.cells[2][0].nodes[1] = -1; }), HasSubstr("a node that does not exist"));
  EXPECT_THAT(broken([](auto& m) { std::swap(m.cells[2], m.cells[3]); }), HasSubstr("wrong dimension"));
  EXPECT_THAT(broken([](auto& m) { m.position[1][2] = std::numeric_limits<double>::infinity(); }),
              HasSubstr("not a finite number"));
  EXPECT_THAT(broken([](auto& m) { m.node_id.pop_back(); }), HasSubstr("nodes without coordinates"));
  EXPECT_THAT(broken([](auto& m) { m.entities[0].count = 2; }), HasSubstr("elements that do not exist"));
  EXPECT_THAT(broken([](auto& m) { m.entities[0].first = static_cast<std::size_t>(-1); }),
              HasSubstr("an entity with elements that do not exist"));
  EXPECT_THAT(broken([](auto& m) { m.entities[0].dimension = 4; }), HasSubstr("unknown dimension"));
  EXPECT_THAT(broken([](auto& m) { m.entities.clear(), m.groups.clear(); }), HasSubstr("without an entity"));
  EXPECT_THAT(broken([](auto& m) { m.geometry.push_back(m.geometry[0]); }), HasSubstr("geometry without an entity"));
  EXPECT_THAT(broken([](auto& m) { m.geometry[0].normal.clear(); }), HasSubstr("points of a face without normals"));
  EXPECT_THAT(broken([](auto& m) { m.geometry[0].size = -1.0; }), HasSubstr("not a finite number"));
  EXPECT_THAT(broken([](auto& m) { m.groups[0].entities[0] = 1; }), HasSubstr("entities that do not exist"));
}

/// Whatever bytes come: an error or a mesh whose numbers fit.
TEST(Answers, OfAnyBytesNeverCrash) {
  const std::string whole = pack(small_mesh());
  const auto look = [](const std::string& bytes) {
    try {
      const reducer::CellMesh mesh = reducer::unpack_answer(bytes, "strange.geo");
      EXPECT_EQ(mesh.position.size(), mesh.node_id.size());
    } catch (const Error&) {
    }
  };
  for (std::size_t n = 0; n < whole.size(); ++n) {
    look(whole.substr(0, n));
    for (const int value : {0, 1, 0x7f, 0x80, 0xff}) {
      std::string changed = whole;
      changed[n] = static_cast<char>(value);
      look(changed);
    }
  }
  reducer::CellMesh strange = small_mesh();
  strange.groups[0].name = "a\x1b[2J\nb\xff";
  EXPECT_EQ(reducer::unpack_answer(pack(strange), "").groups[0].name, "a\\x1b[2J b\\xff");
}

}  // namespace
}  // namespace tisserand::testing::untrusted_file_test
