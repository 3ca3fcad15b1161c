// The story of recovery: results -> coordinates -> fields, batch by batch -> files and the largest values.
#include "reducer/recover/recover.hpp"

#include <algorithm>
#include <filesystem>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/vtk/vtu.hpp"
#include "reducer/recover/history.hpp"
#include "reducer/recover/inertia_loads.hpp"
#include "reducer/recover/vtu_data.hpp"

namespace tisserand::reducer {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using formats::Recovery;
using formats::VtuArray;
using formats::VtuCells;

constexpr double batch_bytes = 256e6;

/// Places of the nodes without deformation: in the part frame of the body, or carried by its floating frame.
Eigen::Matrix3Xd rest_positions(const Recovery& r, const BodyMotion& motion, RecoverFrame frame, Index instant) {
  Eigen::Matrix3Xd X = motion.to_scene.length * (motion.mirror.asDiagonal() * r.position);
  if (frame == RecoverFrame::part) return X;
  X.colwise() -= motion.origin;
  const Eigen::Matrix3Xd turned = frame_axes(motion, frame, instant) * X;
  return turned.colwise() + motion.position.col(instant);
}

/// All files of one request, named after the body.
struct Files {
  fs::path folder;
  std::string stem;
  std::vector<std::pair<double, std::string>> series;

  std::string path(const std::string& name) const { return (folder / name).string(); }
};

Files make_folder(const RecoverRequest& request, const std::string& body) {
  Files files;
  files.stem = body;
  std::replace(files.stem.begin(), files.stem.end(), '/', '_');
  files.folder = request.output.empty() ? fs::path(request.results).parent_path() / (files.stem + ".recovered")
                                        : fs::path(request.output);
  std::error_code error;
  fs::create_directories(files.folder, error);
  if (error)
    throw Error("cannot create the folder: " + error.message(), files.folder.string(), "choose another one with -o");
  return files;
}

void write_envelope(const Recovery& r, const BodyMotion& motion, const VtuCells& cells, const Envelope& envelope,
                    const Files& files) {
  const Eigen::Matrix3Xf X = rest_positions(r, motion, RecoverFrame::part, 0).cast<float>();
  std::vector<VtuArray> points{{"displacement", 1, envelope.displacement},
                               {"displacement_time", 1, envelope.displacement_time}};
  if (r.stress_points() > 0) points.push_back({"solid_von_mises", 1, envelope.solid_von_mises});
  formats::write_vtu(files.path(files.stem + "_envelope.vtu"), X, cells, points,
                     {{"von_mises", 1, envelope.von_mises}, {"von_mises_time", 1, envelope.von_mises_time}});
}

std::string peak_line(const char* what, const Peak& peak, const std::string& unit, const std::string& time_unit,
                      const std::string& place) {
  return fmt::format("{:<29}{:.6g}{}{} at {:.6g}{}{} at {}\n", what, peak.value, unit.empty() ? "" : " ", unit,
                     peak.time, time_unit.empty() ? "" : " ", time_unit, place);
}

/// " (0.025, 0, 0)": the middle of an element of the undeformed body, part frame, units of the scene.
std::string middle_text(const Recovery& r, const BodyMotion& motion, int element) {
  const auto e = static_cast<std::size_t>(element);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const int first = r.elements.first[e], end = r.elements.first[e + 1];
  for (int k = first; k < end; ++k) middle += r.position.col(r.elements.node[static_cast<std::size_t>(k)]);
  middle = motion.to_scene.length / (end - first) * motion.mirror.cwiseProduct(middle);
  return fmt::format(" ({:.4g}, {:.4g}, {:.4g})", middle.x(), middle.y(), middle.z());
}

std::string left_out_line(const LeftOutStress& stress, const BodyMotion& motion) {
  if (motion.load_factor.cols() == 0) return "";
  const std::string unit = unit_label(motion.scene_units, -1, 1, -2), after = unit.empty() ? "" : " " + unit;
  return fmt::format(
      "{:<29}at most {:.3g}{} added by static answers to inertia and weight; what is still missing is "
      "estimated at {:.2g}{}\n",
      "stress left out by modes", stress.added, after, stress.remaining, after);
}

std::string report(const Recovery& r, const BodyMotion& motion, const Envelope& envelope, const std::string& left_out,
                   const Files& files) {
  const std::string length = unit_label(motion.scene_units, 1, 0, 0), time = unit_label(motion.scene_units, 0, 0, 1);
  const std::string stress = unit_label(motion.scene_units, -1, 1, -2);
  const auto node = [&r](int n) { return printable_line(r.node_label[static_cast<std::size_t>(n)], 60); };
  std::string text = fmt::format("body '{}', {} instants\n", motion.body, motion.instants());
  text += "displacements count from the floating frame of the body\n";
  text += peak_line("largest displacement", envelope.moved, length, time, node(envelope.moved.at));
  if (envelope.beam.at >= 0)
    text += peak_line("largest stress of beams", envelope.beam, stress, time,
                      element_text(r, envelope.beam.at) + middle_text(r, motion, envelope.beam.at));
  if (envelope.shell.at >= 0)
    text += peak_line("largest von Mises of shells", envelope.shell, stress, time,
                      element_text(r, envelope.shell.at) + middle_text(r, motion, envelope.shell.at));
  if (envelope.solid.at >= 0)
    text += peak_line("largest von Mises of solids", envelope.solid, stress, time, node(envelope.solid.at));
  text += left_out;
  for (const std::string& note : motion.notes) text += fmt::format("{:<29}{}\n", "note", note);
  return text + fmt::format("written {} (open it with ParaView)\n        {}\n", files.path(files.stem + ".pvd"),
                            files.path(files.stem + "_envelope.vtu"));
}

}  // namespace

