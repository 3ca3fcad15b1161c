// SPDX-License-Identifier: GPL-3.0-or-later
// Products of a tall matrix with a block of a few columns. BLAS copies the tall matrix into its own order at each call,
// which takes as long as the product.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// Product Aᵀ B (k x b) of tall matrices A (n x k) and B (n x b), where n is by far the largest. A is read once for up
/// to eight columns of B in registers. Sums have a fixed order.
Eigen::MatrixXd tall_inner_products(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                    const Eigen::Ref<const Eigen::MatrixXd>& B);

/// Subtracts A B from C: C := C − A B for A (n x k), B (k x b) and C (n x b).
void subtract_tall_product(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::MatrixXd& B,
                           Eigen::Ref<Eigen::MatrixXd> C);

}  // namespace tisserand::reducer
