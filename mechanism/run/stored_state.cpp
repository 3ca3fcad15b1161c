// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of a stored row to nodes, internal coordinates, frames and angles.
#include "mechanism/run/stored_state.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <Eigen/QR>

#include "common/error.hpp"
#include "formats/results/results.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// One row of a results file.
struct StoredRow {
  const formats::ResultsReader& reader;
  std::size_t row = 0;

  VectorXd read(const std::string& before, const std::vector<std::string>& columns) const {
    std::vector<std::string> names;
    for (const std::string& column : columns) names.push_back(before + column);
    try {
      return reader.read_rows(names, row, 1).transpose();
    } catch (const Error& error) {
      throw Error(
          error.what(), "",
          "to continue from an instant, the results need nodes, superelements and joints/coordinate in "
          "output.channels, and the scene must have the same effects as that of the file (flexible bodies, planar)");
    }
  }
  Vector3d vector(const std::string& dataset, const std::string& item) const {
    return read(dataset + "/" + item + "/", {"x", "y", "z"});
  }
  Eigen::Vector4d quaternion(const std::string& dataset, const std::string& item) const {
    return read(dataset + "/" + item + "/", {"w", "x", "y", "z"});
  }
  double sum(const std::string& channel) const {
    const auto& channels = reader.channels();
    const bool stored = std::ranges::any_of(channels, [&](const auto& c) { return c.name == channel; });
    return stored ? reader.read_rows({channel}, row, 1)(0, 0) : 0.0;
  }
};

std::size_t find_row(const formats::ResultsReader& reader, const std::string& file, const std::optional<double>& at) {
  const std::vector<double> time = reader.time();
  if (time.empty()) throw Error("holds no instant", file, "give a results file with rows");
  if (!at) return time.size() - 1;
  const auto nearest = std::ranges::min_element(time, {}, [&](double t) { return std::abs(t - *at); });
  const std::string unit = after_time(reader.layout().units);
  if (std::abs(*nearest - *at) > 1e-9 * std::max(1.0, std::abs(*at)))
    throw Error(fmt::format("holds no instant t = {:.12g}{}; the nearest is {:.12g}{}", *at, unit, *nearest, unit),
                file, "give a stored instant with --at");
  return static_cast<std::size_t>(nearest - time.begin());
}

/// Motion of a stored instant that a planar model would omit, and its largest values.
class LeftOut {
 public:
  explicit LeftOut(const Model& model) : model_(model) {}

  void node(const std::string& name, const Vector3d& velocity, const Vector3d& omega, double height) {
    fastest_ = std::max({fastest_, velocity.norm(), model_.length * omega.norm()});
    raise(speed_, name, std::max(std::abs(velocity.z()), model_.length * omega.head<2>().norm()));
    raise(height_, name, std::abs(height));
  }
  /// Registers a length and a velocity besides those of the nodes.
  void deflection(const std::string& name, double size) { raise(height_, name, size); }
  void rate(const std::string& name, double size) {
    fastest_ = std::max(fastest_, size);
    raise(speed_, name, size);
  }

  void require_nothing(const std::string& file) const {
    const auto require = [&file](const Largest& one, const char* what, double size, const char* beside) {
      if (one.size <= share * size) return;  // false for not-a-number
      throw Error(fmt::format("holds a motion out of the plane of the scene: {} of '{}' is {:.3g} along the normal, "
                              "compared with {} of {:.3g}",
                              what, one.name, one.size, beside, size),
                  file, "continue without planar: on");
    };
    // At rest, velocities are round-off: within a step they move less than this fraction of the scene's size.
    constexpr double rest = 1e-12;
    if (!(speed_.size * model_.motion_spacing <= rest * model_.length))
      require(speed_, "the velocity", fastest_, "a largest velocity");
    require(height_, "the displacement", model_.length, "a size of the scene");
  }

