// Quadratic eigenvalue problem of a linearised mechanism by a shifted inverse in first-order form (LAPACK).
#include "mechanism/analyses/modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "common/stable_sort.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/model/element_map.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/solver/matrix_rank.hpp"
#include "mechanism/step/convergence.hpp"

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

/// |λ| below this times the shift is a rigid motion: a double eigenvalue 0 comes out as about the root of round-off.
constexpr double rigid_tolerance = 1e-5;
/// Growth below this times |λ| is round-off.
constexpr double growth_tolerance = 1e-7;

enum class Vectors { none, right };

struct Spectrum {
  VectorXcd values;
  MatrixXcd vectors;
};

Spectrum eigen(MatrixXd A, Vectors kind) {
  if (!A.allFinite())  // LAPACK would not return
    throw Error(
        "the linearised scene has no finite shifted inverse: its inertia, damping and stiffness are singular together",
        "modes", "fix or remove bodies that neither mass nor stiffness holds");
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
    throw Error("the eigenvalues of the linearised scene were not found", "modes", "change the state a little");
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

/// The projected problem.
struct Reduced {
  MatrixXd M, C, K;
};

/// T with TᵀHT = 1 and TᵀMT diagonal, H the symmetric part of P(σ) = σ²M + σC + K with the first σ = s, 10 s, … that
/// makes it definite: modes, as far as damping and what is not symmetric leave them. The matrices of frequencies that
/// are decades apart are graded in it, and the balancing of LAPACK keeps each to its own size; in any other basis
/// round-off of the largest is in all. The unit matrix, where nothing makes H definite.
MatrixXd graded_basis(const Reduced& m, double s) {
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

Reduced in_basis(const MatrixXd& T, const Reduced& m) {
  return {T.transpose() * m.M * T, T.transpose() * m.C * T, T.transpose() * m.K * T};
}

/// G = (A − sE)⁻¹E of A = [0 1; −K −C], E = [1 0; 0 M]: G [p; r] = [a; p + s a], P(s) a = −(M r + (C + sM) p).
MatrixXd shifted_inverse(const Reduced& m, double s) {
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

/// The shift among s, 1.37 s, 1.37² s… at which P(s) is regular: it is singular at real eigenvalues (divergence,
/// creep).
double away_from_eigenvalues(const Reduced& m, double s) {
  double best = s, largest = -1.0;
  for (int attempt = 0; attempt < 6; ++attempt, s *= 1.3717) {
    const double regular = Eigen::PartialPivLU<MatrixXd>(s * s * m.M + s * m.C + m.K).rcond();
    if (!(regular > largest)) continue;
    best = s, largest = regular;
    if (largest > 1e-10) break;
  }
  return best;
}

/// Of the size of the lowest frequency that is none of a rigid motion.
double choose_shift(const Reduced& m) {
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

/// Whether forces of inertia and damping of the shape Z q with |λ| = `size` are below the round-off of those of
/// stiffness and of loads that turn with it: nothing tells it from a rigid motion. `spread`: |Z||q|. Componentwise,
/// spreadᵀ|K|spread times 2√n ε for the two products in ZᵀKZ, of n terms each ([HM19]: errors of sums grow as √n), so
/// that what no stiff body is tied to keeps its own.
bool drowns(const Model& model, const Linearisation& l, const Evaluation& evaluation, double size,
            const VectorXcd& shape, const VectorXd& spread) {
  const int n = model.sizes.boundary;
  const double lengths = (spread.head(n).array() / model.equation_scale.head(n)).square().sum();
  const double load = std::max(evaluation.force_scale[0], evaluation.force_scale[1] / model.length);
  const double forces = spread.dot(l.K.cwiseAbs() * spread) + load / model.length * lengths;
  const double inertia = std::abs(shape.dot(l.M * shape)), damping = std::abs(shape.dot(l.C * shape));
  const double round_off = 2.0 * std::sqrt(static_cast<double>(l.K.rows())) * std::numeric_limits<double>::epsilon();
  return size * (size * inertia + damping) < round_off * forces;
}

/// The component that moves most becomes 1.
void normalise(const Model& model, VectorXcd& shape) {
  Complex largest = 0.0;
  for (const Node& node : model.nodes)
    for (int k = 0; k < 6; ++k) {
      const int row = coordinate_of(model, node, k);
      const double scale = k < 3 ? 1.0 / model.length : 1.0;
      if (row >= 0 && std::abs(shape[row]) * scale > std::abs(largest) * (1.0 + 1e-9)) largest = shape[row] * scale;
    }
  if (largest == Complex(0.0) && shape.size() > 0) largest = shape[0];
  for (Eigen::Index k = 0; k < shape.size(); ++k)
    if (std::abs(largest) < 1e-12 * std::abs(shape[k])) largest = shape[k];  // an internal mode whose boundary rests
  if (largest != Complex(0.0)) shape /= largest;
}

/// Acceleration of the state in axes that turn with ω, in the coordinates of a linearisation: ẍ − ω×(2ẋ − ω×x) of what
/// moves, Ω̇ − what a turning axis gives.
VectorXd acceleration_in_axes(const Model& model, const State& state, const Eigen::Vector3d& omega,
                              const Evaluation& evaluation) {
  VectorXd a = VectorXd::Zero(model.sizes.velocities());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const NodeMotion& m = evaluation.motion[i];
    const Node& node = model.nodes[i];
    if (node.translation >= 0) set_translation(model, m.xdd - omega.cross(m.xd), node.translation, a);
    if (node.rotation >= 0) set_rotation(model, m.R * m.Omegad - omega.cross(m.R * m.Omega), node.rotation, a);
  }
  a.tail(model.sizes.internal) = state.vdot().tail(model.sizes.internal);
  return a;
}

/// Whether the inertia forces of these accelerations are more than what statics leaves unbalanced, and round-off.
bool is_felt(const Model& model, const State& state, const Linearisation& l, const VectorXd& a,
             const Evaluation& evaluation) {
  constexpr double share = 1e-6;
  const int n = model.sizes.boundary;
  const VectorXd force = (l.M * a).head(n).cwiseProduct(model.equation_scale.head(n).matrix());
  const double load = std::max(evaluation.force_scale[0], evaluation.force_scale[1] / model.length);
  return n > 0 && force.cwiseAbs().maxCoeff() > std::max(share * load, force_round_off(model, state));
}

/// Where the shape is largest, in words.
std::string moves_most(const Model& model, const VectorXcd& shape) {
  double largest = 0.0;
  std::string name = "an internal mode";
  for (const Node& node : model.nodes) {
    const double x =
        node.translation < 0 ? 0.0 : shape.segment(node.translation, translations_of(model)).norm() / model.length;
    const double turn = node.rotation < 0 ? 0.0 : shape.segment(node.rotation, rotations_of(model)).norm();
    if (std::max(x, turn) > (1.0 + 1e-6) * largest) {
      largest = std::max(x, turn);
      name = node.name;
    }
  }
  return name;
}

}  // namespace

MatrixXd null_space(const Model& model, const MatrixXd& B) {
  VectorXd scale = VectorXd::Ones(B.cols());
  for (const Node& node : model.nodes)
    if (node.rotation >= 0) scale.segment(node.rotation, rotations_of(model)).setConstant(1.0 / model.length);
  if (B.rows() == 0) return scale.asDiagonal();
  MatrixXd BT = scale.asDiagonal() * B.transpose();
  for (Eigen::Index row = 0; row < BT.cols(); ++row) {
    const double norm = BT.col(row).norm();
    if (norm > 0.0) BT.col(row) /= norm;
  }
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(rank_tolerance);
  qr.compute(BT);
  const Eigen::Index rank = qr.rank(), free = B.cols() - rank;
  MatrixXd Z = MatrixXd::Zero(B.cols(), free);
  Z.bottomRows(free).setIdentity();
  Z.applyOnTheLeft(qr.householderQ());
  return scale.asDiagonal() * Z;
}

ModesReport solve_modes(const Model& model, const State& state, const formats::ModesSpec& spec,
                        Evaluation& evaluation) {
  const Eigen::Vector3d omega = to_axes(model, spec.rotation.value_or(Eigen::Vector3d::Zero()));
  const Linearisation l = linearise(model, state, omega, evaluation);
  const MatrixXd Z = null_space(model, l.B);
  ModesReport report;
  report.degrees_of_freedom = static_cast<int>(Z.cols());
  const VectorXd acceleration = acceleration_in_axes(model, state, omega, evaluation);
  if (is_felt(model, state, l, acceleration, evaluation)) {
    report.largest_acceleration = size_of(model, acceleration);
    for (const double internal : acceleration.tail(model.sizes.internal))
      report.largest_acceleration = std::max(report.largest_acceleration, std::abs(internal));
  }
  if (Z.cols() == 0) return report;
  Reduced reduced = in_basis(Z, {l.M, l.C, l.K});
  const double s = choose_shift(reduced);
  const MatrixXd T = graded_basis(reduced, s);
  reduced = in_basis(T, reduced);
  const Spectrum spectrum = eigen(shifted_inverse(reduced, s), Vectors::right);
  const double infinite = 1e-13 * spectrum.values.cwiseAbs().maxCoeff();
  int zeros = 0;
  for (Eigen::Index k = 0; k < spectrum.values.size(); ++k) {
    const Complex mu = spectrum.values[k];
    if (!(std::abs(mu) > infinite)) continue;  // a direction without mass
    Mode mode;
    mode.eigenvalue = s + 1.0 / mu;
    const double size = std::abs(mode.eigenvalue);
    const VectorXcd q = T.cast<Complex>() * spectrum.vectors.col(k).head(Z.cols());
    mode.shape = Z.cast<Complex>() * q;
    const bool rigid =
        size < rigid_tolerance * s || drowns(model, l, evaluation, size, mode.shape, Z.cwiseAbs() * q.cwiseAbs());
    if (rigid && ++zeros % 2 == 0) continue;  // position and velocity of one rigid motion
    if (!rigid && mode.eigenvalue.imag() < 0.0) continue;
    if (rigid) mode.eigenvalue = 0.0;
    report.rigid += rigid ? 1 : 0;
    mode.unstable = mode.eigenvalue.real() > growth_tolerance * size;
    if (rigid)
      mode.shape = mode.shape.real().norm() >= mode.shape.imag().norm() ? mode.shape.real().cast<Complex>().eval()
                                                                        : mode.shape.imag().cast<Complex>().eval();
    normalise(model, mode.shape);
    report.modes.push_back(std::move(mode));
  }
  sort_stably(report.modes, {}, [](const Mode& mode) { return std::abs(mode.eigenvalue); });
  std::size_t place = 0;
  std::erase_if(report.modes,
                [&](const Mode& mode) { return place++ >= static_cast<std::size_t>(spec.count) && !mode.unstable; });
  return report;
}

namespace {

/// [δx; δθ] of a node in a mode, world axes: its own coordinates, or through T of the modal body that it follows.
Eigen::Vector<Complex, 6> motion_of_node(const Model& model, const Evaluation& evaluation, int node,
                                         const VectorXcd& shape) {
  std::vector<int> coordinates;
  append_carrier(model, node, coordinates);
  VectorXcd own(coordinates.size());
  for (std::size_t k = 0; k < coordinates.size(); ++k)
    own[static_cast<Eigen::Index>(k)] = coordinates[k] < 0 ? Complex(0.0) : shape[coordinates[k]];
  const int modal = modal_node(model, node);
  if (modal < 0) return own;
  const Eigen::Matrix3d& frame = motion_of(evaluation, modal_body_of(model, modal).node).R;
  own.segment<3>(3) = (frame.transpose().cast<Complex>() * own.segment<3>(3)).eval();  // T takes body axes
  Eigen::Vector<Complex, 6> motion = evaluation.modal_nodes[modal].T.cast<Complex>() * own;
  motion.tail<3>() = (motion_of(evaluation, node).R.cast<Complex>() * motion.tail<3>()).eval();
  return motion;
}

}  // namespace

formats::ModesTable modes_table(const Model& model, const Evaluation& evaluation, const ModesReport& report) {
  const auto modes = static_cast<Eigen::Index>(report.modes.size());
  const auto places = static_cast<Eigen::Index>(model.places.size());
  formats::ModesTable table;
  table.eigenvalue.resize(modes);
  table.frequency.resize(modes);
  table.damping_ratio.resize(modes);
  table.translation.setZero(3 * places, modes);
  table.rotation.setZero(3 * places, modes);
  for (Eigen::Index k = 0; k < modes; ++k) {
    const Mode& mode = report.modes[k];
    table.eigenvalue[k] = mode.eigenvalue;
    table.frequency[k] = mode.frequency();
    table.damping_ratio[k] = mode.damping_ratio();
    for (Eigen::Index p = 0; p < places; ++p) {
      const Marker& marker = model.places[p].marker;
      const Eigen::Vector<Complex, 6> motion = motion_of_node(model, evaluation, marker.node, mode.shape);
      const Eigen::Vector3d arm = motion_of(evaluation, marker.node).R * marker.p;
      const Eigen::Vector3cd turn = motion.tail<3>();
      const Eigen::Matrix3cd axes = to_world(model, Eigen::Matrix3d(Eigen::Matrix3d::Identity())).cast<Complex>();
      table.translation.col(k).segment<3>(3 * p) = axes * (motion.head<3>() - skew<double>(arm).cast<Complex>() * turn);
      table.rotation.col(k).segment<3>(3 * p) = axes * turn;
    }
  }
  return table;
}

std::vector<std::string> modes_lines(const Model& model, const ModesReport& report) {
  const std::string label = unit_label(model.units, 0, 0, -1);
  const std::string unit = label == "s^-1" ? "Hz" : label;
  std::vector<std::string> lines{fmt::format("{:>4} {:>14} {:>12}  {}", "no.",
                                             unit.empty() ? "frequency" : fmt::format("frequency {}", unit), "damping",
                                             "moves most")};
  int number = 0;
  for (const Mode& mode : report.modes)
    lines.push_back(fmt::format("{:>4} {:>14.6g} {:>12.4g}  {}{}", ++number, mode.frequency(),
                                std::abs(mode.damping_ratio()) < 1e-9 ? 0.0 : mode.damping_ratio(),
                                moves_most(model, mode.shape), mode.unstable ? "  UNSTABLE" : ""));
  return lines;
}

}  // namespace tisserand::mechanism
