// SPDX-License-Identifier: GPL-3.0-or-later
// Layout and values of the example rows.
#include "tests/support/results_rows.hpp"

#include <limits>

namespace tisserand::test_support {

formats::ResultsLayout example_layout() {
  formats::ResultsLayout layout;
  layout.scene = "example";
  layout.producer = "tests";
  layout.units = Units::si();
  layout.nodes = {"beam/base", "beam/tip", "hub"};
  layout.superelements = {"beam", "frame"};
  layout.modes_offset = {0, 3, 5};
  layout.boundary_offset = {0, 2, 3};
  layout.boundary_nodes = {"base", "tip", "foot"};
  layout.modal_bodies = {"rod"};
  layout.modal_offset = {0, 2};
  layout.load_case_offset = {0, 0, 1};
  layout.load_cases = {"gust"};
  layout.modal_node_offset = {0, 1};
  layout.modal_nodes = {"tip"};
  layout.joints = {"hinge", "slide"};
  layout.coordinates = {{"hinge", false}, {"slide", true}};
  layout.couplings = {{"pair", false, false}, {"rack", false, true}};
  layout.motions = {{"drive", false}, {"push", true}};
  layout.springs = {{"strut", true}, {"door", false}};
  layout.stops = {{"door", false}};
  layout.bushings = {"mount", "pad"};
  layout.frictions = {"slide"};
  layout.tyres = {"front", "rear"};
  layout.quantities = {{"speed", "m s^-1"}, {"corner/angle", "rad"}};
  layout.treads = layout.strained = true;
  layout.stiffened = {1, 0};
  layout.superelement_content_ids = {std::string(64, 'a'), std::string(64, 'b')};
  return layout;
}

double row_value(int t, int k) { return static_cast<double>(t) * 1024.0 + static_cast<double>(k) + 0.25; }

void fill_row(int t, formats::ResultsRow& row) {
  int k = 0;
  const auto fill = [&](auto& block) {
    for (Eigen::Index i = 0; i < block.size(); ++i) block.data()[i] = row_value(t, k++);
  };
  row.time = 1e-3 * static_cast<double>(t + 1);
  fill(row.node_position);
  fill(row.node_rotation);
  fill(row.node_velocity);
  fill(row.node_angular_velocity);
  fill(row.node_acceleration);
  fill(row.node_angular_acceleration);
  fill(row.frame_position);
  fill(row.frame_rotation);
  for (Eigen::Matrix3Xd* block :
       {&row.frame_acceleration, &row.frame_angular_velocity, &row.frame_angular_acceleration})
    fill(*block);
  fill(row.y);
  fill(row.y_rate);
  fill(row.y_strain);
  fill(row.load_factor);
  fill(row.boundary_force);
  fill(row.w);
  fill(row.w_rate);
  for (Eigen::Matrix3Xd* block :
       {&row.modal.acceleration, &row.modal.angular_velocity, &row.modal.angular_acceleration})
    fill(*block);
  fill(row.modal.node_force);
  fill(row.joint_force);
  fill(row.joint_moment);
  fill(row.joint_coordinate);
  fill(row.joint_rate);
  fill(row.coupling_first_force);
  fill(row.coupling_second_force);
  fill(row.motion_force);
  fill(row.spring_force);
  fill(row.stop_force);
  fill(row.bushing_force);
  fill(row.bushing_moment);
  fill(row.friction_force);
  fill(row.friction_moment);
  for (Eigen::Matrix3Xd* block : {&row.tyre_force, &row.tyre_moment, &row.tyre_contact, &row.tyre_normal}) fill(*block);
  for (Eigen::VectorXd* block : {&row.tyre_slip, &row.tyre_slip_angle, &row.tyre_camber, &row.tyre_penetration,
                                 &row.tyre_rolling_radius, &row.tyre_adhesion})
    fill(*block);
  for (Eigen::Matrix2Xd* block : {&row.tyre_deflection, &row.tyre_deflection_rate}) fill(*block);
  fill(row.quantity);
  for (double* value : {&row.kinetic, &row.strain, &row.potential, &row.work, &row.dissipated, &row.total, &row.balance,
                        &row.step, &row.iterations, &row.residual, &row.constraint})
    *value = row_value(t, k++);
  if (row.joint_coordinate.size() > 1) row.joint_coordinate[1] = std::numeric_limits<double>::quiet_NaN();
}

void write_rows(const std::string& path, const formats::ResultsLayout& layout, int rows) {
  formats::ResultsWriter writer(path, layout);
  formats::ResultsRow row;
  row.resize(layout);
  for (int t = 0; t < rows; ++t) {
    fill_row(t, row);
    writer.append(row);
  }
  writer.finish(true, "", R"({"steps": 3})");
}

}  // namespace tisserand::test_support
