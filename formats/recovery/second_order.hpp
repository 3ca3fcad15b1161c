// SPDX-License-Identifier: GPL-3.0-or-later
// Second-order displacement in a recovery file: a quadratic form of the coordinates for each shape
// (formats/RECOVERY.md, second-order displacement).
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"

namespace tisserand::formats {

/// Quadratic forms of the second-order displacement u₂ = Σ_r s_r ½ yᵀ C_r y with the shapes s_r and the coordinates y.
/// An internal coordinate k that a body leaves out moves by ½ yᵀ C_k y.
struct SecondOrderForms {
  std::vector<Eigen::MatrixXd> of_shape;       ///< C_r (n x n each), symmetric
  std::vector<Eigen::MatrixXd> of_coordinate;  ///< C_k (n x n each), for the coordinates in `coordinate`
  std::vector<int> coordinate;                 ///< k of each form in `of_coordinate`

  int shapes() const { return count_of(of_shape); }
};

/// Note for a body with stiffening whose recovery file has no second order.
inline constexpr const char* no_second_order_note =
    "the recovery file has no second-order displacement, because it was written before version 1.3. Between the "
    "boundary nodes, the foreshortening of bent parts is distributed as by an axial force. Reduce the part again with "
    "`recovery: yes`";

/// Values ½ yᵀ C y of every form C at every instant (forms x T). `y`: coordinates (n x T).
Eigen::MatrixXd second_order_amplitudes(const std::vector<Eigen::MatrixXd>& forms, const Eigen::MatrixXd& y);

/// Amplitudes of the second-order shapes (shapes x T). They are zero except at `stiffened` instants (T; 1 or 0). The
/// function also adds to y the second-order motion of the coordinates `left_out`, which the body lacks. `y`:
/// coordinates (n x T) of the part in units of the file.
Eigen::MatrixXd add_second_order(const SecondOrderForms& forms, const Eigen::RowVectorXd& stiffened,
                                 const std::vector<Eigen::Index>& left_out, Eigen::MatrixXd& y);

/// Flags (T) that are 1 at instants at which a body has its stiffening, else 0. `stiffened`: whether results from
/// version 1.13 on say so for the whole run. Without it, flags are 1 where `y_strain` (n x T, y with second-order
/// strain) differs from y.
Eigen::RowVectorXd stiffened_instants(std::optional<bool> stiffened, const Eigen::MatrixXd& y,
                                      const Eigen::MatrixXd& y_strain);

}  // namespace tisserand::formats
