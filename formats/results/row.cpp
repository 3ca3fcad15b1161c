// The room that one instant takes, in memory and in the file.
#include <algorithm>

#include "formats/results/blocks.hpp"

namespace tisserand::formats {

void ResultsRow::resize(const ResultsLayout& layout) {
  const auto is_reaction = [](const Block& block) {
    return block.dataset == "/joints/force" || block.dataset == "/joints/moment" || block.dataset == "/motions/force" ||
           block.dataset == "/couplings/first_force" || block.dataset == "/couplings/second_force";
  };
  reactions = std::ranges::any_of(chosen_blocks(layout, layout.scene), is_reaction);
  const auto nodes = static_cast<Eigen::Index>(layout.nodes.size());
  const auto superelements = static_cast<Eigen::Index>(layout.superelements.size());
  const auto joints = static_cast<Eigen::Index>(layout.joints.size());
  const auto coordinates = static_cast<Eigen::Index>(layout.coordinates.size());
  const auto last = [](const std::vector<int>& offset) { return offset.empty() ? 0 : offset.back(); };
  for (Eigen::Matrix3Xd* block :
       {&node_position, &node_velocity, &node_angular_velocity, &node_acceleration, &node_angular_acceleration})
    block->setZero(3, nodes);
  const Eigen::Vector4d no_rotation(1, 0, 0, 0);
  node_rotation = no_rotation.replicate(1, nodes);
  frame_position.setZero(3, superelements);
  frame_rotation = no_rotation.replicate(1, superelements);
  y.setZero(last(layout.modes_offset));
  y_rate.setZero(last(layout.modes_offset));
  y_strain.setZero(layout.strained ? last(layout.modes_offset) : 0);
  for (Eigen::Matrix3Xd* block : {&frame_acceleration, &frame_angular_velocity, &frame_angular_acceleration})
    block->setZero(3, superelements);
  load_factor.setZero(static_cast<Eigen::Index>(layout.load_cases.size()));
  boundary_force.setZero(6, last(layout.boundary_offset));
  for (Eigen::Matrix3Xd* block : {&modal.acceleration, &modal.angular_velocity, &modal.angular_acceleration})
    block->setZero(3, static_cast<Eigen::Index>(layout.modal_bodies.size()));
  modal.node_force.setZero(6, static_cast<Eigen::Index>(layout.modal_nodes.size()));
  w.setZero(last(layout.modal_offset));
  w_rate.setZero(last(layout.modal_offset));
  joint_force.setZero(3, joints);
  joint_moment.setZero(3, joints);
  joint_coordinate.setZero(coordinates);
  joint_rate.setZero(coordinates);
  for (Eigen::VectorXd* block : {&coupling_first_force, &coupling_second_force})
    block->setZero(static_cast<Eigen::Index>(layout.couplings.size()));
  motion_force.setZero(static_cast<Eigen::Index>(layout.motions.size()));
  spring_force.setZero(static_cast<Eigen::Index>(layout.springs.size()));
  stop_force.setZero(static_cast<Eigen::Index>(layout.stops.size()));
  for (Eigen::Matrix3Xd* block : {&bushing_force, &bushing_moment})
    block->setZero(3, static_cast<Eigen::Index>(layout.bushings.size()));
  for (Eigen::Matrix3Xd* block : {&friction_force, &friction_moment})
    block->setZero(3, static_cast<Eigen::Index>(layout.frictions.size()));
  const auto tyres = static_cast<Eigen::Index>(layout.tyres.size());
  for (Eigen::Matrix3Xd* block : {&tyre_force, &tyre_moment, &tyre_contact, &tyre_normal}) block->setZero(3, tyres);
  for (Eigen::VectorXd* block :
       {&tyre_slip, &tyre_slip_angle, &tyre_camber, &tyre_penetration, &tyre_rolling_radius, &tyre_adhesion})
    block->setZero(tyres);
  for (Eigen::Matrix2Xd* block : {&tyre_deflection, &tyre_deflection_rate}) block->setZero(2, tyres);
  load.setZero(3, static_cast<Eigen::Index>(layout.loads.size()));
  quantity.setZero(static_cast<Eigen::Index>(layout.quantities.size()));
}

std::size_t bytes_of_row(const ResultsLayout& layout) {
  std::size_t width = 0;
  for (const Block& block : chosen_blocks(layout, layout.scene)) width += block.width();
  return width * sizeof(double);
}

}  // namespace tisserand::formats
