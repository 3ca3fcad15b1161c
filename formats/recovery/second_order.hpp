// SPDX-License-Identifier: GPL-3.0-or-later
// Second-order displacement in a recovery file: a quadratic form of the coordinates for each shape
// (formats/RECOVERY.md, second-order displacement).
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"

namespace tisserand::formats {

/// Forms of u₂ = Σ_r s_r ½ yᵀ C_r y with the shapes s_r. A dropped internal coordinate k moves by ½ yᵀ C_k y.
struct SecondOrderForms {
  std::vector<Eigen::MatrixXd> of_shape;       ///< C_r, n x n each, symmetric
  std::vector<Eigen::MatrixXd> of_coordinate;  ///< C_k
  std::vector<int> coordinate;                 ///< k of each

  int shapes() const { return count_of(of_shape); }
};

/// Note for a body with stiffening whose recovery file has no second order.
inline constexpr const char* no_second_order_note =
    "the recovery file has no displacement of second order (it was written before version 1.3): between the boundary "
    "nodes "
    "the foreshortening of bent parts is spread as a push would spread it; reduce the part again with `recovery: yes`";

/// Values ½ yᵀ C y of every form and instant: forms x T. `y`: n x T.
Eigen::MatrixXd second_order_amplitudes(const std::vector<Eigen::MatrixXd>& forms, const Eigen::MatrixXd& y);

/// Amplitudes of the shapes, shapes x T, zero except at `stiffened` instants (T; 1 or 0). Adds the second-order motion
/// of the coordinates `left_out` to y: the body lacks these coordinates. `y`: n x T, of the part in the units of the
/// file.
Eigen::MatrixXd add_second_order(const SecondOrderForms& forms, const Eigen::RowVectorXd& stiffened,
                                 const std::vector<Eigen::Index>& left_out, Eigen::MatrixXd& y);

/// 1 for instants at which a body has its stiffening, else 0. If the results do not say whether it is `stiffened`
/// (before version 1.13), `y_strain` (n x T, y with the second-order strain) differs from y then.
Eigen::RowVectorXd stiffened_instants(std::optional<bool> stiffened, const Eigen::MatrixXd& y,
                                      const Eigen::MatrixXd& y_strain);

}  // namespace tisserand::formats
