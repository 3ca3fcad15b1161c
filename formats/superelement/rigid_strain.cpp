// SPDX-License-Identifier: GPL-3.0-or-later
// Compares rigid motions with the softest deformations of scaled stiffness matrices, and counts digits of entries.
#include "formats/superelement/rigid_strain.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace tisserand::formats {
namespace {

constexpr int chosen_digits = 4;           // limit of digits of chosen numbers such as 12.5
constexpr int double_digits = 15;          // from here on entries are not rounded
constexpr int digits_lost_in_fields = 3;   // by sign and exponent in fields of fixed width
constexpr double usual_share = 0.3;        // of entries; 10 % of rounded ones end in 0 and look shorter
constexpr double single_precision = 6e-8;  // 2⁻²⁴
constexpr double least_digits = 2e-8;      // nine or more digits: compare with single precision
constexpr double entry_error = 1e-9;       // of every entry: accuracy of reductions by other programs
constexpr double reduction_error = 1e-11;  // of max |S|: 2⁻⁵² × stiffness of the mesh / that of the part, rows
constexpr double zero_stiffness = 1e-12;   // of |S|: internal hinges, with round-off
constexpr double rank_tolerance = 1e-9;    // of rigid motions on the rows of S
constexpr Eigen::Index most_eigenvectors = 400;
constexpr Eigen::Index subspace_vectors = 12;
constexpr int subspace_passes = 4;

/// Number of digits of the shortest decimal text of `value`.
int decimal_digits(double value) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), std::abs(value), std::chars_format::scientific);
  const char* exponent = std::find(text.data(), end.ptr, 'e');
  const auto length = static_cast<int>(exponent - text.data());
  return length > 1 ? length - 1 : length;  // without the point
}

/// Number of digits to which the entries were rounded, or double_digits if they were not.
int usual_digits(const Eigen::MatrixXd& matrix) {
  std::array<long, double_digits> count{};
  long total = 0;
  int most = 0;
  for (const double value : matrix.reshaped()) {
    if (value == 0.0) continue;
    const int digits = decimal_digits(value);
    if (digits >= double_digits) return double_digits;
    most = std::max(most, digits);
    ++count[digits];
    ++total;
  }
  if (most <= chosen_digits) return double_digits;
  long shorter = 0;
  for (int digits = 1; digits <= most; ++digits) {
    shorter += count[digits];
    if (static_cast<double>(shorter) >= usual_share * static_cast<double>(total))
      return std::max({digits, chosen_digits + 1, most - digits_lost_in_fields});
  }
  return most;
}

/// Whether every entry is a single-precision number, up to the relative error `decimal` of its text.
bool has_single_precision(const Eigen::MatrixXd& matrix, double decimal) {
  return std::ranges::all_of(matrix.reshaped(), [&](double value) {
    return std::abs(value) < static_cast<double>(std::numeric_limits<float>::max()) &&
           std::abs(value - static_cast<double>(static_cast<float>(value))) <= decimal * std::abs(value);
  });
}

/// Deformations (columns, orthonormal, without rigid motions) and their stiffness.
struct Deformations {
  Eigen::MatrixXd vector;
  Eigen::VectorXd stiffness;
};

/// Softest deformations and those caused by `forces`, by inverse iteration and Rayleigh-Ritz. `lifted`: P S P + σ QQᵀ.
Deformations soft_deformations(const Eigen::MatrixXd& lifted, const Eigen::MatrixXd& Q, double sigma,
                               const Eigen::MatrixXd& forces) {
  const Eigen::Index n = lifted.rows();
  Eigen::LLT<Eigen::MatrixXd> factor;
  for (double shift = 1e-15; shift < 1e-5; shift *= 100.0) {
    Eigen::MatrixXd shifted = lifted;
    shifted.diagonal().array() += shift * sigma;
    factor.compute(shifted);
    if (factor.info() == Eigen::Success) break;
  }
  if (factor.info() != Eigen::Success) return {};  // indefinite, which another check reports
  const auto orthonormal = [&](Eigen::MatrixXd Y) {
    for (int pass = 0; pass < 2; ++pass) Y -= (Q * (Q.transpose() * Y)).eval();
    const Eigen::Index columns = Y.cols();
    return Eigen::MatrixXd(Eigen::HouseholderQR<Eigen::MatrixXd>(Y).householderQ() *
                           Eigen::MatrixXd::Identity(n, columns));
  };
  Eigen::MatrixXd Y(n, subspace_vectors);
  for (Eigen::Index j = 0; j < Y.cols(); ++j)
    for (Eigen::Index i = 0; i < n; ++i) Y(i, j) = std::sin(1.0 + static_cast<double>((7 * j + 3) * i + j));
  for (int pass = 0; pass < subspace_passes; ++pass) Y = orthonormal(factor.solve(orthonormal(Y)));
  Eigen::MatrixXd Z(n, Y.cols() + forces.cols());
  Z << Y, factor.solve(forces);
  for (Eigen::Index j = 0; j < Z.cols(); ++j) Z.col(j).normalize();  // not colwise(): a column may be zero
  Z = orthonormal(Z);
  const Eigen::MatrixXd reduced = Z.transpose() * (lifted * Z);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (reduced + reduced.transpose()));
  return {Z * eigen.eigenvectors(), eigen.eigenvalues()};
}

