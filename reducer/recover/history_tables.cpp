// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of histories from the rows of fields.
#include "reducer/recover/history_tables.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/text.hpp"
#include "reducer/recover/envelope.hpp"
#include "reducer/recover/places.hpp"

namespace tisserand::reducer {

using Eigen::Index;
using formats::Recovery;
using formats::RecoveryField;

namespace {

/// Name of a column with its unit, in quotes because labels contain commas.
std::string heading(const std::string& label, const std::string& quantity, const std::string& unit) {
  std::string name = printable_line(label, 60);
  std::replace(name.begin(), name.end(), '"', '\'');
  return fmt::format(",\"{}/{}{}\"", name, quantity, unit.empty() ? "" : " [" + unit + "]");
}

std::string stress_unit(const BodyMotion& still) { return unit_label(still.scene_units, -1, 1, -2); }

/// The first six rows of an item at an instant.
Eigen::Matrix<float, 6, 1> six_of(const Eigen::MatrixXf& rows, Index instant) { return rows.col(instant).head<6>(); }

bool is_node_of(const Recovery& r, int element, int node) {
  const auto begin = r.elements.node.begin();
  return std::find(begin + r.elements.first[element], begin + r.elements.first[element + 1], node) !=
         begin + r.elements.first[element + 1];
}

template <class Values>
std::string comma_cells(const Values& values) {
  std::string text;
  for (Index k = 0; k < values.size(); ++k) text += fmt::format(",{:.9g}", values[k]);
  return text;
}

}  // namespace

void KeptItems::take(const FieldBlock& block) {
  if (block.field != field_) return;
  const int width = formats::width(field_);
  for (auto item = rows_.lower_bound(block.first); item != rows_.end() && item->first < block.first + block.count;
       ++item)
    item->second = block.values.middleRows(static_cast<Index>(width) * (item->first - block.first), width);
}

NodeTable::NodeTable(const Recovery& r, const BodyMotion& still, RecoverFrame frame, std::vector<ChosenItem> nodes)
    : recovery_(r), still_(still), frame_(frame), nodes_(std::move(nodes)) {
  for (const ChosenItem& node : nodes_) {
    translation_.want(node.index);
    Around around;
    for (int e = 0; e < r.beams() + r.shells(); ++e)
      if (is_node_of(r, e, node.index)) (e < r.beams() ? around.beams : around.shells).push_back(e);
    for (int& shell : around.shells) shell -= r.beams();
    for (int p = 0; p < r.stress_points(); ++p)
      if (r.stress_node[p] == node.index) around.points.push_back(p);
    for (const int beam : around.beams) beam_.want(beam);
    for (const int shell : around.shells) shell_.want(shell);
    for (const int point : around.points) solid_.want(point);
    around_.push_back(std::move(around));
  }
}

std::string NodeTable::header() const {
  const std::string length = unit_label(still_.scene_units, 1, 0, 0);
  std::string text;
  for (const ChosenItem& node : nodes_) {
    for (const char* quantity : {"displacement_x", "displacement_y", "displacement_z", "x", "y", "z"})
      text += heading(node.label, quantity, length);
    text += heading(node.label, "stress", stress_unit(still_));
  }
  return text;
}

void NodeTable::take(const FieldBlock& block) {
  for (KeptItems* kept : {&translation_, &beam_, &shell_, &solid_}) kept->take(block);
}

float NodeTable::stress_at(const Around& around, const BodyMotion& motion, Index t) const {
  float stress = 0.0f;
  for (const int beam : around.beams)
    stress = std::max(
        stress,
        beam_measures(recovery_, beam, beam_.of(beam).col(t).head<12>(), motion.stress_factor()).von_mises.value);
  for (const int shell : around.shells)
    stress = std::max(stress, shell_measures(six_of(shell_.of(shell), t)).von_mises.value);
  for (const int point : around.points)
    stress = std::max(stress, solid_measures(six_of(solid_.of(point), t)).von_mises.value);
  return stress;
}

std::string NodeTable::cells(const BodyMotion& motion, Index t) const {
  const Eigen::Matrix3d axes = frame_axes(motion, frame_, t);
  std::string text;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const int node = nodes_[k].index;
    const Eigen::Matrix3Xd place = motion.to_scene.length * motion.mirror.cwiseProduct(recovery_.position.col(node));
    const Eigen::Vector3d u = axes * translation_.of(node).col(t).head<3>().cast<double>();
    const Eigen::Vector3d x = rest_positions(place, motion, frame_, t).col(0) + u;
    text += comma_cells(u) +
            fmt::format(",{:.12g},{:.12g},{:.12g},{:.9g}", x.x(), x.y(), x.z(), stress_at(around_[k], motion, t));
  }
  return text;
}

