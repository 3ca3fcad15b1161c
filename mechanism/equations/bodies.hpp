// SPDX-License-Identifier: GPL-3.0-or-later
// Contributions of bodies to an evaluation: the functions of a type of body T (model/bodies.hpp lists the types).
#pragma once

#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {

/// Adds the residuals of a pool of bodies, G_iner + G_int + G_damp − gravity, to the evaluation. It also updates the
/// force scales and the power of dampers.
void add_forces(const Model& model, const State& state, const Pool<SuperelementUse>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<BeamElement2>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<BeamElement3>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<RigidBody>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<ModalBody>& pool, Evaluation& evaluation);

/// Adds the internal forces of the modes of modal bodies to the scale of forces, as √mass · max(ω² |w|, |ẅ|). In a free
/// vibration elastic and inertia forces cancel in the residual. Requires all other forces: it first stores their scale
/// as `outer_force`. Internal forces of modes scale residuals only, because they grow with the number of modes and are
/// no load.
void note_modes(const Model& model, Evaluation& evaluation);

/// Adds the derivatives of the residuals of a pool of bodies to the stored values of `target`. Internal coordinates of
/// superelements are condensed.
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

/// Adds kinetic, strain and potential energy of a pool of bodies to `sum`.
template <class T>
void add_energy(const Model& model, const Pool<T>& pool, const Evaluation& evaluation, Energy& sum) = delete;
void add_energy(const Model& model, const Pool<SuperelementUse>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<BeamElement2>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<BeamElement3>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<RigidBody>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<ModalBody>& pool, const Evaluation& evaluation, Energy& sum);

}  // namespace tisserand::mechanism
