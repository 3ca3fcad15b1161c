// SPDX-License-Identifier: GPL-3.0-or-later
// Contributions of forces to an evaluation: the overloads of a type of force T (model/forces.hpp lists the types).
#pragma once

#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {

/// Adds the forces of a pool to the residual with the sign of r, and their energy and powers to the evaluation. Part
/// loads on superelements are not among them: the body adds them.
void add_forces(const Model& model, const State& state, const Pool<Bushing>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<Tyre>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<Load>& pool, Evaluation& evaluation);
void add_forces(const Model& model, const State& state, const Pool<PartLoad>& pool, Evaluation& evaluation);

/// Adds the derivatives of the forces of a pool to the stored values of `target`.
template <class T>
void add_tangents(const Model& model, const Pool<T>& pool, Evaluation& evaluation,
                  const TangentTarget& target) = delete;
void add_tangents(const Model& model, const Pool<Bushing>& pool, Evaluation& evaluation, const TangentTarget& target);
void add_tangents(const Model& model, const Pool<Tyre>& pool, Evaluation& evaluation, const TangentTarget& target);
void add_tangents(const Model& model, const Pool<Load>& pool, Evaluation& evaluation, const TangentTarget& target);
void add_tangents(const Model& model, const Pool<PartLoad>& pool, Evaluation& evaluation, const TangentTarget& target);

}  // namespace tisserand::mechanism
