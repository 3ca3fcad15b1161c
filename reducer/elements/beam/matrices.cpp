// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices of a beam element of the mesh about its nodes, in part axes, and checks of its shape.
#include "reducer/elements/element_matrices.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "common/math/rotation.hpp"
#include "reducer/elements/beam/ends.hpp"
#include "reducer/elements/beam/general.hpp"
#include "reducer/elements/beam/mesh_beam.hpp"
#include "reducer/elements/element_stress.hpp"

namespace tisserand::reducer {
namespace {

/// Names of the released end forces: "moments about x at both ends", ...
std::string released_text(std::uint16_t released) {
  static constexpr const char* names[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  std::string text;
  for (int k = 0; k < 12; ++k)
    if ((released >> k & 1) != 0)
      text += fmt::format("{}{} at end {}", text.empty() ? "" : ", ", names[k % 6], k / 6 + 1);
  return text;
}

}  // namespace

Eigen::Vector3d axis_of(const Mesh& mesh, const BeamElement& beam) {
  return mesh.position.col(beam.second) + beam.second_offset - mesh.position.col(beam.first) - beam.first_offset;
}

BeamElementData data_of(const Mesh& mesh, const BeamElement& beam) {
  BeamElementData data = mesh.beam_properties[beam.property].data;
  data.length = axis_of(mesh, beam).norm();
  return data;
}

Matrix12 ends_from_nodes(const BeamElement& beam) {
  Matrix12 to_ends = Matrix12::Identity();
  to_ends.block<3, 3>(0, 3) = -skew<double>(beam.first_offset);
  to_ends.block<3, 3>(6, 9) = -skew<double>(beam.second_offset);
  for (int k = 0; k < 12; k += 3) to_ends.middleRows<3>(k) = (beam.R_PE.transpose() * to_ends.middleRows<3>(k)).eval();
  return to_ends;
}

BeamMatrices at_the_ends(const BeamElementData& data) {
  if (!is_plain(data)) return general_beam(data);
  return {beam_stiffness(data), beam_mass(data)};
}

void element_matrices(const Mesh& mesh, const BeamElement& beam, ElementMatrices& out) {
  BeamMatrices matrices = at_the_ends(data_of(mesh, beam));
  if (beam.released != 0) release_ends(beam.released, matrices);
  matrices.stiffness = to_part_axes(matrices.stiffness, beam.R_PE);
  matrices.mass = to_part_axes(matrices.mass, beam.R_PE);
  if (!beam.first_offset.isZero(0.0) || !beam.second_offset.isZero(0.0)) {
    move_to_nodes(beam.first_offset, beam.second_offset, matrices.stiffness);
    move_to_nodes(beam.first_offset, beam.second_offset, matrices.mass);
  }
  out.S = matrices.stiffness;
  out.M = matrices.mass;
}

Matrix12 beam_section_forces(const Mesh& mesh, const BeamElement& beam) {
  BeamMatrices matrices = at_the_ends(data_of(mesh, beam));
  if (beam.released != 0) release_ends(beam.released, matrices);
  Matrix12 forces = matrices.stiffness * ends_from_nodes(beam);  // forces on the ends of the element
  forces.topRows<6>() *= -1.0;
  return forces;
}

void check_shape(const Mesh& mesh, const BeamElement& beam, ShapeFindings& findings) {
  const Eigen::Vector3d axis = axis_of(mesh, beam);
  const double length = axis.norm();
  const double reach = mesh.position.col(beam.first).norm() + mesh.position.col(beam.second).norm() +
                       beam.first_offset.norm() + beam.second_offset.norm();
  if (!std::isfinite(length) || !(length > 1e-12 * reach)) {
    findings.errors.push_back(fmt::format("its ends are at the same place (length {:g})", length));
    return;
  }
  if ((beam.R_PE.col(0) - axis / length).norm() > 1e-6 || !beam.R_PE.isUnitary(1e-6))
    findings.errors.push_back("its axes are not aligned with the line between its ends");
  const BeamElementData data = data_of(mesh, beam);
  if (!is_plain(data)) {
    if (const std::optional<std::string> fault = general_beam_fault(data)) {
      findings.errors.push_back(*fault);
      return;
    }
  }
  const double depth =
      std::sqrt(12.0 * std::max(data.section.second_moment_y, data.section.second_moment_z) / data.section.area);
  if (length < 0.02 * depth)
    findings.warnings.push_back(
        fmt::format("its length {:.3g} is less than 1/50 of the depth {:.3g} of its section", length, depth));
  if (beam.released == 0) return;
  BeamMatrices matrices = at_the_ends(data);
  if (release_ends(beam.released, matrices) > 0)
    findings.errors.push_back("its released end forces (" + released_text(beam.released) +
                              ") make it a mechanism: the element can move between its nodes without any stiffness");
}

}  // namespace tisserand::reducer
