// SPDX-License-Identifier: GPL-3.0-or-later
// Contributions of bodies to an evaluation: the functions of a type of body T (model/bodies.hpp lists the types).
#pragma once

#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {

/// Adds G_iner + G_int + G_damp − gravity of a pool of bodies, with their force scales and the power of their dampers.
void add_forces(const Model& model, const State& state, const Pool<SuperelementUse>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<BeamElement2>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<BeamElement3>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<RigidBody>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<ModalBody>& pool, Evaluation& evaluation);

/// Adds the elastic and inertia forces of the modes to the scales, as forces of size √m ω² |w|. In a free vibration
/// they cancel in the residual. Called after all others, the outer forces. They scale residuals only: they grow with
/// the number of modes and are no load.
void note_modes(const Model& model, Evaluation& evaluation);

/// Adds the derivatives of these forces; internal coordinates of superelements are condensed.
template <class T>
void add_tangents(const Model& model, const Pool<T>& pool, TangentKind kind, Evaluation& evaluation,
                  const TangentTarget& target) = delete;
void add_tangents(const Model& model, const Pool<SuperelementUse>& pool, TangentKind kind, Evaluation& evaluation,
                  const TangentTarget& target);
void add_tangents(const Model& model, const Pool<BeamElement2>& pool, TangentKind kind, Evaluation& evaluation,
                  const TangentTarget& target);
void add_tangents(const Model& model, const Pool<BeamElement3>& pool, TangentKind kind, Evaluation& evaluation,
                  const TangentTarget& target);
void add_tangents(const Model& model, const Pool<RigidBody>& pool, TangentKind kind, Evaluation& evaluation,
                  const TangentTarget& target);
void add_tangents(const Model& model, const Pool<ModalBody>& pool, TangentKind kind, Evaluation& evaluation,
                  const TangentTarget& target);

/// Adds kinetic, strain and potential energy.
template <class T>
void add_energy(const Model& model, const Pool<T>& pool, const Evaluation& evaluation, Energy& sum) = delete;
void add_energy(const Model& model, const Pool<SuperelementUse>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<BeamElement2>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<BeamElement3>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<RigidBody>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<ModalBody>& pool, const Evaluation& evaluation, Energy& sum);

}  // namespace tisserand::mechanism
