// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of rows of results into named quantities, mapped to the original description.
#include "tests/support/crossings/history.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "mechanism/simulate.hpp"

namespace tisserand::test_support::crossings {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using formats::ResultsRow;
using formats::Scene;

namespace {

/// Stores one row of one quantity after the other.
struct Collector {
  History& history;
  Eigen::Index row, rows;

  void put(const std::string& name, Family family, const Eigen::VectorXd& values) const {
    Quantity& quantity = history.quantities[name];
    if (quantity.rows.size() == 0) quantity = {family, Eigen::MatrixXd::Zero(rows, values.size())};
    quantity.rows.row(row) = values.transpose();
  }
  void put(const std::string& name, Family family, double value) const {
    put(name, family, Eigen::VectorXd(Eigen::VectorXd::Constant(1, value)));
  }
};

/// Maps values of rows to the original description.
struct Reverse {
  const Similarity& s;
  double v, a;  ///< units of velocity and acceleration

  explicit Reverse(const Similarity& similarity)
      : s(similarity), v(s.length / s.time), a(s.length / (s.time * s.time)) {}
  Vector3d point(const Vector3d& p) const { return s.Q.transpose() * (p - s.shift) / s.length; }
  Vector3d vector(const Vector3d& x) const { return s.Q.transpose() * x; }
  Vector3d axial(const Vector3d& x) const { return s.sign() * (s.Q.transpose() * x); }
  Eigen::VectorXd rotation(const Eigen::Vector4d& wxyz) const {
    const Matrix3d R = Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).toRotationMatrix();
    const Matrix3d back = s.Q.transpose() * R * s.parts();
    return back.reshaped();
  }
  /// Force and moment of a joint or bushing, in axes of its marker a.
  Vector3d in_a(const Vector3d& f) const { return s.markers() * f; }
  Vector3d moment_in_a(const Vector3d& m) const { return s.sign() * (s.markers() * m); }
};

void put_nodes(const ResultsRow& row, const formats::ResultsLayout& layout, const Reverse& r, const Collector& to) {
  const Similarity& s = r.s;
  for (std::size_t i = 0; i < layout.nodes.size(); ++i) {
    const std::string& name = layout.nodes[i];
    to.put("nodes/position/" + name, Family::place, r.point(row.node_position.col(i)));
    to.put("nodes/rotation/" + name, Family::place, r.rotation(row.node_rotation.col(i)));
    to.put("nodes/velocity/" + name, Family::rate, r.vector(row.node_velocity.col(i)) / r.v);
    to.put("nodes/angular_velocity/" + name, Family::rate, r.axial(row.node_angular_velocity.col(i)) * s.time);
    to.put("nodes/acceleration/" + name, Family::acceleration, r.vector(row.node_acceleration.col(i)) / r.a);
    to.put("nodes/angular_acceleration/" + name, Family::acceleration,
           r.axial(row.node_angular_acceleration.col(i)) * (s.time * s.time));
  }
  for (std::size_t i = 0; i < layout.superelements.size(); ++i) {
    const std::string& name = layout.superelements[i];
    to.put("frame_position/" + name, Family::place, r.point(row.frame_position.col(i)));
    to.put("frame_rotation/" + name, Family::place, r.rotation(row.frame_rotation.col(i)));
    for (int b = layout.boundary_offset[i]; b < layout.boundary_offset[i + 1]; ++b) {
      const std::string end = name + "/" + std::to_string(b - layout.boundary_offset[i]);
      to.put("boundary_force/" + end, Family::force, r.vector(row.boundary_force.col(b).head<3>()) / s.force());
      to.put("boundary_moment/" + end, Family::force, r.axial(row.boundary_force.col(b).tail<3>()) / s.energy());
    }
  }
  const double modal = std::sqrt(s.mass) * s.length;
  if (row.w.size() > 0) {
    to.put("w", Family::place, row.w / modal);
    to.put("w_rate", Family::rate, row.w_rate * (s.time / modal));
  }
}

void put_joints(const ResultsRow& row, const formats::ResultsLayout& layout, const Scene& before, const Reverse& r,
                const Collector& to) {
  const Similarity& s = r.s;
  for (std::size_t i = 0; i < layout.joints.size(); ++i) {
    const std::string& name = layout.joints[i];
    const auto joint =
        std::find_if(before.joints.begin(), before.joints.end(), [&](const auto& j) { return j.name == name; });
    // A distance joint has no axes: its force on the ground is in world axes.
    const bool in_world = joint != before.joints.end() && joint->kind == formats::JointKind::distance;
    const Vector3d f = row.joint_force.col(i), m = row.joint_moment.col(i);
    to.put("joints/force/" + name, Family::force, (in_world ? r.vector(f) : r.in_a(f)) / s.force());
    to.put("joints/moment/" + name, Family::force, (in_world ? r.axial(m) : r.moment_in_a(m)) / s.energy());
  }
  for (std::size_t i = 0; i < layout.coordinates.size(); ++i) {
    const std::string& name = layout.coordinates[i].name;
    const double factor = coordinate_factor(before, name, s).whole();
    to.put("joints/coordinate/" + name, Family::place, row.joint_coordinate[i] / factor);
    to.put("joints/rate/" + name, Family::rate, row.joint_rate[i] / factor * s.time);
  }
  const auto along = [&](const std::string& coordinate) {
    const Factor f = coordinate_factor(before, coordinate, s);
    return f.sign * s.energy() / f.scale;
  };
  for (std::size_t i = 0; i < layout.couplings.size(); ++i) {
    const std::string& name = layout.couplings[i].name;
    const auto gear =
        std::find_if(before.gears.begin(), before.gears.end(), [&](const auto& g) { return g.name == name; });
    to.put("couplings/first_force/" + name, Family::force, row.coupling_first_force[i] / along(gear->first.name));
    to.put("couplings/second_force/" + name, Family::force, row.coupling_second_force[i] / along(gear->second.name));
  }
  for (std::size_t i = 0; i < layout.motions.size(); ++i) {
    const std::string& name = layout.motions[i].name;
    const auto motion =
        std::find_if(before.motions.begin(), before.motions.end(), [&](const auto& m) { return m.name == name; });
    to.put("motions/force/" + name, Family::force, row.motion_force[i] / along(motion->coordinate.name));
  }
}

void put_forces(const ResultsRow& row, const formats::ResultsLayout& layout, const Scene& before, const Reverse& r,
                const Collector& to) {
  const Similarity& s = r.s;
  const auto along = [&](const std::string& name) {
    const auto spring =
        std::find_if(before.springs.begin(), before.springs.end(), [&](const auto& one) { return one.name == name; });
    const Factor f = spring_factor(before, *spring, s);
    return f.sign * s.energy() / f.scale;
  };
  for (std::size_t i = 0; i < layout.springs.size(); ++i)
    to.put("forces/spring/" + layout.springs[i].name, Family::force,
           row.spring_force[i] / along(layout.springs[i].name));
  for (std::size_t i = 0; i < layout.stops.size(); ++i)
    to.put("forces/stop/" + layout.stops[i].name, Family::force, row.stop_force[i] / along(layout.stops[i].name));
  for (std::size_t i = 0; i < layout.bushings.size(); ++i) {
    const std::string& name = layout.bushings[i];
    to.put("forces/bushing_force/" + name, Family::force, r.in_a(row.bushing_force.col(i)) / s.force());
    to.put("forces/bushing_moment/" + name, Family::force, r.moment_in_a(row.bushing_moment.col(i)) / s.energy());
  }
  for (std::size_t i = 0; i < layout.frictions.size(); ++i) {
    const std::string& name = layout.frictions[i];
    to.put("forces/friction_force/" + name, Family::force, r.in_a(row.friction_force.col(i)) / s.force());
    to.put("forces/friction_moment/" + name, Family::force, r.moment_in_a(row.friction_moment.col(i)) / s.energy());
  }
  for (std::size_t i = 0; i < layout.loads.size(); ++i) {
    const std::string& name = layout.loads[i].name;
    const auto load =
        std::find_if(before.loads.begin(), before.loads.end(), [&](const auto& l) { return l.name == name; });
    const double unit = layout.loads[i].length ? s.force() : s.sign() * s.energy();
    Matrix3d back = s.parts();  // of load cases
    if (load != before.loads.end())
      back = load->axes == formats::LoadAxes::world ? Matrix3d(s.Q.transpose()) : body_axes_of(*load, s);
    to.put("forces/load/" + name, Family::force, back * row.load.col(i) / unit);
  }
}

void put_energy(const ResultsRow& row, const ResultsRow& first, const Similarity& s, const Collector& to) {
  const double unit = s.energy();
  to.put("energy/kinetic", Family::energy, row.kinetic / unit);
  to.put("energy/strain", Family::energy, row.strain / unit);
  to.put("energy/work", Family::energy, row.work / unit);
  to.put("energy/dissipated", Family::energy, row.dissipated / unit);
  // Only differences of potential energy mean something, because its zero is at the origin of the world.
  to.put("energy/potential", Family::energy, (row.potential - first.potential) / unit);
  to.put("energy/total", Family::energy, (row.total - first.total) / unit);
}

/// Size of a family, at least 1 in SI units: what the weights of the scenes, some 5 N, cause in a second.
double size_of(const History& history, Family family) {
  double size = 1.0;
  if (family == Family::place) return size;
  for (const auto& [name, quantity] : history.quantities) {
    if (quantity.family != family) continue;
    for (const double value : quantity.rows.reshaped())
      if (std::isfinite(value)) size = std::max(size, std::abs(value));
  }
  return size;
}

std::string without_numbers(const std::string& text) {
  static const std::regex number(R"([-+]?[0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?)");
  return std::regex_replace(text, number, "#");
}

}  // namespace

