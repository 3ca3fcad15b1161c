// SPDX-License-Identifier: GPL-3.0-or-later
// Recovery: results -> coordinates -> fields, batch by batch -> files and the largest values.
#include "reducer/recover/recover.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "common/error.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"
#include "formats/vtk/vtu.hpp"
#include "reducer/recover/envelope.hpp"
#include "reducer/recover/histories.hpp"
#include "reducer/recover/inertia_loads.hpp"
#include "reducer/recover/instant_values.hpp"
#include "reducer/recover/load_files.hpp"
#include "reducer/recover/vtu_data.hpp"

namespace tisserand::reducer {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using formats::Recovery;
using formats::VtuCells;

constexpr double batch_bytes = 256e6;

/// Folder and name of all files of one request; the name is that of the body.
struct Files {
  fs::path folder;
  std::string stem;

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
    throw Error("cannot create the folder: " + error.message(), files.folder.string(), "choose another folder with -o");
  return files;
}

/// Unit labels of the printed lines.
struct Labels {
  std::string length, time, stress;
};

Labels labels_of(const Units& units) {
  return {unit_label(units, 1, 0, 0), unit_label(units, 0, 0, 1), unit_label(units, -1, 1, -2)};
}

/// Middle of an element of the undeformed body, part frame, units of the scene: "shell 17 of 'skin' (0.025, 0, 0)".
std::string element_place(const Recovery& r, const BodyMotion& still, int element) {
  const Eigen::Vector3d middle = still.to_scene.length * still.mirror.cwiseProduct(element_middle(r, element));
  return element_text(r, element) + fmt::format(" ({:.4g}, {:.4g}, {:.4g})", middle.x(), middle.y(), middle.z());
}

/// Likewise for a node: "tip (0.3, 0, 0)".
std::string node_place(const Recovery& r, const BodyMotion& still, int node) {
  const Eigen::Vector3d place = still.to_scene.length * still.mirror.cwiseProduct(r.position.col(node));
  return printable_line(r.node_label[node], 60) +
         fmt::format(" ({:.4g}, {:.4g}, {:.4g})", place.x(), place.y(), place.z());
}

std::string left_out_line(const Recovery& r, const LeftOutStress& stress, const BodyMotion& still) {
  if (!stress.known) return "";
  const std::string after = after_number(labels_of(still.scene_units).stress);
  return fmt::format(
      "{:<29}at most {:.3g}{} added by static answers to {}; the remaining error is estimated at {:.2g}{}\n",
      "stress omitted by modes", stress.added, after, answered_loads(r), stress.remaining, after);
}

/// Lines with the largest values over time: "largest ...   12 Pa at 0.1 s at tip (0.3, 0, 0)".
std::string peaks_text(const Recovery& r, const MotionReader& motion, const Envelope& envelope) {
  const Labels labels = labels_of(motion.still().scene_units);
  const int beams = r.beams(), shells = beams + r.shells(), all = r.elements.count();
  const StressEnvelope &of = envelope.element, &points = envelope.point;
  const auto node = [&](int n) { return node_place(r, motion.still(), n); };
  const auto element = [&](int e) { return element_place(r, motion.still(), e); };
  const auto point = [&](int p) { return node(r.stress_node[p]); };
  const auto placed = [&](const ExtremeOverTime& over_time) {
    return [&](int e) {
      return element(e) + ", " +
             printable_line(place_text(r, e, over_time.place(e), motion.still().to_scene.length), 60);
    };
  };
  std::string text;
  const auto add = [&](const char* what, const ExtremeOverTime& over_time, int at, const auto& place,
                       const std::string& unit) {
    if (at < 0) return;
    const auto value = static_cast<double>(over_time.value(at));
    text += fmt::format("{:<29}{:.6g}{} at {:.6g}{} at {}\n", what, value, after_number(unit),
                        motion.time()[over_time.instant(at)], after_number(labels.time), place(at));
  };
  add("largest displacement", envelope.displacement, envelope.displacement.extreme(0, r.nodes()), node, labels.length);
  add("largest stress of beams", of.von_mises, of.von_mises.extreme(0, beams), element, labels.stress);
  add("largest von Mises of shells", of.von_mises, of.von_mises.extreme(beams, shells), element, labels.stress);
  add("largest von Mises of solids", points.von_mises, points.von_mises.extreme(0, r.stress_points()), point,
      labels.stress);
  add("largest principal stress", of.largest, of.largest.extreme(0, all), placed(of.largest), labels.stress);
  add("smallest principal stress", of.smallest, of.smallest.extreme(0, all), placed(of.smallest), labels.stress);
  return text;
}

std::string written_text(std::vector<std::string> paths, const RecoverRequest& request) {
  if (!request.envelope_only) paths[0] += " (open it with ParaView)";
  std::string text;
  for (std::size_t k = 0; k < paths.size(); ++k) text += (k == 0 ? "written " : "        ") + paths[k] + '\n';
  return text;
}

/// Whole fields on the mesh, one file per instant.
struct Series {
  const Recovery& r;
  const VtuCells& cells;
  const SolidPoints& points;
  RecoverFrame frame;
  const Files& files;
  std::vector<std::pair<double, std::string>> written = {};

