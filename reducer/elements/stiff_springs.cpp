// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about springs so stiff that their round-off hides the stiffness of the part.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "reducer/elements/checks.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;

/// Largest translational and rotational stiffness of elements.
struct Stiffest {
  double translation = 0.0, rotation = 0.0;

  void take(const Eigen::MatrixXd& S, Index per_node) {
    for (Index k = 0; k < S.rows(); ++k)
      (k % per_node < 3 ? translation : rotation) = std::max(k % per_node < 3 ? translation : rotation, S(k, k));
  }
};

/// Adds the diagonals of elements to `stiffest`: of all, or of about a thousand at equal intervals.
template <class Element>
void take_some(const Mesh& mesh, const std::vector<Element>& elements, Index per_node, Stiffest& stiffest) {
  constexpr std::size_t most = 1000;
  ElementMatrices matrices;
  const std::size_t step = std::max<std::size_t>(1, elements.size() / most);
  for (std::size_t e = 0; e < elements.size(); e += step) {
    element_matrices(mesh, elements[e], matrices);
    stiffest.take(matrices.S, per_node);
  }
}

}  // namespace

std::vector<std::string> stiff_spring_doubts(const Mesh& mesh) {
  constexpr double digits_left = 1e8;  // of the 16 decimal digits, half remain for the part
  if (mesh.springs.empty()) return {};
  Stiffest part;
  take_some(mesh, mesh.beams, 6, part);
  take_some(mesh, mesh.shells, 6, part);
  take_some(mesh, mesh.solids, 3, part);
  std::vector<std::string> doubts;
  for (const Spring& spring : mesh.springs) {
    Stiffest own;
    own.take(spring.stiffness, 6);
    const bool by_translation = own.translation > digits_left * part.translation && part.translation > 0.0;
    const bool by_rotation = own.rotation > digits_left * part.rotation && part.rotation > 0.0;
    if (!by_translation && !by_rotation) continue;
    const double stiff = by_translation ? own.translation : own.rotation;
    const double of_part = by_translation ? part.translation : part.rotation;
    doubts.push_back(
        fmt::format("spring '{}' has a stiffness of {:.3g}, {:.2g} times that of the stiffest element ({:.3g}), so "
                    "round-off hides the stiffness of the part; use 1e4 times the stiffness of the elements, which is "
                    "rigid enough, or a rigid spider",
                    spring.name, stiff, stiff / of_part, of_part));
  }
  return doubts;
}

}  // namespace tisserand::reducer
