// SPDX-License-Identifier: GPL-3.0-or-later
// Averaging spiders (RBE3): the reference follows the weighted mean motion of the nodes.
#pragma once

#include <string>

#include "reducer/ties/equations.hpp"

namespace tisserand::reducer {

/// Largest number of nodes of an averaging spider whose coordinates enter the equations of the reference directly.
/// More nodes form groups.
inline constexpr int averaging_group = 24;

/// Appends the equations of an averaging spider to `ties`, whose last name must be that of the spider. The motion v =
/// [translation; rotation] of the reference minimises Σ w (s_iᵀ v − u_i)². u_i is component i of a node, and s_iᵀ v
/// this component for the rigid motion v. So (Σ w s sᵀ) v = Σ w s u. If rotations of nodes are averaged, they have the
/// weight w L², with the mean distance L of the nodes from the reference. This makes them comparable to translations,
/// as in Nastran (pyYeti, nastran/n2p.py, formrbe3, which is tested against Nastran's matrices).
///
/// With more nodes than averaging_group, the sum on the right is taken over groups of near nodes, groups of groups,
/// and so on. Each group has up to six auxiliary coordinates y = Qᵀ x with orthonormal columns Q (pivoted QR
/// decomposition of its share of the sum). So elimination couples near nodes only. The result is exact.
void append_averaging(const Mesh& mesh, const Coordinates& coordinates, const Spider& spider, const std::string& where,
                      TieSystem& ties);

}  // namespace tisserand::reducer
