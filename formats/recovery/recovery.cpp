// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of the fields of a recovery file, its name, and its superelement.
#include "formats/recovery/recovery.hpp"

#include <algorithm>

#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/text.hpp"

namespace tisserand::formats {
namespace {
constexpr std::uint64_t field_chunk_bytes = 1u << 20;
}  // namespace

int node_count(ElementShape shape) {
  constexpr std::array<int, element_shapes> counts{2, 3, 4, 4, 10, 8, 20, 6, 15};
  return counts[static_cast<std::size_t>(shape)];
}

Eigen::Vector3d mirror_axes(int image) {
  const int bits = image + 1;
  return {(bits & 1) != 0 ? -1.0 : 1.0, (bits & 2) != 0 ? -1.0 : 1.0, (bits & 4) != 0 ? -1.0 : 1.0};
}

int width(RecoveryField field) {
  switch (field) {
    case RecoveryField::translation:
    case RecoveryField::rotation:
      return 3;
    case RecoveryField::beam_force:
      return 12;
    case RecoveryField::shell_stress:
    case RecoveryField::solid_stress:
      return 6;
  }
  TISSERAND_ENSURE(false, "recovery field {}", static_cast<int>(field));
}

int items(const Recovery& recovery, RecoveryField field) {
  switch (field) {
    case RecoveryField::translation:
    case RecoveryField::rotation:
      return recovery.nodes();
    case RecoveryField::beam_force:
      return recovery.beams();
    case RecoveryField::shell_stress:
      return recovery.shells();
    case RecoveryField::solid_stress:
      return recovery.stress_points();
  }
  TISSERAND_ENSURE(false, "recovery field {}", static_cast<int>(field));
}

int chunk_items(const Recovery& recovery, RecoveryField field) {
  const std::uint64_t bytes = sizeof(float) * static_cast<std::uint64_t>(width(field)) *
                              std::max<std::uint64_t>(static_cast<std::uint64_t>(recovery.coordinates()), 1);
  const std::uint64_t chunk = std::max<std::uint64_t>(field_chunk_bytes / bytes, 1);
  return static_cast<int>(
      std::clamp<std::uint64_t>(chunk, 1, static_cast<std::uint64_t>(std::max(items(recovery, field), 1))));
}

std::string recovery_path(const std::string& superelement_file) {
  return without_ending(superelement_file, {".superelement.h5", ".h5"}) + ".recovery.h5";
}

Eigen::Vector3d require_same_superelement(const Recovery& recovery, const std::string& content_id,
                                          const std::string& where, const std::string& body) {
  if (content_id == recovery.content_id) return Eigen::Vector3d::Ones();
  for (int image = 0; image < 7; ++image)
    if (content_id == recovery.mirror_content_id[static_cast<std::size_t>(image)]) return mirror_axes(image);
  throw Error(
      fmt::format("belongs to the superelement or modal body {}..., but body '{}' was simulated with {}...",
                  recovery.content_id.substr(0, 12), printable_line(body, 60),
                  printable_line(content_id.substr(0, 12), 12)),
      where,
      "give the recovery file of the part that was simulated, or simulate again with the part of this recovery file");
}

void to_part(const Recovery& recovery, const Eigen::Vector3d& mirror, double length, Eigen::MatrixXd& y) {
  for (Eigen::Index k = 0; k < y.rows(); ++k) {
    const int component = recovery.dof_component[static_cast<std::size_t>(k)];
    if (recovery.dof_node[static_cast<std::size_t>(k)] < 0) continue;
    const double sign = mirror[component % 3] * (component < 3 ? 1.0 : mirror.prod());
    y.row(k) *= component < 3 ? sign / length : sign;
  }
}

}  // namespace tisserand::formats
