// Random deformed states of single beam elements and their perturbation in any scalar, for tests of forces and
// tangents.
#pragma once

#include <random>
#include <span>
#include <vector>

#include "mechanism/bodies/beam_kernels.hpp"

namespace tisserand::mechanism::test {

inline Eigen::Vector3d random_vector(std::mt19937& generator, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
  return {x, y, z};
}

inline formats::Section rectangle(double width_y, double height_z, double torsion_constant, double shear_factor) {
  formats::Section section;
  section.name = "rectangle";
  section.area = width_y * height_z;
  section.second_moment_y = width_y * std::pow(height_z, 3) / 12.0;
  section.second_moment_z = height_z * std::pow(width_y, 3) / 12.0;
  section.torsion_constant = torsion_constant;
  section.polar_moment = section.second_moment_y + section.second_moment_z;
  section.shear_area_y = section.shear_area_z = shear_factor * section.area;
  return section;
}

inline formats::Material material(double youngs_modulus, double poisson_ratio, double density) {
  formats::Material result;
  result.name = "material";
  result.youngs_modulus = youngs_modulus;
  result.poisson_ratio = poisson_ratio;
  result.density = density;
  return result;
}

/// A curved and twisted element whose nodes are 0 .. N−1, all constants of size one, section triads that differ.
template <int N>
BeamElement<N> general_element() {
  BeamReference<N> reference;
  std::mt19937 generator(7);
  for (int i = 0; i < N; ++i) {
    const double s = static_cast<double>(i) / (N - 1);
    reference.nodes[i] = i;
    reference.position[i] = {s, 0.2 * s * s, -0.1 * s};
    reference.section[i] = exp_so3<double>(Eigen::Vector3d(0.3 * s, 0.1, 0.4 * s) + random_vector(generator, 0.05));
  }
  reference.length = 1.1;
  formats::Section section = rectangle(0.8, 1.1, 0.15, 0.8);
  section.shear_area_y = 0.5;
  return make_beam_element<N>(reference, section, material(2.0, 0.3, 1.7));
}

/// Nodes of an element turned rigidly by a large rotation, each with displacement and rotation up to `size` beside it.
template <int N>
std::vector<NodeMotion> random_state(std::mt19937& generator, double size) {
  std::vector<NodeMotion> nodes(N);
  const Eigen::Matrix3d turn = exp_so3<double>(random_vector(generator, 1.5));
  for (int i = 0; i < N; ++i) {
    const double s = static_cast<double>(i) / (N - 1);
    nodes[i].x =
        turn * (Eigen::Vector3d(s, 0.2 * s * s, -0.1 * s) + random_vector(generator, size)) + Eigen::Vector3d(1, -2, 3);
    nodes[i].R = turn * exp_so3<double>(random_vector(generator, size));
    nodes[i].xd = random_vector(generator, 1.0);
    nodes[i].Omega = random_vector(generator, 1.0);
    nodes[i].xdd = random_vector(generator, 1.0);
    nodes[i].Omegad = random_vector(generator, 1.0);
  }
  return nodes;
}

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
