// SPDX-License-Identifier: GPL-3.0-or-later
// Forces, derivatives and energies of bodies, type by type.
#include "mechanism/equations/bodies.hpp"

#include <algorithm>
#include <cmath>

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Notes inertia and internal forces separately, because they cancel in the residual of a free vibration.
void note_scale(const SuperelementBody& body, const SuperelementScratch& scratch, Evaluation& evaluation) {
  const auto& forces = scratch.forces;
  const auto note = [&evaluation, &forces](int kind, int row, int count) {
    double& scale = evaluation.force_scale[kind];
    for (int k = row; k < row + count && row >= 0; ++k)
      scale = std::max({scale, std::abs(forces.f_B[k]), std::abs(forces.s_B[k])});
  };
  for (const SuperelementNode& node : body.node) {
    note(0, node.translation_row, body.translations());
    note(1, node.rotation_row, body.rotations());
  }
  const auto& motion = scratch.motion;
  double& internal = evaluation.force_scale[2];
  for (Eigen::Index k = 0; k < body.modes; ++k)
    internal = std::max({internal, std::abs(body.S_II[k] * motion.y_I[k]), std::abs(motion.acceleration_I[k])});
}

void note_scale(const ModalScratch& scratch, Evaluation& evaluation) {
  double &force = evaluation.force_scale[0], &moment = evaluation.force_scale[1];
  force = std::max(force, scratch.r.head<3>().cwiseAbs().maxCoeff());
  moment = std::max(moment, scratch.r.segment<3>(3).cwiseAbs().maxCoeff());
}

template <int N>
void add_beam_forces(const Pool<BeamElement<N>>& pool, Evaluation& evaluation) {
  Eigen::Matrix<double, BeamElement<N>::dofs, 1> r;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    residual(pool[i], evaluation.motion, evaluation.load_factor * pool[i].gravity, r);
    scatter(pool.maps[i], r, evaluation.residual);
    note_scale(r, evaluation);
  }
}

template <int N>
void add_beam_tangents(const Pool<BeamElement<N>>& pool, const Evaluation& evaluation, const TangentTarget& target) {
  constexpr int n = BeamElement<N>::dofs;
  Eigen::Matrix<double, n, 1> r;
  Eigen::Matrix<double, n, n> A;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    residual_and_tangent(pool[i], evaluation.motion, pool[i].gravity, target.coefficients, r, A);
    scatter_matrix(pool.maps[i], A, target.factor, target.values);
  }
}

template <int N>
void add_beam_energy(const Pool<BeamElement<N>>& pool, const Evaluation& evaluation, Energy& sum) {
  for (const auto& beam : pool) {
    const BeamEnergy part = energy(beam, evaluation.motion, beam.gravity);
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.potential += part.potential;
  }
}

}  // namespace

void add_forces(const Model& model, const State& state, const Pool<SuperelementUse>& pool, Evaluation& evaluation) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const Vector3d gravity = evaluation.load_factor * pool[i].gravity;
    SuperelementScratch& scratch = evaluation.superelements[i];
    const int internal = model.internal_offset[i];
    const int first = model.sizes.boundary + internal;
    const Matrix3d R0 = quaternion(state.frames().col(i)).toRotationMatrix();
    update_kinematics(body, nodes_of(model, i, evaluation), state.y().data() + internal, state.v().data() + first,
                      state.vdot().data() + first, R0, scratch);
    residual(body, scratch, gravity);
    scatter(pool.maps[i], scratch.forces.r_B, evaluation.residual);
    note_scale(body, scratch, evaluation);
    if (body.damping.active) {
      const double power = damping_power(body, scratch);
      evaluation.body_power += power;
      evaluation.damper_power += power;
    }
    if (!body.load_cases.empty()) evaluation.load_power += load_power(body, scratch.motion, scratch.forces.loads);
  }
}

void add_forces(const Model&, const State&, const Pool<BeamElement2>& pool, Evaluation& evaluation) {
  add_beam_forces(pool, evaluation);
}

void add_forces(const Model&, const State&, const Pool<BeamElement3>& pool, Evaluation& evaluation) {
  add_beam_forces(pool, evaluation);
}

void add_forces(const Model& model, const State&, const Pool<RigidBody>& pool, Evaluation& evaluation) {
  in_space(model.planar, [&]<int D>() {
    for (std::size_t i = 0; i < pool.size(); ++i) {
      const RigidBody& body = pool[i];
      const CarrierVector<D> r =
          residual<D>(body, motion_of(evaluation, body.node), evaluation.load_factor * body.gravity);
      scatter_carrier<D>(pool.maps[i].coordinates.data(), r, evaluation.residual);
      note_scale(r, evaluation);
    }
  });
}

