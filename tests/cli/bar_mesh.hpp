// SPDX-License-Identifier: GPL-3.0-or-later
// A bar of tetrahedra as a deck that this program and CalculiX read.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Core>

namespace tisserand::cli {

/// Straight tetrahedra of ten nodes in a bar of 0.4 x 0.05 x 0.04 m, numbers from 101.
struct BarMesh {
  std::map<std::array<int, 3>, int> number;  ///< by place on a grid of half cells
  std::vector<std::array<int, 10>> tetrahedra;
  std::map<int, Eigen::Vector3d> position;

  static constexpr std::array<int, 3> cells{6, 1, 1};

  int node(const std::array<int, 3>& at) {
    const auto [found, is_new] = number.try_emplace(at, 101 + static_cast<int>(number.size()));
    if (is_new)
      position[found->second] = {0.4 * at[0] / (2.0 * cells[0]), 0.05 * at[1] / (2.0 * cells[1]),
                                 0.04 * at[2] / (2.0 * cells[2])};
    return found->second;
  }
  BarMesh() {
    // Six tetrahedra around the diagonal of a cell: along the axes in each order.
    for (int i = 0; i < cells[0]; ++i)
      for (std::array<int, 3> order : {std::array{0, 1, 2}, std::array{0, 2, 1}, std::array{1, 0, 2},
                                       std::array{1, 2, 0}, std::array{2, 0, 1}, std::array{2, 1, 0}}) {
        std::array<std::array<int, 3>, 4> corner{};
        corner[0] = {2 * i, 0, 0};
        for (std::size_t k = 0; k < 3; ++k) {
          corner[k + 1] = corner[k];
          corner[k + 1][static_cast<std::size_t>(order[k])] += 2;
        }
        const bool left = order == std::array{0, 2, 1} || order == std::array{1, 0, 2} || order == std::array{2, 1, 0};
        if (left) std::swap(corner[1], corner[2]);
        constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
        std::array<int, 10> nodes{};
        for (std::size_t k = 0; k < 4; ++k) nodes[k] = node(corner[k]);
        for (std::size_t k = 0; k < 6; ++k) {
          std::array<int, 3> middle{};
          for (std::size_t c = 0; c < 3; ++c) middle[c] = (corner[edges[k][0]][c] + corner[edges[k][1]][c]) / 2;
          nodes[k + 4] = node(middle);
        }
        tetrahedra.push_back(nodes);
      }
  }

  /// Nodes, elements, material and section, for both programs; in m, kg, s or in mm, t, s.
  std::string deck(bool is_mm) const {
    std::string text = "*NODE\n";
    for (const auto& [id, at] : position) {
      const Eigen::Vector3d x = (is_mm ? 1e3 : 1.0) * at;
      text += fmt::format("{}, {:.17g}, {:.17g}, {:.17g}\n", id, x.x(), x.y(), x.z());
    }
    text += "*ELEMENT, TYPE=C3D10, ELSET=body\n";
    for (std::size_t e = 0; e < tetrahedra.size(); ++e)
      text += fmt::format("{}, {}\n", e + 1, fmt::join(tetrahedra[e], ", "));
    return text + fmt::format(
                      "*MATERIAL, NAME=steel\n*ELASTIC\n{}, 0.3\n*DENSITY\n{}\n*SOLID SECTION, ELSET=body, "
                      "MATERIAL=steel\n",
                      is_mm ? "2.1e5" : "2.1e11", is_mm ? "7.85e-9" : "7850");
  }
  int at(int i, int j, int k) const { return number.at({i, j, k}); }
};

}  // namespace tisserand::cli
