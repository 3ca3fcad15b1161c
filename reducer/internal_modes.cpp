// Internal modes: how many, which, and in which basis.
#include "reducer/internal_modes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "common/rotation.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

/// Fixed numbers without simple ratios: equal roles of x, y and z become unequal. Rotations ascend, so that bending in
/// x-y (translation y, rotation z) comes before bending in x-z.
const Eigen::Matrix<double, 6, 1> component_weight =
    (Eigen::Matrix<double, 6, 1>() << 1.0, 0.83, 0.67, 0.31, 0.41, 0.53).finished();

/// Fixed functions that choose a basis inside clusters and signs; all depend on the body, none on its node numbers.
struct Gauge {
  Eigen::MatrixXd rigid;   ///< n_I x 6: (M R)_I, weighted; R about the centre of mass, rotations scaled
  Eigen::VectorXd square;  ///< n_I: weights of a quadratic form
  Eigen::VectorXd linear;  ///< n_I: weights of a linear form
  double mass = 0.0;
};

Gauge make_gauge(const InternalProblem& problem) {
  const Mesh& mesh = problem.mesh;
  const Partition& p = problem.partition;
  const double length = characteristic_length(mesh);
  Eigen::MatrixXd R = rigid_motions(mesh);
  const auto mass_times = [&](const Eigen::MatrixXd& all) {
    return Eigen::MatrixXd(multiply(problem.blocks.M_II, rows(all, p.internal)) +
                           problem.blocks.M_IB * rows(all, p.boundary));
  };
  const Eigen::MatrixXd R_B = rows(R, p.boundary);
  const Eigen::MatrixXd R_I = rows(R, p.internal);
  const Eigen::MatrixXd at_boundary = problem.blocks.M_IB.transpose() * R_I + problem.blocks.M_BB * R_B;
  const Eigen::MatrixXd rigid_mass = R_I.transpose() * mass_times(R) + R_B.transpose() * at_boundary;
  Gauge gauge;
  gauge.mass = rigid_mass(0, 0);
  const Eigen::Matrix3d first = rigid_mass.topRightCorner<3, 3>() / gauge.mass;  // −skew(center)
  const Eigen::Vector3d center(first(1, 2), first(2, 0), first(0, 1));
  R.rightCols<3>() += R.leftCols<3>() * skew<double>(center);
  R.rightCols<3>() /= length;
  gauge.rigid = mass_times(R) * component_weight.asDiagonal();

  const Eigen::VectorXd mass = diagonal(problem.blocks.M_II);
  gauge.square.resize(p.n_I());
  gauge.linear.resize(p.n_I());
  for (Eigen::Index i = 0; i < p.n_I(); ++i) {
    const Eigen::Vector3d x = (mesh.position.col(p.internal[i] / 6) - center) / length;
    const int component = p.internal[i] % 6;
    const double place =
        x.dot(Eigen::Vector3d(0.9, 0.7, 0.5));  // exp: all powers, so no symmetry of a mode hides from it
    gauge.square[i] = mass[i] * component_weight[component] * std::exp(place);
    gauge.linear[i] = gauge.square[i] * (component < 3 ? 1.0 : 1.0 / length);
  }
  return gauge;
}

/// Orthogonal basis (k x k) that diagonalises `form`, largest value first, and those values.
std::pair<Eigen::MatrixXd, Eigen::VectorXd> descending_basis(const Eigen::MatrixXd& form) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(form);
  return {solver.eigenvectors().rowwise().reverse(), solver.eigenvalues().reverse()};
}

void rotate_cluster(const Gauge& gauge, Eigen::Ref<Eigen::MatrixXd> Phi) {
  const Eigen::MatrixXd L = Phi.transpose() * gauge.rigid;
  const auto [basis, value] = descending_basis(L * L.transpose());
  Phi = (Phi * basis).eval();
  for (Eigen::Index first = 0; first < Phi.cols();) {
    Eigen::Index end = first + 1;
    while (end < Phi.cols() && value[first] - value[end] < 1e-6 * gauge.mass) ++end;
    if (end - first > 1) {
      auto equal = Phi.middleCols(first, end - first);
      equal = (equal * descending_basis(equal.transpose() * gauge.square.asDiagonal() * equal).first).eval();
    }
    first = end;
  }
}

