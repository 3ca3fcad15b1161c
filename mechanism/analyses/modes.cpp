// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of a linearised mechanism: eigenproblem on its constraints, rigid and growing modes, printed shapes.
#include "mechanism/analyses/modes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/QR>

#include "common/math/rotation.hpp"
#include "common/stable_sort.hpp"
#include "mechanism/analyses/quadratic_eigenproblem.hpp"
#include "mechanism/analyses/steady_axes.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/model/element_map.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/solver/matrix_rank.hpp"
#include "mechanism/step/convergence.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

/// The linearised scene, its coordinates ξ = Z T q, and the eigenproblem of q.
struct Problem {
  Linearisation l;
  MatrixXd Z, T;
  QuadraticProblem reduced;
  double shift = 0.0;

  VectorXcd shape(const VectorXcd& q) const { return Z.cast<Complex>() * (T.cast<Complex>() * q); }
  VectorXd spread(const VectorXcd& q) const { return Z.cwiseAbs() * (T.cast<Complex>() * q).cwiseAbs(); }
};

/// Whether the mode cannot be distinguished from a rigid motion. Then inertia and damping forces of the shape Z q with
/// |λ| = `size` are below the round-off of stiffness and of loads that turn with it. `spread` is |Z||q|. Componentwise,
/// round-off is spreadᵀ|K|spread times 2√n ε for the two products in ZᵀKZ of n terms each ([HM19]: errors grow as √n),
/// so that a stiff body does not hide motions of parts that are not tied to it.
bool drowns(const Model& model, const Evaluation& evaluation, const Problem& problem, double size, const VectorXcd& q) {
  const Linearisation& l = problem.l;
  const VectorXcd shape = problem.shape(q);
  const VectorXd spread = problem.spread(q);
  const int n = model.sizes.boundary;
  const double lengths = (spread.head(n).array() / model.equation_scale.head(n)).square().sum();
  const double forces = spread.dot(l.K.cwiseAbs() * spread) + force_size(model, evaluation) / model.length * lengths;
  const double inertia = std::abs(shape.dot(l.M * shape)), damping = std::abs(shape.dot(l.C * shape));
  const double round_off = 2.0 * std::sqrt(static_cast<double>(l.K.rows())) * std::numeric_limits<double>::epsilon();
  return size * (size * inertia + damping) < round_off * forces;
}

/// Scales the shape so that its largest component is 1.
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

/// Acceleration of the state in axes that turn with ω, in the coordinates of a linearisation: ẍ − ω×(2ẋ − ω×x) of
/// nodes, Ω̇ less the contribution of a turning axis.
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

/// Whether the inertia forces of these accelerations exceed round-off and the residual that statics leaves.
bool is_felt(const Model& model, const State& state, const Linearisation& l, const VectorXd& a,
             const Evaluation& evaluation) {
  constexpr double share = 1e-6;
  const int n = model.sizes.boundary;
  const VectorXd force = (l.M * a).head(n).cwiseProduct(model.equation_scale.head(n).matrix());
  return n > 0 && force.cwiseAbs().maxCoeff() > allowed_force(model, state, evaluation, share);
}

/// Name of the node where the shape is largest.
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

/// Whether a mode grows by more than round-off. The shifted inverse loses digits of modes above the shift. Modes that
/// seem to grow slowly are therefore found again by inverse iteration. Round-off of yᴴP(λ)x is that of its products
/// with the matrices of the scene, componentwise as in drowns().
bool grows(const Problem& problem, Complex& value, const VectorXcd& q) {
  const double size = std::abs(value);
  if (!(value.real() > growth_tolerance * size)) return false;
  constexpr double slow = 1e-2;
  if (value.real() > slow * size) return true;
  const RefinedPair pair = refined(problem.reduced, value, q);
  if (!(std::abs(pair.value - value) < slow * size) || !(pair.slope > 0.0)) return true;
  const VectorXd x = problem.spread(pair.x), y = problem.spread(pair.y);
  const double products = y.dot(size * size * (problem.l.M.cwiseAbs() * x) + size * (problem.l.C.cwiseAbs() * x) +
                                problem.l.K.cwiseAbs() * x);
  const double round_off =
      2.0 * std::sqrt(static_cast<double>(x.size())) * std::numeric_limits<double>::epsilon() * products / pair.slope;
  value = pair.value;
  if (value.real() > std::max(growth_tolerance * size, round_off)) return true;
  value.real(std::min(value.real(), 0.0));
  return false;
}

