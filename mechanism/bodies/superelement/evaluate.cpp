// SPDX-License-Identifier: GPL-3.0-or-later
// Kinematics, residual, energies and boundary weight of a superelement body in double precision.
#include "mechanism/bodies/superelement/evaluate.hpp"

namespace tisserand::mechanism {

void update_kinematics(const SuperelementBody& body, const NodeView<NodeMotion>& nodes, const double* y,
                       const double* yd, const double* ydd, const Eigen::Matrix3d& R0_reference,
                       SuperelementScratch& scratch) {
  LocalMotion<double>& motion = scratch.motion;
  if (body.modes > 0) {
    motion.y_I = Eigen::Map<const Eigen::VectorXd>(y, body.modes);
    motion.rate_I = Eigen::Map<const Eigen::VectorXd>(yd, body.modes);
    motion.acceleration_I = Eigen::Map<const Eigen::VectorXd>(ydd, body.modes);
  }
  scratch.R0_reference = R0_reference;
  motion.R0 = R0_reference;
  local_motion<double>(body, nodes, motion);
}

void residual(const SuperelementBody& body, SuperelementScratch& scratch, const Eigen::Vector3d& gravity) {
  superelement_forces(body, scratch.motion, gravity, scratch.forces);
}

double load_power(const SuperelementBody& body, const LocalMotion<double>& motion, const LoadTerms<double>& t) {
  const Eigen::Index nb = body.boundary_size;
  return t.force.dot(motion.origin_velocity) + t.moment.dot(motion.Omega0) +
         t.g.head(nb).dot(motion.deformation_rate_B) + t.g.tail(body.modes).dot(motion.rate_I);
}

void load_case_direction(const SuperelementBody& body, int load_case, const SuperelementScratch& scratch,
                         Eigen::VectorXd& boundary, Eigen::VectorXd& internal) {
  LoadTerms<double> t = make_load_terms<double>(body);
  t.factors[load_case] = 1.0;
  load_terms(body, scratch.motion, t);
  boundary = -t.g.head(body.boundary_size);
  internal = t.g.tail(body.modes);
  pull_back<double>(body, scratch.motion, {-t.force, -t.moment}, boundary);
  boundary = -boundary;
}

namespace {

double quadratic_form(const Eigen::MatrixXd& A, const Eigen::VectorXd& v) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < A.cols(); ++k) sum += v[k] * A.col(k).dot(v);
  return sum;
}

double coupling_form(const Eigen::MatrixXd& A, const Eigen::VectorXd& row, const Eigen::VectorXd& column) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < A.cols(); ++k) sum += column[k] * A.col(k).dot(row);
  return sum;
}

/// Dissipated power ẏᵀ D ẏ with D = b S̄ + diag(…) + a full matrix.
double power_at(const SuperelementBody& body, const Eigen::VectorXd& rate_B, const Eigen::VectorXd& rate_I) {
  const SuperelementDamping& damping = body.damping;
  double power = damping.stiffness * quadratic_form(body.S_BB, rate_B) + rate_I.cwiseAbs2().dot(damping.internal);
  if (damping.is_full())
    power += quadratic_form(damping.BB, rate_B) + 2.0 * coupling_form(damping.BI, rate_B, rate_I) +
             quadratic_form(damping.II, rate_I);
  return power;
}

/// Converts coordinates of the body, or their rates, to rows of the file.
void to_file_rows(const SuperelementBody& body, const Eigen::VectorXd& boundary, const Eigen::VectorXd& internal,
                  Eigen::Ref<Eigen::VectorXd> out) {
  for (std::size_t i = 0; i < body.file.boundary_row.size(); ++i)
    out[body.file.boundary_row[i]] = boundary_of_file(body, boundary, i);
  for (std::size_t k = 0; k < body.file.internal_row.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    out[body.file.internal_row[k]] =
        body.file.static_part.row(row).dot(boundary) + body.file.modal_part.row(row).dot(internal);
  }
}

}  // namespace

SuperelementEnergy energy(const SuperelementBody& body, const SuperelementScratch& scratch,
                          const Eigen::Vector3d& gravity) {
  const LocalMotion<double>& motion = scratch.motion;
  SuperelementEnergy result;
  const bool full_inertia = body.second_order.inertia.has_value();
  result.kinetic = full_inertia ? scratch.forces.inertia.kinetic
                                : 0.5 * (quadratic_form(body.M_BB, motion.rate_B) + motion.rate_I.squaredNorm()) +
                                      coupling_form(body.M_BI, motion.rate_B, motion.rate_I);
  if (body.inertia == formats::InertiaOption::M)
    result.kinetic +=
        0.5 * body.mass *
        (motion.center_velocity.squaredNorm() - mean_of<double>(body, motion.rate_B, motion.rate_I).squaredNorm());
  result.strain = 0.5 * (quadratic_form(body.S_BB, motion.y_B) + motion.y_I.cwiseAbs2().dot(body.S_II));
  if (body.second_order.stiffening) result.strain += strain_energy(scratch.forces.strain);
  if (!gravity.isZero(0.0)) {
    Eigen::Vector3d arm = deformed_center_of_mass<double>(body, motion);
    if (full_inertia) arm += scratch.forces.inertia.sigma / body.mass;
    const Eigen::Vector3d center = motion.x0 + motion.R0 * arm;
    result.gravity_potential = -body.mass * gravity.dot(center);
  }
  return result;
}

