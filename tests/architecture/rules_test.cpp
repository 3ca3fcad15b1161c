// SPDX-License-Identifier: GPL-3.0-or-later
// The scanner itself: a planted violation of each rule is found, and only that one.
#include "tests/architecture/rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

namespace tisserand::architecture::rules_test {
namespace {

using ::testing::HasSubstr;

/// A small tree in a temporary folder, in which all rules hold until something is planted.
class PlantedTree : public ::testing::Test {
 protected:
  PlantedTree() {
    std::string name = (std::filesystem::temp_directory_path() / "tisserand-tree-XXXXXX").string();
    root_ = ::mkdtemp(name.data());
    plant("common/a.hpp", "#pragma once\n#include <vector>\n");
    plant("formats/b.hpp", "#pragma once\n#include \"common/a.hpp\"\n");
    plant("formats/b.cpp", "#include \"formats/b.hpp\"\n#include <hdf5.h>\n#include <yaml-cpp/yaml.h>\n");
    plant("reducer/gmsh/mesh.hpp", "#pragma once\n");
    plant("reducer/gmsh/mesh.cpp",
          "#include \"reducer/gmsh/mesh.hpp\"\n#include <gmsh.h>\n#include \"formats/b.hpp\"\n");
    plant("mechanism/solver/klu.cpp", "#include <klu.h>\n#include \"formats/b.hpp\"\n");
    plant("mechanism/main.cpp", "#include <CLI/CLI.hpp>\n");
    plant("README.md", "[a](common/a.hpp) and [b](https://example.org/x)\n");
  }
  ~PlantedTree() override { std::filesystem::remove_all(root_); }

  void plant(const std::string& path, const std::string& text) {
    std::filesystem::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }

  SourceTree tree() const { return read_tree(root_); }