/// Frequency |λ|/2π of a mode in axes that turn with `turn` in those of the linearisation. NaN if the mode is neither a
/// circle of one sense about `turn` nor a motion along and about it: it has two frequencies there.
double frequency_seen_from(const Model& model, const Eigen::Vector3d& turn, const Mode& mode) {
  const Eigen::Vector3d axis = turn.normalized();
  const Eigen::Vector3d e1 = axis.unitOrthogonal(), e2 = axis.cross(e1);
  double with = 0.0, against = 0.0, along = 0.0;  // with: e^{iωt} of u·e1 + i u·e2
  const auto add = [&](const Eigen::Vector3cd& u) {
    const Complex a = u.dot(e1.cast<Complex>()), b = u.dot(e2.cast<Complex>()), i(0.0, 1.0);
    with += std::norm(std::conj(a) + i * std::conj(b));
    against += std::norm(std::conj(a) - i * std::conj(b));
    along += 2.0 * std::norm(u.dot(axis.cast<Complex>()));
  };
  for (const Node& node : model.nodes) {
    Eigen::Vector3cd x = Eigen::Vector3cd::Zero(), turned = Eigen::Vector3cd::Zero();
    for (int k = 0; k < 6; ++k)
      if (const int row = coordinate_of(model, node, k); row >= 0) (k < 3 ? x : turned)[k % 3] = mode.shape[row];
    add(x / model.length);
    add(turned);
  }
  constexpr double other = 1e-6;  // share of the square of the motion
  const double all = with + against + along, rate = std::abs(mode.eigenvalue.imag());
  if (along > (1.0 - other) * all) return mode.frequency();
  if (with > (1.0 - other) * all) return std::abs(rate - turn.norm()) / (2.0 * std::numbers::pi);
  if (against > (1.0 - other) * all) return (rate + turn.norm()) / (2.0 * std::numbers::pi);
  return std::numeric_limits<double>::quiet_NaN();
}

/// Collects the modes of a spectrum: one of each conjugate pair, and each rigid motion once.
void collect(const Model& model, const Evaluation& evaluation, const Problem& problem, const Spectrum& spectrum,
             ModesReport& report) {
  int zeros = 0;
  for (Eigen::Index k = 0; k < spectrum.values.size(); ++k) {
    const VectorXcd q = spectrum.vectors.col(k);
    Mode mode{spectrum.values[k], problem.shape(q)};
    const double size = std::abs(mode.eigenvalue);
    const bool rigid = size < rigid_tolerance * problem.shift || drowns(model, evaluation, problem, size, q);
    if (rigid && ++zeros % 2 == 0) continue;  // one rigid motion appears twice: as position and as velocity
    if (!rigid && mode.eigenvalue.imag() < 0.0) continue;
    if (rigid) mode.eigenvalue = 0.0;
    report.rigid += rigid ? 1 : 0;
    mode.unstable = grows(problem, mode.eigenvalue, q);
    if (rigid)
      mode.shape = mode.shape.real().norm() >= mode.shape.imag().norm() ? mode.shape.real().cast<Complex>().eval()
                                                                        : mode.shape.imag().cast<Complex>().eval();
    normalise(model, mode.shape);
    report.modes.push_back(std::move(mode));
  }
  // Among modes of equal |λ| a growing one comes first, so that round-off does not decide the order.
  sort_stably(report.modes, {}, [](const Mode& mode) { return std::abs(mode.eigenvalue); });
  const auto tied = [](const Mode& a, const Mode& b) {
    return std::abs(b.eigenvalue) <= (1.0 + 1e-9) * std::abs(a.eigenvalue);
  };
  for (std::size_t from = 0, to = 0; from < report.modes.size(); from = to) {
    for (to = from + 1; to < report.modes.size() && tied(report.modes[to - 1], report.modes[to]);) ++to;
    std::vector<Mode> group(std::make_move_iterator(report.modes.begin() + static_cast<long>(from)),
                            std::make_move_iterator(report.modes.begin() + static_cast<long>(to)));
    const double step = 1e-6 * std::abs(group.front().eigenvalue);
    sort_stably(group, std::greater{}, [step](const Mode& mode) { return std::round(mode.eigenvalue.real() / step); });
    std::ranges::move(group, report.modes.begin() + static_cast<long>(from));
  }
}

