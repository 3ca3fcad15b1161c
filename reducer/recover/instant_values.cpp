// SPDX-License-Identifier: GPL-3.0-or-later
// Values at one instant, and their maxima.
#include "reducer/recover/instant_values.hpp"

#include <algorithm>

namespace tisserand::reducer {
namespace {

LargestAt largest_of(const std::vector<float>& values, int first, int end) {
  LargestAt largest;
  for (int i = first; i < end; ++i)
    if (const float value = values[i]; largest.at < 0 || value > (1.0f + equal_by_symmetry) * largest.value)
      largest = {value, i};
  return largest;
}

}  // namespace

InstantValues instant_values(const formats::Recovery& r, const SolidPoints& points, const RecoveredFields& fields,
                             Eigen::Index t) {
  const auto nodes = static_cast<std::size_t>(r.nodes());
  InstantValues values;
  for (Eigen::Index n = 0; n < r.nodes(); ++n)
    values.displacement.push_back(fields.displacement.col(t).segment<3>(3 * n).norm());
  values.solid_von_mises.assign(nodes, 0.0f);
  values.solid_stress.assign(6 * nodes, 0.0f);
  for (std::size_t p = 0; p < r.stress_node.size(); ++p) {
    const auto node = static_cast<std::size_t>(r.stress_node[p]);
    const float found = fields.solid_von_mises(static_cast<Eigen::Index>(p), t);
    if (found < values.solid_von_mises[node]) continue;
    values.solid_von_mises[node] = found;
    for (std::size_t k = 0; k < 6; ++k)
      values.solid_stress[6 * node + k] = fields.solid_stress(static_cast<Eigen::Index>(6 * p + k), t);
  }
  for (int e = 0; e < r.elements.count(); ++e) {
    float value = 0.0f;
    if (e < r.beams()) {
      value = fields.beam_stress(e, t);
    } else if (const Eigen::Index s = e - r.beams(); s < r.shells()) {
      value = std::max(fields.shell_von_mises(2 * s, t), fields.shell_von_mises(2 * s + 1, t));
    } else {
      for (int k = points.first[e]; k < points.first[e + 1]; ++k)
        value = std::max(value, fields.solid_von_mises(points.point[k], t));
    }
    values.von_mises.push_back(value);
  }
  return values;
}

InstantPeaks instant_peaks(const formats::Recovery& r, const InstantValues& values) {
  InstantPeaks peaks;
  peaks.beam = largest_of(values.von_mises, 0, r.beams());
  peaks.shell = largest_of(values.von_mises, r.beams(), r.beams() + r.shells());
  if (r.stress_points() > 0) peaks.solid = largest_of(values.solid_von_mises, 0, r.nodes());
  return peaks;
}

}  // namespace tisserand::reducer
