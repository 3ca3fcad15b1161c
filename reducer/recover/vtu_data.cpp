// SPDX-License-Identifier: GPL-3.0-or-later
// Values on all cells and points, zero for kinds without them.
#include "reducer/recover/vtu_data.hpp"

#include <utility>

namespace tisserand::reducer {

using Eigen::Index;
using formats::Recovery;
using formats::VtuArray;

namespace {

/// Values of one kind of elements, whose cells are contiguous.
struct KindField {
  const Eigen::MatrixXf& all;  ///< rows per element x instants
  int rows = 0;
  int first_cell = 0;
};

}  // namespace

std::vector<VtuArray> vtu_cell_data(const Recovery& r, const RecoveredFields& fields, const InstantValues& values,
                                    Index instant) {
  const auto cells = static_cast<std::size_t>(r.elements.count());
  VtuArray group{"group", 1, {r.elements.group.begin(), r.elements.group.end()}};
  std::vector<VtuArray> data{{"von_mises", 1, values.von_mises}, group};
  /// Adds rows [from, from + width) of each element; other kinds get zero.
  const auto add = [&](const char* name, const KindField& field, int from, int width) {
    VtuArray array{name, width, std::vector<float>(cells * static_cast<std::size_t>(width))};
    for (Index item = 0; item < field.all.rows() / field.rows; ++item)
      for (Index k = 0; k < width; ++k)
        array.values[(field.first_cell + item) * width + k] = field.all(item * field.rows + from + k, instant);
    data.push_back(std::move(array));
  };
  if (r.shells() > 0) {
    const KindField von_mises{fields.shell_von_mises, 2, r.beams()}, stress{fields.shell_stress, 6, r.beams()};
    add("von_mises_top", von_mises, 0, 1);
    add("von_mises_bottom", von_mises, 1, 1);
    add("shell_membrane", stress, 0, 3);
    add("shell_bending", stress, 3, 3);
  }
  if (r.beams() > 0) {
    const KindField force{fields.beam_force, 12, 0};
    add("beam_stress", {fields.beam_stress, 1, 0}, 0, 1);
    add("beam_force_1", force, 0, 3);
    add("beam_moment_1", force, 3, 3);
    add("beam_force_2", force, 6, 3);
    add("beam_moment_2", force, 9, 3);
  }
  return data;
}

std::vector<VtuArray> vtu_point_data(const Recovery& r, const RecoveredFields& fields, const InstantValues& values,
                                     const Eigen::Matrix3d& axes, Index instant) {
  const Eigen::Map<const Eigen::Matrix3Xf> local(fields.displacement.col(instant).data(), 3, r.nodes());
  const Eigen::Matrix3Xf u = axes.cast<float>() * local;
  std::vector<VtuArray> data{{"displacement", 3, {u.data(), u.data() + u.size()}}};
  if (r.stress_points() > 0) {
    data.push_back({"solid_von_mises", 1, values.solid_von_mises});
    data.push_back({"solid_stress", 6, values.solid_stress});
  }
  return data;
}

}  // namespace tisserand::reducer
