// Small motions: x = x_0 + Re(shape e^(i phase)).
#include "mechanism/view/run_modes.hpp"


namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

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
  for (const double x : row) list.push_back(x);
  return list;
}

}  // namespace

ModesOfBodies::ModesOfBodies(const formats::ResultsReader& reader) {
  if (reader.modes() == 0) return;
  const MatrixXd values = reader.read_rows({"modes/frequency", "modes/damping_ratio"}, 0, reader.modes());
  frequency_ = values.col(0);
  damping_ = values.col(1);
  translation_ = shapes_of_nodes(reader, "translation");
  rotation_ = shapes_of_nodes(reader, "rotation");
  bodies_.assign(reader.modes(), Json::array());
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

void ModesOfBodies::take(const ViewedRun& run, int body, BodyShape& shape) {
  const ViewedBody& viewed = run.bodies[body];
  const Index modes = frequency_.size(), count = static_cast<Index>(shape.stations.size()),
              rows = shape.deformation.amplitudes.rows(),
              width = count > 0 ? shape.deformation.modes.cols() / count : 0;
  if (count > 0) {
    shape.deformation.amplitudes.conservativeResize(rows + 2 * modes, Eigen::NoChange);
    shape.deformation.amplitudes.bottomRows(2 * modes).setZero();
  }
  const Matrix3d back = viewed.frame.turn(0).conjugate().toRotationMatrix();
  for (Index mode = 0; mode < modes; ++mode) {
    const Small frames[2] = {frame_motion(run, body, mode, 0), frame_motion(run, body, mode, 1)};
    for (int part = 0; part < 2; ++part)
      for (Index i = 0; i < count; ++i) {
        const int node = shape.stations[i];
        const Small small = motion_of(node, mode, part), &frame = frames[part];
        if (!small.translation.allFinite()) continue;
        const Vector3d arm = (run.nodes[node].position.row(0) - viewed.frame.position.row(0)).transpose();
        auto y = shape.deformation.amplitudes.row(rows + 2 * mode + part).segment(width * i, width);
        y.head<3>() = back * (small.translation - frame.translation - frame.rotation.cross(arm));
        const Vector3d turn = back * (small.rotation - frame.rotation);
        for (Index k = 0; k < (width - 3) / 3; ++k) {
          const Matrix3d E = (viewed.frame.turn(0).conjugate() * run.nodes[node].turn(0)).toRotationMatrix();
          y.segment<3>(3 + 3 * k) = turn.cross(E * shape.station_axes[i].col(1 + k));
        }
      }
    bodies_[mode].push_back({{"body", body},
                             {"translation", {triple(frames[0].translation), triple(frames[1].translation)}},
                             {"rotation", {triple(frames[0].rotation), triple(frames[1].rotation)}},
                             {"amplitudes", nullptr}});
  }
}

void ModesOfBodies::reduce(int body, const FewModes& few, Index instants) {
  for (std::size_t mode = 0; mode < bodies_.size(); ++mode) {
    const Index row = instants + 2 * static_cast<Index>(mode);
    if (few.count() == 0 || row + 1 >= few.amplitudes.rows()) continue;
    for (Json& one : bodies_[mode])
      if (one["body"] == body)
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