 private:
  static constexpr double share = 1e-6;  // above the drift of runs in space
  struct Largest {
    double size = 0.0;
    std::string name;
  };
  /// A not-a-number stays the largest.
  static void raise(Largest& largest, const std::string& name, double size) {
    if (!(size <= largest.size) && !std::isnan(largest.size)) largest = {size, name};
  }
  const Model& model_;
  double fastest_ = 0.0;
  Largest speed_, height_;
};

/// Rotation about z that equals R up to round-off.
Eigen::Quaterniond turn_in_plane(const Eigen::Quaterniond& R) {
  return Eigen::Quaterniond(R.w(), 0.0, 0.0, R.z()).normalized();
}

void read_nodes(const Model& model, const StoredRow& stored, State& state, LeftOut& left_out) {
  std::vector<bool> done(model.nodes.size(), false);
  for (const Place& place : model.places) {
    const auto i = static_cast<std::size_t>(place.marker.node);
    if (done[i]) continue;
    done[i] = true;
    const Node& node = model.nodes[i];
    const auto column = static_cast<Eigen::Index>(i);
    Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
    Vector3d omega = Vector3d::Zero();
    if (node.rotation >= 0) {
      R = quaternion(stored.quaternion("nodes/rotation", place.name)).normalized() *
          Eigen::Quaterniond(place.marker.R).conjugate();
      if (model.planar) R = turn_in_plane(Eigen::Quaterniond(model.axes).conjugate() * R);
      omega = to_axes(model, stored.vector("nodes/angular_velocity", place.name));
      state.Q().col(column) = wxyz(R);
      set_rotation(model, R.conjugate() * omega, node.rotation, state.v());
    }
    if (node.translation < 0) continue;
    const Vector3d arm = R * place.marker.p;
    const double start = state.x()(2, column);
    state.x().col(column) = to_axes(model, stored.vector("nodes/position", place.name) - model.origin) - arm;
    const Vector3d velocity = to_axes(model, stored.vector("nodes/velocity", place.name)) - omega.cross(arm);
    left_out.node(place.name, velocity, omega, state.x()(2, column) - start);
    set_translation(model, velocity, node.translation, state.v());
  }
}

/// Canonical internal coordinates from those of the file: those of the body, then those of its omitted modes.
VectorXd canonical(const SuperelementBody& body, const VectorXd& file) {
  VectorXd boundary(static_cast<Eigen::Index>(body.file.boundary_row.size())),
      internal(static_cast<Eigen::Index>(body.file.internal_row.size()));
  for (std::size_t i = 0; i < body.file.boundary_row.size(); ++i) boundary[i] = file[body.file.boundary_row[i]];
  for (std::size_t k = 0; k < body.file.internal_row.size(); ++k) internal[k] = file[body.file.internal_row[k]];
  if (body.planar) boundary = (body.file.lift.transpose() * boundary).eval();
  Eigen::MatrixXd Q(internal.size(), body.file.modal_part.cols() + body.file.left_out.cols());
  Q.leftCols(body.file.modal_part.cols()) = body.file.modal_part;
  if (body.planar) Q.rightCols(body.file.left_out.cols()) = body.file.left_out;
  return Q.colPivHouseholderQr().solve(internal - body.file.static_part * boundary);
}

void read_superelements(const Model& model, const StoredRow& stored, State& state, LeftOut& left_out) {
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const std::string& name = model.superelements[i].name;
    state.frames().col(i) = stored.quaternion("superelements/frame_rotation", name);
    if (model.planar) {
      const Eigen::Quaterniond R = quaternion(state.frames().col(i));
      state.frames().col(i) =
          wxyz(turn_in_plane(Eigen::Quaterniond(model.axes).conjugate() * R * Eigen::Quaterniond(body.axes)));
    }
    const Eigen::Index others = body.file.left_out.cols();
    if (body.modes + others == 0) continue;
    std::vector<std::string> columns;
    for (Eigen::Index k = 0; k < file_coordinate_count(body); ++k) columns.push_back(fmt::format("{}", k));
    const int at = model.internal_offset[i];
    const VectorXd eta = canonical(body, stored.read("superelements/y/" + name + "/", columns)),
                   rate = canonical(body, stored.read("superelements/y_rate/" + name + "/", columns));
    state.y().segment(at, body.modes) = eta.head(body.modes);
    state.v().segment(model.sizes.boundary + at, body.modes) = rate.head(body.modes);
    if (others == 0) continue;
    left_out.deflection(name, eta.tail(others).cwiseAbs().maxCoeff() / std::sqrt(body.mass));
    left_out.rate(name, rate.tail(others).cwiseAbs().maxCoeff() / std::sqrt(body.mass));
  }
}