StressTable::StressTable(const Recovery& r, const BodyMotion& still, std::vector<ChosenItem> elements)
    : recovery_(r), still_(still), elements_(std::move(elements)) {
  const bool has_solids = std::any_of(elements_.begin(), elements_.end(),
                                      [&r](const ChosenItem& item) { return item.index >= r.beams() + r.shells(); });
  const SolidPoints points = has_solids ? solid_points(r) : SolidPoints{};
  for (const ChosenItem& item : elements_) {
    const int e = item.index;
    if (e < r.beams()) {
      beam_.want(e);
    } else if (e < r.beams() + r.shells()) {
      shell_.want(e - r.beams());
    } else {
      const auto begin = points.point.begin();
      std::vector<int>& own = points_[e];
      own.assign(begin + points.first[e], begin + points.first[e + 1]);
      for (const int point : own) solid_.want(point);
    }
  }
}

std::string StressTable::header() const {
  const std::string force = unit_label(still_.scene_units, 1, 1, -2), moment = unit_label(still_.scene_units, 2, 1, -2);
  const std::string stress = stress_unit(still_);
  std::string text;
  for (const ChosenItem& item : elements_) {
    const auto add = [&](const std::vector<const char*>& names, const std::string& unit, const char* ending) {
      for (const char* name : names) text += heading(item.label, std::string(name) + ending, unit);
    };
    if (item.index < recovery_.beams()) {
      for (const char* end : {"_1", "_2"}) {
        add({"N", "Vy", "Vz"}, force, end);
        add({"Mx", "My", "Mz"}, moment, end);
      }
      add({"largest_normal", "smallest_normal"}, stress, "");
    } else if (item.index < recovery_.beams() + recovery_.shells()) {
      add({"von_mises_top", "von_mises_bottom", "largest_principal", "smallest_principal", "membrane_xx", "membrane_yy",
           "membrane_xy", "bending_xx", "bending_yy", "bending_xy"},
          stress, "");
    } else {
      add({"von_mises", "largest_principal", "smallest_principal", "xx", "yy", "zz", "xy", "yz", "zx"}, stress, "");
    }
  }
  return text;
}

void StressTable::take(const FieldBlock& block) {
  for (KeptItems* kept : {&beam_, &shell_, &solid_}) kept->take(block);
}

std::string StressTable::beam_cells(int beam, const BodyMotion& motion, Index t) const {
  const Eigen::Matrix<float, 12, 1> raw = beam_.of(beam).col(t).head<12>();
  Eigen::Matrix<double, 12, 1> force = motion.to_scene.force() * raw.cast<double>();
  for (Index k = 0; k < 12; ++k)
    if (k % 6 >= 3) force[k] *= motion.to_scene.length;
  if (!has_stress(recovery_, beam)) return comma_cells(force) + ",,";
  const Measures measures = beam_measures(recovery_, beam, raw, motion.stress_factor());
  return comma_cells(force) + fmt::format(",{:.9g},{:.9g}", measures.largest.value, measures.smallest.value);
}

std::string StressTable::shell_cells(int shell, Index t) const {
  const Eigen::Matrix<float, 6, 1> s = six_of(shell_.of(shell), t);
  const Eigen::Vector3d membrane = s.head<3>().cast<double>(), bending = s.tail<3>().cast<double>();
  const Measures measures = shell_measures(s);
  return fmt::format(",{:.9g},{:.9g},{:.9g},{:.9g}", static_cast<float>(plane_von_mises(membrane + bending)),
                     static_cast<float>(plane_von_mises(membrane - bending)), measures.largest.value,
                     measures.smallest.value) +
         comma_cells(s);
}

