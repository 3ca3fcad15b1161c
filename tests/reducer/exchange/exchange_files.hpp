// SPDX-License-Identifier: GPL-3.0-or-later
// Files written by hand and superelements to compare with, for the tests of import and export.
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/exchange/to_superelement.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::reducer::exchange::testing {

using test_support::error_of;

/// A folder with files.
class Files : public test_support::TemporaryFolder {
 public:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }
};

inline ImportOptions options_named(const std::string& name) { return {name, Units::si(), {}}; }

/// Largest difference relative to the diagonals: |a_ij − b_ij| / √(a_ii a_jj), or to |a_ij| where these vanish.
inline double distance(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  double worst = A.rows() == B.rows() ? 0.0 : 1e300;
  for (Eigen::Index j = 0; j < A.cols() && worst < 1e300; ++j)
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const double scale = std::max(std::sqrt(std::abs(A(i, i) * A(j, j))), std::abs(A(i, j)));
      if (A(i, j) != B(i, j)) worst = std::max(worst, std::abs(A(i, j) - B(i, j)) / std::max(scale, 1e-300));
    }
  return worst;
}

/// Free steel beam of 2 m with four internal coordinates, canonical, its S free of rigid strain to rounding.
inline formats::Superelement reduced_beam() {
  formats::Superelement beam = test_support::craig_bampton_beam({}, 4);
  const Eigen::VectorXd lambda = beam.stiffness.diagonal().tail(4);
  formats::filter_rigid_motions(beam);
  beam.stiffness.topRightCorner(12, 4).setZero();
  beam.stiffness.bottomLeftCorner(4, 12).setZero();
  beam.stiffness.bottomRightCorner(4, 4) = lambda.asDiagonal();
  beam.content_id = formats::content_id(beam);
  return beam;
}

}  // namespace tisserand::reducer::exchange::testing
