// SPDX-License-Identifier: GPL-3.0-or-later
// Test superelements from closed formulas: a free straight beam (12 x 12), and rearrangements that change no physics.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/superelement/superelement.hpp"

namespace tisserand::test_support {

/// A straight beam of constant section along x of the part frame. The defaults are steel-like numbers in SI.
struct BeamData {
  double length = 2.0;
  double young = 2.1e11;
  double shear_modulus = 8.0e10;
  double density = 7800.0;
  double area = 4.0e-4;
  double Iy = 1.5e-8;          ///< second moment that resists bending in the x-z plane
  double Iz = 2.0e-8;          ///< second moment that resists bending in the x-y plane
  double J = 3.0e-8;           ///< torsion constant
  double shear_area_y = 0.0;   ///< 0: Euler-Bernoulli in the x-y plane
  double shear_area_z = 0.0;   ///< 0: Euler-Bernoulli in the x-z plane
  bool rotary_inertia = true;  ///< of the bending terms; the torsional one ρ (Iy + Iz) always stays
};

namespace detail {

/// Adds `block` to the rows and columns `rows` of `matrix`, with signs.
template <std::size_t n>
void scatter(const Eigen::MatrixXd& block, const std::array<int, n>& rows, const std::array<double, n>& sign,
             Eigen::MatrixXd& matrix) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      matrix(rows[i], rows[j]) += sign[i] * sign[j] * block(static_cast<int>(i), static_cast<int>(j));
}

}  // namespace detail

/// Free beam element with nodes "base" (origin) and "tip" (L, 0, 0); rows base x y z rx ry rz, tip x y z rx ry rz.
/// Mass ρAL, centre of mass (L/2, 0, 0), inertia ρ(Iy + Iz)L about x and ρAL³/12 (+ ρI L with rotary inertia) across.
formats::Superelement beam_superelement(const BeamData& beam);

/// Superelement with its rows in another order: row i of the result is row order[i] of `element`.
formats::Superelement permute_rows(const formats::Superelement& element, const std::vector<int>& order);

/// Superelement with its boundary nodes in another order: node i of the result is node order[i]. Rows stay.
formats::Superelement permute_nodes(const formats::Superelement& element, const std::vector<int>& order);

/// Free beam of four equal elements, its three inner nodes reduced by Craig-Bampton. Rows: base and tip as in
/// beam_superelement(), then the internal coordinates 0 ... modes − 1 (modes ≤ 18). These are ascending, with unit
/// modal mass and S_BI = 0.
formats::Superelement craig_bampton_beam(const BeamData& beam, int modes);

}  // namespace tisserand::test_support
