// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the reducer's tests, built in code, and small helpers around the full model.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Core>

#include "formats/part/part.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/modes/eps_block_lanczos.hpp"
#include "reducer/reduce.hpp"
#include "reducer/system/system.hpp"

/// Skips a test of the block Lanczos type where SLEPc's header for new solvers was not found.
#define NEEDS_BLOCK_LANCZOS()                                                       \
  if (!reducer::has_block_lanczos()) {                                              \
    GTEST_SKIP() << "slepc/private/epsimpl.h was missing when this was configured"; \
  }                                                                                 \
  static_assert(true)

namespace tisserand::testing {

/// PETSc and SLEPc, started once per test process.
void start_solvers();

/// The beam of [Car00] section 8: L = 141.42 along x, double bending modes; boundary base and tip.
formats::Part cardona_beam(int elements, int modes);

/// Beam of unequal bending planes from `from` to `to` with boundary nodes at both ends.
formats::Part plain_beam(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int elements, int modes);

/// An unsymmetric space frame with an arc, two materials, two sections, a point mass with inertia; boundary a, b, c;
/// all its frequencies are single.
formats::Part space_frame(int modes);

/// Replaces the values of all beams of the part.
void set_theory(formats::Part& part, formats::BeamTheory theory);
void set_mass(formats::Part& part, formats::MassMatrix mass_matrix, bool rotary_inertia);

reducer::Reduction reduce(const formats::Part& part);

/// Dense S and M of all coordinates of the part's mesh.
struct FullModel {
  reducer::Mesh mesh;
  reducer::System system;
  Eigen::MatrixXd S, M;
};
FullModel full_model(const formats::Part& part);

/// Angular frequencies [rad/time] of S x = ω² M x on the coordinates `keep`, ascending; both positive definite there.
Eigen::VectorXd angular_frequencies(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const std::vector<int>& keep);

/// Eigenvalues of a positive semidefinite pencil with a shift below 0, ascending.
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double shift);

/// Largest difference, relative to the largest entry of `expected`.
double relative_difference(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected);

}  // namespace tisserand::testing