double damping_power(const SuperelementBody& body, const SuperelementScratch& scratch) {
  const LocalMotion<double>& motion = scratch.motion;
  const bool strained = body.second_order.stiffening && body.damping.stiffness > 0.0;
  return power_at(body, motion.deformation_rate_B, motion.rate_I) +
         (strained ? scratch.forces.strain.damping_power : 0.0);
}

double mean_damping_power(const SuperelementBody& body, const SuperelementScratch& scratch, double step,
                          StepDeformation& before) {
  before.rate_B = (scratch.motion.y_B - before.y_B) / step;
  before.rate_I = (scratch.motion.y_I - before.y_I) / step;
  const double power = power_at(body, before.rate_B, before.rate_I);
  if (!body.second_order.stiffening || body.damping.stiffness == 0.0) return power;
  const StrainTerms<double>& strain = scratch.forces.strain;
  double sum = 0.0;
  for (Eigen::Index a = 0; a < strain.g.size(); ++a) {
    const double bent = (strain.g[a] - before.quadratic[a]) / step;
    sum += (2.0 * (strain.linear[a] - before.linear[a]) / step + bent) * bent;
  }
  return power + body.damping.stiffness * sum;
}

void keep_deformation(const SuperelementBody& body, const SuperelementScratch& scratch, StepDeformation& kept) {
  kept.y_B = scratch.motion.y_B;
  kept.y_I = scratch.motion.y_I;
  if (!body.second_order.stiffening) return;
  kept.linear = scratch.forces.strain.linear;
  kept.quadratic = scratch.forces.strain.g;
}

Eigen::Index file_coordinate_count(const SuperelementBody& body) {
  return static_cast<Eigen::Index>(body.file.boundary_row.size() + body.file.internal_row.size());
}

void file_coordinates(const SuperelementBody& body, const SuperelementScratch& scratch,
                      Eigen::Ref<Eigen::VectorXd> out) {
  to_file_rows(body, scratch.motion.y_B, scratch.motion.y_I, out);
}

void strain_coordinates(const SuperelementBody& body, const SuperelementScratch& scratch,
                        Eigen::Ref<Eigen::VectorXd> out) {
  if (!body.second_order.stiffening) return file_coordinates(body, scratch, out);
  const Eigen::VectorXd strained =
      scratch.forces.strain.y + body.second_order.stiffening->inverse * scratch.forces.strain.g;
  to_file_rows(body, strained.head(body.boundary_size), strained.tail(body.modes), out);
}

FrameAcceleration frame_acceleration_of(const SuperelementBody& body, SuperelementScratch& scratch,
                                        const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity) {
  LocalMotion<double>& motion = scratch.motion;
  if (body.inertia != formats::InertiaOption::M && !body.second_order.inertia) {  // else update_kinematics() has
    deformation_rates(body, nodes, motion);
    deformation_accelerations(body, nodes, motion);
  }
  return {body.axes * (motion.origin_acceleration - motion.R0.transpose() * gravity), body.axes * motion.Omega0,
          body.axes * motion.Omega0d};
}

void file_rates(const SuperelementBody& body, SuperelementScratch& scratch, const NodeView<NodeMotion>& nodes,
                Eigen::Ref<Eigen::VectorXd> out) {
  LocalMotion<double>& motion = scratch.motion;
  if (!body.damping.active)  // otherwise update_kinematics() has done it
    deformation_rates(body, nodes, motion);
  to_file_rows(body, motion.deformation_rate_B, motion.rate_I, out);
}

void boundary_weight(const SuperelementBody& body, const TangentCoefficients& coefficients,
                     const SuperelementScratch& scratch, SuperelementWork& work) {
  Eigen::MatrixXd& A = work.A_BB;
  A = coefficients.mass * body.M_BB + coefficients.stiffness * body.S_BB;
  const Eigen::Matrix3d& R0 = scratch.motion.R0;
  const int n = body.translations();
  for (const SuperelementNode& node : body.node) {
    if (!node.has_translation()) continue;
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      Eigen::Vector3d turned = Eigen::Vector3d::Zero();
      turned.head(n) = A.col(j).segment(node.translation_row, n);
      A.col(j).segment(node.translation_row, n) = (R0 * turned).head(n);
    }
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      Eigen::Vector3d turned = Eigen::Vector3d::Zero();
      turned.head(n) = A.row(i).segment(node.translation_row, n).transpose();
      A.row(i).segment(node.translation_row, n) = (R0 * turned).head(n).transpose();
    }
  }
}

}  // namespace tisserand::mechanism
