// SPDX-License-Identifier: GPL-3.0-or-later
// Files of the tables over time.
#include "reducer/recover/histories.hpp"

#include <Eigen/Geometry>

#include <fmt/format.h>

namespace tisserand::reducer {

Eigen::Matrix3d frame_axes(const BodyMotion& motion, RecoverFrame frame, Eigen::Index instant) {
  if (frame == RecoverFrame::part) return Eigen::Matrix3d::Identity();
  const Eigen::Vector4d q = motion.rotation.col(instant);
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

Eigen::Matrix3Xd rest_positions(const Eigen::Matrix3Xd& places, const BodyMotion& motion, RecoverFrame frame,
                                Eigen::Index instant) {
  if (frame == RecoverFrame::part) return places;
  const Eigen::Matrix3Xd turned = frame_axes(motion, frame, instant) * (places.colwise() - motion.origin);
  return turned.colwise() + motion.position.col(instant);
}

Histories::Histories(ChosenHistories chosen, const BodyMotion& still, const std::string& stem)
    : chosen_(std::move(chosen)) {
  const std::string time = unit_label(still.scene_units, 0, 0, 1);
  for (std::size_t k = 0; k < chosen_.tables.size(); ++k) {
    paths_.push_back(stem + '_' + chosen_.endings[k] + ".csv");
    files_.push_back(std::make_unique<TextFile>(paths_.back()));
    files_.back()->write((time.empty() ? "time" : "\"time [" + time + "]\"") + chosen_.tables[k]->header() + '\n');
  }
}

void Histories::begin(Eigen::Index instants) {
  for (const auto& table : chosen_.tables) table->begin(instants);
}

void Histories::take(const FieldBlock& block) {
  for (const auto& table : chosen_.tables) table->take(block);
}

void Histories::end(const BodyMotion& motion) {
  for (std::size_t k = 0; k < files_.size(); ++k) {
    std::string text;
    for (Eigen::Index t = 0; t < motion.instants(); ++t)
      text += fmt::format("{:.17g}", motion.time[t]) + chosen_.tables[k]->cells(motion, t) + '\n';
    files_[k]->write(text);
  }
}

std::vector<std::string> Histories::publish() {
  for (const auto& file : files_) file->publish();
  return paths_;
}

}  // namespace tisserand::reducer
