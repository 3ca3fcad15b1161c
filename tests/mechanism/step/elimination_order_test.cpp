// SPDX-License-Identifier: GPL-3.0-or-later
// Order of bodies and joints: no pivot that is zero by structure, and no fill on trees of bodies.
#include "mechanism/solver/elimination_order.hpp"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Core>

namespace tisserand::mechanism::elimination_order_test {
namespace {

constexpr int coordinates = 6, multipliers = 5;  // of a body, of a joint

struct Joined {
  int a, b;  ///< bodies; −1: ground
};

/// Pattern of bodies with six coordinates and of joints with five multipliers.
SparsePattern pattern_of(int bodies, const std::vector<Joined>& joints) {
  std::vector<SparsePattern::Position> positions;
  UnknownBlocks blocks{{}, bodies * coordinates};
  const auto add = [&](int row, int column, int rows, int columns) {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) positions.push_back({row + i, column + j});
  };
  for (int body = 0; body < bodies; ++body) {
    blocks.start.push_back(body * coordinates);
    add(body * coordinates, body * coordinates, coordinates, coordinates);
  }
  int row = bodies * coordinates;
  for (const Joined& joint : joints) {
    blocks.start.push_back(row);
    for (const int body : {joint.a, joint.b}) {
      if (body < 0) continue;
      add(row, body * coordinates, multipliers, coordinates);
      add(body * coordinates, row, coordinates, multipliers);
    }
    for (int i = 0; i < multipliers; ++i) positions.push_back({row + i, row + i});
    row += multipliers;
  }
  return {row, positions, SparsePattern::Storage::sparse, blocks};
}

/// Joints of a random tree, in random order: each body hangs on the ground or on a body before it.
std::vector<Joined> random_tree(int bodies, std::mt19937& random) {
  std::vector<Joined> joints;
  for (int body = 0; body < bodies; ++body)
    joints.push_back({static_cast<int>(random() % static_cast<unsigned>(body + 1)) - 1, body});
  std::ranges::shuffle(joints, random);
  return joints;
}

/// Eliminates in the order by structure alone, multipliers with zeros on the diagonal. Returns the entries of the
/// factors, −1 if a pivot is zero or an unknown is missing.
long entries_of_factors(const SparsePattern& pattern, const std::vector<int>& order) {
  if (std::ssize(order) != pattern.size()) return -1;
  Eigen::MatrixXi left = Eigen::MatrixXi::Zero(pattern.size(), pattern.size());
  for (int j = 0; j < pattern.size(); ++j)
    pattern.for_each_in(j, [&](int i, int) { left(i, j) = i != j || i < pattern.blocks().first_multiplier; });
  std::vector<bool> done(order.size(), false);
  long entries = 0;
  for (const int pivot : order) {
    if (done[pivot] || left(pivot, pivot) == 0) return -1;
    done[pivot] = true;
    ++entries;
    for (int i = 0; i < pattern.size(); ++i) {
      if (done[i] || left(i, pivot) == 0) continue;
      entries += 2;
      for (int j = 0; j < pattern.size(); ++j)
        if (!done[j] && left(pivot, j) != 0) left(i, j) = 1;
    }
  }
  return entries;
}

// A body is eliminated with one joint left, and a joint with one body left: 6 or 5 full rows and columns of 11.
TEST(EliminationOrder, FillsNothingInTreesOfBodies) {
  std::mt19937 random(47);
  for (int trial = 0; trial < 50; ++trial) {
    const int bodies = 2 + static_cast<int>(random() % 12);
    const SparsePattern pattern = pattern_of(bodies, random_tree(bodies, random));
    const long entries = entries_of_factors(pattern, elimination_order(pattern));
    EXPECT_GT(entries, 0);
    EXPECT_LE(entries, bodies * (6 * 6 + 2 * 6 * 5) + bodies * (5 * 5 + 2 * 5 * 6));
  }
}

// Loops fill. A joint that closes one still follows a body, so that no pivot is zero by structure.
TEST(EliminationOrder, HasNoPivotThatIsZeroByStructure) {
  std::mt19937 random(48);
  for (int trial = 0; trial < 50; ++trial) {
    const int bodies = 6 + static_cast<int>(random() % 10);
    std::vector<Joined> joints = random_tree(bodies, random);
    joints.push_back({0, bodies - 1});
    joints.push_back({bodies / 2, -1});
    const SparsePattern pattern = pattern_of(bodies, joints);
    EXPECT_GT(entries_of_factors(pattern, elimination_order(pattern)), 0);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::elimination_order_test
