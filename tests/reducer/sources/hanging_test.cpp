// SPDX-License-Identifier: GPL-3.0-or-later
// Hanging nodes are reported with their number and the first place; what joins them, or is no neighbour, is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "formats/part/part.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::testing::hanging_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Warnings of hanging nodes of an Abaqus deck with a skin of shells or a body of solids.
std::vector<std::string> hanging(const std::string& deck, const std::string& part = "") {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.file("deck.inp")) << deck;
  std::ofstream(folder.file("x.part.yaml")) << "part: x\nmesh: {file: deck.inp}\n" << part;
  std::vector<std::string> found;
  for (const std::string& warning :
       reducer::build_mesh_to_solve(formats::read_part(folder.file("x.part.yaml"), {})).warnings)
    if (warning.find("hanging") != std::string::npos) found.push_back(warning);
  return found;
}

const std::string steel = "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1e11, 0.3\n*DENSITY\n7800\n";
const std::string skin = steel + "*SHELL SECTION, ELSET=SKIN, MATERIAL=STEEL\n0.01\n";
const std::string body = steel + "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL\n";

/// One square of side 1 with two halves beyond it: node 9 at (1, 0.5, 0) is in the middle of an edge of the square.
std::string halved(double height = 0.0) {
  return fmt::format(
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 2, 0, 0\n6, 2, 1, 0\n"
      "9, 1, 0.5, {}\n10, 2, 0.5, 0\n"
      "*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n2, 2, 5, 10, 9\n3, 9, 10, 6, 3\n",
      height);
}

TEST(HangingNodes, OnAnEdgeOfAShell) {
  EXPECT_THAT(hanging(halved() + skin),
              ::testing::ElementsAre(AllOf(HasSubstr("1, first node 9 at (1, 0.5, 0) on shell 1 of 'skin'"),
                                           HasSubstr("Divide the elements"))));
}

TEST(HangingNodes, NotThoseBesideAnEdge) {
  EXPECT_THAT(hanging(halved(0.01) + skin), ::testing::IsEmpty()) << "a hole of a hundredth: a crack, and seen";
}

TEST(HangingNodes, NotThoseThatAnEquationTies) {
  std::string ties;
  for (int component = 1; component <= 6; ++component)
    ties += fmt::format("*EQUATION\n3\n9, {0}, 1., 2, {0}, -0.5, 3, {0}, -0.5\n", component);
  EXPECT_THAT(hanging(halved() + skin + ties), ::testing::IsEmpty());
}

/// A rib stands on the diagonal of a square and has a node in its middle, a corner at its ends.
TEST(HangingNodes, OnTheFaceOfAShell) {
  const std::string rib =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0.5, 0.5, 0\n6, 0, 0, 1\n7, 0.5, 0.5, 1\n8, 1, 1, 1\n"
      "*ELEMENT, TYPE=S4, ELSET=SKIN\n1, 1, 2, 3, 4\n2, 1, 5, 7, 6\n3, 5, 3, 8, 7\n";
  EXPECT_THAT(hanging(rib + skin), ::testing::ElementsAre(HasSubstr("1, first node 5 at (0.5, 0.5, 0) on shell 1")));
}

/// Grid of bricks from x = `from`: cells of 1/n, nodes numbered from `first` on; `shared` returns a number for nodes
/// that exist.
class Bricks {
 public:
  void add(double from, int n) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
          elements_ += fmt::format("{}", ++count_);
          for (const auto& [a, b, c] : std::vector<std::array<int, 3>>{
                   {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
            elements_ +=
                fmt::format(", {}", node(from + (i + a) / double(n), (j + b) / double(n), (k + c) / double(n)));
          elements_ += "\n";
        }
  }
  std::string deck() const { return "*NODE\n" + nodes_ + "*ELEMENT, TYPE=C3D8, ELSET=BODY\n" + elements_ + body; }

 private:
  std::size_t node(double x, double y, double z) {
    const std::string place = fmt::format("{:.6f}, {:.6f}, {:.6f}", x, y, z);
    const auto found = std::ranges::find(places_, place);
    if (found != places_.end()) return static_cast<std::size_t>(found - places_.begin()) + 1;
    places_.push_back(place);
    nodes_ += fmt::format("{}, {}\n", places_.size(), place);
    return places_.size();
  }

  std::vector<std::string> places_;
  std::string nodes_, elements_;
  int count_ = 0;
};

/// A cube beside eight of half its size: of the nine nodes between them four are corners of both, five hang.
TEST(HangingNodes, OnFacesAndEdgesOfSolids) {
  Bricks bricks;
  bricks.add(0.0, 1);
  bricks.add(1.0, 2);
  EXPECT_THAT(hanging(bricks.deck()), ::testing::ElementsAre(AllOf(HasSubstr(": 5, first"), HasSubstr("on solid 1"))));
  Bricks even;
  even.add(0.0, 2);
  even.add(1.0, 2);
  EXPECT_THAT(hanging(even.deck()), ::testing::IsEmpty());
}

}  // namespace
}  // namespace tisserand::testing::hanging_test