  /// Writes a batch of instants, the first of which has number `first`.
  void add(const RecoveredFields& fields, const BodyMotion& motion, Index first) {
    const Eigen::Matrix3Xd places = motion.to_scene.length * (motion.mirror.asDiagonal() * r.position);
    for (Index t = 0; t < motion.instants(); ++t) {
      const InstantValues values = instant_values(r, points, fields, t);
      const Eigen::Matrix3Xd rest = rest_positions(places, motion, frame, t);
      const Eigen::Matrix3d axes = frame_axes(motion, frame, t);
      written.emplace_back(motion.time[t], fmt::format("{}_{:05}.vtu", files.stem, first + t));
      formats::write_vtu(files.path(written.back().second), producer("reducer"), rest.cast<float>(), cells,
                         vtu_point_data(r, fields, values, axes, t), vtu_cell_data(r, fields, values, t));
    }
  }
};

/// Number of instants in a batch; only a series needs whole fields in memory.
Index batch_of(const Recovery& r, const MotionReader& motion, const RecoverRequest& request) {
  if (request.envelope_only) return motion.batch();
  return std::min(motion.batch(), static_cast<Index>(std::max(batch_bytes / bytes_per_instant(r), 1.0)));
}

constexpr Index most_load_cases = 100;

void require_few_load_cases(const MotionReader& motion) {
  if (motion.instants() <= most_load_cases) return;
  throw Error(
      fmt::format("{} instants are chosen, and each of them becomes a load case on all nodes", motion.instants()),
      "--loads", fmt::format("choose at most {} with --times 0.1,0.2 or --every", most_load_cases));
}

/// Throws Error for an instant without any load: nothing acts on the body, or the run took it for rigid.
void require_some_load(const LoadInstant& instant, const MotionReader& motion) {
  const NodalLoads& loads = instant.loads;
  const bool is_zero = loads.boundary.isZero(0.0) && loads.frame.isZero(0.0) && loads.deformation.isZero(0.0);
  if (!is_zero || (instant.balance.compared && instant.balance.largest == 0.0)) return;
  throw Error(
      fmt::format("body '{}' does not deform at time {:g}{}: the run treated it as rigid (`flexibility: auto`), "
                  "or no load acts on it",
                  motion.body().name, instant.time, after_time(motion.still().scene_units)),
      "--loads", "choose other instants with --times, or run the scene with `flexibility: on`");
}

/// Writes load cases of all chosen instants. Returns the lines about them and adds the files to `written`.
std::string write_loads(const formats::RecoveryReader& file, const MotionReader& motion, const RecoverRequest& request,
                        const Files& files, std::vector<std::string>& written) {
  if (request.loads.empty()) return "";
  const Recovery& r = file.recovery();
  const NodeNumbers numbers = node_numbers(r);
  const LoadHead head{r, motion.still(), request, numbers};
  std::vector<std::unique_ptr<LoadFile>> outputs;
  for (const LoadFormat format : request.loads)
    outputs.push_back(std::make_unique<LoadFile>(
        format, files.path(files.stem + (format == LoadFormat::nastran ? "_loads.bdf" : "_loads.inp")), head,
        motion.instants()));
  std::string text;
  for (Index k = 0; k < motion.instants(); ++k) {
    const BodyMotion now = motion.read(k, 1);
    LoadInstant instant{now.time[0], nodal_loads(file, now, 0), {}};
    instant.balance = load_balance(r, instant.loads);
    compare_with_run(motion, now, k, instant.loads, instant.balance);
    require_some_load(instant, motion);
    for (const auto& output : outputs) output->add(instant);
    text += balance_text(r, instant, motion.still());
  }
  for (const auto& output : outputs) written.push_back(output->publish());
  return text;
}

}  // namespace

std::string recover(const RecoverRequest& request) {
  const formats::RecoveryReader file(request.recovery);
  const Recovery& r = file.recovery();
  const formats::ResultsReader results(request.results);
  const MotionReader motion(r, results, request);
  if (!request.loads.empty()) require_nodal_loads(file, motion);
  if (!request.loads.empty()) require_few_load_cases(motion);
  ChosenHistories chosen = chosen_histories(r, motion.still(), request);
  const Files files = make_folder(request, motion.body().name);
  Histories histories(std::move(chosen), motion.still(), files.path(files.stem));
  const VtuCells cells = formats::vtu_cells(r.elements);
  const SolidPoints points = solid_points(r);
  Series series{r, cells, points, request.frame, files};
  Envelope envelope(r);
  const Index batch = batch_of(r, motion, request);
  for (Index first = 0; first < motion.instants(); first += batch) {
    const BodyMotion now = motion.read(first, std::min(batch, motion.instants() - first));
    histories.begin(now.instants());
    const auto take = [&](const FieldBlock& block) {
      envelope.add(block, now, first);
      histories.take(block);
    };
    if (request.envelope_only)
      for_field_blocks(file, now, take);
    else
      series.add(recover_fields(file, now, take), now, first);
    histories.end(now);
  }
  envelope.finish(points);
  std::vector<std::string> written;
  const auto add = [&](const std::string& ending) { return written.emplace_back(files.path(files.stem + ending)); };
  if (!request.envelope_only) formats::write_pvd(add(".pvd"), producer("reducer"), series.written);
  write_envelope_vtu(add("_envelope.vtu"), r, motion, cells, envelope);
  write_envelope_csv(add("_envelope.csv"), r, motion, envelope);
  for (const std::string& path : histories.publish()) written.push_back(path);
  std::string text = fmt::format("body '{}', {} instants\n", motion.body().name, motion.instants());
  text += "displacements are relative to the floating frame of the body\n" + peaks_text(r, motion, envelope);
  text += left_out_line(r, left_out_stress(file, motion), motion.still());
  text += write_loads(file, motion, request, files, written);
  for (const std::string& note : motion.notes()) text += fmt::format("{:<29}{}\n", "note", note);
  return text + written_text(written, request);
}

}  // namespace tisserand::reducer
