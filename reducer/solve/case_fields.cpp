// SPDX-License-Identifier: GPL-3.0-or-later
// Recovered fields in memory, and the loads between the ends of beams.
#include "reducer/solve/case_fields.hpp"

#include "reducer/elements/element_loads.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using formats::RecoveryField;

/// A field, and the number of its rows that are already filled.
struct Growing {
  Eigen::MatrixXf* field;
  Index filled = 0;
};

void append(const Eigen::MatrixXd& rows, Growing& growing) {
  growing.field->middleRows(growing.filled, rows.rows()) = rows.cast<float>();
  growing.filled += rows.rows();
}

/// Completes forces on the ends of beams: S d minus the end forces of the load between them.
void add_loads_between(const Mesh& mesh, Eigen::MatrixXd& beam_force) {
  for (std::size_t c = 0; c < mesh.load_cases.size(); ++c) {
    const MeshLoadCase& load = mesh.load_cases[c];
    const auto column = static_cast<Index>(c);
    const auto add = [&](int beam, const BeamLoad& between) {
      const Eigen::Matrix<double, 12, 1> force = beam_end_load(mesh, mesh.beams[beam], between);
      beam_force.col(column).segment<6>(12 * beam) += force.head<6>();
      beam_force.col(column).segment<6>(12 * beam + 6) -= force.tail<6>();
    };
    for (const BeamLineLoad& line : load.beams) add(line.beam, {line.force, Eigen::Vector3d::Zero()});
    if (load.gravity.isZero(0.0)) continue;
    for (int b = 0; b < std::ssize(mesh.beams); ++b) add(b, {Eigen::Vector3d::Zero(), load.gravity});
  }
}

}  // namespace

RecoveredFields case_fields(const Mesh& mesh, const formats::Recovery& tables, const Eigen::MatrixXd& motions,
                            const std::function<void(double)>& share) {
  const Index cases = motions.cols();
  const auto sized = [&](RecoveryField field, Eigen::MatrixXf& values) {
    values.resize(static_cast<Index>(formats::width(field)) * formats::items(tables, field), cases);
    return Growing{&values, 0};
  };
  RecoveredFields fields;
  Growing displacement = sized(RecoveryField::translation, fields.displacement);
  Growing shells = sized(RecoveryField::shell_stress, fields.shell_stress);
  Growing solids = sized(RecoveryField::solid_stress, fields.solid_stress);
  Eigen::MatrixXd beam_force(12 * static_cast<Index>(mesh.beams.size()), cases);
  Index beam_rows = 0;
  const MotionSource source{[&](const std::vector<int>& nodes) {
                              Eigen::MatrixXd rows(6 * static_cast<Index>(nodes.size()), cases);
                              for (std::size_t k = 0; k < nodes.size(); ++k)
                                rows.middleRows<6>(6 * static_cast<Index>(k)) = motions.middleRows<6>(6 * nodes[k]);
                              return rows;
                            },
                            cases};
  motion_fields(mesh, source, tables, share, [&](RecoveryField field, const Eigen::MatrixXd& rows) {
    switch (field) {
      case RecoveryField::translation:
        return append(rows, displacement);
      case RecoveryField::rotation:
        return;
      case RecoveryField::beam_force:
        beam_force.middleRows(beam_rows, rows.rows()) = rows;
        beam_rows += rows.rows();
        return;
      case RecoveryField::shell_stress:
        return append(rows, shells);
      case RecoveryField::solid_stress:
        return append(rows, solids);
    }
  });
  add_loads_between(mesh, beam_force);
  fields.beam_force = beam_force.cast<float>();
  derive_stresses(tables, UnitConversion{}, fields);
  return fields;
}

}  // namespace tisserand::reducer
