// Eigenpairs by LAPACK (small) or block Lanczos iteration, SLEPc's Krylov-Schur where that does not end; counted by
// Sylvester's law of inertia.
#include "reducer/modes/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <slepcsys.h>
#include <Eigen/Cholesky>

// Does not compile before the others, so it has a block of its own.
#include <petscblaslapack.h>

#include "common/error.hpp"
#include "common/stable_sort.hpp"
#include "reducer/modes/block_lanczos.hpp"
#include "reducer/modes/krylov_schur.hpp"

namespace tisserand::reducer {
namespace {

void append(const EigenPairs& more, EigenPairs& pairs) {
  const Eigen::Index old = pairs.value.size(), added = more.value.size();
  pairs.value.conservativeResize(old + added);
  pairs.value.tail(added) = more.value;
  pairs.vector.conservativeResize(more.vector.rows(), old + added);
  pairs.vector.rightCols(added) = more.vector;
}

/// Drops pairs whose 1/(λ − shift) is round-off beside that of the first: nearly massless coordinates have such.
/// Expects and leaves ascending order.
void discard_unresolved(double shift, EigenPairs& pairs) {
  constexpr double resolved = 1e-13;
  const Eigen::ArrayXd mu = (pairs.value.array() - shift).inverse();
  std::vector<int> good;
  for (int k = 0; k < mu.size(); ++k)
    if (mu[k] > resolved * mu.maxCoeff()) good.push_back(k);
  pairs.value = Eigen::VectorXd(pairs.value(good));
  pairs.vector = Eigen::MatrixXd(pairs.vector(Eigen::all, good));
}

void sort_pairs(EigenPairs& pairs) {
  std::vector<int> order(static_cast<std::size_t>(pairs.value.size()));
  std::iota(order.begin(), order.end(), 0);
  sort_stably(order, [&](int a, int b) { return pairs.value[a] < pairs.value[b]; });
  if (std::is_sorted(order.begin(), order.end())) return;
  pairs.value = Eigen::VectorXd(pairs.value(order));
  pairs.vector = Eigen::MatrixXd(pairs.vector(Eigen::all, order));
}

/// X := X R⁻¹ with the upper triangle of Xᵀ M X = Rᵀ R: what a column has of earlier ones goes.
void orthonormalise(const Eigen::MatrixXd& G, Eigen::MatrixXd& X) {
  const Eigen::LLT<Eigen::MatrixXd, Eigen::Upper> factor(G);
  if (factor.info() == Eigen::Success) factor.matrixU().solveInPlace<Eigen::OnTheRight>(X);
}

/// One step of inverse iteration, y = (λ − shift) (S − shift M)⁻¹ M x: removes from x what nearly massless coordinates
/// hide from the solver, whose inner product is that of M. As S y − λ M y = (λ − shift) M (x − y), it tells the
/// residual of y without the cancellation of S y. λ becomes Rayleigh's quotient. Pairs far above the first keep x,
/// since the step amplifies the round-off along the first. Then sorted, Xᵀ M X = 1; returns the residuals, relative to
/// (λ − shift) ‖M y‖, of far ones also to λ/λ₁. A few columns at a time: vectors take the memory here.
Eigen::VectorXd purify(const Pencil& pencil, EigenPairs& pairs) {
  constexpr double far = 1e4;
  constexpr Eigen::Index at_once = 64;
  sort_pairs(pairs);
  discard_unresolved(pencil.shift, pairs);
  const Eigen::VectorXd lambda = pairs.value.array() - pencil.shift;
  Eigen::VectorXd residual(lambda.size());
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(lambda.size(), lambda.size());
  for (Eigen::Index first = 0; first < lambda.size(); first += at_once) {
    const Eigen::Index count = std::min(at_once, lambda.size() - first), end = first + count;
    const Eigen::MatrixXd MX = multiply(pencil.M, pairs.vector.middleCols(first, count));
    const Eigen::MatrixXd Y = pencil.factor.solve(MX * lambda.segment(first, count).asDiagonal());
    Eigen::MatrixXd MY = multiply(pencil.M, Y);
    residual.segment(first, count) = (MX - MY).colwise().norm().cwiseQuotient(MY.colwise().norm());
    for (Eigen::Index c = 0; c < count; ++c) {
      const Eigen::Index k = first + c;
      if (lambda[k] < far * lambda[0]) {
        pairs.value[k] = pencil.shift + lambda[k] * Y.col(c).dot(MX.col(c)) / Y.col(c).dot(MY.col(c));
        pairs.vector.col(k) = Y.col(c);
      } else {
        residual[k] /= 1.0 + lambda[k] / lambda[0];
        MY.col(c) = MX.col(c);
      }
    }
    G.block(0, first, end, count).noalias() = pairs.vector.leftCols(end).transpose() * MY;
  }
  orthonormalise(G, pairs.vector);
  sort_pairs(pairs);
  return residual;
}

[[noreturn]] void fail_missing(int found, int exist) {
  throw Error(fmt::format("{} internal modes found where {} exist", found, exist), "eigenvalue solver",
              "ask for fewer modes, or use fewer elements per line");
}

/// Between the last kept and the first dropped eigenvalue; nothing dropped: above the last.
double value_in_gap(const EigenPairs& pairs, int kept, double shift) {
  const double below = pairs.value[kept - 1] - shift;
  if (kept == pairs.value.size()) return shift + below * (1.0 + 10.0 * cluster_tolerance);
  return shift + std::sqrt(below * (pairs.value[kept] - shift));
}

Spectrum dense_spectrum(const Pencil& pencil, int count, int available) {
  Spectrum s;
  s.solver = EigenSolver::dense;
  const Eigen::MatrixXd S = dense(pencil.S), M = dense(pencil.M);
  for (int wanted = std::min(available, count + 8);; wanted = std::min(available, 2 * wanted)) {
    s.pairs = dense_lowest(S, M, pencil.shift, wanted);
    discard_unresolved(pencil.shift, s.pairs);
    if (s.pairs.value.size() < count) fail_missing(static_cast<int>(s.pairs.value.size()), count);
    s.kept = cluster_end(s.pairs.value, count, pencil.shift);
    if (s.kept < s.pairs.value.size() || s.pairs.value.size() < wanted || wanted == available) break;
  }
  s.counted = s.kept;
  s.residual = purify(pencil, s.pairs).head(s.kept).maxCoeff();
  return s;
}

/// Whether one more factorisation costs less than a tenth of the solutions: their operations, of which the processor
/// does a third as many a second, with the columns that block Lanczos iteration needs for `count` pairs.
bool counting_is_cheap(const Factor& factor, int count) {
  const double columns = 3.0 * count + 60.0;
  return factor.cost().operations < 0.1 * 3.0 * columns * 4.0 * factor.cost().entries;
}

/// Members of the largest cluster.
int largest_cluster(const Eigen::VectorXd& value, double shift) {
  int largest = 0;
  for (int first = 0; first < value.size();) {
    const int end = cluster_end(value, first + 1, shift);
    largest = std::max(largest, end - first);
    first = end;
  }
  return largest;
}

EigenPairs first_search(const Pencil& pencil, int wanted, Spectrum& s) {
  if (s.solver == EigenSolver::block_lanczos) {
    if (std::optional<EigenPairs> pairs = block_lanczos(pencil, wanted)) return std::move(*pairs);
    s.solver = EigenSolver::krylov_schur;
  }
  return KrylovSchur(pencil.S, pencil.M, {pencil.shift, pencil.factor, 1.0}).solve(wanted);
}

Spectrum iterated_spectrum(const Pencil& pencil, int count, int available, EigenSolver solver, Count verify) {
  constexpr int attempts = 6;
  Spectrum s;
  s.solver = solver;
  const int wanted = std::min(available, count + 2);
  s.pairs = first_search(pencil, wanted, s);
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const Eigen::VectorXd residual = purify(pencil, s.pairs);
    const auto found = static_cast<int>(s.pairs.value.size());
    if (found >= count) {
      s.kept = cluster_end(s.pairs.value, count, pencil.shift);
      s.residual = residual.head(s.kept).maxCoeff();
      if (s.kept == available) s.counted = available;
      const bool needed = verify == Count::always ||
                          (verify == Count::if_cheap && counting_is_cheap(pencil.factor, count)) ||
                          largest_cluster(s.pairs.value.head(s.kept), pencil.shift) >= lanczos_block(wanted);
      if (s.kept < found && !needed) return s;
      if (s.kept < available) s.counted = count_kept(pencil, s.pairs, s.kept);
      if (s.counted == s.kept) return s;
    }
    // Repeated eigenvalues hide from one Krylov sequence: look for what is orthogonal.
    KrylovSchur again(pencil.S, pencil.M, {pencil.shift, pencil.factor, 1.0});
    again.deflate(s.pairs.vector);
    append(again.solve(std::max(4, s.counted.value_or(0) - s.kept)), s.pairs);
  }
  fail_missing(static_cast<int>(s.pairs.value.size()), std::max(count, s.counted.value_or(0)));
}

}  // namespace

