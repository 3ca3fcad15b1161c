// Internal modes: how many, which, and in which basis.
#include "reducer/modes/internal_modes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

/// Fixed numbers without simple ratios: equal roles of x, y and z become unequal. Rotations ascend, so that bending in
/// x-y (translation y, rotation z) comes before bending in x-z.
const Eigen::Matrix<double, 6, 1> component_weight =
    (Eigen::Matrix<double, 6, 1>() << 1.0, 0.83, 0.67, 0.31, 0.41, 0.53).finished();

/// Fixed functions that choose a basis inside clusters and signs; all depend on the body, none on its node numbers.
struct Gauge {
  Eigen::MatrixXd rigid;   ///< n_I x 6: (M R)_I, weighted; R about the centre of mass, rotations scaled
  Eigen::VectorXd square;  ///< coordinates of the mesh: weights of a quadratic form
  Eigen::VectorXd linear;  ///< coordinates of the mesh: weights of a linear form
  double mass = 0.0;
};

/// Weights by place, on the coordinates of the mesh: which of them ties made dependent plays no role.
void set_place_weights(const InternalProblem& problem, const Eigen::Vector3d& center, Gauge& gauge) {
  const System& system = problem.system;
  gauge.square.resize(system.coordinates.count());
  gauge.linear.resize(system.coordinates.count());
  for (int x = 0; x < system.coordinates.count(); ++x) {
    const auto k = static_cast<std::size_t>(x);
    const Eigen::Vector3d X = (problem.mesh.position.col(system.coordinates.node[k]) - center) / system.length;
    const int component = system.coordinates.component[k];
    const double place =
        X.dot(Eigen::Vector3d(0.9, 0.7, 0.5));  // exp: all powers, so no symmetry of a mode hides from it
    gauge.square[x] = system.mesh_mass[x] * component_weight[component] * std::exp(place);
    gauge.linear[x] = gauge.square[x] * (component < 3 ? 1.0 : 1.0 / system.length);
  }
}

Gauge make_gauge(const InternalProblem& problem) {
  const System& system = problem.system;
  const Partition& p = problem.partition;
  Gauge gauge;
  Eigen::MatrixXd R = rigid_motions_about(system, system.middle);
  const Eigen::MatrixXd rigid_mass = R.transpose() * multiply(system.matrices, system.matrices.M, R);
  gauge.mass = rigid_mass(0, 0);
  const Eigen::Matrix3d first = rigid_mass.topRightCorner<3, 3>() / gauge.mass;  // −skew(center − middle)
  const Eigen::Vector3d center = system.middle + Eigen::Vector3d(first(1, 2), first(2, 0), first(0, 1));
  R = rigid_motions_about(system, center);
  R.rightCols<3>() /= system.length;
  gauge.rigid = rows(multiply(system.matrices, system.matrices.M, R), p.internal) * component_weight.asDiagonal();
  set_place_weights(problem, center, gauge);
  return gauge;
}

/// Motion of the mesh's coordinates when the inside moves by `Phi` and the boundary is held.
Eigen::MatrixXd mesh_motion(const InternalProblem& problem, const Eigen::MatrixXd& Phi) {
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(problem.system.size(), Phi.cols());
  q(problem.partition.internal, Eigen::all) = Phi;
  return expand(problem.system.T, q).topRows(problem.system.coordinates.count());
}

/// Orthogonal basis (k x k) that diagonalises `form`, largest value first, and those values.
std::pair<Eigen::MatrixXd, Eigen::VectorXd> descending_basis(const Eigen::MatrixXd& form) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(form);
  return {solver.eigenvectors().rowwise().reverse(), solver.eigenvalues().reverse()};
}

void rotate_cluster(const InternalProblem& problem, const Gauge& gauge, Eigen::Ref<Eigen::MatrixXd> Phi) {
  const Eigen::MatrixXd L = Phi.transpose() * gauge.rigid;
  const auto [basis, value] = descending_basis(L * L.transpose());
  Phi = (Phi * basis).eval();
  for (Eigen::Index first = 0; first < Phi.cols();) {
    Eigen::Index end = first + 1;
    while (end < Phi.cols() && value[first] - value[end] < 1e-6 * gauge.mass) ++end;
    if (end - first > 1) {
      auto equal = Phi.middleCols(first, end - first);
      const Eigen::MatrixXd moved = mesh_motion(problem, equal);
      equal = (equal * descending_basis(moved.transpose() * gauge.square.asDiagonal() * moved).first).eval();
    }
    first = end;
  }
}