std::string StressTable::solid_cells(int element, Index t) const {
  const std::vector<int>& points = points_.at(element);
  Eigen::Matrix<float, 6, 1> mean = Eigen::Matrix<float, 6, 1>::Zero();
  StressEnvelope worst(1);
  for (const int point : points) {
    const Eigen::Matrix<float, 6, 1> s = six_of(solid_.of(point), t);
    worst.take(0, solid_measures(s), 0);
    mean += s / static_cast<float>(points.size());
  }
  return fmt::format(",{:.9g},{:.9g},{:.9g}", worst.von_mises.value(0), worst.largest.value(0),
                     worst.smallest.value(0)) +
         comma_cells(mean);
}

std::string StressTable::cells(const BodyMotion& motion, Index t) const {
  std::string text;
  for (const ChosenItem& item : elements_) {
    const int shell = item.index - recovery_.beams();
    text += shell < 0                    ? beam_cells(item.index, motion, t)
            : shell < recovery_.shells() ? shell_cells(shell, t)
                                         : solid_cells(item.index, t);
  }
  return text;
}

GroupTable::GroupTable(const Recovery& r, const BodyMotion& still, std::vector<ChosenItem> groups)
    : recovery_(r), still_(still), groups_(std::move(groups)), row_(r.group_name.size(), -1) {
  for (const ChosenItem& item : groups_) row_[item.index] = static_cast<int>(&item - groups_.data());
}

std::string GroupTable::header() const {
  std::string text;
  for (const ChosenItem& item : groups_) {
    text += heading(item.label, "von_mises", stress_unit(still_)) + heading(item.label, "von_mises_at", "");
    for (const char* name : {"largest_principal", "smallest_principal"})
      text += heading(item.label, name, stress_unit(still_));
  }
  return text;
}

void GroupTable::begin(Index instants) {
  worst_.assign(groups_.size(), std::vector<Worst>(static_cast<std::size_t>(instants)));
}

void GroupTable::raise(int group, const FieldBlock& block, Index i) {
  const int row = row_[group], item = block.first + static_cast<int>(i);
  if (row < 0) return;
  for (Index t = 0; t < block.values.cols(); ++t) {
    const bool is_point = block.field == RecoveryField::solid_stress;
    const Measures found = is_point ? solid_measures(block.item<6>(i, t))
                           : block.field == RecoveryField::shell_stress
                               ? shell_measures(block.item<6>(i, t))
                               : beam_measures(recovery_, item, block.item<12>(i, t), still_.stress_factor());
    Worst& worst = worst_[row][t];
    const int at = block.field == RecoveryField::shell_stress ? recovery_.beams() + item : item;
    const bool first = worst.at < 0;
    worst.largest = first ? found.largest.value : std::max(worst.largest, found.largest.value);
    worst.smallest = first ? found.smallest.value : std::min(worst.smallest, found.smallest.value);
    if (first || found.von_mises.value > (1.0f + equal_by_symmetry) * worst.von_mises) {
      worst.von_mises = found.von_mises.value;
      worst.at = at;
      worst.is_point = is_point;
    }
  }
}

void GroupTable::take(const FieldBlock& block) {
  const Recovery& r = recovery_;
  for (Index i = 0; i < block.count; ++i) {
    const auto item = static_cast<std::size_t>(block.first + i);
    switch (block.field) {
      case RecoveryField::beam_force:
        if (has_stress(r, static_cast<int>(item))) raise(r.elements.group[item], block, i);
        break;
      case RecoveryField::shell_stress:
        raise(r.elements.group[static_cast<std::size_t>(r.beams()) + item], block, i);
        break;
      case RecoveryField::solid_stress:
        raise(r.stress_group[item], block, i);
        break;
      case RecoveryField::translation:
      case RecoveryField::rotation:
        break;
    }
  }
}

std::string GroupTable::cells(const BodyMotion& /*motion*/, Index t) const {
  std::string text;
  for (const std::vector<Worst>& over_time : worst_) {
    const Worst& worst = over_time[t];
    if (worst.at < 0) {
      text += ",,,,";
      continue;
    }
    const auto at = static_cast<std::size_t>(worst.at);
    const std::string place =
        worst.is_point ? recovery_.node_label[recovery_.stress_node[at]] : element_text(recovery_, worst.at);
    std::string quoted = printable_line(place, 80);
    std::replace(quoted.begin(), quoted.end(), '"', '\'');
    text += fmt::format(",{:.9g},\"{}\",{:.9g},{:.9g}", worst.von_mises, quoted, worst.largest, worst.smallest);
  }
  return text;
}

}  // namespace tisserand::reducer
