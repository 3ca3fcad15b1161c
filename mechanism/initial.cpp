// Rank, projection and consistent start.
#include "mechanism/initial.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/QR>
#include <Eigen/SparseCore>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/evaluate.hpp"
#include "mechanism/integrator.hpp"
#include "mechanism/newton.hpp"
#include "mechanism/schedule.hpp"
#include "mechanism/solver/matrix_rank.hpp"

namespace tisserand::mechanism {
namespace {

/// Singular values of B below this (relative) count as zero.
constexpr double rank_tolerance = 1e-10;
/// Smallest reciprocal condition of a mass matrix that is solved as it is.
constexpr double mass_condition = 1e-15;
/// Constraint Jacobians up to this size are decomposed densely.
constexpr int dense_rank_limit = 150;

/// Bᵀ with rotation rows divided by the characteristic length and angle columns multiplied with it.
Eigen::SparseMatrix<double> scaled_jacobian(const Model& model, const Workspace& workspace) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const std::vector<int>& coordinates, int row, const auto& values) {
    for (std::size_t j = 0; j < coordinates.size(); ++j) {
      const double value = values[static_cast<Eigen::Index>(j)];
      if (coordinates[j] < 0 || value == 0.0) continue;
      const double scale = (j % 6 < 3 ? 1.0 : 1.0 / model.length) *
                           (model.length_row[static_cast<std::size_t>(row)] ? 1.0 : model.length);
      entries.emplace_back(coordinates[j], row, value * scale);
    }
  };
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    for (int k = 0; k < model.joints[i].size(); ++k)
      add(model.joint_maps[i].coordinates, model.joints[i].row + k, workspace.joints[i].B.row(k));
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Row12 row = term.factor * workspace.coordinates[at].G;
      add(model.coordinate_maps[at].coordinates, coupling.row, row);
    }
  Eigen::SparseMatrix<double> B(model.sizes.boundary, model.sizes.constraints);
  B.setFromTriplets(entries.begin(), entries.end());
  B.makeCompressed();
  return B;
}

/// Largest violation and its row; positions relative to the length.
struct Violation {
  double value = 0.0;
  int row = -1;
};

Violation largest_violation(const Model& model, const Eigen::VectorXd& rows) {
  Violation worst;
  for (int row = 0; row < model.sizes.constraints; ++row) {
    const double value = std::abs(rows[row]) / (model.length_row[static_cast<std::size_t>(row)] ? model.length : 1.0);
    if (!(value <= worst.value)) worst = {value, row};
  }
  return worst;
}

double largest_velocity(const Model& model, const State& state) {
  double largest = 0.0;
  for (const Node& node : model.nodes) {
    if (node.translation >= 0)
      largest = std::max(largest, state.v().segment<3>(node.translation).norm() / model.length);
    if (node.rotation >= 0) largest = std::max(largest, state.v().segment<3>(node.rotation).norm());
  }
  return largest;
}

void require_factors(const Model& model, const FactorReport& factors, const std::string& where, Workspace& workspace) {
  if (factors.regular && factors.reciprocal_condition > 1e-300) return;
  std::string name = "a direction of the scene";
  if (factors.singular_column >= 0)
    name = factors.singular_column < model.sizes.boundary
               ? coordinate_name(model, factors.singular_column)
               : constraint_name(model, factors.singular_column - model.sizes.boundary);
  workspace.has_factors = false;
  throw Error(fmt::format("{} has no mass, no stiffness and no constraint", name), where,
              "give the body mass or inertia there, or hold the direction with a joint");
}

