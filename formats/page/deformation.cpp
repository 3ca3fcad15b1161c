// SPDX-License-Identifier: GPL-3.0-or-later
// Computes singular vectors from the two Gram matrices, which are as small as the number of coordinates.
#include "formats/page/deformation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Factors of modes amplitudesᵀ = U Aᵀ. Columns of U are orthonormal, those of A orthogonal and descending.
struct Singular {
  MatrixXd U;  ///< 3 V x r
  MatrixXd A;  ///< T x r
};

/// Singular vectors of Φ Yᵀ. With ΦᵀΦ = Q D Qᵀ and S = D^½ Qᵀ they are those of S Yᵀ, mapped by Φ Q D^-½.
Singular singular_vectors(const Deformation& d) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> gram(d.modes.transpose() * d.modes);
  const VectorXd D = gram.eigenvalues();
  const Index m = D.size();
  const double least = 1e-14 * std::max(D.tail(1)[0], 0.0);
  Index first = 0;
  while (first < m && !(D[first] > least)) ++first;
  const VectorXd root = D.tail(m - first).cwiseSqrt();
  const MatrixXd Q = gram.eigenvectors().rightCols(m - first);
  const MatrixXd M = d.amplitudes * Q * root.asDiagonal();  // T x r
  const Eigen::SelfAdjointEigenSolver<MatrixXd> visited(M.transpose() * M);
  const MatrixXd W = visited.eigenvectors().rowwise().reverse();
  return {d.modes * (Q * root.cwiseInverse().asDiagonal() * W), M * W};
}

/// Largest displacement of any vertex at any instant, from X Yᵀ (3 V x T), computed in blocks.
double largest_displacement(const MatrixXd& X, const MatrixXd& Y) {
  constexpr Index block = 768;
  double largest = 0.0;
  MatrixXd values;
  for (Index row = 0; row < X.rows(); row += block) {
    const Index count = std::min(block, X.rows() - row);
    values.noalias() = X.middleRows(row, count) * Y.transpose();
    for (Index t = 0; t < values.cols(); ++t)
      for (Index v = 0; v < count; v += 3) largest = std::max(largest, values.col(t).segment<3>(v).squaredNorm());
  }
  return std::sqrt(largest);
}

/// Rows of at most about 2000 vertices, evenly chosen. They speed up the search; stated errors use all vertices.
MatrixXd sample(const MatrixXd& X) {
  constexpr Index most = 2000;
  const Index vertices = X.rows() / 3, step = std::max<Index>(1, vertices / most), count = (vertices + step - 1) / step;
  MatrixXd chosen(3 * count, X.cols());
  for (Index i = 0; i < count; ++i) chosen.middleRows(3 * i, 3) = X.middleRows(3 * i * step, 3);
  return chosen;
}

/// Smallest number of vectors for which the rest is at most `tolerance`.
Index enough(const MatrixXd& U, const MatrixXd& A, double tolerance) {
  Index low = 0, high = A.cols();  // high is enough, low - 1 is not
  while (low < high) {
    const Index middle = (low + high) / 2, rest = A.cols() - middle;
    if (largest_displacement(U.rightCols(rest), A.rightCols(rest)) <= tolerance)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

/// Stores the first k vectors in steps that add at most `tolerance` in total, and the resulting error.
void store(const Deformation& d, const Singular& s, Index k, double tolerance, FewModes& few) {
  const Index vertices = s.U.rows() / 3;
  few.modes.resize(k * vertices, 3);
  few.step.assign(k, 1.0);
  few.amplitudes = s.A.leftCols(k).cast<float>();
  MatrixXd stored(s.U.rows(), k);
  for (Index j = 0; j < k; ++j) {
    constexpr double largest_integer = 32767.0;
    const double reach = std::max(s.A.col(j).cwiseAbs().maxCoeff(), 1e-300), size = s.U.col(j).cwiseAbs().maxCoeff();
    // Each component has an error of at most half a step, so a vertex at most sqrt(3)/2 steps.
    const double wanted = tolerance / (reach * static_cast<double>(k) * std::sqrt(0.75));
    few.step[j] = std::max(wanted, size / largest_integer);
    for (Index v = 0; v < vertices; ++v)
      for (Index c = 0; c < 3; ++c) {
        const double value = few.step[j] * std::rint(s.U(3 * v + c, j) / few.step[j]);
        few.modes(j * vertices + v, c) = stored(3 * v + c, j) = value;
      }
  }
  MatrixXd X(d.modes.rows(), d.modes.cols() + k), Y(d.amplitudes.rows(), d.modes.cols() + k);
  X << d.modes, -stored;
  Y << d.amplitudes, few.amplitudes.cast<double>();
  few.error = largest_displacement(X, Y);
}

}  // namespace

double largest_displacement(const Deformation& deformation) {
  return largest_displacement(deformation.modes, deformation.amplitudes);
}

FewModes few_modes(const Deformation& deformation, double relative, double size) {
  FewModes few;
  few.amplitudes.resize(deformation.amplitudes.rows(), 0);
  if (deformation.modes.cols() == 0 || deformation.modes.rows() == 0) return few;
  few.largest = largest_displacement(deformation.modes, deformation.amplitudes);
  few.error = few.largest;
  if (!(few.largest > 1e-9 * size)) return few;
  const Singular s = singular_vectors(deformation);
  const double tolerance = relative * few.largest;
  constexpr double share_of_steps = 0.2;  // of the error, allowed for rounding to integers
  Index k = enough(sample(s.U), s.A, 0.7 * tolerance);
  for (; k <= s.A.cols(); ++k) {
    store(deformation, s, k, share_of_steps * tolerance, few);
    if (few.error <= tolerance) break;
  }
  return few;
}

}  // namespace tisserand::formats
