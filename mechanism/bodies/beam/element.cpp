// SPDX-License-Identifier: GPL-3.0-or-later
// Constants, residuals, energies and section forces of beam elements: the double instantiation of
// bodies/beam/kernels.hpp.
#include "mechanism/bodies/beam/element.hpp"

#include "common/error.hpp"
#include "formats/sections/axis.hpp"
#include "mechanism/bodies/beam/kernels.hpp"

namespace tisserand::mechanism {
namespace {

template <int N>
beam::Configuration<double, N> gather(const BeamElement<N>& element, std::span<const NodeMotion> nodes) {
  beam::Configuration<double, N> q;
  for (int i = 0; i < N; ++i) {
    const NodeMotion& node = nodes[element.nodes[i]];
    q.x[i] = node.x;
    q.R[i] = node.R;
  }
  return q;
}

template <int N>
beam::NodePointers<NodeMotion, N> gather_motion(const BeamElement<N>& element, std::span<const NodeMotion> nodes) {
  beam::NodePointers<NodeMotion, N> motion;
  for (int i = 0; i < N; ++i) motion[i] = &nodes[element.nodes[i]];
  return motion;
}

void require_positive(double value, const char* quantity, const std::string& where) {
  if (!(value > 0.0) || !std::isfinite(value))
    throw Error(fmt::format("{} is {}, must be positive", quantity, value), where, "give a positive value");
}

void check_data(const formats::Section& section, const formats::Material& material, double length) {
  if (section.shear_area_y == 0.0 || section.shear_area_z == 0.0)
    throw Error(fmt::format("section '{}' has no shear areas (shear_area_y = {}, shear_area_z = {}), but the nonlinear "
                            "beam deforms in shear",
                            section.name, section.shear_area_y, section.shear_area_z),
                section.where,
                "give both shear areas (about 5/6 of the area for a rectangle, 0.9 for a solid circle) or a shape");
  if (const auto text = formats::off_axis_text(section))
    throw Error(fmt::format("section '{}' does not fit a nonlinear beam: {}", section.name, *text), section.where,
                "use a section with two axes of symmetry, or a superelement of this beam");
  require_positive(section.area, "area of the section", section.where);
  require_positive(section.second_moment_y, "second moment of area Iy of the section", section.where);
  require_positive(section.second_moment_z, "second moment of area Iz of the section", section.where);
  require_positive(section.torsion_constant, "torsion constant of the section", section.where);
  require_positive(section.shear_area_y, "shear area along y of the section", section.where);
  require_positive(section.shear_area_z, "shear area along z of the section", section.where);
  require_positive(material.youngs_modulus, "Young's modulus", material.where);
  require_positive(material.shear_modulus(), "shear modulus", material.where);
  if (!(material.density >= 0.0))
    throw Error(fmt::format("density is {}, must not be negative", material.density), material.where,
                "give a density of zero or more");
  require_positive(length, "length of the beam element", section.where);
}

/// Adds the residual bending flexibility. One quadrature point sees only the bending moment of the middle. The energy
/// of its linear part, V s, enters through the shear flexibility: 1/GA + L²/(12 E I) ([Mac78]). I belongs to the plane
/// in which the shear force bends. β is the share of bending in this sum.
void add_residual_bending(BeamElement2& element) {
  const double share = element.length * element.length / 12.0;
  for (const auto& [force, moment] : {std::pair(1, 2), std::pair(2, 1)}) {
    const double bending = share / element.moment_stiffness[moment];
    const double flexibility = 1.0 / element.force_stiffness[force] + bending;
    element.force_stiffness[force] = 1.0 / flexibility;
    element.bending_share[force] = bending / flexibility;
  }
}

void set_initial_strains(BeamElement2& element, const beam::Configuration<double, 2>& q) {
  const beam::State2<double> state(element, q);
  element.initial_gamma[0] = state.gamma;
  element.initial_kappa[0] = state.kappa;
}

void set_initial_strains(BeamElement3& element, const beam::Configuration<double, 3>& q) {
  const beam::State3<double> state(element, q);
  for (int k = 0; k < 2; ++k) {
    element.initial_gamma[k] = state.point[k].gamma;
    element.initial_kappa[k] = state.point[k].kappa;
  }
}

}  // namespace

template <int N>
BeamElement<N> make_beam_element(const BeamReference<N>& reference, const formats::Section& section,
                                 const formats::Material& material) {
  check_data(section, material, reference.length);
  const double E = material.youngs_modulus, G = material.shear_modulus();
  BeamElement<N> element;
  element.nodes = reference.nodes;
  element.length = reference.length;
  element.section = reference.section;
  element.force_stiffness = {E * section.area, G * section.shear_area_y, G * section.shear_area_z};
  element.moment_stiffness = {G * section.torsion_constant, E * section.second_moment_y, E * section.second_moment_z};
  element.polar_radius_squared = (section.second_moment_y + section.second_moment_z) / section.area;
  if constexpr (N == 2) add_residual_bending(element);
  const formats::SectionInertia rotary = formats::section_inertia(section, material);
  element.mass = rotary.mass * reference.length;
  const Eigen::Vector3d inertia =
      reference.length * Eigen::Vector3d(rotary.about_y + rotary.about_z, rotary.about_y, rotary.about_z);
  beam::Configuration<double, N> q;
  for (int i = 0; i < N; ++i) {
    const Eigen::Matrix3d& D = reference.section[i];
    element.inertia[i] = beam::Shares<N>::node[i] * (D * inertia.asDiagonal() * D.transpose());
    q.x[i] = reference.position[i];
    q.R[i].setIdentity();
  }
  for (int k = 0; k < N - 1; ++k) {
    element.initial_gamma[k].setZero();
    element.initial_kappa[k].setZero();
  }
  set_initial_strains(element, q);
  return element;
}

void residual(const BeamElement2& element, std::span<const NodeMotion> nodes, const Eigen::Vector3d& gravity,
              Eigen::Matrix<double, 12, 1>& r) {
  const beam::State2<double> state(element, gather(element, nodes));
  beam::internal_force(element, state, r);
  beam::add_inertia(element, gather_motion(element, nodes), gravity, r);
}

void residual(const BeamElement3& element, std::span<const NodeMotion> nodes, const Eigen::Vector3d& gravity,
              Eigen::Matrix<double, 18, 1>& r) {
  const beam::State3<double> state(element, gather(element, nodes));
  beam::internal_force(element, state, r);
  beam::add_inertia(element, gather_motion(element, nodes), gravity, r);
}

template <int N>
BeamEnergy energy(const BeamElement<N>& element, std::span<const NodeMotion> nodes, const Eigen::Vector3d& gravity) {
  BeamEnergy sum;
  const beam::NodePointers<NodeMotion, N> motion = gather_motion(element, nodes);
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j)
      sum.kinetic += 0.5 * element.mass * beam::Shares<N>::mass[i][j] * motion[i]->xd.dot(motion[j]->xd);
    sum.kinetic += 0.5 * motion[i]->Omega.dot(element.inertia[i] * motion[i]->Omega);
    sum.potential -= element.mass * beam::Shares<N>::node[i] * gravity.dot(motion[i]->x);
  }
  if constexpr (N == 2) {
    using beam::Parabola;
    const beam::Bow<double> bow(element, motion);
    const Eigen::Vector3d rate = bow.rate();
    sum.kinetic +=
        element.mass * rate.dot(Parabola::by_node * (motion[0]->xd + motion[1]->xd) + 0.5 * Parabola::by_itself * rate);
    sum.potential -= element.mass * Parabola::whole * gravity.dot(bow.value());
  }
  sum.strain = beam::strain_energy(element, gather(element, nodes));
  return sum;
}