Deformations deformations(const Eigen::MatrixXd& S, const Eigen::MatrixXd& Q, const Eigen::MatrixXd& forces) {
  const Eigen::Index n = S.rows(), count = n - Q.cols();
  const Eigen::MatrixXd SQ = S * Q, QSQ = Q.transpose() * SQ;
  Eigen::MatrixXd lifted = S + Q * QSQ * Q.transpose() - SQ * Q.transpose() - Q * SQ.transpose();
  lifted = (0.5 * (lifted + lifted.transpose())).eval();
  const double sigma = 2.0 * lifted.norm();
  lifted += sigma * Q * Q.transpose();
  if (n > most_eigenvectors) return soft_deformations(lifted, Q, sigma, forces);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(lifted);
  return {eigen.eigenvectors().leftCols(count), eigen.eigenvalues().head(count)};
}

/// Causes of the forces of motions r: unexplained beyond (errors + entry_error |S| + reduction_error 11ᵀ) |r|.
std::vector<RigidStrainCause> causes_of(const Eigen::MatrixXd& S, const Eigen::MatrixXd& r,
                                        const Eigen::MatrixXd& errors) {
  const Eigen::MatrixXd size = r.cwiseAbs(), force = (S * r).cwiseAbs();
  Eigen::MatrixXd bound = (reduction_error * size.colwise().sum()).replicate(r.rows(), 1);
  bound += entry_error * S.cwiseAbs() * size;
  if (errors.size() > 0) bound += errors * size;
  std::vector<RigidStrainCause> causes;
  for (Eigen::Index k = 0; k < r.cols(); ++k)
    causes.push_back((force.col(k).array() <= bound.col(k).array()).all() ? RigidStrainCause::rounding
                                                                          : RigidStrainCause::unexplained);
  return causes;
}

/// The larger of √Σ_j (v_jᵀ f)² / (d_j d_1) and |rᵀ f| / d_1, for each force f = S r.
Eigen::VectorXd changes(const Deformations& soft, const Eigen::MatrixXd& r, const Eigen::MatrixXd& forces,
                        double zero) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(r.cols());
  const Eigen::ArrayXd stiffness = soft.stiffness.array().abs();
  double softest = std::numeric_limits<double>::infinity();
  for (const double d : stiffness)
    if (d > zero) softest = std::min(softest, d);
  if (std::isinf(softest)) return change;
  const Eigen::ArrayXd scale = (stiffness.max(zero) * softest).sqrt().inverse();
  for (Eigen::Index k = 0; k < r.cols(); ++k) {
    const Eigen::ArrayXd strain = (soft.vector.transpose() * forces.col(k)).array() * scale;
    change[k] = std::max(strain.matrix().norm(), std::abs(r.col(k).dot(forces.col(k))) / softest);
    if (std::isnan(change[k])) change[k] = std::numeric_limits<double>::infinity();
  }
  return change;
}

}  // namespace

EntryErrors entry_errors(const Eigen::MatrixXd& matrix) {
  const int digits = usual_digits(matrix);
  const double decimal = digits < double_digits ? 0.5 * std::pow(10.0, 1 - digits) : 0.0;
  const bool chosen = digits == double_digits && std::ranges::all_of(matrix.reshaped(), [](double value) {
                        return value == 0.0 || decimal_digits(value) <= chosen_digits;
                      });
  if (!chosen && decimal < least_digits && has_single_precision(matrix, decimal))
    return {single_precision * matrix.cwiseAbs(), "single precision"};
  if (decimal == 0.0) return {};
  return {decimal * matrix.cwiseAbs(), fmt::format("{} digits", digits)};
}

RigidStrain rigid_strain(const Eigen::MatrixXd& whole_S, const Eigen::MatrixXd& R,
                         const Eigen::MatrixXd& whole_errors) {
  RigidStrain result;
  // Zero rows (unheld rotations) would mix rigid motions, with the errors of their forces, into hinges.
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < whole_S.rows(); ++i)
    if ((whole_S.col(i).array() != 0.0).any()) rows.push_back(i);
  const Eigen::MatrixXd S = whole_S(rows, rows), r = R.colwise().normalized()(rows, Eigen::all), forces = S * r;
  const Eigen::MatrixXd errors = whole_errors.size() > 0 ? whole_errors(rows, rows).eval() : Eigen::MatrixXd();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(rank_tolerance);
  qr.compute(r);
  if (S.rows() <= qr.rank()) return result;
  const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(S.rows(), qr.rank());
  const Deformations soft = deformations(S, Q, forces);
  if (soft.stiffness.size() == 0) return result;
  const double zero = zero_stiffness * S.cwiseAbs().rowwise().sum().maxCoeff();
  const Eigen::VectorXd change = changes(soft, r, forces, zero);
  const std::vector<RigidStrainCause> causes = causes_of(S, r, errors);
  for (Eigen::Index k = 0; k < r.cols(); ++k) {
    const bool worse_cause = causes[k] > result.cause && change[k] > rigid_change_accepted;
    if (!worse_cause && (causes[k] < result.cause || change[k] <= result.change)) continue;
    result.cause = causes[k];
    result.change = change[k];
    result.motion = k;
  }
  Eigen::Index row = 0;
  result.force = forces.col(result.motion).cwiseAbs().maxCoeff(&row) * R.col(result.motion).norm();
  result.row = rows[static_cast<std::size_t>(row)];
  return result;
}

}  // namespace tisserand::formats