void read_modal_bodies(const Model& model, const StoredRow& stored, State& state, LeftOut& left_out) {
  for (const ModalBody& body : model.modal_bodies) {
    if (body.modes_in_space() == 0) continue;
    std::vector<std::string> columns;
    for (int k = 0; k < body.modes_in_space(); ++k) columns.push_back(fmt::format("{}", k));
    const auto own = [&](const std::string& dataset, bool rates) -> VectorXd {
      VectorXd w = stored.read(dataset + body.name + "/", columns);
      if (!body.planar) return w;
      const VectorXd in_plane = body.lift.transpose() * w;
      const double out = (w - body.lift * in_plane).cwiseAbs().maxCoeff() / std::sqrt(body.mass);
      rates ? left_out.rate(body.name, out) : left_out.deflection(body.name, out);
      return in_plane;
    };
    state.w().segment(body.offset, body.modes) = own("modal_bodies/w/", false);
    state.v().segment(model.sizes.first_modal() + body.offset, body.modes) = own("modal_bodies/w_rate/", true);
  }
}

void read_treads(const Model& model, const StoredRow& stored, State& state, LeftOut& left_out) {
  for (const Tyre& tyre : model.tyres) {
    if (!tyre.relaxes()) continue;
    const std::vector<std::string> columns{tyre.name + "/x", tyre.name + "/y"};
    state.w().segment<2>(tyre.lag) = stored.read("tyres/deflection/", columns);
    left_out.deflection(tyre.name, std::abs(state.w()[tyre.lag + 1]));
    state.v().segment<2>(model.sizes.first_modal() + tyre.lag) = stored.read("tyres/deflection_rate/", columns);
  }
}

}  // namespace

StoredSums read_stored_state(const Model& model, const std::string& file, const std::optional<double>& at, State& state,
                             Workspace& workspace) {
  const formats::ResultsReader reader(file);
  const StoredRow stored{reader, find_row(reader, file, at)};
  LeftOut left_out(model);
  read_nodes(model, stored, state, left_out);
  read_superelements(model, stored, state, left_out);
  read_modal_bodies(model, stored, state, left_out);
  read_treads(model, stored, state, left_out);
  if (model.planar) left_out.require_nothing(file);
  for (const Coordinate& coordinate : model.coordinates)
    if (coordinate.turn >= 0) state.hinges()[coordinate.turn] = stored.read("joints/coordinate/", {coordinate.name})[0];
  state.time() = state.load_time() = stored.reader.read_rows({"time"}, stored.row, 1)(0, 0);
  state.vdot().setZero();
  state.lambda().setZero();
  if (!state.x().allFinite() || !state.Q().allFinite() || !state.v().allFinite() || !state.y().allFinite() ||
      !state.w().allFinite())
    throw Error(fmt::format("the instant t = {:.9g}{} contains values that are not numbers", state.time(),
                            after_time(model.units)),
                file, "continue from a dynamic or static analysis");
  workspace.forget();
  StoredSums sums;
  sums.work = stored.sum("energy/work");
  sums.dissipated = stored.sum("energy/dissipated");
  sums.initial_energy = stored.sum("energy/total") - sums.work + sums.dissipated - stored.sum("energy/balance");
  if (!std::isfinite(sums.initial_energy)) sums = {};
  sums.row = stored.row;
  return sums;
}

}  // namespace tisserand::mechanism