void add_forces(const Model&, const State&, const Pool<ModalBody>& pool, Evaluation& evaluation) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const ModalBody& body = pool[i];
    ModalScratch& scratch = evaluation.modal_bodies[i];
    residual(body, scratch);
    scatter(pool.maps[i], scratch.r, evaluation.residual);
    note_scale(scratch, evaluation);
    evaluation.damper_power += body.damping.dot(scratch.wd.cwiseAbs2());
  }
}

void add_tangents(const Model& model, const Pool<SuperelementUse>& pool, TangentKind kind, Evaluation& evaluation,
                  const TangentTarget& target) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    SuperelementScratch& scratch = evaluation.superelements[i];
    SuperelementWork& work = work_of(model, i, evaluation);
    switch (kind) {
      case TangentKind::step:
        tangent(body_of(model, i), target.coefficients, scratch, work);
        break;
      case TangentKind::exact:
        exact_tangent(body_of(model, i), nodes_of(model, i, evaluation), evaluation.load_factor * pool[i].gravity,
                      target.coefficients, scratch, work);
        break;
    }
    scatter_matrix(pool.maps[i], work.A_BB, target.factor, target.values);
  }
}

void add_tangents(const Model&, const Pool<BeamElement2>& pool, TangentKind, Evaluation& evaluation,
                  const TangentTarget& target) {
  add_beam_tangents(pool, evaluation, target);
}

void add_tangents(const Model&, const Pool<BeamElement3>& pool, TangentKind, Evaluation& evaluation,
                  const TangentTarget& target) {
  add_beam_tangents(pool, evaluation, target);
}

void add_tangents(const Model&, const Pool<RigidBody>& pool, TangentKind, Evaluation& evaluation,
                  const TangentTarget& target) {
  Matrix6d A;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    tangent(pool[i], motion_of(evaluation, pool[i].node), target.coefficients, A);
    scatter_matrix(pool.maps[i], A, target.factor, target.values);
  }
}

void add_tangents(const Model&, const Pool<ModalBody>& pool, TangentKind, Evaluation& evaluation,
                  const TangentTarget& target) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    tangent(pool[i], target.coefficients, evaluation.modal_bodies[i]);
    scatter_matrix(pool.maps[i], evaluation.modal_bodies[i].tangent, target.factor, target.values);
  }
}

void add_energy(const Model& model, const Pool<SuperelementUse>& pool, const Evaluation& evaluation, Energy& sum) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const SuperelementEnergy part = energy(body_of(model, i), evaluation.superelements[i], pool[i].gravity);
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.potential += part.gravity_potential;
  }
}

void add_energy(const Model&, const Pool<BeamElement2>& pool, const Evaluation& evaluation, Energy& sum) {
  add_beam_energy(pool, evaluation, sum);
}

void add_energy(const Model&, const Pool<BeamElement3>& pool, const Evaluation& evaluation, Energy& sum) {
  add_beam_energy(pool, evaluation, sum);
}

void add_energy(const Model&, const Pool<RigidBody>& pool, const Evaluation& evaluation, Energy& sum) {
  for (const RigidBody& body : pool) {
    const NodeMotion& node = motion_of(evaluation, body.node);
    sum.kinetic += kinetic_energy(body, node);
    sum.potential += gravity_potential(body, node, body.gravity);
  }
}

void add_energy(const Model&, const Pool<ModalBody>& pool, const Evaluation& evaluation, Energy& sum) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const ModalEnergy part =
        energy(pool[i], motion_of(evaluation, pool[i].node), pool[i].gravity, evaluation.modal_bodies[i]);
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.potential += part.potential;
  }
}

void note_modes(const Model& model, Evaluation& evaluation) {
  double& force = evaluation.force_scale[0];
  evaluation.outer_force = force;
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    const ModalScratch& scratch = evaluation.modal_bodies[i];
    for (Eigen::Index k = 0; k < body.modes; ++k)
      force = std::max(
          force, std::sqrt(body.mass) * std::max(std::abs(body.stiffness[k] * scratch.w[k]), std::abs(scratch.wdd[k])));
  }
}

void gather_residual(const Model& model, const Evaluation& evaluation, Eigen::Ref<Eigen::VectorXd> r) {
  r.head(model.sizes.boundary) = evaluation.residual;
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    r.segment(model.sizes.boundary + model.internal_offset[i], body_of(model, i).modes) =
        evaluation.superelements[i].forces.r_I;
}

}  // namespace tisserand::mechanism
