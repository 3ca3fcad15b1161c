// Linear and angular momentum of bodies that hang together, by their kinetic energy, whatever they are.
#pragma once

#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Bodies by name.
using BodyGroup = std::set<std::string>;

/// Groups of bodies that joints, drives and gears hold together, without those that only ground connects, as far as
/// they hold one of `bodies`.
std::vector<BodyGroup> jointed_groups(const Model& model, const BodyGroup& bodies);

/// [linear; angular about a point], world axes.
using Momentum = Eigen::Matrix<double, 6, 1>;

/// P_k = ∂T(v + ε z_k)/∂ε for the translations and rotations z_k of the group as one rigid body. T is quadratic in v,
/// so that differences give it to round-off.
Momentum momentum_of(const Model& model, const State& state, const BodyGroup& group, const Eigen::Vector3d& about,
                     Evaluation& evaluation);

/// Moves the group as one rigid body, v += Σ a_k z_k, in those directions that joints and drives leave free, until its
/// momentum there is `wanted`. What ground holds keeps what it has: the joints to it gave the rest.
void restore_momentum(const Model& model, const BodyGroup& group, const Momentum& wanted, const Eigen::Vector3d& about,
                      State& state, Evaluation& evaluation);

}  // namespace tisserand::mechanism
