// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of T [1 0; Ψ Φ], THEORY (79).
#include "reducer/fields/shapes.hpp"

namespace tisserand::reducer {
namespace {

/// A term of a row of x: out.row(row) += coefficient · (row `place` of [1 0; Ψ Φ]).
struct Share {
  Eigen::Index row;
  Eigen::Index place;
  double coefficient;
};

}  // namespace

FullShapes::FullShapes(const ReducedPart& part)
    : system_(part.system),
      boundary_(part.boundary),
      internal_(part.internal),
      n_B_(part.partition.n_B()),
      place_(system_.size(), 0) {
  const Partition& partition = part.partition;
  for (int k = 0; k < std::ssize(partition.boundary); ++k) place_[partition.boundary[k]] = k;
  for (int k = 0; k < std::ssize(partition.internal); ++k) place_[partition.internal[k]] = static_cast<int>(n_B_) + k;
}

Eigen::MatrixXd FullShapes::motions(const std::vector<int>& nodes) const {
  std::vector<Share> inside;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(6 * static_cast<Eigen::Index>(nodes.size()), coordinates());
  const auto add = [&](Eigen::Index row, int q, double coefficient) {
    const Eigen::Index place = place_[q];
    if (place < n_B_)
      out(row, place) += coefficient;
    else
      inside.push_back({row, place - n_B_, coefficient});
  };
  const Coordinates& numbers = system_.coordinates;
  for (int i = 0; i < std::ssize(nodes); ++i)
    for (int x = numbers.first[nodes[i]]; x < numbers.first[nodes[i] + 1]; ++x) {
      const Eigen::Index row = 6 * i + numbers.component[x];
      const int source = system_.T.row[x];
      if (source >= 0)
        add(row, source, 1.0);
      else
        for (const Term& term : system_.T.dependent[-1 - source]) add(row, term.coordinate, term.coefficient);
    }
  const auto add_columns = [&](const Eigen::MatrixXd& modes, Eigen::Index first) {
    for (Eigen::Index k = 0; k < modes.cols(); ++k)
      for (const Share& share : inside) out(share.row, first + k) += share.coefficient * modes(share.place, k);
  };
  add_columns(boundary_.Psi, 0);
  add_columns(internal_.Phi, n_B_);
  return out;
}

}  // namespace tisserand::reducer