template <int N>
std::array<BeamSectionForces, N - 1> section_forces(const BeamElement<N>& element, std::span<const NodeMotion> nodes) {
  const beam::Configuration<double, N> q = gather(element, nodes);
  std::array<BeamSectionForces, N - 1> result;
  if constexpr (N == 2) {
    const beam::State2<double> p(element, q);
    result[0] = {0.5 * element.length, p.axes, p.gamma, p.kappa, p.force, p.moment};
  } else {
    const beam::State3<double> state(element, q);
    for (int k = 0; k < 2; ++k) {
      const beam::Point3<double>& p = state.point[k];
      const double s = (k == 0 ? -beam::gauss : beam::gauss);
      result[k] = {0.5 * (1.0 + s) * element.length, p.axes, p.gamma, p.kappa, p.force, p.moment};
    }
  }
  return result;
}

template BeamElement2 make_beam_element(const BeamReference<2>&, const formats::Section&, const formats::Material&);
template BeamElement3 make_beam_element(const BeamReference<3>&, const formats::Section&, const formats::Material&);
template BeamEnergy energy(const BeamElement2&, std::span<const NodeMotion>, const Eigen::Vector3d&);
template BeamEnergy energy(const BeamElement3&, std::span<const NodeMotion>, const Eigen::Vector3d&);
template std::array<BeamSectionForces, 1> section_forces(const BeamElement2&, std::span<const NodeMotion>);
template std::array<BeamSectionForces, 2> section_forces(const BeamElement3&, std::span<const NodeMotion>);

}  // namespace tisserand::mechanism
