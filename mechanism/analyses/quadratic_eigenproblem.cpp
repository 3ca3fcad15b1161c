// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenvalues of a shifted inverse in first-order form by LAPACK; single ones by inverse iteration.
#include "mechanism/analyses/quadratic_eigenproblem.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "common/error.hpp"
#include "common/stable_sort.hpp"

extern "C" void dgeev_(const char* left, const char* right, const int* n, double* A, const int* lda, double* real,
                       double* imaginary, double* VL, const int* ldvl, double* VR, const int* ldvr, double* work,
                       const int* lwork, int* info);

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

enum class Vectors { none, right };

Spectrum eigen(MatrixXd A, Vectors kind) {
  if (!A.allFinite())  // LAPACK would not return
    throw Error(
        "the linearised scene has no finite shifted inverse: its inertia, damping and stiffness are singular together",
        "modes", "fix or remove bodies that have neither mass nor stiffness");
  const int n = static_cast<int>(A.rows()), one = 1;
  const char* right = kind == Vectors::right ? "V" : "N";
  VectorXd real(n), imaginary(n), work(1);
  MatrixXd V(kind == Vectors::right ? n : 1, kind == Vectors::right ? n : 1);
  const int ldv = static_cast<int>(V.rows());
  int info = 0, size = -1;
  dgeev_("N", right, &n, A.data(), &n, real.data(), imaginary.data(), nullptr, &one, V.data(), &ldv, work.data(), &size,
         &info);
  size = static_cast<int>(work[0]);
  work.resize(size);
  dgeev_("N", right, &n, A.data(), &n, real.data(), imaginary.data(), nullptr, &one, V.data(), &ldv, work.data(), &size,
         &info);
  if (info != 0)
    throw Error("the iteration for the eigenvalues of the linearised scene does not converge", "modes",
                "change the state slightly");
  Spectrum spectrum{real.cast<Complex>() + Complex(0, 1) * imaginary.cast<Complex>(), {}};
  if (kind == Vectors::none) return spectrum;
  spectrum.vectors = V.cast<Complex>();
  for (int k = 0; k + 1 < n; ++k) {
    if (!(imaginary[k] > 0.0)) continue;  // columns k, k + 1: real and imaginary part of a pair
    spectrum.vectors.col(k) = V.col(k).cast<Complex>() + Complex(0, 1) * V.col(k + 1).cast<Complex>();
    spectrum.vectors.col(k + 1) = spectrum.vectors.col(k).conjugate();
  }
  return spectrum;
}

/// Matrix G = (A − sE)⁻¹E of A = [0 1; −K −C], E = [1 0; 0 M]: G [p; r] = [a; p + s a], P(s) a = −(M r + (C + sM) p).
MatrixXd shifted_inverse(const QuadraticProblem& m, double s) {
  const Eigen::Index k = m.M.rows();
  const MatrixXd P = s * s * m.M + s * m.C + m.K;
  const Eigen::PartialPivLU<MatrixXd> factors(P);
  MatrixXd G(2 * k, 2 * k);
  G.topLeftCorner(k, k) = -factors.solve(m.C + s * m.M);
  G.topRightCorner(k, k) = -factors.solve(m.M);
  G.bottomRows(k) = s * G.topRows(k);
  G.bottomLeftCorner(k, k).diagonal().array() += 1.0;
  return G;
}

/// The first shift among s, 1.37 s, 1.37² s, … at which P(s) is regular. P(s) is singular at real eigenvalues
/// (divergence, creep).
double away_from_eigenvalues(const QuadraticProblem& m, double s) {
  double best = s, largest = -1.0;
  for (int attempt = 0; attempt < 6; ++attempt, s *= 1.3717) {
    const double regular = Eigen::PartialPivLU<MatrixXd>(s * s * m.M + s * m.C + m.K).rcond();
    if (!(regular > largest)) continue;
    best = s, largest = regular;
    if (largest > 1e-10) break;
  }
  return best;
}

/// The finite eigenvalues from the inverse with one shift, ascending |λ|.
Spectrum of_one_shift(const QuadraticProblem& m, double s) {
  const Spectrum inverse = eigen(shifted_inverse(m, s), Vectors::right);
  const double infinite = 1e-13 * inverse.values.cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> finite;
  for (Eigen::Index k = 0; k < inverse.values.size(); ++k)
    if (std::abs(inverse.values[k]) > infinite) finite.push_back(k);  // the others are massless directions
  const auto value = [&](Eigen::Index k) { return s + 1.0 / inverse.values[k]; };
  sort_stably(finite, {}, [&](Eigen::Index k) { return std::abs(value(k)); });
  Spectrum sorted{VectorXcd(finite.size()), MatrixXcd(m.M.rows(), finite.size())};
  Eigen::Index count = 0;
  for (const Eigen::Index k : finite) {
    sorted.values[count] = value(k);
    sorted.vectors.col(count++) = inverse.vectors.col(k).head(m.M.rows());
  }
  return sorted;
}

