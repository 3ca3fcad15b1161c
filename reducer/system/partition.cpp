// SPDX-License-Identifier: GPL-3.0-or-later
// Partition of the coordinates and extraction of the blocks.
#include "reducer/system/partition.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/QR>

namespace tisserand::reducer {
namespace {

/// Place of each coordinate: its index among the internal ones, or −1 − its index on the boundary.
std::vector<int> places(const Partition& p) {
  std::vector<int> place(p.boundary.size() + p.internal.size());
  for (int i = 0; i < std::ssize(p.internal); ++i) place[p.internal[i]] = i;
  for (int b = 0; b < std::ssize(p.boundary); ++b) place[p.boundary[b]] = -1 - b;
  return place;
}

}  // namespace

Partition partition(const Mesh& mesh, const System& system) {
  std::vector<OwnedCoordinate> boundary;
  for (int b = 0; b < std::ssize(mesh.boundary); ++b)
    for (int component = 0; component < 6; ++component)
      if (component < 3 ? mesh.boundary[b].translations : mesh.boundary[b].rotations)
        boundary.push_back({system.coordinates.of(mesh.boundary[b].node, component), b});
  return partition(system, boundary);
}

Partition partition(const System& system, const std::vector<OwnedCoordinate>& boundary) {
  Partition p;
  std::vector<bool> taken(static_cast<std::size_t>(system.size()), false);
  for (const OwnedCoordinate& b : boundary) {
    const int q = system.T.row[b.x];
    if (q < 0) continue;
    p.boundary.push_back(q);
    p.boundary_node.push_back(b.owner);
    p.boundary_component.push_back(system.coordinates.component[b.x]);
    taken[q] = true;
  }
  for (int q = 0; q < system.size(); ++q)
    if (!taken[q]) p.internal.push_back(q);
  return p;
}

std::vector<int> six_coordinates(const System& system) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivots(system.R.transpose());
  std::vector<int> six;
  for (Eigen::Index k = 0; k < 6; ++k) six.push_back(static_cast<int>(pivots.colsPermutation().indices()[k]));
  std::ranges::sort(six);
  return six;
}

SymmetricPair internal_matrices(SymmetricPair matrices, const Partition& p) {
  const std::vector<int> place = places(p);
  std::vector<int> begin{0};
  begin.reserve(p.internal.size() + 1);
  int to = 0;  // remaining rows and columns keep their order: every entry moves down
  for (const int i : p.internal) {
    for (int k = matrices.begin[i]; k < matrices.begin[i + 1]; ++k) {
      if (place[matrices.column[k]] < 0) continue;
      matrices.column[to] = place[matrices.column[k]];
      matrices.S[to] = matrices.S[k];
      matrices.M[to] = matrices.M[k];
      ++to;
    }
    begin.push_back(to);
  }
  matrices.begin = std::move(begin);
  matrices.column.resize(static_cast<std::size_t>(to));
  matrices.S.resize(static_cast<std::size_t>(to));
  matrices.M.resize(static_cast<std::size_t>(to));
  return matrices;
}

Blocks split(SymmetricPair matrices, const Partition& p) {
  const std::vector<int> place = places(p);
  Blocks blocks;
  blocks.S_BB = blocks.M_BB = Eigen::MatrixXd::Zero(p.n_B(), p.n_B());
  std::vector<Eigen::Triplet<double>> S_IB, M_IB;
  for (int i = 0; i < matrices.size(); ++i)
    for (int k = matrices.begin[i]; k < matrices.begin[i + 1]; ++k) {
      const int a = place[i], b = place[matrices.column[k]];
      if (a >= 0 && b >= 0) continue;
      if (a < 0 && b < 0) {
        blocks.S_BB(-1 - a, -1 - b) = blocks.S_BB(-1 - b, -1 - a) = matrices.S[k];
        blocks.M_BB(-1 - a, -1 - b) = blocks.M_BB(-1 - b, -1 - a) = matrices.M[k];
      } else {
        S_IB.emplace_back(std::max(a, b), -1 - std::min(a, b), matrices.S[k]);
        M_IB.emplace_back(std::max(a, b), -1 - std::min(a, b), matrices.M[k]);
      }
    }
  blocks.S_IB.resize(p.n_I(), p.n_B());
  blocks.M_IB.resize(p.n_I(), p.n_B());
  blocks.S_IB.setFromTriplets(S_IB.begin(), S_IB.end());
  blocks.M_IB.setFromTriplets(M_IB.begin(), M_IB.end());
  if (p.n_I() > 0) {
    SystemMatrices II = to_petsc(internal_matrices(std::move(matrices), p));
    blocks.S_II = std::move(II.stiffness);
    blocks.M_II = std::move(II.mass);
  }
  return blocks;
}

Eigen::MatrixXd rows(const Eigen::MatrixXd& all, const std::vector<int>& which) { return all(which, Eigen::all); }

}  // namespace tisserand::reducer
