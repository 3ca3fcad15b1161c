// SPDX-License-Identifier: GPL-3.0-or-later
// List of the numerical arrays of a modal body file, shared by its reader, writer and checks.
#pragma once

#include <cstdint>

#include "formats/hdf5/file.hpp"
#include "formats/modal_body/modal_body.hpp"

namespace tisserand::formats {

/// Array of 3 x 3 blocks, of which a column holds 9 numbers per block. In memory the 9 numbers are column by column, in
/// the file row by row.
template <class Array>
struct Blocks {
  Array& array;
};

/// Numbers of nodes, modes and residual components of a modal body, which give the shapes of its arrays.
struct ModalSizes {
  std::uint64_t n, m, f;  ///< nodes, modes, components of the residual
};

/// Calls visit(dataset, shape, meaning of the shape, array) for each array of a modal body.
template <class Body, class Visit>
void for_each_array(Body& body, const ModalSizes& sizes, const Visit& visit) {
  const auto [n, m, f] = sizes;
  visit("/frame/position", {3}, "three numbers", body.frame_position);
  visit("/frame/orientation", {4}, "w x y z", body.frame_orientation);
  visit("/nodes/position", {n, 3}, "n x 3 positions", body.node_position);
  visit("/nodes/mass", {n}, "n masses", body.node_mass);
  visit("/nodes/inertia", {n, 3, 3}, "n x 3 x 3 inertias", body.node_inertia);
  visit("/modes/X", {n, 6, m}, "n x 6 x m rows of the modes", body.X);
  visit("/modes/omega2", {m}, "m modes", body.omega2);
  visit("/modes/zeta", {m}, "m modes", body.zeta);
  auto& sums = body.integrals;
  visit("/integrals/mass", {1}, "one number", sums.mass);
  visit("/integrals/c0", {3}, "three numbers", sums.c0);
  visit("/integrals/C1", {3, m}, "3 x m", sums.C1);
  visit("/integrals/P0", {3, 3}, "3 x 3", sums.P0);
  visit("/integrals/P1", {m, 3, 3}, "m x 3 x 3", Blocks{sums.P1});
  visit("/integrals/P2", {m, m, 3, 3}, "m x m x 3 x 3", Blocks{sums.P2});
  visit("/integrals/J_mu", {3, 3}, "3 x 3", sums.J_mu);
  visit("/integrals/N_mu", {3, m}, "3 x m", sums.N_mu);
  if (f == 0) return;
  visit("/residual/flexibility", {f, f}, "f x f", body.residual.flexibility);
  visit("/residual/mass", {f, f}, "f x f", body.residual.mass);
  visit("/residual/coupling", {6, f}, "6 x f", body.residual.coupling);
}

}  // namespace tisserand::formats
