// Lines of CSV.
#include "reducer/recover/history.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

/// A column's name with its unit; in quotes, since labels hold commas.
std::string heading(const std::string& label, const char* quantity, const std::string& unit) {
  std::string name = printable_line(label, 60);
  std::replace(name.begin(), name.end(), '"', '\'');
  return fmt::format(",\"{}/{}{}\"", name, quantity, unit.empty() ? "" : " [" + unit + "]");
}

}  // namespace

Eigen::Matrix3d frame_axes(const BodyMotion& motion, RecoverFrame frame, Eigen::Index instant) {
  if (frame == RecoverFrame::part) return Eigen::Matrix3d::Identity();
  const Eigen::Vector4d q = motion.rotation.col(instant);
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
}

PointHistory::PointHistory(const formats::Recovery& r, const BodyMotion& motion, const RecoverRequest& request) {
  if (request.points.empty()) return;
  const std::string length = unit_label(motion.scene_units, 1, 0, 0), time = unit_label(motion.scene_units, 0, 0, 1);
  const std::string stress = unit_label(motion.scene_units, -1, 1, -2);
  text_ = time.empty() ? "time" : "\"time [" + time + "]\"";
  for (const std::string& point : request.points) {
    const int node = find_node(r, point, request.recovery);
    nodes_.push_back(node);
    for (const char* quantity : {"displacement_x", "displacement_y", "displacement_z", "x", "y", "z"})
      text_ += heading(point, quantity, length);
    text_ += heading(point, "stress", stress);
    around_.emplace_back();
    for (int e = 0; e < r.elements.count(); ++e) {
      const auto first = r.elements.node.begin() + r.elements.first[static_cast<std::size_t>(e)];
      const auto last = r.elements.node.begin() + r.elements.first[static_cast<std::size_t>(e) + 1];
      // Solids have stresses at the node itself.
      if (e < r.beams() + r.shells() && std::find(first, last, node) != last) around_.back().push_back(e);
    }
  }
  text_ += '\n';
}

void PointHistory::add(const RecoveredFields& fields, const InstantValues& values, const Eigen::Matrix3Xd& rest,
                       const Eigen::Matrix3d& axes, Eigen::Index instant, double time) {
  if (empty()) return;
  text_ += fmt::format("{:.17g}", time);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Eigen::Index node = nodes_[k];
    const Eigen::Vector3d u = axes * fields.displacement.col(instant).segment<3>(3 * node).cast<double>();
    const Eigen::Vector3d x = rest.col(node) + u;
    float stress = values.solid_von_mises[static_cast<std::size_t>(node)];
    for (const int e : around_[k]) stress = std::max(stress, values.von_mises[static_cast<std::size_t>(e)]);
    text_ += fmt::format(",{:.9g},{:.9g},{:.9g},{:.12g},{:.12g},{:.12g},{:.9g}", u.x(), u.y(), u.z(), x.x(), x.y(),
                         x.z(), stress);
  }
  text_ += '\n';
}

}  // namespace tisserand::reducer