/// The equations of a joint are also met by axes that point the other way: z_A·z_B > 0 for hinges, all axes for fixed
/// ones.
void require_facing(const Model& model, const std::string& where, const Workspace& workspace) {
  for (const Joint& joint : model.joints) {
    const Eigen::Matrix3d R_AB = marker_rotation(joint.a, motion_of(workspace, joint.a.node)).transpose() *
                                 marker_rotation(joint.b, motion_of(workspace, joint.b.node));
    const int axis = aligned_axis(joint);
    const bool hinge = axis >= 0 && R_AB(axis, axis) <= 0.0;
    const bool fixed = keeps_orientation(joint) && R_AB.diagonal().minCoeff() <= 0.0;
    if (!hinge && !fixed) continue;
    throw Error(hinge ? fmt::format("the {} axes of the markers of {} joint '{}' point in opposite directions",
                                    "xyz"[axis], formats::joint_word(joint.kind), joint.name)
                      : fmt::format("the axes of the markers of {} joint '{}' are turned against each other",
                                    formats::joint_word(joint.kind), joint.name),
                where, "turn the orientation of one marker, so that the axes of both agree at the start");
  }
}

}  // namespace

Mobility count_mobility(const Model& model, const State& state, Workspace& workspace) {
  evaluate(model, state, workspace);
  Mobility mobility;
  mobility.coordinates = model.sizes.velocities();
  mobility.constraints = model.sizes.constraints;
  const Eigen::SparseMatrix<double> B = scaled_jacobian(model, workspace);
  if (mobility.constraints > 0 && mobility.constraints <= dense_rank_limit) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(rank_tolerance);
    qr.compute(Eigen::MatrixXd(B));
    mobility.rank = static_cast<int>(qr.rank());
    for (Eigen::Index k = qr.rank(); k < mobility.constraints; ++k)
      mobility.redundant.push_back(static_cast<int>(qr.colsPermutation().indices()[k]));
  } else if (mobility.constraints > 0) {
    ColumnRank columns = column_rank(B, rank_tolerance * std::max(1.0, B.coeffs().cwiseAbs().maxCoeff()));
    mobility.rank = columns.rank;
    mobility.redundant = std::move(columns.dependent);
  }
  std::sort(mobility.redundant.begin(), mobility.redundant.end());
  mobility.degrees_of_freedom = mobility.coordinates - mobility.rank;
  const int elements = static_cast<int>(model.beams2.size() + model.beams3.size());
  mobility.rigid_mobility =
      elements > 0 ? -1 : 6 * static_cast<int>(model.superelements.size() + model.rigid_bodies.size()) - mobility.rank;
  return mobility;
}

Projection project_initial_state(const Model& model, double tolerance, double step, const std::string& where,
                                 State& state, Workspace& workspace) {
  Projection projection;
  workspace.displacement.setZero();
  for (int iteration = 0;; ++iteration) {
    evaluate(model, state, workspace);
    const Violation worst = largest_violation(model, workspace.constraint);
    if (iteration == 0) {
      projection.position = worst.value;
      if (!(worst.value <= tolerance))
        throw Error(
            fmt::format("joint '{}' is not met at the start: off by {:.3g} {} (initial_tolerance allows {:.3g})",
                        constraint_name(model, worst.row), worst.value, "of the characteristic length or radians",
                        tolerance),
            where, "correct poses or markers, or raise initial_tolerance to let the program move the bodies");
    }
    if (worst.value <= 1e-14 || iteration == 20) break;
    require_factors(model, factor(model, state, {1.0, 0.0, step * step}, TangentKind::step, {}, workspace), where,
                    workspace);
    solve_correction(model, -workspace.constraint, workspace);
    const State before = state;
    retract(model, before, workspace.correction, state);
    if (workspace.correction.head(model.sizes.boundary).cwiseAbs().maxCoeff() < 1e-15 * model.length) break;
  }
  const Violation left = largest_violation(model, workspace.constraint);
  if (!(left.value <= 1e-9))
    throw Error(fmt::format("the joints cannot be closed: '{}' stays open by {:.3g}", constraint_name(model, left.row),
                            left.value),
                where, "correct the poses of the bodies");
  require_facing(model, where, workspace);
  const double velocity = largest_velocity(model, state);
  const Violation worst = largest_violation(model, workspace.constraint_rate);
  projection.velocity = velocity > 0.0 ? worst.value / velocity : 0.0;
  if (!(projection.velocity <= tolerance))
    throw Error(
        fmt::format(
            "initial velocities violate joint '{}': {:.3g} of the largest velocity (initial_tolerance allows {:.3g})",
            constraint_name(model, worst.row), projection.velocity, tolerance),
        where, "give velocities that agree with the joints, or raise initial_tolerance to let the program change them");
  if (worst.value > 0.0) {
    require_factors(model, factor(model, state, {1.0, 0.0, step * step}, TangentKind::step, {}, workspace), where,
                    workspace);
    solve_correction(model, -workspace.constraint_rate, workspace);
    state.v() += workspace.correction;
  }
  workspace.has_factors = false;
  return projection;
}

