// Values on all cells and points, zero where a kind has none.
#include "reducer/recover/vtu_data.hpp"

namespace tisserand::reducer {

using Eigen::Index;
using formats::Recovery;
using formats::VtuArray;

namespace {

/// Rows [from, from + width) of every `stride` rows, one set per element of a kind, on all cells: zero for others.
VtuArray on_cells(const std::string& name, const Eigen::MatrixXf& all, Index instant, int stride, int from, int width,
                  int first_cell, int cells) {
  VtuArray array{name, width, std::vector<float>(static_cast<std::size_t>(cells) * static_cast<std::size_t>(width))};
  for (Index item = 0; item < all.rows() / stride; ++item)
    for (Index k = 0; k < width; ++k)
      array.values[(first_cell + item) * width + k] = all(item * stride + from + k, instant);
  return array;
}

}  // namespace

std::vector<VtuArray> vtu_cell_data(const Recovery& r, const RecoveredFields& fields, const InstantValues& values,
                                    Index instant) {
  const int cells = r.elements.count();
  VtuArray group{"group", 1, {r.elements.group.begin(), r.elements.group.end()}};
  std::vector<VtuArray> data{{"von_mises", 1, values.von_mises}, group};
  const auto add = [&](const char* name, const Eigen::MatrixXf& all, int stride, int from, int width, int first_cell) {
    data.push_back(on_cells(name, all, instant, stride, from, width, first_cell, cells));
  };
  if (r.shells() > 0) {
    add("von_mises_top", fields.shell_von_mises, 2, 0, 1, r.beams());
    add("von_mises_bottom", fields.shell_von_mises, 2, 1, 1, r.beams());
    add("shell_membrane", fields.shell_stress, 6, 0, 3, r.beams());
    add("shell_bending", fields.shell_stress, 6, 3, 3, r.beams());
  }
  if (r.beams() > 0) {
    add("beam_stress", fields.beam_stress, 1, 0, 1, 0);
    add("beam_force_1", fields.beam_force, 12, 0, 3, 0);
    add("beam_moment_1", fields.beam_force, 12, 3, 3, 0);
    add("beam_force_2", fields.beam_force, 12, 6, 3, 0);
    add("beam_moment_2", fields.beam_force, 12, 9, 3, 0);
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