History HistoryListener::history() const {
  History history;
  const Reverse back(s_);
  const auto count = static_cast<Eigen::Index>(rows_.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    const ResultsRow& row = rows_[k];
    const Collector to{history, k, count};
    history.time.push_back((row.time - s_.delay) / s_.time);
    put_nodes(row, layout_, back, to);
    put_joints(row, layout_, before_, back, to);
    put_forces(row, layout_, before_, back, to);
    put_energy(row, rows_.front(), s_, to);
  }
  for (auto& [name, quantity] : history.quantities)  // what was the part frame is a node now
    if (name.starts_with("nodes/") && name.ends_with("/origin"))
      history.quantities[name.substr(0, name.rfind('/'))] = quantity;
  return history;
}

History History::every(int factor) const {
  History result;
  result.report = report;
  result.refusal = refusal;
  std::vector<Eigen::Index> chosen;
  for (std::size_t i = 0; i < time.size(); i += factor) {
    chosen.push_back(static_cast<Eigen::Index>(i));
    result.time.push_back(time[i]);
  }
  for (const auto& [name, quantity] : quantities)
    result.quantities[name] = {quantity.family, quantity.rows(chosen, Eigen::all)};
  return result;
}

History run_history(const Scene& scene, const Scene& before, const Similarity& similarity,
                    const mechanism::BodyFiles& files, const mechanism::State* begin,
                    std::optional<mechanism::State>* end) {
  HistoryListener listener(before, similarity);
  try {
    mechanism::RunRequest request{scene, files, std::nullopt, "", "", std::nullopt};
    if (begin != nullptr) request.begin = *begin;
    request.listener = &listener;
    formats::check(scene);
    mechanism::RunEnd done = mechanism::simulate(request, {});
    if (end != nullptr) *end = std::move(done.state);
    History history = listener.history();
    history.report = std::move(done.report);
    return history;
  } catch (const Error& error) {
    History history;
    history.refusal = error.what();
    return history;
  }
}

