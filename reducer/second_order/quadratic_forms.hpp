// SPDX-License-Identifier: GPL-3.0-or-later
// Σ σ(w_j) Q(Φ_k, Φ_l) over all points of the part: matrices over the reduced coordinates from stresses and gradients
// of batches of elements.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "reducer/elements/second_order.hpp"

namespace tisserand::reducer {

/// Stresses and gradients of some elements that have equal `sections`. Row s · count + e is stress or gradient number
/// s of element e.
struct StrainBatch {
  std::vector<StrainSection> sections;
  int count = 0;
  Eigen::MatrixXd stress;    ///< one column per displacement w that causes stress
  Eigen::MatrixXd gradient;  ///< one column per reduced coordinate, with its displacement Φ
};

/// Number of stresses of one element that has the sections `sections`.
int stress_rows(const std::vector<StrainSection>& sections);

/// Calls use(stress, first, second, coefficient) for every product in the second-order strains of the sections.
/// `stress`, `first` and `second` are rows of the stress and of both gradients of one element.
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

/// Sum over all elements of Φᵀ K_G[w_j] Φ of THEORY (82), for all displacements w_j. A batch costs one matrix product
/// of the stresses of w_j with E2 of the pairs Φ_k, Φ_l: about 2 · stresses · (number of w) · n²/2 operations. The
/// pairs are divided into fixed pieces, so the sums are equal for any number of threads.
class QuadraticForms {
 public:
  QuadraticForms(int coordinates, int displacements, int threads);

  /// Adds the batches one after the other. Each thread computes pieces of the pairs.
  void add(std::span<const StrainBatch> batches);

  /// Sum Φᵀ K_G[w_j] Φ for the displacement j = `displacement` (n x n, symmetric).
  Eigen::MatrixXd matrix(int displacement) const;

 private:
  /// Range of columns of `sum_` for the pairs k, l ≥ k of some k: first ≤ k < end.
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
  std::vector<Eigen::VectorXd> forms_;  ///< for each thread: E2 of the pairs of a piece
  Eigen::MatrixXd sum_;                 ///< sums so far: displacements x pairs
};

}  // namespace tisserand::reducer