/// Motion [δx; δθ] of a node in a mode, world axes: from its own coordinates, or from T of its modal body.
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
  constexpr double slow = 1e-6;  // of the lowest mode: a slower spin turns by little during one oscillation
  Problem problem;
  problem.l = linearise(model, state, omega, evaluation);
  FastestSpin fastest = fastest_spin(model, omega, evaluation);
  problem.Z = null_space(model, problem.l.B);
  ModesReport report;
  report.degrees_of_freedom = static_cast<int>(problem.Z.cols());
  const VectorXd acceleration = acceleration_in_axes(model, state, omega, evaluation);
  if (is_felt(model, state, problem.l, acceleration, evaluation)) {
    report.largest_acceleration = size_of(model, acceleration);
    const double unit = std::sqrt(model.mass_scale) * model.length;
    for (const double internal : acceleration.tail(model.sizes.internal))
      report.largest_acceleration = std::max(report.largest_acceleration, std::abs(internal) / unit);
  }
  if (problem.Z.cols() == 0) return report;
  QuadraticProblem free = in_basis(problem.Z, {problem.l.M, problem.l.C, problem.l.K});
  problem.shift = choose_shift(free);
  SteadyLinearisation steady;
  if (!(fastest.spin.norm() > slow * problem.shift)) fastest = {};
  if (std::max(omega.norm(), fastest.spin.norm()) > slow * problem.shift) {
    steady = linearise_steady(model, state, omega, std::move(problem.l), evaluation);
    problem.l = std::move(steady.now);
    free = in_basis(problem.Z, {problem.l.M, problem.l.C, problem.l.K});
    problem.shift = choose_shift(free);
  }
  problem.T = graded_basis(free, problem.shift);
  problem.reduced = in_basis(problem.T, free);
  collect(model, evaluation, problem, eigenpairs(problem.reduced, problem.shift, 2 * spec.count), report);
  std::size_t place = 0;
  std::erase_if(report.modes,
                [&](const Mode& mode) { return place++ >= static_cast<std::size_t>(spec.count) && !mode.unstable; });
  report.axes = to_world(model, omega);
  report.spin = to_world(model, fastest.spin);
  if (fastest.node >= 0) report.spins = model.nodes[fastest.node].name;
  report.undecided = steady.undecided;
  if (steady.later)
    report.change = largest_change(problem.reduced,
                                   in_basis(problem.Z * problem.T, {steady.later->M, steady.later->C, steady.later->K}),
                                   problem.shift, spec.count);
  const Eigen::Vector3d turn = omega.norm() > 0.0 ? Eigen::Vector3d(-omega) : fastest.spin;
  for (Mode& mode : report.modes)
    mode.seen_from_other_axes = turn.norm() > 0.0 && std::abs(mode.eigenvalue) > 0.0
                                    ? frequency_seen_from(model, turn, mode)
                                    : std::numeric_limits<double>::quiet_NaN();
  return report;
}

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
  const std::string unit = label == "s^-1" ? " Hz" : label.empty() ? "" : " " + label;
  const bool both = report.axes.norm() > 0.0 || report.spin.norm() > 0.0;
  const std::string other =
      !both ? "" : fmt::format(" {:>18}", (report.axes.norm() > 0.0 ? "in axes at rest" : "in turning axes") + unit);
  // Real eigenvalues are not vibrations: their frequency |λ| / 2π with damping 1 is not meaningful.
  const auto is_real = [](const Mode& mode) { return std::abs(mode.damping_ratio()) >= 1.0 - 1e-9; };
  const bool has_poles = std::ranges::any_of(report.modes, is_real);
  const std::string poles = has_poles ? fmt::format(" {:>12}", "pole" + (label.empty()     ? ""
                                                                         : label == "s^-1" ? " 1/s"
                                                                                           : " " + label))
                                      : "";
  std::vector<std::string> lines{
      fmt::format("{:>4} {:>14}{} {:>12}{}  {}", "no.", "frequency" + unit, other, "damping", poles, "moves most")};
  int number = 0;
  for (const Mode& mode : report.modes) {
    const std::string seen = !both ? ""
                             : std::isnan(mode.seen_from_other_axes)
                                 ? fmt::format(" {:>18}", "-")
                                 : fmt::format(" {:>18.6g}", mode.seen_from_other_axes);
    const std::string pole = !has_poles      ? ""
                             : is_real(mode) ? fmt::format(" {:>12.4g}", mode.eigenvalue.real())
                                             : fmt::format(" {:>12}", "");
    lines.push_back(fmt::format("{:>4} {:>14.6g}{} {:>12.4g}{}  {}{}", ++number, mode.frequency(), seen,
                                std::abs(mode.damping_ratio()) < 1e-9 ? 0.0 : mode.damping_ratio(), pole,
                                moves_most(model, mode.shape), mode.unstable ? "  UNSTABLE" : ""));
  }
  return lines;
}

}  // namespace tisserand::mechanism