Difference compare_histories(const History& a, const History& b, const std::vector<Family>& families) {
  Difference worst;
  std::map<Family, double> sizes;
  for (const auto& [name, quantity] : a.quantities) {
    if (!families.empty() && std::find(families.begin(), families.end(), quantity.family) == families.end()) continue;
    if (!sizes.contains(quantity.family)) sizes[quantity.family] = size_of(a, quantity.family);
    const auto other = b.quantities.find(name);
    if (other == b.quantities.end() || other->second.rows.rows() != quantity.rows.rows() ||
        other->second.rows.cols() != quantity.rows.cols())
      return {std::numeric_limits<double>::infinity(), name + " (shape)"};
    for (Eigen::Index i = 0; i < quantity.rows.size(); ++i) {
      const double x = quantity.rows.reshaped()[i], y = other->second.rows.reshaped()[i];
      if (std::isnan(x) && std::isnan(y)) continue;
      const double difference = std::abs(x - y) / sizes[quantity.family];
      if (!(difference <= worst.largest)) worst = {std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference, name};
    }
  }
  return worst;
}

std::string disagreement(const History& a, const History& b, const Limits& limits) {
  if (without_numbers(a.refusal) != without_numbers(b.refusal))
    return fmt::format("refused: '{}' and '{}'\n", a.refusal, b.refusal);
  if (!a.refusal.empty()) return "";
  if (a.report.outcome != b.report.outcome)
    return fmt::format("outcomes {} ({}) and {} ({})\n", static_cast<int>(a.report.outcome), a.report.reason,
                       static_cast<int>(b.report.outcome), b.report.reason);
  std::string text;
  if (a.time.size() != b.time.size()) return fmt::format("{} rows and {}\n", a.time.size(), b.time.size());
  for (std::size_t i = 0; i < a.time.size(); ++i)
    if (!(std::abs(a.time[i] - b.time[i]) <= 1e-12)) text = fmt::format("times {} and {}\n", a.time[i], b.time[i]);
  for (const auto& [family, limit] :
       {std::pair{Family::place, limits.place}, std::pair{Family::rate, limits.rate},
        std::pair{Family::acceleration, limits.acceleration}, std::pair{Family::force, limits.force},
        std::pair{Family::energy, limits.energy}}) {
    if (std::isinf(limit)) continue;
    const Difference difference = compare_histories(a, b, {family});
    if (!(difference.largest <= limit))
      text += fmt::format("{} by {:.2e}, allowed {:.0e}\n", difference.of, difference.largest, limit);
  }
  return text;
}

}  // namespace tisserand::test_support::crossings
