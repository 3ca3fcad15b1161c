// SPDX-License-Identifier: GPL-3.0-or-later
// One plate as the part file draws it, and matrices that can be compared whatever the numbering.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tests/support/meshes/small_model.hpp"

namespace tisserand::testing {

/// 6 x 4 shells on 0.6 x 0.4, as meshes/plate.geo and its relatives.
inline const std::string drawn_plate =
    "plates: {deck: {corners: [[0, 0, 0], [0.6, 0, 0], [0.6, 0.4, 0], [0, 0.4, 0]], elements: [6, 4], "
    "thickness: 0.01, material: steel}}\npoints: {o: [0, 0, 0]}\nboundary: [o]\n";

/// Dense S and M with the nodes sorted by place, so that numbering has no influence.
struct Sorted {
  Eigen::MatrixXd S, M;
};

inline Sorted sorted_matrices(const reducer::Mesh& mesh) {
  std::vector<int> order(static_cast<std::size_t>(mesh.nodes()));
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&mesh](int n) {
    return std::lround(mesh.position(0, n) * 1e6) * 10'000'000 + std::lround(mesh.position(1, n) * 1e6);
  };
  std::ranges::sort(order, {}, key);
  const reducer::SmallMatrices small = reducer::assemble_small(mesh);
  const Eigen::MatrixXd S = small.S, M = small.M;
  std::vector<int> rows;
  for (const int n : order)
    for (int c = 0; c < 6; ++c) rows.push_back(6 * n + c);
  return {S(rows, rows), M(rows, rows)};
}

}  // namespace tisserand::testing