int cluster_end(const Eigen::VectorXd& value, int count, double shift) {
  int end = count;
  while (end > 0 && end < value.size() && value[end] - value[end - 1] <= cluster_tolerance * (value[end] - shift))
    ++end;
  return end;
}

int count_below(const Matrix& S, const Matrix& M, double value) {
  return Factor::indefinite(combine(S, -value, M)).negative();
}

int count_below(const Pencil& pencil, double value) {
  pencil.begin("count");
  const int count = count_below(pencil.S, pencil.M, value);
  pencil.begin("internal modes");
  return count;
}

int count_kept(const Pencil& pencil, const EigenPairs& pairs, int kept) {
  return count_below(pencil, value_in_gap(pairs, kept, pencil.shift));
}

EigenSolver choose_solver(Eigen::Index size, int count) {
  const bool small = size <= 200 || (size <= 4000 && 5 * (count + 8) > size);
  return small ? EigenSolver::dense : EigenSolver::block_lanczos;
}

Spectrum lowest_pairs(const Pencil& pencil, int count, int available, EigenSolver solver, Count verify) {
  Spectrum s = solver == EigenSolver::dense ? dense_spectrum(pencil, count, available)
                                            : iterated_spectrum(pencil, count, available, solver, verify);
  if (!(s.residual < 1e-8))
    throw Error(fmt::format("internal modes have a relative residual of {:.1e}, above 1e-8", s.residual),
                "eigenvalue solver",
                "the part is badly conditioned: avoid very short beside very long elements, and very stiff beside very "
                "soft ones");
  return s;
}

