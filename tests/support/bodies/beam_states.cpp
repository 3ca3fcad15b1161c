// SPDX-License-Identifier: GPL-3.0-or-later
// Sections, materials, elements and states of nodes for the tests of beam elements.
#include "tests/support/bodies/beam_states.hpp"

#include <cmath>

namespace tisserand::mechanism::test {

Eigen::Vector3d random_vector(std::mt19937& generator, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
  return {x, y, z};
}

formats::Section rectangle(double width_y, double height_z, double torsion_constant, double shear_factor) {
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

formats::Material material(double youngs_modulus, double poisson_ratio, double density) {
  formats::Material result;
  result.name = "material";
  result.youngs_modulus = youngs_modulus;
  result.poisson_ratio = poisson_ratio;
  result.density = density;
  return result;
}

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

template BeamElement2 general_element<2>();
template BeamElement3 general_element<3>();
template std::vector<NodeMotion> random_state<2>(std::mt19937& generator, double size);
template std::vector<NodeMotion> random_state<3>(std::mt19937& generator, double size);

}  // namespace tisserand::mechanism::test