bool solve_accelerations(const Model& model, double step, const std::string& where, State& state,
                         Workspace& workspace) {
  workspace.displacement.setZero();
  state.vdot().setZero();
  state.lambda().setZero();
  evaluate(model, state, workspace);
  FactorReport factors = factor(model, state, {1.0, 0.0, 0.0}, TangentKind::step, {}, workspace);
  const bool massless = !factors.regular || factors.reciprocal_condition < mass_condition;
  if (massless) {
    factors = factor(model, state, {1.0, 0.0, step * step}, TangentKind::step, {}, workspace);
    require_factors(model, factors, where, workspace);
  }
  for (int refinement = 0; refinement < 2; ++refinement) {
    if (refinement > 0) evaluate(model, state, workspace);
    evaluate_bias(model, workspace);
    apply_jacobian(model, workspace, state.vdot(), workspace.multipliers);
    workspace.bias = -workspace.bias - workspace.multipliers;
    solve_increment(model, workspace.bias, workspace);
    state.vdot() += workspace.increment;
    state.lambda() += workspace.unknowns.tail(model.sizes.constraints);
  }
  workspace.has_factors = false;
  evaluate(model, state, workspace);
  return massless;
}

void start_algorithmic_acceleration(const Model& model, double shift, double step, const std::string& where,
                                    State& state, Workspace& workspace) {
  state.algorithmic() = state.vdot();
  state.step() = step;
  if (shift == 0.0) return;
  const double epsilon = 1e-3 * step;
  State ahead = state;
  ahead.time() += epsilon;
  ahead.load_time() += epsilon;
  const Eigen::VectorXd d = epsilon * state.v() + 0.5 * epsilon * epsilon * state.vdot();
  retract(model, state, d, ahead);
  ahead.v() += epsilon * state.vdot();
  evaluate(model, ahead, workspace);
  evaluate_bias(model, workspace);
  // With M + h/2 C + h²/4 K in place of M: equal to it up to O(h) where the step resolves the motion; elsewhere the
  // rate of the acceleration would grow with the frequency squared and mean nothing.
  const FactorReport factors =
      factor(model, ahead, {1.0, 0.5 * step, 0.25 * step * step}, TangentKind::step, {}, workspace);
  require_factors(model, factors, where, workspace);
  apply_jacobian(model, workspace, ahead.vdot(), workspace.multipliers);
  workspace.bias = -workspace.bias - workspace.multipliers;
  solve_increment(model, workspace.bias, workspace);
  workspace.has_factors = false;
  state.algorithmic() += (shift * step / epsilon) * workspace.increment;
}

StartReport start(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace) {
  const std::string& where = scene.file;
  const bool dynamics = scene.analysis == formats::AnalysisKind::dynamics;
  // Only regularises massless directions, where statics has no step of its own.
  const double step = dynamics ? scene.integrator.step : 1e-3;
  StartReport report;
  report.mobility = count_mobility(model, state, workspace);
  for (const int row : report.mobility.redundant) state.active()[row] = 0.0;
  report.projection = project_initial_state(model, scene.initial_tolerance, step, where, state, workspace);
  if (!dynamics) return report;
  report.massless = solve_accelerations(model, step, where, state, workspace);
  const AlphaParameters alpha = alpha_parameters(scene.integrator);
  start_algorithmic_acceleration(model, alpha.alpha_m - alpha.alpha_f, step, where, state, workspace);
  begin(model, state, workspace);
  return report;
}

}  // namespace tisserand::mechanism