namespace {

/// Eigenvalues μ ascending and vectors, Xᵀ B X = 1, of A x = μ B x; `info` as LAPACK gives it: above n, B is not
/// positive definite.
struct DensePairs {
  Eigen::VectorXd mu;
  Eigen::MatrixXd X;
  PetscBLASInt info = 0;
};

/// The `count` largest ones, by bisection and inverse iteration.
DensePairs largest_pairs(Eigen::MatrixXd A, Eigen::MatrixXd B, int count) {
  const auto n = static_cast<PetscBLASInt>(A.rows());
  const PetscBLASInt first = n - count + 1, last = n;
  PetscBLASInt found = 0, lwork = -1;
  // Twice the least normal number: with 0 the inverse iteration of dsyevx fails now and then (its documentation).
  const double unused = 0.0, tolerance = 2.0 * std::numeric_limits<double>::min();
  DensePairs pairs{Eigen::VectorXd(n), Eigen::MatrixXd(n, count)};
  std::vector<PetscBLASInt> iwork(static_cast<std::size_t>(5 * n)), fail(static_cast<std::size_t>(n));
  std::vector<double> work(1);
  for (int pass = 0; pass < 2; ++pass) {
    PetscBLASInt type = 1;
    LAPACKsygvx_(&type, "V", "I", "L", &n, A.data(), &n, B.data(), &n, &unused, &unused, &first, &last, &tolerance,
                 &found, pairs.mu.data(), pairs.X.data(), &n, work.data(), &lwork, iwork.data(), fail.data(),
                 &pairs.info);
    lwork = static_cast<PetscBLASInt>(work[0]);
    work.resize(static_cast<std::size_t>(lwork));
  }
  pairs.mu.conservativeResize(count);
  if (pairs.info == 0 && found != count) pairs.info = 1;
  return pairs;
}

/// The same by the QR algorithm, which finds all of them always.
DensePairs largest_pairs_by_qr(Eigen::MatrixXd A, Eigen::MatrixXd B, int count) {
  const auto n = static_cast<PetscBLASInt>(A.rows());
  const PetscBLASInt type = 1;
  PetscBLASInt lwork = -1;
  Eigen::VectorXd mu(n);
  DensePairs pairs;
  std::vector<double> work(1);
  for (int pass = 0; pass < 2; ++pass) {
    LAPACKsygv_(&type, "V", "L", &n, A.data(), &n, B.data(), &n, mu.data(), work.data(), &lwork, &pairs.info);
    lwork = static_cast<PetscBLASInt>(work[0]);
    work.resize(static_cast<std::size_t>(lwork));
  }
  pairs.mu = mu.tail(count);
  pairs.X = A.rightCols(count);
  return pairs;
}

}  // namespace

EigenPairs dense_lowest(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double shift, int count) {
  // M x = μ (S − shift M) x, μ = 1/(λ − shift): the lowest λ are the largest μ, found to full relative accuracy.
  // Inverse iteration fails now and then on groups of equal ones, such as the six rigid motions.
  const Eigen::MatrixXd B = S - shift * M;
  DensePairs found = largest_pairs(M, B, count);
  if (found.info > 0 && found.info <= S.rows()) found = largest_pairs_by_qr(M, B, count);
  if (found.info != 0)
    throw Error(fmt::format("LAPACK found no eigenpairs of {} coordinates (info {})", S.rows(), found.info),
                "eigenvalue solver", "the stiffness is not positive definite: check sections and boundary");
  EigenPairs pairs{Eigen::VectorXd(count), Eigen::MatrixXd(S.rows(), count)};
  for (int k = 0; k < count; ++k) {
    const double m = found.mu[count - 1 - k];
    pairs.value[k] = shift + 1.0 / m;
    pairs.vector.col(k) = found.X.col(count - 1 - k) / std::sqrt(m);
  }
  return pairs;
}

}  // namespace tisserand::reducer