/// Number of the ascending eigenvalues that one shift gives accurately: up to the widest gap below `reach` s.
Eigen::Index well_found(const VectorXcd& values, double reach) {
  Eigen::Index count = 0;
  double widest = 0.0;
  for (Eigen::Index k = 0; k < values.size() && std::abs(values[k]) <= reach; ++k) {
    if (std::abs(values[k]) < 0.3 * reach) widest = 0.0;
    const double gap = k + 1 < values.size() ? std::abs(values[k + 1]) - std::abs(values[k]) : reach;
    if (gap < widest) continue;
    widest = gap;
    count = k + 1;
  }
  return count;
}

}  // namespace

QuadraticProblem in_basis(const MatrixXd& T, const QuadraticProblem& m) {
  return {T.transpose() * m.M * T, T.transpose() * m.C * T, T.transpose() * m.K * T};
}

MatrixXd graded_basis(const QuadraticProblem& m, double s) {
  for (int attempt = 0; attempt < 6; ++attempt, s *= 10.0) {
    const MatrixXd P = s * s * m.M + s * m.C + m.K;
    const Eigen::LLT<MatrixXd> factors(0.5 * (P + P.transpose()));
    if (factors.info() != Eigen::Success) continue;
    const auto L = factors.matrixL();
    const MatrixXd half = L.solve(m.M);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(L.solve(half.transpose()));
    if (modes.info() == Eigen::Success) return L.transpose().solve(modes.eigenvectors());
  }
  return MatrixXd::Identity(m.M.rows(), m.M.rows());
}

double choose_shift(const QuadraticProblem& m) {
  const double mass = m.M.norm(), stiffness = m.K.norm(), damping = m.C.norm();
  double s = mass > 0.0 && stiffness > 0.0 ? std::sqrt(stiffness / mass) : 0.0;
  if (mass > 0.0) s = std::max(s, damping / mass);
  s = away_from_eigenvalues(m, s > 0.0 ? s : 1.0);
  for (int pass = 0; pass < 2; ++pass) {
    const VectorXcd mu = eigen(shifted_inverse(m, s), Vectors::none).values;
    double lowest = 0.0;
    for (const Complex value : mu) {
      if (value == Complex(0.0)) continue;
      const double size = std::abs(s + 1.0 / value);
      if (size > rigid_tolerance * s && (lowest == 0.0 || size < lowest)) lowest = size;
    }
    if (lowest == 0.0) return s;
    const double before = s;
    s = away_from_eigenvalues(m, 1.3717 * lowest);
    if (s > 1e-2 * before) break;
  }
  return s;
}

Spectrum eigenpairs(const QuadraticProblem& m, double s, int count) {
  constexpr double reach = 30.0;  // errors grow with the fourth power of |λ|/s: 1e-10 at 30
  Spectrum all = of_one_shift(m, s);
  Eigen::Index found = 0;
  for (int slice = 1; slice < 8; ++slice, s *= reach) {
    found = std::max(found, well_found(all.values, reach * s));
    const auto rest = all.values.tail(all.values.size() - found);
    const bool grows = (rest.real().array() > growth_tolerance * rest.array().abs()).any();
    if (rest.size() == 0 || (found >= count && !grows)) break;
    const Spectrum next = of_one_shift(m, away_from_eigenvalues(m, reach * s));
    if (next.values.size() < all.values.size()) break;
    all.values.conservativeResize(next.values.size());
    all.vectors.conservativeResize(Eigen::NoChange, next.values.size());
    all.values.tail(next.values.size() - found) = next.values.tail(next.values.size() - found);
    all.vectors.rightCols(next.values.size() - found) = next.vectors.rightCols(next.values.size() - found);
  }
  return all;
}

RefinedPair refined(const QuadraticProblem& m, Complex near, const VectorXcd& x) {
  const auto at = [&m](Complex value) -> MatrixXcd {
    return (value * value) * m.M.cast<Complex>() + value * m.C.cast<Complex>() + m.K.cast<Complex>();
  };
  RefinedPair pair{near, x.normalized(), x.normalized(), 0.0};
  for (int pass = 0; pass < 3; ++pass) {
    // A small offset from the eigenvalue: at the exact one the matrix has no inverse. The direction is the same.
    const Eigen::PartialPivLU<MatrixXcd> factors(at(pair.value * (1.0 + 1e-10)));
    for (int turn = 0; turn < 2; ++turn) {
      const VectorXcd right = factors.solve(pair.x), left = factors.adjoint().solve(pair.y);
      if (!right.allFinite() || !left.allFinite()) return {near, x.normalized(), x.normalized(), 0.0};
      pair.x = right.normalized();
      pair.y = left.normalized();
    }
    const VectorXcd Mx = m.M * pair.x, Cx = m.C * pair.x, Kx = m.K * pair.x;
    const Complex mass = pair.y.dot(Mx), damping = pair.y.dot(Cx), stiffness = pair.y.dot(Kx);
    for (int turn = 0; turn < 3; ++turn) {
      const Complex slope = 2.0 * pair.value * mass + damping;
      pair.slope = std::abs(slope);
      if (pair.slope == 0.0) return pair;
      pair.value -= (pair.value * (pair.value * mass + damping) + stiffness) / slope;
    }
  }
  return pair;
}

}  // namespace tisserand::mechanism
