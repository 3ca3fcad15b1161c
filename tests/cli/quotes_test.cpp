// SPDX-License-Identifier: GPL-3.0-or-later
// Messages about files of another kind: they name file and line and quote nothing. A scene or part from elsewhere may
// name any file that its reader may read.
#include <filesystem>

#include "tests/cli/scenes.hpp"

namespace tisserand::cli::quotes_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

/// What must not be told.
const std::string word = "hushhush";

/// Files as they lie in the homes of people.
const std::vector<std::pair<std::string, std::string>> strange_files{
    {"passwd", "root:x:0:0:hushhush:/root:/bin/bash\nadm:x:1:1:hushhush:/:/bin/sh\n"},
    {"shadow", "root:$6$hushhush$abc:19000:0:99999:7:::\n"},
    {"netrc", "machine example.com login me password hushhush\n"},
    {"env", "PASSWORD=hushhush\nTOKEN=\"hushhush\"\n"},
    {"key", "-----BEGIN PRIVATE KEY-----\nhushhushb3BlbnNzaC1rZXktdjEAAAAABG5v\n-----END PRIVATE KEY-----\n"},
    {"ini", "[default]\nid = hushhush\nhushhush\n"},
    {"yaml", "token: hushhush\nusers: [hushhush, hushhush]\n"},
    {"csv", "user,password\nme,hushhush\n"},
    {"json", "{\"token\": \"hushhush\", hushhush}\n"}};

constexpr const char* car = R"yaml(scene: car
bodies: {w: {type: rigid, mass: 1, inertia: [1, 1, 1]}}
roads: {r: ROAD}
tyres: {t: TYRE}
integrator: {step: 0.01, end: 0.1}
)yaml";
const std::string plane = "{type: plane}";
const std::string slip =
    "{type: comprehensive_slip, wheel: w, road: r, radius: 0.3, stiffness: 1e5, slip_stiffness: 1e4, "
    "cornering_stiffness: 1e4, friction: 1}";
const std::string magic = "{type: magic_formula, wheel: w, road: r, file: strange.tir}";

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  text.replace(text.find(old), old.size(), by);
  return text;
}

class Quotes : public Folder {
 protected:
  /// An error about the strange file that does not quote it.
  static void expect_silent(const Outcome& outcome, const std::string& file) {
    EXPECT_EQ(outcome.code, 1) << outcome.out << outcome.error;
    EXPECT_THAT(outcome.error, HasSubstr(file));
    std::string small = outcome.out + outcome.error;
    for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    EXPECT_THAT(small, Not(HasSubstr(word)));
  }
};

TEST_F(Quotes, ScenesRevealNothingOfUntrustedFiles) {
  const std::string load = "loads.push.value=[0, 0, u]";
  for (const auto& [name, text] : strange_files) {
    SCOPED_TRACE(name);
    write_text(file("strange"), text);
    for (const std::string column : {"{file: strange, time: 1, value: 2}", "{file: strange, time: t, value: u}"})
      expect_silent(with("check", {"inputs={u: " + column + "}", load}), "strange");
    expect_silent(with("check", {"include=strange"}), "strange");
    expect_silent(with("check", {"assemblies={a: strange}", "instances={i: {use: a}}"}), "strange");
    expect_silent(with("check", {"loads.push.value=[{file: strange}, 0, 0]"}), "strange");
    expect_silent(mechanism({"check", "strange"}), "strange");
    for (const std::string column : {"1:2", "t:u"})
      expect_silent(mechanism({"plot", "--reference", "strange:" + column, "-o", "a.png"}), "");
  }
}

TEST_F(Quotes, RoadsAndTyresRevealNothingOfUntrustedFiles) {
  for (const auto& [name, text] : strange_files) {
    SCOPED_TRACE(name);
    for (const char* ending : {"crg", "csv", "tir"}) write_text(file(std::string("strange.") + ending), text);
    const auto check = [&](const std::string& road, const std::string& tyre, const std::string& strange) {
      write_text(file("car.scene.yaml"), replaced(replaced(car, "ROAD", road), "TYRE", tyre));
      expect_silent(mechanism({"check", "car.scene.yaml"}), strange);
    };
    check("{type: crg, file: strange.crg}", slip, "strange.crg");
    check("{type: grid, file: strange.csv}", slip, "strange.csv");
    check(plane, magic, "strange.tir");
  }
}

