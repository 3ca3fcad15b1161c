// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of elements, ties, boundary, ways to reduce and descriptions: a part is the same however it is described.
#include <array>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/text.hpp"
#include "reducer/modes/eps_block_lanczos.hpp"
#include "reducer/reduce.hpp"
#include "reducer/solve/solve.hpp"
#include "tests/reducer/crossings/description.hpp"
#include "tests/reducer/crossings/fingerprint.hpp"
#include "tests/reducer/crossings/model.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/crossings/pairs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::testing::crossings {
namespace {

Cell cell_of(const test_support::crossings::Choice& choice) {
  return {static_cast<Body>(choice[0]), static_cast<Extra>(choice[1]), static_cast<Boundary>(choice[2]),
          static_cast<Way>(choice[3]), static_cast<Change>(choice[4])};
}

std::vector<Cell> all_cells() {
  std::vector<Cell> cells;
  for (const auto& choice : test_support::crossings::pairwise({sizes.begin(), sizes.end()},
                                                              [](const auto& c) { return is_sensible(cell_of(c)); }))
    cells.push_back(cell_of(choice));
  return cells;
}

reducer::Solution solved_with_buckling(const formats::Part& part) {
  start_solvers();
  return reducer::solve(part, {.modes = 5, .points = {}, .buckling = 3}, [](const std::string&) {});
}

std::vector<Trait> traits(const Cell& cell, const Description& d) {
  const PartModel model = part_model(cell);
  const test_support::TemporaryFolder folder;
  const std::string deck = d.is_abaqus ? "crossing.inp" : "crossing.bdf";
  write_text_file(folder.file(deck), deck_text(model, d));
  write_text_file(folder.file("crossing.part.yaml"), part_text(model, d, cell.way, deck));
  const formats::Part part = formats::read_part(folder.file("crossing.part.yaml"), {});
  return fingerprint(reduce(part), solved_with_buckling(part), d, model.has_own_second_order);
}

void compare(const Cell& cell) {
  if (cell.way == Way::block_lanczos && !reducer::has_block_lanczos()) return;
  SCOPED_TRACE(name_of(cell));
  try {
    const Difference worst = worst_difference(traits(cell, {}), traits(cell, description_of(cell.change)));
    EXPECT_LE(worst.share, 1.0) << worst.name;
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
  }
}

// About a dozen of the cells of AllDescriptions.
TEST(PartCrossings, FewDescriptions) {
  const std::vector<Cell> cells = all_cells();
  for (std::size_t k = 0; k < cells.size(); k += cells.size() / 12) compare(cells[k]);
}

/// The cell with the next sensible change of its description.
Cell with_next_change(Cell cell) {
  do cell.change = static_cast<Change>((static_cast<int>(cell.change) + 1) % sizes[4]);
  while (!is_sensible(cell));
  return cell;
}

// Any two of 9 bodies, 5 extras, 4 boundaries, 7 ways and 6 descriptions meet, each part in two descriptions.
TEST(PartCrossings, AllDescriptions) {
  std::set<std::array<int, 4>> pairs;
  int cells = 0;
  for (const Cell& chosen : all_cells())
    for (const Cell& cell : {chosen, with_next_change(chosen)}) {
      const std::array<int, 5> values{static_cast<int>(cell.body), static_cast<int>(cell.extra),
                                      static_cast<int>(cell.boundary), static_cast<int>(cell.way),
                                      static_cast<int>(cell.change)};
      for (int i = 0; i < 5; ++i)
        for (int j = i + 1; j < 5; ++j) pairs.insert({i, values[i], j, values[j]});
      compare(cell);
      ++cells;
    }
  EXPECT_EQ(cells, 150);
  EXPECT_GE(pairs.size(), 300u);
}

// Each extra acts: it changes the part by far more than the limits.
TEST(PartCrossings, EveryExtraActs) {
  const auto of = [](Extra extra) {
    return traits({Body::quads, extra, Boundary::ends, Way::modes, Change::turned}, {});
  };
  const std::vector<Trait> plain = of(Extra::nothing);
  for (const Extra extra : {Extra::mass, Extra::bushing, Extra::link, Extra::offset})
    EXPECT_GT(worst_difference(plain, of(extra)).share, 1e3) << static_cast<int>(extra);
}

// Without the similarity that maps it back, another description is a different part.
TEST(PartCrossings, EveryDescriptionDiffers) {
  const Cell cell{Body::bricks, Extra::nothing, Boundary::ends, Way::modes, Change::turned};
  const std::vector<Trait> plain = traits(cell, {});
  for (const Change change : {Change::turned, Change::mirrored, Change::units, Change::far}) {
    const Description d = description_of(change);
    const PartModel model = part_model(cell);
    const test_support::TemporaryFolder folder;
    write_text_file(folder.file("crossing.bdf"), deck_text(model, d));
    write_text_file(folder.file("crossing.part.yaml"), part_text(model, d, cell.way, "crossing.bdf"));
    const formats::Part part = formats::read_part(folder.file("crossing.part.yaml"), {});
    const std::vector<Trait> unmapped = fingerprint(reduce(part), solved_with_buckling(part), {}, true);
    EXPECT_GT(worst_difference(plain, unmapped).share, 1e3) << static_cast<int>(change);
  }
}

}  // namespace
}  // namespace tisserand::testing::crossings
