// SPDX-License-Identifier: GPL-3.0-or-later
// Modes as small motions: x = x_0 + Re(shape e^(i phase)).
#include "mechanism/view/run_modes.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::FewModes;
using formats::Json;

std::vector<MatrixXd> shapes_of_nodes(const formats::ResultsReader& reader, const std::string& quantity) {
  std::vector<std::string> channels;
  for (const std::string& node : reader.layout().nodes)
    for (const char* axis : {"x", "y", "z"})
      for (const char* part : {"real", "imaginary"})
        channels.push_back("modes/" + quantity + "/" + node + "/" + axis + "/" + part);
  const MatrixXd all = reader.read_rows(channels, 0, reader.modes());
  std::vector<MatrixXd> shapes;
  for (std::size_t i = 0; i < reader.layout().nodes.size(); ++i)
    shapes.push_back(all.middleCols(6 * static_cast<Index>(i), 6));
  return shapes;
}

Json triple(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json numbers(const auto& row) {
  Json list = Json::array();
  for (const auto x : row) list.push_back(static_cast<double>(x));
  return list;
}

}  // namespace

ModesOfBodies::ModesOfBodies(const formats::ResultsReader& reader) {
  if (reader.modes() == 0) return;
  const MatrixXd values = reader.read_rows({"modes/frequency", "modes/damping_ratio"}, 0, reader.modes());
  frequency_ = values.col(0);
  damping_ = (values.col(1).array().abs() < 1e-9).select(0.0, values.col(1));  // round-off
  translation_ = shapes_of_nodes(reader, "translation");
  rotation_ = shapes_of_nodes(reader, "rotation");
  bodies_.assign(reader.modes(), Json::array());
  std::vector<std::string> coordinates;
  for (const formats::Channel& channel : reader.channels())
    if (channel.name.starts_with("modes/y/")) coordinates.push_back(channel.name);
  if (!coordinates.empty()) y_ = reader.read_rows(coordinates, 0, reader.modes());
}

ModesOfBodies::Small ModesOfBodies::motion_of(int node, Index mode, int part) const {
  Small small;
  for (Index k = 0; k < 3; ++k) {
    small.translation[k] = translation_[node](mode, 2 * k + part);
    small.rotation[k] = rotation_[node](mode, 2 * k + part);
  }
  return small;
}

ModesOfBodies::Small ModesOfBodies::frame_motion(const ViewedRun& run, int body, Index mode, int part) const {
  const ViewedBody& viewed = run.bodies[body];
  for (const int node : viewed.nodes) {
    Small small = motion_of(node, mode, part);
    if (!run.nodes[node].has_rotation() || !small.translation.allFinite() || !small.rotation.allFinite()) continue;
    const Vector3d arm = (viewed.frame.position.row(0) - run.nodes[node].position.row(0)).transpose();
    small.translation += small.rotation.cross(arm);
    return small;
  }
  for (const int node : viewed.nodes)
    if (const Small small = motion_of(node, mode, part); small.translation.allFinite())
      return {small.translation, Vector3d::Zero()};
  return {};
}

ModesOfBodies::Small ModesOfBodies::relative_motion(const ViewedRun& run, int body, int node, Index mode,
                                                    int part) const {
  const ViewedBody& viewed = run.bodies[body];
  const Small frame = frame_motion(run, body, mode, part);
  Small small = motion_of(node, mode, part);
  if (!small.rotation.allFinite()) small.rotation = frame.rotation;
  const Vector3d arm = (run.nodes[node].position.row(0) - viewed.frame.position.row(0)).transpose();
  const Eigen::Quaterniond back = viewed.frame.turn(0).conjugate();
  return {back * (small.translation - frame.translation - frame.rotation.cross(arm)),
          back * (small.rotation - frame.rotation)};
}

/// Motions of the stations: displacements, and changes of the axes of sections.
Eigen::VectorXd ModesOfBodies::stations_motion(const ViewedRun& run, int body, const BodyShape& shape, Index mode,
                                               int part) const {
  const Index count = static_cast<Index>(shape.stations.size()), width = shape.deformation.modes.cols() / count;
  Eigen::VectorXd motion(shape.deformation.modes.cols());
  for (Index i = 0; i < count; ++i) {
    const int node = shape.stations[i];
    const Small small = relative_motion(run, body, node, mode, part);
    motion.segment<3>(width * i) = small.translation;
    if (width == 3) continue;
    const Matrix3d E = (run.bodies[body].frame.turn(0).conjugate() * run.nodes[node].turn(0)).toRotationMatrix();
    for (Index k = 1; k < 3; ++k)
      motion.segment<3>(width * i + 3 * k) = small.rotation.cross(E * shape.station_axes[i].col(k));
  }
  return motion;
}

/// Motions of the coordinates: boundary rows relative to the frame chosen here, internal ones as stored.
Eigen::VectorXd ModesOfBodies::coordinates_motion(const ViewedRun& run, int body, const BodyShape& shape, Index mode,
                                                  int part) const {
  const int first = run.layout().modes_offset[run.bodies[body].superelement];
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(shape.deformation.modes.cols());
  for (Index k = 0; k < motion.size(); ++k) {
    const int node = shape.coordinate_node[k], component = shape.coordinate_component[k];
    if (node == BodyShape::beyond) continue;
    if (node < 0) {
      if (y_.cols() > 0) motion[k] = y_(mode, 2 * (first + k) + part);
      continue;
    }
    const Small small = relative_motion(run, body, node, mode, part);
    motion[k] = component < 3 ? small.translation[component] : small.rotation[component - 3];
  }
  return motion;
}

void ModesOfBodies::take(const ViewedRun& run, int body, BodyShape& shape) {
  const Index modes = frequency_.size(), rows = shape.deformation.amplitudes.rows();
  const bool deforms = shape.deformation.modes.cols() > 0 && modes > 0;
  if (deforms) shape.deformation.amplitudes.conservativeResize(rows + 2 * modes, Eigen::NoChange);
  for (Index mode = 0; mode < modes; ++mode) {
    for (int part = 0; deforms && part < 2; ++part)
      shape.deformation.amplitudes.row(rows + 2 * mode + part) =
          (shape.stations.empty() ? coordinates_motion(run, body, shape, mode, part)
                                  : stations_motion(run, body, shape, mode, part))
              .transpose();
    const Small real = frame_motion(run, body, mode, 0), imaginary = frame_motion(run, body, mode, 1);
    bodies_[mode].push_back({{"body", body},
                             {"translation", {triple(real.translation), triple(imaginary.translation)}},
                             {"rotation", {triple(real.rotation), triple(imaginary.rotation)}},
                             {"amplitudes", nullptr}});
  }
}

void ModesOfBodies::reduce(int body, const FewModes& few, Index instants) {
  for (std::size_t mode = 0; mode < bodies_.size(); ++mode) {
    const Index row = instants + 2 * static_cast<Index>(mode);
    if (few.count() == 0 || row + 1 >= few.amplitudes.rows()) continue;
    Json& one = bodies_[mode].at(static_cast<std::size_t>(body));  // take() was called for each body in order
    one["amplitudes"] = {numbers(few.amplitudes.row(row)), numbers(few.amplitudes.row(row + 1))};
  }
}

Json ModesOfBodies::json() const {
  if (frequency_.size() == 0) return nullptr;
  Json list = Json::array();
  for (Index mode = 0; mode < frequency_.size(); ++mode)
    list.push_back({{"frequency", frequency_[mode]}, {"damping", damping_[mode]}, {"bodies", bodies_[mode]}});
  return list;
}

}  // namespace tisserand::mechanism