std::string recover(const RecoverRequest& request) {
  const formats::RecoveryReader file(request.recovery);
  const Recovery& r = file.recovery();
  const BodyMotion motion = body_motion(r, formats::ResultsReader(request.results), request);
  PointHistory history(r, motion, request);
  Files files = make_folder(request, motion.body);
  const VtuCells cells = formats::vtu_cells(r.elements);
  const SolidPoints points = solid_points(r);
  const auto batch = static_cast<Index>(std::max(batch_bytes / bytes_per_instant(r), 1.0));
  Envelope envelope;
  for (Index first = 0; first < motion.instants(); first += batch) {
    const Index count = std::min(batch, motion.instants() - first);
    const RecoveredFields fields = recover_fields(file, motion, first, count);
    for (Index t = 0; t < count; ++t) {
      const double time = motion.time[static_cast<std::size_t>(first + t)];
      const InstantValues values = instant_values(r, points, fields, t);
      const Eigen::Matrix3Xd rest = rest_positions(r, motion, request.frame, first + t);
      const Eigen::Matrix3d axes = frame_axes(motion, request.frame, first + t);
      extend(r, values, time, envelope);
      history.add(fields, values, rest, axes, t, time);
      files.series.emplace_back(time, fmt::format("{}_{:05}.vtu", files.stem, first + t));
      formats::write_vtu(files.path(files.series.back().second), rest.cast<float>(), cells,
                         vtu_point_data(r, fields, values, axes, t), vtu_cell_data(r, fields, values, t));
    }
  }
  formats::write_pvd(files.path(files.stem + ".pvd"), files.series);
  write_envelope(r, motion, cells, envelope, files);
  std::string text = report(r, motion, envelope, left_out_line(left_out_stress(file, motion), motion), files);
  if (history.empty()) return text;
  write_text_file(files.path(files.stem + "_points.csv"), history.text());
  return text + fmt::format("        {}\n", files.path(files.stem + "_points.csv"));
}

}  // namespace tisserand::reducer
