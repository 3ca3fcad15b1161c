// SPDX-License-Identifier: GPL-3.0-or-later
// Random deformed states of single beam elements and their perturbation in any scalar, for tests of forces and
// tangents.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "mechanism/bodies/beam/kernels.hpp"

namespace tisserand::mechanism::test {

Eigen::Vector3d random_vector(std::mt19937& generator, double size);

formats::Section rectangle(double width_y, double height_z, double torsion_constant, double shear_factor);

formats::Material material(double youngs_modulus, double poisson_ratio, double density);

/// N = 2, 3. A curved and twisted element whose nodes are 0 .. N−1, all constants of size one, section triads that
/// differ.
template <int N>
BeamElement<N> general_element();

/// N = 2, 3. Nodes of an element turned rigidly by a large rotation, each with displacement and rotation up to `size`
/// beside it.
template <int N>
std::vector<NodeMotion> random_state(std::mt19937& generator, double size);

/// NodeMotion with another scalar.
template <class S>
struct ScalarMotion {
  Vec3<S> x;
  Mat3<S> R;
  Vec3<S> xd, Omega, xdd, Omegad;
};

/// Coordinate `dof` (per node 3 translations, 3 material rotations) of q, v and v̇ moved by the amounts given.
template <class S, int N>
std::array<ScalarMotion<S>, N> perturbed(const std::vector<NodeMotion>& nodes, int dof, const S& dq, const S& dv,
                                         const S& da) {
  std::array<ScalarMotion<S>, N> moved;
  for (int i = 0; i < N; ++i) {
    const NodeMotion& n = nodes[i];
    ScalarMotion<S>& m = moved[i];
    m.x = n.x.cast<S>();
    m.R = n.R.cast<S>();
    m.xd = n.xd.cast<S>();
    m.Omega = n.Omega.cast<S>();
    m.xdd = n.xdd.cast<S>();
    m.Omegad = n.Omegad.cast<S>();
    if (dof / 6 != i) continue;
    const int k = dof % 3;
    if (dof % 6 < 3) {
      m.x[k] += dq;
      m.xd[k] += dv;
      m.xdd[k] += da;
    } else {
      Vec3<S> turn = Vec3<S>::Zero();
      turn[k] = dq;
      m.R = (m.R * exp_so3<S>(turn)).eval();
      m.Omega[k] += dv;
      m.Omegad[k] += da;
    }
  }
  return moved;
}

template <class S, int N>
beam::Configuration<S, N> configuration(const std::array<ScalarMotion<S>, N>& motion) {
  beam::Configuration<S, N> q;
  for (int i = 0; i < N; ++i) {
    q.x[i] = motion[i].x;
    q.R[i] = motion[i].R;
  }
  return q;
}

/// The residual of the templates for any scalar.
template <class S, int N>
Eigen::Matrix<S, 6 * N, 1> scalar_residual(const BeamElement<N>& element, const std::array<ScalarMotion<S>, N>& motion,
                                           const Eigen::Vector3d& gravity) {
  Eigen::Matrix<S, 6 * N, 1> r;
  if constexpr (N == 2) {
    const beam::State2<S> state(element, configuration<S, N>(motion));
    beam::internal_force(element, state, r);
  } else {
    const beam::State3<S> state(element, configuration<S, N>(motion));
    beam::internal_force(element, state, r);
  }
  beam::NodePointers<ScalarMotion<S>, N> pointers;
  for (int i = 0; i < N; ++i) pointers[i] = &motion[i];
  beam::add_inertia(element, pointers, gravity, r);
  return r;
}

}  // namespace tisserand::mechanism::test
