// SPDX-License-Identifier: GPL-3.0-or-later
// Separation of modes of one frequency.
#include "mechanism/bodies/planar/split.hpp"

#include <fmt/format.h>
#include <Eigen/SVD>

#include "common/math/count.hpp"

namespace tisserand::mechanism {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double one_frequency = 1e-8;  ///< relative difference of ω² of modes that may be mixed

double largest(const MatrixXd& A) { return A.size() > 0 ? A.cwiseAbs().maxCoeff() : 0.0; }

}  // namespace

void require_nothing(const MatrixXd& part, double size, const std::string& what) {
  if (!(largest(part) <= planar_share * size))
    throw LeavesPlane{fmt::format("{} has a component of {:.3g} out of the plane, compared with a size of {:.3g}", what,
                                  largest(part), size)};
}

Split split_modes(const ModePulls& pulls, const VectorXd& stiffness, const std::string& kind) {
  const auto m = count_of(stiffness);
  Split split{MatrixXd::Zero(m, m), MatrixXd::Zero(m, m)};
  int in = 0, out = 0;
  for (int first = 0, end = 0; first < m; first = end) {
    const auto pulls_at = [first](const MatrixXd& C) { return largest(C.col(first)) > planar_share; };
    end = first + 1;
    MatrixXd turn = MatrixXd::Identity(1, 1);
    if (pulls_at(pulls.in) && pulls_at(pulls.out)) {
      while (end < m && stiffness[end] <= (1.0 + one_frequency) * stiffness[first]) ++end;
      turn = Eigen::JacobiSVD<MatrixXd>(pulls.out.middleCols(first, end - first), Eigen::ComputeFullV).matrixV();
    }
    for (Eigen::Index k = 0; k < turn.cols(); ++k) {
      const VectorXd mode = turn.col(k);
      const double pull_in = largest(pulls.in.middleCols(first, end - first) * mode),
                   pull_out = largest(pulls.out.middleCols(first, end - first) * mode);
      if (pull_in > planar_share && pull_out > planar_share)
        throw LeavesPlane{fmt::format("{} {} couples with motion in the plane ({:.3g}) and out of the plane ({:.3g})",
                                      kind, first + 1, pull_in, pull_out)};
      (pull_in > planar_share ? split.in.col(in++) : split.out.col(out++)).segment(first, end - first) = mode;
    }
  }
  split.in.conservativeResize(Eigen::NoChange, in);
  split.out.conservativeResize(Eigen::NoChange, out);
  return split;
}

}  // namespace tisserand::mechanism
