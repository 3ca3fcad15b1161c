// SPDX-License-Identifier: GPL-3.0-or-later
// Drawn beams that touch without a common node are told, unless they are tied.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reducer/sources/part_text.hpp"

namespace tisserand::testing::unjoined_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string points = "points: {a: [0, 0, 0], b: [1, 0, 0], m: [0.5, 0, 0], t: [0.5, 1, 0], u: [0.5, -1, 0]}\n";

std::string beams(const std::string& lines, const std::string& more) {
  std::string text = points + "beams:\n";
  for (std::size_t at = 0, next = 0; at < lines.size(); at = next + 1) {
    next = std::min(lines.find(';', at), lines.size());
    const std::string line = lines.substr(at, next - at);
    text += "  " + line.substr(0, 3) + ": {section: rod, material: steel, " + line.substr(4) + "}\n";
  }
  return text + more + "boundary: [a]\n";
}

TEST(UnjoinedBeams, EndOnAnInnerNode) {
  const auto mesh = mesh_of(beams("bar from: a, to: b, elements: 4;pst from: m, to: t, elements: 2", ""));
  EXPECT_THAT(mesh.warnings, ElementsAre(HasSubstr("node m lies on beam 'bar' but is not connected to it")));
}

TEST(UnjoinedBeams, EndInsideAnElementAndCrossings) {
  const auto inside = mesh_of(beams("bar from: a, to: b, elements: 3;pst from: m, to: t, elements: 2", ""));
  EXPECT_THAT(inside.warnings, ElementsAre(HasSubstr("node m lies on beam 'bar'")));
  const auto crossing = mesh_of(beams("bar from: a, to: b, elements: 2;pst from: u, to: t, elements: 2", ""));
  EXPECT_THAT(crossing.warnings, ElementsAre(HasSubstr("is not connected to it")));
}

TEST(UnjoinedBeams, JoinedOrTiedOnesAreSilent) {
  EXPECT_THAT(
      mesh_of(
          beams("bar from: a, to: m, elements: 2;bat from: m, to: b, elements: 2;pst from: m, to: t, elements: 2", ""))
          .warnings,
      IsEmpty());
  const std::string spring = "springs: {s: {from: m, to: n, stiffness: [1e6, 1e6, 1e6, 1, 1, 1]}}\n";
  std::string tied =
      beams("bar from: a, to: m, elements: 2;bat from: m, to: b, elements: 2;pst from: n, to: t, elements: 2", spring);
  tied.replace(tied.find("t: ["), 0, "n: [0.5, 0, 0], ");
  EXPECT_THAT(mesh_of(tied).warnings, IsEmpty());
}

}  // namespace
}  // namespace tisserand::testing::unjoined_test
