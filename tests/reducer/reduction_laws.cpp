// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the laws of the reduction against dense matrices of the full frame.
#include "tests/reducer/reduction_laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "reducer/system/partition.hpp"
#include "tests/reducer/parts.hpp"

namespace tisserand::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::Superelement;

/// A shift of the size of the first elastic eigenvalues of the frame.
constexpr double frame_shift = -1e4;

/// Unit loads on boundary nodes B and C, node A held: full against reduced.
double flexibility_difference(const FullModel& full, const reducer::Partition& p, const Superelement& e) {
  std::vector<int> free;
  const std::vector<int> held(p.boundary.begin(), p.boundary.begin() + 6);
  for (int i = 0; i < full.system.size(); ++i)
    if (std::find(held.begin(), held.end(), i) == held.end()) free.push_back(i);
  const auto n = static_cast<Eigen::Index>(free.size());
  const MatrixXd flexibility = MatrixXd(full.S(free, free)).ldlt().solve(MatrixXd::Identity(n, n));
  std::vector<int> loaded;
  for (std::size_t b = 6; b < 18; ++b)
    loaded.push_back(static_cast<int>(std::find(free.begin(), free.end(), p.boundary[b]) - free.begin()));
  const MatrixXd reduced = MatrixXd(e.stiffness.block(6, 6, 12, 12)).inverse();
  return relative_difference(reduced, flexibility(loaded, loaded));
}

double effective_mass_difference(const FullModel& full, const reducer::Partition& p) {
  const MatrixXd S_II = full.S(p.internal, p.internal), M_II = full.M(p.internal, p.internal);
  const MatrixXd S_IB = full.S(p.internal, p.boundary), M_IB = full.M(p.internal, p.boundary);
  const MatrixXd X = M_IB - M_II * S_II.ldlt().solve(S_IB);
  const MatrixXd expected = X.transpose() * M_II.ldlt().solve(X);
  const int all = static_cast<int>(p.n_I());
  const MatrixXd reduced = reduce(space_frame(all)).superelement.mass.bottomLeftCorner(all, 18);
  return relative_difference(reduced.transpose() * reduced, expected);
}

}  // namespace

RitzLaws ritz_laws() {
  const FullModel full = full_model(space_frame(0));
  const int all = static_cast<int>(reducer::partition(full.mesh, full.system).n_I());
  const VectorXd exact = eigenvalues(full.S, full.M, frame_shift);
  VectorXd last = VectorXd::Constant(18, std::numeric_limits<double>::infinity());
  RitzLaws laws{-1.0, -1.0, 0.0, 0.0};
  for (const int modes : {0, 1, 4, 10, 20, 40, all}) {
    const reducer::Reduction r = reduce(space_frame(modes));
    const VectorXd lambda = eigenvalues(r.superelement.stiffness, r.superelement.mass, frame_shift);
    const double dropped = std::pow(2.0 * std::numbers::pi * r.model.first_dropped_frequency.value_or(1e30), 2);
    for (int k = 6; k < 18; ++k) {
      laws.below_full = std::max(laws.below_full, exact[k] / lambda[k] - 1.0);
      laws.growth = std::max(laws.growth, lambda[k] / last[k] - 1.0);
      const double bound = exact[k] / (dropped - exact[k]);
      if (modes == all)
        laws.all_modes = std::max(laws.all_modes, std::abs(lambda[k] / exact[k] - 1.0));
      else if (exact[k] < dropped)
        laws.share_of_bound = std::max(laws.share_of_bound, (lambda[k] / exact[k] - 1.0) / bound);
    }
    last = lambda.head(18);
  }
  return laws;
}

BoundaryLaws boundary_laws() {
  const FullModel full = full_model(space_frame(0));
  const reducer::Partition p = reducer::partition(full.mesh, full.system);
  const Superelement e = reduce(space_frame(0)).superelement;
  const MatrixXd R = reducer::rigid_motions_about(full.system, Vector3d::Zero());
  const MatrixXd R_reduced = formats::rigid_motions(e, Vector3d::Zero());
  return {relative_difference(R_reduced.transpose() * e.mass * R_reduced, R.transpose() * full.M * R),
          (e.stiffness * R_reduced).cwiseAbs().maxCoeff() / e.stiffness.cwiseAbs().maxCoeff(),
          flexibility_difference(full, p, e), effective_mass_difference(full, p)};
}

}  // namespace tisserand::testing
