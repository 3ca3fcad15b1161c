// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of three elements.
#include "tests/support/bodies/small_recovery.hpp"

#include <cmath>

#include "formats/superelement/mirror.hpp"
#include "tests/support/bodies/beam_superelement.hpp"

namespace tisserand::test_support {

using formats::ElementShape;
using formats::Recovery;
using formats::RecoveryField;

Recovery small_recovery() {
  const formats::Superelement beam = craig_bampton_beam({}, 1);
  Recovery r;
  r.name = "small";
  r.producer = "tests";
  r.content_id = formats::content_id(beam);
  for (int image = 0; image < 7; ++image)
    r.mirror_content_id[static_cast<std::size_t>(image)] =
        formats::mirrored({beam, {}}, formats::mirror_axes(image)).superelement.content_id;
  r.units = beam.units;
  r.boundary_name = beam.node_name;
  r.boundary_node = {0, 1};
  r.dof_node = beam.dof_node;
  r.dof_component = beam.dof_component;
  r.position.resize(3, 7);
  r.position << 0, 2, 2, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 0, 1, 1, 1;
  for (int n = 0; n < 7; ++n) {
    r.node_label.push_back("node " + std::to_string(n));
    r.rotates.push_back(n < 4 ? 1 : 0);
  }
  r.group_name = {"spar", "skin", "body"};
  r.elements.shape = {ElementShape::beam, ElementShape::quadrilateral, ElementShape::tetrahedron4};
  r.elements.group = {0, 1, 2};
  r.elements.id = {1, 1, 7};
  r.elements.first = {0, 2, 6, 10};
  r.elements.node = {0, 1, 0, 1, 2, 3, 0, 1, 3, 4};
  r.beam_axes = {Eigen::Matrix3d::Identity()};
  r.beam_offset = Eigen::Matrix3Xd::Zero(3, 2);
  r.beam_section = {0, 0};
  r.sections = {{4e-4, 1.5e-8, 2e-8, 0.0, 0.0, 0.0, {{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}, true}};
  r.shell_axes = {Eigen::Matrix3d::Identity()};
  r.shell_thickness = {0.01};
  r.shell_offset = {0.0};
  r.stress_node = {0, 1, 3, 4};
  r.stress_group = {2, 2, 2, 2};
  r.triangle.resize(3, 2);
  r.triangle << 0, 0, 1, 2, 2, 3;
  r.triangle_element = {1, 1};
  return r;
}

Eigen::MatrixXd small_field(const Recovery& recovery, RecoveryField field) {
  const Eigen::Index rows = static_cast<Eigen::Index>(formats::width(field)) * formats::items(recovery, field);
  return Eigen::MatrixXd::NullaryExpr(rows, recovery.coordinates(), [&](Eigen::Index i, Eigen::Index k) {
    return std::sin(1.0 + static_cast<double>(i) + 0.37 * static_cast<double>(k) + static_cast<double>(field));
  });
}

void write_small_recovery(const std::string& path) {
  Recovery recovery = small_recovery();
  const Eigen::Index n = recovery.coordinates();
  recovery.second_order = formats::SecondOrderForms{{Eigen::MatrixXd::Identity(n, n), Eigen::MatrixXd::Ones(n, n)},
                                                    {Eigen::MatrixXd::Constant(n, n, 0.5)},
                                                    {static_cast<int>(n) - 1}};
  formats::RecoveryWriter writer(path, recovery);
  for (const RecoveryField field : formats::recovery_fields) writer.append(field, small_field(recovery, field));
  for (const RecoveryField field : {RecoveryField::translation, RecoveryField::rotation})
    writer.append_second_order(field, small_field(recovery, field).leftCols<2>());
  writer.finish();
}

}  // namespace tisserand::test_support