void fix_sign(const Gauge& gauge, Eigen::Ref<Eigen::VectorXd> phi) {
  const double participation = (gauge.rigid.transpose() * phi).sum();
  const double place = gauge.linear.dot(phi);
  Eigen::Index largest = 0;
  phi.cwiseAbs().maxCoeff(&largest);
  const double limit = 1e-5 * std::sqrt(gauge.mass);
  const double decisive = std::abs(participation) > limit ? participation
                          : std::abs(place) > limit       ? place
                                                          : phi[largest];
  if (decisive < 0.0) phi = -phi;
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

int finite_mode_count(const Mesh& mesh, const Partition& p) {
  std::vector<bool> full(static_cast<std::size_t>(mesh.nodes()), false);
  std::vector<Eigen::Matrix<double, 6, 6>> block(full.size(), Eigen::Matrix<double, 6, 6>::Zero());
  ElementMatrices matrices;
  for (const BeamElement& beam : mesh.beams) {
    const BeamElementData& data = mesh.beam_properties[static_cast<std::size_t>(beam.property)].data;
    const bool consistent = data.mass_matrix == formats::MassMatrix::consistent && data.material.density > 0.0;
    element_matrices(mesh, beam, matrices);
    if (consistent) matrices.M.setZero();
    for (const auto& [node, first] : {std::pair{beam.first, 0}, std::pair{beam.second, 6}}) {
      if (consistent) full[static_cast<std::size_t>(node)] = true;
      block[static_cast<std::size_t>(node)] += matrices.M.block<6, 6>(first, first);
    }
  }
  for (const NodalMass& point : mesh.masses) {
    block[static_cast<std::size_t>(point.node)].topLeftCorner<3, 3>().diagonal().array() += point.mass;
    block[static_cast<std::size_t>(point.node)].bottomRightCorner<3, 3>() += point.inertia;
  }
  int count = 0;
  for (std::size_t i = 0; i < p.internal.size();) {
    const std::size_t node = static_cast<std::size_t>(p.internal[i] / 6);
    std::vector<int> components;
    for (; i < p.internal.size() && p.internal[i] / 6 == static_cast<int>(node); ++i)
      components.push_back(p.internal[i] % 6);
    if (full[node]) {
      count += static_cast<int>(components.size());
      continue;
    }
    for (const int low : {0, 3}) {
      std::vector<int> part;
      std::copy_if(components.begin(), components.end(), std::back_inserter(part),
                   [low](int c) { return c >= low && c < low + 3; });
      if (part.empty()) continue;
      const Eigen::VectorXd value =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(block[node](part, part)).eigenvalues();
      count += static_cast<int>((value.array() > 1e-12 * value.maxCoeff()).count());
    }
  }
  return count;
}

void fix_basis(const InternalProblem& problem, Eigen::VectorXd& lambda, Eigen::MatrixXd& Phi) {
  if (lambda.size() == 0) return;
  const Gauge gauge = make_gauge(problem);
  for (int first = 0; first < lambda.size();) {
    const int end = cluster_end(lambda, first + 1, 0.0);
    if (end - first > 1) {
      rotate_cluster(gauge, Phi.middleCols(first, end - first));
      lambda.segment(first, end - first).setConstant(lambda.segment(first, end - first).mean());
    }
    for (int k = first; k < end; ++k) fix_sign(gauge, Phi.col(k));
    first = end;
  }
}

InternalModes internal_modes(const InternalProblem& problem, const formats::ModeSelection& selection) {
  InternalModes modes;
  const Eigen::Index n_I = problem.partition.n_I();
  modes.available = finite_mode_count(problem.mesh, problem.partition);
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
