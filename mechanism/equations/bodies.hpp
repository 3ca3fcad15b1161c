// What bodies contribute to an evaluation: the hooks of a type of body T (model/bodies.hpp lists the types).
#pragma once

#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {

/// G_iner + G_int + G_damp − gravity of all bodies of the pool, with their force scales and the power of their dampers.
void add_forces(const Model& model, const State& state, const Pool<SuperelementUse>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<BeamElement2>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<BeamElement3>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<RigidBody>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<ModalBody>& pool, Evaluation& evaluation);

/// Elastic and inertia forces of modes one by one, which cancel in the residual of a free vibration, as forces of size
/// √m ω² |w|, after all others, which are the outer forces: of use beside residuals alone, for they grow with the
/// number of modes and are nobody's load.
void note_modes(const Model& model, Evaluation& evaluation);

/// Their derivatives; internal coordinates of superelements are condensed.
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

/// Kinetic, strain and potential energy.
template <class T>
void add_energy(const Model& model, const Pool<T>& pool, const Evaluation& evaluation, Energy& sum) = delete;
void add_energy(const Model& model, const Pool<SuperelementUse>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<BeamElement2>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<BeamElement3>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<RigidBody>& pool, const Evaluation& evaluation, Energy& sum);
void add_energy(const Model& model, const Pool<ModalBody>& pool, const Evaluation& evaluation, Energy& sum);

}  // namespace tisserand::mechanism
