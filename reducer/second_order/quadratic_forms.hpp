// SPDX-License-Identifier: GPL-3.0-or-later
// Σ σ(w_j) Q(Φ_k, Φ_l) over all points of the part: matrices over the reduced coordinates from stresses and gradients
// of batches of elements.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "reducer/elements/second_order.hpp"

namespace tisserand::reducer {

/// Elements of one layout. Row s · count + e contains stress (gradient) s of element e.
struct StrainBatch {
  std::vector<StrainSection> sections;
  int count = 0;
  Eigen::MatrixXd stress;    ///< a column per displacement w
  Eigen::MatrixXd gradient;  ///< a column per displacement Φ of a coordinate
};

/// Number of stress rows of one element.
int stress_rows(const std::vector<StrainSection>& sections);

/// Calls use(stress, first, second, coefficient) for all products of the sections, with rows of stress and gradients.
template <class Use>
void for_each_product(const std::vector<StrainSection>& sections, const Use& use) {
  int stress = 0, gradient = 0;
  for (const StrainSection& section : sections)
    for (int r = 0; r < section.repeat; ++r) {
      for (const QuadraticTerm& term : section.pattern->terms)
        use(stress + term.stress, gradient + term.first, gradient + term.second, term.coefficient);
      stress += section.pattern->stresses;
      gradient += section.pattern->gradients;
    }
}

/// Accumulates Φᵀ K_G[w_j] Φ of THEORY (82) for all w_j: per batch one matrix product (stresses of w)ᵀ (E2 of pairs
/// Φ_k, Φ_l), about 2 · stresses · (number of w) · n²/2 operations. Columns have fixed pieces, so sums are the same for
/// any number of threads.
class QuadraticForms {
 public:
  QuadraticForms(int coordinates, int displacements, int threads);

  /// Adds the batches one after the other; each thread computes pieces of the pairs.
  void add(std::span<const StrainBatch> batches);

  /// Φᵀ K_G[w_j] Φ, n x n, symmetric.
  Eigen::MatrixXd matrix(int displacement) const;

 private:
  /// Pairs k, l ≥ k for some k: columns from `column` on.
  struct Piece {
    int first = 0;
    int end = 0;
    Eigen::Index column = 0;
    Eigen::Index width = 0;
  };
  void add(const StrainBatch& batch, const Piece& piece, Eigen::VectorXd& memory);

  int n_ = 0;
  int threads_ = 1;
  std::vector<Piece> pieces_;
  std::vector<Eigen::VectorXd> forms_;  ///< one per thread: E2 of the pairs of a piece
  Eigen::MatrixXd sum_;                 ///< displacements x pairs
};

}  // namespace tisserand::reducer