  std::filesystem::path root_;
};

TEST_F(PlantedTree, IsCleanAtFirst) {
  EXPECT_EQ(to_text(check_dependencies(tree())), "");
  EXPECT_EQ(to_text(check_cycles(tree())), "");
  EXPECT_EQ(to_text(check_headers(tree())), "");
  EXPECT_EQ(to_text(check_lengths(tree())), "");
  EXPECT_EQ(to_text(check_functions(tree())), "");
  EXPECT_EQ(to_text(check_source_names(tree())), "");
  EXPECT_EQ(to_text(check_casts(tree())), "");
  EXPECT_EQ(to_text(check_ways(tree())), "");
  EXPECT_EQ(to_text(check_formulas(tree())), "");
  EXPECT_EQ(to_text(check_rooms(tree())), "");
  EXPECT_EQ(to_text(check_stories(tree())), "");
  EXPECT_EQ(to_text(check_wording(tree())), "");
  EXPECT_EQ(to_text(check_links(tree())), "");
  EXPECT_EQ(to_text(check_sentences(tree())), "");
  EXPECT_EQ(to_text(check_docstrings(tree())), "");
}

struct Planted {
  std::string path;
  std::string text;
  std::string found;  ///< expected beginning of the only line of the report
};

class PlantedDependency : public PlantedTree, public ::testing::WithParamInterface<Planted> {};

TEST_P(PlantedDependency, IsFound) {
  plant(GetParam().path, GetParam().text);
  const std::vector<Violation> violations = check_dependencies(tree());
  ASSERT_EQ(violations.size(), 1u) << to_text(violations);
  EXPECT_THAT(to_text(violations), HasSubstr(GetParam().found));
}

INSTANTIATE_TEST_SUITE_P(
    Rules, PlantedDependency,
    ::testing::Values(
        Planted{"common/x.cpp", "#include \"formats/b.hpp\"\n", "common/x.cpp:1: common may not include formats/b.hpp"},
        Planted{"formats/x.cpp", "\n#include \"mechanism/m.hpp\"\n", "formats/x.cpp:2: formats may not include"},
        Planted{"reducer/x.cpp", "#include \"mechanism/m.hpp\" // why\n", "reducer/x.cpp:1"},
        Planted{"tests/mechanism/x_test.cpp", "#include \"reducer/m.hpp\"\n", "tests/mechanism/x_test.cpp:1"},
        Planted{"mechanism/x.cpp", "#include <petscksp.h>\n", "PETSc and SLEPc stay in reducer"},
        Planted{"formats/x.cpp", "#include <slepceps.h>\n", "PETSc and SLEPc stay in reducer"},
        Planted{"reducer/other.cpp", "#include <gmsh.h>\n", "gmsh stays in reducer/gmsh"},
        Planted{"reducer/other.cpp", "#include <linux/landlock.h>\n", "the door is one file of reducer/gmsh"},
        Planted{"reducer/other.cpp", "#include <linux/seccomp.h>\n", "filtered by common/confined/call_filter"},
        Planted{"mechanism/gmsh.cpp", "#include <gmsh.h>\n", "gmsh stays in reducer/gmsh"},
        Planted{"mechanism/equations/newton.cpp", "#include <suitesparse/klu.h>\n", "SuiteSparse stays in four files"},
        Planted{"reducer/x.cpp", "#include <cholmod.h>\n", "SuiteSparse stays in four files"},
        Planted{"reducer/x.cpp", "#include <cvode/cvode.h>\n", "SUNDIALS stays in one file"},
        Planted{"mechanism/x.cpp", "#include <CLI/App.hpp>\n", "only main.cpp sees"},
        Planted{"reducer/x.cpp", "#  include <hdf5.h>\n", "HDF5 stays in formats"},
        Planted{"mechanism/x.hpp", "#include <yaml-cpp/yaml.h>\n", "yaml-cpp stays in formats"},
        Planted{"common/x.hpp", "#include <nlohmann/json.hpp>\n", "common reads and writes no JSON"},
        Planted{"mechanism/bodies/x.cpp", "#include <chrono>\n", "numerics do not include <chrono>"},
        Planted{"mechanism/joints/x.cpp", "#include <iostream>\n", "numerics do not include <iostream>"},
        Planted{"reducer/elements/x.cpp", "int f() { return std::getenv(\"A\") != nullptr; }\n",
                "numerics do not use getenv"},
        Planted{"mechanism/x.cpp",
                "void f() { std::ranges::stable_"
                "sort(lines); }\n",
                "use sort_stably"},
        Planted{"mechanism/x.cpp", "const char* s = \"run reducer again\";\n", "do not name each other"},
        Planted{"reducer/x.cpp", "using namespace mechanism::other;\n", "do not name each other"},
        Planted{"mechanism/CMakeLists.txt", "target_link_libraries(a tisserand_reducer)\n", "do not name each other"}));

TEST_F(PlantedTree, CommentsAndForeignWordsAreNoDependency) {
  plant("mechanism/x.cpp", "// #include <petscksp.h>\n/* reducer\n#include <gmsh.h> */\nint n = 1'000; // reducer's\n");
  plant("reducer/x.cpp", "const char* s = \"a mechanism inside the part\";\n");
  EXPECT_EQ(to_text(check_dependencies(tree())), "");
}

TEST_F(PlantedTree, OneFileStartsTheOtherProgram) {
  plant("mechanism/study/parts.cpp", "const char* program = \"reducer\";\n");
  EXPECT_EQ(to_text(check_dependencies(tree())), "");
  plant("mechanism/study/cells.cpp", "const char* program = \"reducer\";\n");
  EXPECT_THAT(to_text(check_dependencies(tree())),
              HasSubstr("mechanism/study/cells.cpp:1: the two stages do not name"));
}

TEST_F(PlantedTree, CircleOfHeadersIsFound) {
  plant("common/p.hpp", "#include \"common/q.hpp\"\n");
  plant("common/q.cpp", "#include \"common/q.hpp\"\n#include \"common/p.hpp\"\n");
  plant("common/q.hpp", "#include \"common/r.hpp\"\n");
  plant("common/r.hpp", "#include \"common/p.hpp\"\n");
  EXPECT_THAT(to_text(check_cycles(tree())), HasSubstr("common/p -> common/q -> common/r -> common/p"));
}

TEST_F(PlantedTree, CircleOfFoldersIsFound) {
  plant("mechanism/bodies/p.hpp", "#include \"mechanism/joints/q.hpp\"\n");
  plant("mechanism/joints/r.hpp", "#include \"mechanism/bodies/s.hpp\"\n");
  EXPECT_THAT(to_text(check_cycles(tree())), HasSubstr("mechanism/bodies -> mechanism/joints -> mechanism/bodies"));
}

TEST_F(PlantedTree, CircleThroughTheRootOfAStageIsFound) {
  plant("mechanism/main.cpp", "#include \"mechanism/study/a.hpp\"\n");
  plant("mechanism/study/a.cpp", "#include \"mechanism/simulate.hpp\"\n");
  EXPECT_EQ(to_text(check_cycles(tree())), "");
  plant("mechanism/simulate.cpp", "#include \"mechanism/study/b.hpp\"\n");
  EXPECT_THAT(to_text(check_cycles(tree())), HasSubstr("mechanism/study -> mechanism/simulate -> mechanism/study"));
}

TEST_F(PlantedTree, UnguardedAndLateHeadersAreFound) {
  plant("common/p.hpp", "// #pragma once\n");
  EXPECT_EQ(to_text(check_headers(tree())), "common/p.hpp: has no #pragma once\n");
  plant("common/p.hpp", "#pragma once\n");
  plant("common/p.cpp", "#include <vector>\n#include \"common/p.hpp\"\n");
  EXPECT_EQ(to_text(check_headers(tree())), "common/p.cpp: must include common/p.hpp first\n");
}

TEST_F(PlantedTree, LengthIsBounded) {
  const auto lines = [](int n) {
    std::string text;
    for (int i = 0; i < n; ++i) text += "\n";
    return text;
  };
  plant("common/long.hpp", lines(300));
  plant("common/long.cpp", lines(500));
  EXPECT_EQ(to_text(check_lengths(tree())), "");
  plant("common/long.hpp", lines(301));
  EXPECT_EQ(to_text(check_lengths(tree())), "common/long.hpp: 301 lines, at most 300\n");
}

TEST_F(PlantedTree, LongFunctionsAndNumberedNamesAreFound) {
  const auto function = [](const std::string& name, int lines) {
    std::string text = "namespace a {\nclass B {\n  int size() { return 1; }\n};\nint " + name +
                       "(int a,\n    const char* text = \"}(,\") {\n";
    for (int i = 0; i < lines - 3; ++i) text += "  if (a) { a = int{1}; }  // }\n";
    return text + "}\n}\n";
  };
  plant("common/long.cpp", function("long_one", 60));
  EXPECT_EQ(to_text(check_functions(tree())), "");
  plant("common/list.cpp", function("some_fields", 61));
  EXPECT_EQ(to_text(check_functions(tree())), "");
  plant("common/long.cpp", function("long_one", 61));
  EXPECT_EQ(to_text(check_functions(tree())), "common/long.cpp:5: long_one: 61 lines, 60 are allowed\n");
  plant("common/long.cpp", "struct A {\n  int work_1;  // or work_2\n};\n");
  EXPECT_THAT(to_text(check_functions(tree())), HasSubstr("common/long.cpp:2: a name that says nothing"));
}

TEST_F(PlantedTree, FunctionsWithManyParametersAreCounted) {
  std::string text;
  for (int i = 0; i < 200; ++i)
    text += "void f" + std::to_string(i) + "(std::map<int, int> a, int b, int c, int d, int e) {}\n";
  plant("common/many.cpp", text);
  EXPECT_EQ(to_text(check_functions(tree())), "");
  text.clear();
  for (int i = 0; i < 200; ++i)
    text += "void g" + std::to_string(i) + "(int a, int b, int c, int d, int e, int f) {}\n";
  plant("common/many.cpp", text);
  EXPECT_THAT(to_text(check_functions(tree())), HasSubstr("200 functions have more than 5 parameters"));
}

TEST_F(PlantedTree, LongWaysAndWaysBackAreFound) {
  const auto row = [](const std::vector<std::string>& rooms) {
    std::string text = "## Ways through the code\n\n| a step size |";
    for (const std::string& room : rooms) text += " [x](" + room + "/x.cpp)";
    return text + " |\n\n## More\n\n| [x](a/b) [x](c/d) [x](a/b) |\n";
  };
  plant("mechanism/MAP.md", row({"run", "run", "../formats/scene", "step", "solver", "joints"}));
  EXPECT_EQ(to_text(check_ways(tree())), "");
  plant("mechanism/MAP.md", row({"run", "../formats/scene", "step", "solver", "joints", "forces"}));
  EXPECT_EQ(to_text(check_ways(tree())), "mechanism/MAP.md:3: a way through 6 rooms, at most 5\n");
  plant("mechanism/MAP.md", row({"run", "step", "run"}));
  EXPECT_EQ(to_text(check_ways(tree())), "mechanism/MAP.md:3: a way that comes back to mechanism/run\n");
}

TEST_F(PlantedTree, FormulasThatAreNotThereAreFound) {
  plant("docs/THEORY.md", "$$ a \\tag{1} $$\n\n$$ b\n   c \\tag{2} $$\n\n## 12. Reduction\n\n$$ d \\tag{3} $$\n");
  plant("tests/mechanism/step/theory_step_test.cpp", "// (1) to (2)\nint f(2);\n");
  plant("mechanism/solver/a.hpp", "#pragma once\n// a of THEORY (1), (3): [HW96] (8.5) and (7)\n");
  EXPECT_EQ(to_text(check_formulas(tree())), "");
  plant("mechanism/solver/a.hpp", "#pragma once\n/// THEORY (2) to (4).\n");
  EXPECT_EQ(to_text(check_formulas(tree())),
            "mechanism/solver/a.hpp:2: cites THEORY (4), but docs/THEORY.md has 3 formulas\n");
  plant("mechanism/solver/a.hpp", "#pragma once\n");
  plant("tests/mechanism/step/theory_step_test.cpp", "// (1)\n");
  EXPECT_EQ(to_text(check_formulas(tree())), "docs/THEORY.md: formula 2 is in no tests/mechanism/*/theory_*test.cpp\n");
  plant("docs/THEORY.md", "$$ a \\tag{1} $$\n$$ b \\tag{3} $$\n## 12. Reduction\n");
  EXPECT_THAT(to_text(check_formulas(tree())), HasSubstr("docs/THEORY.md:2: formula 3 follows formula 1"));
}

TEST_F(PlantedTree, SourcesOfAnotherNameAreFound) {
  plant("formats/c.cpp", "#include \"formats/b.hpp\"\n");
  EXPECT_EQ(to_text(check_source_names(tree())),
            "formats/c.cpp: has no header of its name, and is not on the list of those that share one\n");
  plant("formats/c.hpp", "#pragma once\n");
  plant("formats/page/surface.hpp", "#pragma once\n");
  EXPECT_EQ(to_text(check_source_names(tree())),
            "formats/page/thinning.cpp: is listed as a part of formats/page/surface.hpp, but is not there\n");
  plant("formats/page/thinning.cpp", "");
  EXPECT_EQ(to_text(check_source_names(tree())), "");
  plant("formats/page/thinning.hpp", "#pragma once\n");
  EXPECT_THAT(to_text(check_source_names(tree())), HasSubstr("formats/page/thinning.cpp: has a header of its name"));
}

TEST_F(PlantedTree, CastsToIntAreCounted) {
  std::string text = "#include \"common/a.hpp\"\n";
  for (int i = 0; i < 600; ++i) text += "int a = static_cast<int>(3.0);  // and static_cast<int>(4.0)\n";
  plant("common/a.cpp", text);
  EXPECT_THAT(to_text(check_casts(tree())), HasSubstr("600 casts to int"));
  plant("common/a.cpp",
        "#include \"common/a.hpp\"\nvoid f() {\n  for (int i = 0; i < static_cast<int>(a.b().size()); ++i) {}\n}\n");
  EXPECT_THAT(to_text(check_casts(tree())), HasSubstr("common/a.cpp:3: compare an index with std::ssize()\n"));
  plant("common/a.cpp", "#include \"common/a.hpp\"\nint a = static_cast<int>(b->c[1].size());\n");
  EXPECT_EQ(to_text(check_casts(tree())), "common/a.cpp:2: write count_of() for a size as an int\n");
}

TEST_F(PlantedTree, FullRoomsAndLongStoriesAreFound) {
  for (int i = 0; i < 30; ++i) plant("common/math/" + std::to_string(i) + ".hpp", "#pragma once\n");
  EXPECT_EQ(to_text(check_rooms(tree())), "");
  plant("common/math/more.cpp", "\n");
  EXPECT_EQ(to_text(check_rooms(tree())), "common/math: 31 sources, at most 30\n");
  std::string page;
  for (int i = 0; i < 80; ++i) page += "\n";
  plant("mechanism/step/step.cpp", page);
  EXPECT_EQ(to_text(check_stories(tree())), "");
  plant("mechanism/step/step.cpp", page + "\n");
  EXPECT_EQ(to_text(check_stories(tree())), "mechanism/step/step.cpp: 81 lines, a story has at most 80\n");
}

TEST_F(PlantedTree, LongSentencesAreFound) {
  std::string words, table;
  for (int i = 0; i < 29; ++i) words += "word" + std::string(i % 7 == 6 ? "\n" : " ");
  for (int i = 0; i < 40; ++i) table += "word ";
  plant("formats/PAGE.md",
        "# Title\n\nA " + words + ". Next " + words + ".\n\n| A " + std::string(words.size(), 'b') + " |\n");
  EXPECT_EQ(to_text(check_sentences(tree())), "");
  plant("formats/PAGE.md", "# Title\n\n- One.\n- A `b c d` [two words](x.md) " + words + "\n");
  EXPECT_THAT(to_text(check_sentences(tree())), HasSubstr("formats/PAGE.md:4: 33 words in a sentence, at most 30"));
}

TEST_F(PlantedTree, DocstringsWithoutNounAreFound) {
  plant("common/a.hpp",
        "#pragma once\n/// O"
        "f a beam.\nint f();\n/// Mass\n/// O"
        "f a beam.\nint g();\nint h;  ///< The sa"
        "me of h\n");
  EXPECT_EQ(to_text(check_docstrings(tree())),
            "common/a.hpp:2: a docstring begins with a noun or a verb\n"
            "common/a.hpp:7: a docstring begins with a noun or a verb\n");
}

TEST_F(PlantedTree, MissingLicencesAreFound) {
  const std::string licence = "SPDX-License-Identifier: GPL-3.0-or-later\n";
  plant("common/a.hpp", "// " + licence + "#pragma once\n");
  plant("common/a.cpp", "// " + licence + "#include \"common/a.hpp\"\n");
  plant("scripts/b", "#!/bin/sh\n# " + licence);
  plant("scripts/c", "#!/bin/sh\necho\n");
  plant("cmake/d.cmake", "# a list\n");
  std::string found;
  for (const Violation& violation : check_licences(tree()))
    if (violation.path.find("/a.") != std::string::npos || !violation.path.ends_with("pp"))
      found += violation.path + " ";
  EXPECT_EQ(found, "cmake/d.cmake scripts/c ");
}

TEST_F(PlantedTree, TypesOfOneNameAreFound) {
  plant("reducer/a.hpp",
        "namespace tisserand::reducer {\nstruct Twice {\n};\nstruct Once {\n};\n}  // namespace tisserand::reducer\n");
  plant("reducer/b.hpp",
        "namespace tisserand::reducer {\nclass Twice : A {\n};\nstruct Twice::Impl {\n};\nclass Once;\n}  // "
        "namespace\n");
  plant("reducer/c.cpp",
        "namespace tisserand::reducer {\nnamespace {\nstruct Twice {\n};\n}  // namespace\n}  // namespace\n");
  plant("formats/d.hpp", "namespace tisserand::formats {\nstruct Twice {\n};\n}  // namespace\n");
  const std::vector<Violation> found = check_type_names(tree());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].path, "reducer/b.hpp");
  EXPECT_EQ(found[0].what, "tisserand::reducer::Twice is also defined in reducer/a.hpp");
}