/// The number whose sign a mode takes: the first of participation, place and largest entry that is not close to 0.
double decisive_number(const InternalProblem& problem, const Gauge& gauge, const Eigen::VectorXd& phi) {
  const double limit = 1e-5 * std::sqrt(gauge.mass);
  const double participation = (gauge.rigid.transpose() * phi).sum();
  if (std::abs(participation) > limit) return participation;
  const Eigen::VectorXd moved = mesh_motion(problem, phi);
  const double place = gauge.linear.dot(moved);
  if (std::abs(place) > limit) return place;
  Eigen::Index largest = 0;
  moved.cwiseAbs().maxCoeff(&largest);
  return moved[largest];
}

/// Number of modes to compute, from the selection.
int wanted_modes(const InternalProblem& problem, const formats::ModeSelection& selection, int available) {
  if (!selection.cutoff) {
    if (selection.count <= available) return selection.count;
    throw Error(fmt::format("{} internal modes asked for, but only {} exist", selection.count, available),
                selection.where.empty() ? problem.where : selection.where,
                fmt::format("ask for at most {} modes, or use more elements{}", available,
                            available < problem.partition.n_I() ? " or masses with rotary inertia" : ""));
  }
  if (problem.partition.n_I() == 0) return 0;
  const double omega = 2.0 * EIGEN_PI * *selection.cutoff;
  return std::min(available, count_below(problem.blocks.S_II, problem.blocks.M_II, omega * omega));
}

}  // namespace

int finite_mode_count(const Matrix& M) {
  constexpr Eigen::Index factored = 20000;
  constexpr double null_pivot = 1e-10;
  const Eigen::VectorXd mass = diagonal(M);
  const auto with_mass = static_cast<int>((mass.array() > 0.0).count());
  if (with_mass == 0 || mass.size() > factored) return with_mass;
  const Eigen::VectorXd scale = (mass.array() > 0.0).select(mass.cwiseMax(1e-300).cwiseSqrt().cwiseInverse(), 1.0);
  return static_cast<int>(mass.size()) - Factor(scaled(M, scale), null_pivot).null();
}

void fix_basis(const InternalProblem& problem, Eigen::VectorXd& lambda, Eigen::MatrixXd& Phi) {
  if (lambda.size() == 0) return;
  const Gauge gauge = make_gauge(problem);
  for (int first = 0; first < lambda.size();) {
    const int end = cluster_end(lambda, first + 1, 0.0);
    if (end - first > 1) {
      rotate_cluster(problem, gauge, Phi.middleCols(first, end - first));
      lambda.segment(first, end - first).setConstant(lambda.segment(first, end - first).mean());
    }
    for (int k = first; k < end; ++k)
      if (decisive_number(problem, gauge, Phi.col(k)) < 0.0) Phi.col(k) = -Phi.col(k);
    first = end;
  }
}

InternalModes internal_modes(const InternalProblem& problem, const formats::ModeSelection& selection) {
  InternalModes modes;
  const Eigen::Index n_I = problem.partition.n_I();
  modes.available = n_I > 0 ? finite_mode_count(problem.blocks.M_II) : 0;
  modes.requested = wanted_modes(problem, selection, modes.available);
  modes.Phi.resize(n_I, 0);
  if (modes.available == 0) return modes;
  const Pencil pencil{problem.blocks.S_II, problem.blocks.M_II, problem.S_II, 0.0};
  const int sought = std::max(1, modes.requested);
  const Spectrum spectrum = lowest_pairs(pencil, sought, modes.available, choose_solver(n_I, sought));
  const int kept = modes.requested == 0 ? 0 : spectrum.kept;
  modes.solver = spectrum.solver == EigenSolver::dense ? "LAPACK dsygvx" : "SLEPc Krylov-Schur, shift-invert";
  modes.residual = spectrum.residual;
  modes.counted = modes.requested == 0 ? 0 : spectrum.counted;
  if (kept < spectrum.pairs.value.size()) modes.first_dropped = spectrum.pairs.value[kept];
  modes.lambda = spectrum.pairs.value.head(kept);
  modes.Phi = spectrum.pairs.vector.leftCols(kept);
  fix_basis(problem, modes.lambda, modes.Phi);
  return modes;
}

}  // namespace tisserand::reducer