TEST_F(Quotes, PartsAndDecksRevealNothingOfUntrustedFiles) {
  if (!fs::exists(program("reducer"))) GTEST_SKIP() << "built without the reducer";
  const auto reducer = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all{program("reducer")};
    all.insert(all.end(), words.begin(), words.end());
    return call(all, where);
  };
  for (const auto& [name, text] : strange_files) {
    SCOPED_TRACE(name);
    for (const char* ending : {"inp", "bdf", "part.yaml"}) write_text(file(std::string("strange.") + ending), text);
    expect_silent(reducer({"groups", "strange.inp"}), "strange.inp");
    expect_silent(reducer({"groups", "strange.bdf"}), "strange.bdf");
    expect_silent(reducer({"run", "strange.part.yaml"}), "strange.part.yaml");
    write_text(file("deck.inp"), "*INCLUDE, INPUT=strange.inp\n");
    expect_silent(reducer({"groups", "deck.inp"}), "strange.inp");
    write_text(file("deck.bdf"), "INCLUDE 'strange.bdf'\n");
    expect_silent(reducer({"groups", "deck.bdf"}), "deck.bdf");
  }
}

TEST_F(Quotes, TablesThatAreTablesAreQuoted) {
  const auto with_table = [&](const std::string& text) {
    write_text(file("push.csv"), text);
    return with("check", {"inputs={u: {file: push.csv, time: t, value: weight}}", "loads.push.value=[0, 0, u]"});
  };
  expect_error(with_table("t,v\n0,1\n1,2\n"), {"push.csv:1: there is no column 'weight'", "its 2 columns", "t, v"});
  expect_error(with_table("t,weight\n0,1\n1,two\n"), {"push.csv:3: 'two' in column 2 is not a finite number"});
  expect_error(with_table("t,weight\n0,1.2.3\n"), {"push.csv:2: '1.2.3' in column 2 is not a finite number"});
  EXPECT_EQ(with_table("t,weight\n0,1\n1,2\n").code, 0);
}

// The trial `input_utf16.csv`: "t,v" and two rows, with a mark and without.
TEST_F(Quotes, Utf16IsNamed) {
  for (const bool marked : {true, false}) {
    std::string text = marked ? "\xff\xfe" : "";
    for (const char c : std::string("t,v\n0,1\n1,2\n")) text += {c, '\0'};
    write_text(file("push.csv"), text);
    expect_error(with("check", {"inputs={u: {file: push.csv, time: 1, value: 2}}", "loads.push.value=[0, 0, u]"}),
                 {"push.csv: looks like UTF-16; save it as UTF-8"});
  }
  write_text(file("push.csv"), std::string("t,v\n0,1\n1,2\0"
                                           "2\n",
                                           14));
  expect_error(with("check", {"inputs={u: {file: push.csv, time: 1, value: 2}}", "loads.push.value=[0, 0, u]"}),
               {"push.csv:3: '2\\x002' in column 2 is not a finite number"});
}

TEST_F(Quotes, UnknownOptionsAreCompared) {
  for (const auto& [words, meant] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"run", "arm.scene.yaml", "--setx", "a=1"}, "did you mean --set?"},
           {{"run", "arm.scene.yaml", "--restrat=a.checkpoint.h5"}, "did you mean --restart?"},
           {{"view", "arm.results.h5", "--titel", "arm"}, "did you mean --title?"}}) {
    const Outcome outcome = mechanism(words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.error, HasSubstr(meant));
  }
  EXPECT_THAT(mechanism({"run", "arm.scene.yaml", "--quite-another"}).error, Not(HasSubstr("did you mean")));
}

}  // namespace
}  // namespace tisserand::cli::quotes_test