TEST_F(PlantedTree, WordingIsChecked) {
  for (const std::string text : {"// TO"
                                 "DO later",
                                 "see /tm"
                                 "p/x",
                                 "a \xE2\x80\x94 b", "blank ", "\xE2\x80\x9Cquoted"}) {
    plant("formats/PAGE.md", text + "\n");
    EXPECT_EQ(check_wording(tree()).size(), 1u) << text;
  }
  plant("formats/PAGE.md",
        "a/tm"
        "p/b, a - b, 'quoted'\n");
  EXPECT_EQ(to_text(check_wording(tree())), "");
}

TEST_F(PlantedTree, DeadLinksAreFound) {
  plant("formats/PAGE.md", "[x](../common/a.hpp#l3) [y](none.md)\n");
  EXPECT_EQ(to_text(check_links(tree())), "formats/PAGE.md:1: dead link: none.md\n");
  plant("formats/PAGE.md", "see `formats/NONE.md` and `formats/b.hpp`\n");
  EXPECT_THAT(to_text(check_links(tree())), HasSubstr("names a file that is not there: formats/NONE.md"));
  plant("formats/PAGE.md", "");
  plant("common/a.hpp", "#include \"x/missing.hpp\"\nint a;  // rules: ABSENT.md, PAGE.md\n");
  EXPECT_EQ(to_text(check_links(tree())), "common/a.hpp:2: names a page that is not there: ABSENT.md\n");
}

TEST_F(PlantedTree, UnknownSourceKeysAreFound) {
  plant("CONVENTIONS.md", "| [Abc01] | A. Bc, 2001 |\n");
  plant("common/a.hpp", "#pragma once\nint a;  // as in [Abc01] (3), not as in [Xyz99]\n");
  EXPECT_EQ(to_text(check_links(tree())), "common/a.hpp:2: CONVENTIONS.md has no source [Xyz99]\n");
}

}  // namespace
}  // namespace tisserand::architecture::rules_test
