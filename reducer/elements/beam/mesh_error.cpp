// SPDX-License-Identifier: GPL-3.0-or-later
// Discretisation error of beams, which are exact for loads at their ends, by the inertia between the ends.
#include "reducer/elements/mesh_error.hpp"

#include <Eigen/LU>

#include "common/math/rotation.hpp"
#include "reducer/elements/beam/mesh_beam.hpp"

namespace tisserand::reducer {
namespace {

/// Motions of the ends in element axes.
Eigen::MatrixXd motion_of_ends(const BeamElement& beam, const Eigen::MatrixXd& u) {
  Eigen::MatrixXd v = u;
  v.topRows<3>() -= skew<double>(beam.first_offset) * u.middleRows<3>(3);
  v.middleRows<3>(6) -= skew<double>(beam.second_offset) * u.middleRows<3>(9);
  for (int k = 0; k < 12; k += 3) v.middleRows<3>(k) = (beam.R_PE.transpose() * v.middleRows<3>(k)).eval();
  return v;
}

/// Mean over the ends of a tapered beam, which the estimate uses in place of the taper.
double mean_of(const BeamElementData& data, double formats::Section::*value) {
  if (data.stations.empty()) return data.section.*value;
  return 0.5 * (data.stations.front().*value + data.stations.back().*value);
}

double energy_along(double load, double stiffness, double length) {
  return stiffness > 0.0 ? load * load * length * length * length / (12.0 * stiffness) : 0.0;
}

}  // namespace

Eigen::VectorXd energy_error(const Mesh& mesh, const BeamElement& beam, const ElementModes& modes) {
  using formats::Section;
  const auto& [u, lambda] = modes;
  BeamElementData data = data_of(mesh, beam);
  const double L = data.length, E = data.material.youngs_modulus, G = data.material.shear_modulus();
  const Section& first = data.stations.empty() ? data.section : data.stations.front();
  const Section& last = data.stations.empty() ? data.section : data.stations.back();
  const formats::SectionInertia a = section_inertia(first, data.material), b = section_inertia(last, data.material);
  const double mass = 0.5 * (a.mass + b.mass + data.added_mass.first + data.added_mass.second);
  const double about_x = 0.5 * (a.about_x + b.about_x) + data.added_mass.inertia;
  Eigen::Matrix2d EI;
  EI << mean_of(data, &Section::second_moment_z), mean_of(data, &Section::second_moment_yz),
      mean_of(data, &Section::second_moment_yz), mean_of(data, &Section::second_moment_y);
  EI *= E;
  const bool rod = is_rod(data), shear = data.theory == formats::BeamTheory::timoshenko;
  const double across = rod ? 0.0 : L * L * L * L * L / (beam.released == 0 ? 720.0 : 240.0);  // held or hinged ends
  const Eigen::MatrixXd v = motion_of_ends(beam, u);
  Eigen::VectorXd error = Eigen::VectorXd::Zero(u.cols());
  for (Eigen::Index m = 0; m < u.cols(); ++m) {
    const Eigen::Vector4d mean = 0.5 * (v.col(m).head<4>() + v.col(m).segment<4>(6));
    Eigen::Vector2d load(mean.y(), mean.z());
    if (!rod) load += L / 12.0 * Eigen::Vector2d(v(5, m) - v(11, m), v(10, m) - v(4, m));
    load *= lambda[m] * mass;
    error[m] = energy_along(lambda[m] * mass * mean.x(), E * mean_of(data, &Section::area), L) +
               energy_along(lambda[m] * about_x * mean[3], G * mean_of(data, &Section::torsion_constant), L);
    if (rod) continue;
    error[m] += across * load.dot(EI.inverse() * load);
    if (!shear) continue;
    error[m] += energy_along(load.x(), G * mean_of(data, &Section::shear_area_y), L) +
                energy_along(load.y(), G * mean_of(data, &Section::shear_area_z), L);
  }
  if (data.mass_matrix == formats::MassMatrix::consistent) return error;
  const Matrix12 lumped = at_the_ends(data).mass;
  data.mass_matrix = formats::MassMatrix::consistent;
  const Eigen::MatrixXd excess = (at_the_ends(data).mass - lumped) * v;
  return error + lambda.cwiseProduct(v.cwiseProduct(excess).colwise().sum().transpose());
}

}  // namespace tisserand::reducer
