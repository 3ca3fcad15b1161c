// SPDX-License-Identifier: GPL-3.0-or-later
// Coordinates of one superelement or modal body from the rows of a results file.
#include "reducer/recover/motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/recover/inertia_loads.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::ResultsLayout;

constexpr double batch_doubles = 4e6;  // size of a part of a dataset of the results
constexpr Index largest_batch = 256;   // instants; the fields of the file are read once for each batch

BodyRow find_body(const formats::ResultsReader& results, const std::string& body) {
  const ResultsLayout& layout = results.layout();
  std::vector<std::string> names = layout.superelements;
  names.insert(names.end(), layout.modal_bodies.begin(), layout.modal_bodies.end());
  const auto at = [&](std::size_t k) {
    const bool is_modal = k >= layout.superelements.size();
    return BodyRow{is_modal ? k - layout.superelements.size() : k, is_modal, names[k]};
  };
  if (body.empty() && names.size() == 1) return at(0);
  const std::string remedy =
      names.empty()
          ? "use results of a scene with a flexible superelement, and store its coordinates (channel superelements/y)"
          : "give --body " + listed(names, " or --body ");
  if (body.empty())
    throw Error(fmt::format("holds {} superelements and modal bodies, but none of them is chosen", names.size()),
                results.path(), remedy);
  const auto found = std::find(names.begin(), names.end(), body);
  if (found != names.end()) return at(static_cast<std::size_t>(found - names.begin()));
  const std::string shown = printable_line(body, 60);
  for (const formats::SimulatedBody& simulated : layout.simulated.bodies)
    if (simulated.name == body)
      throw Error(fmt::format("body '{}' was simulated as {}, which does not deform as a superelement does", shown,
                              printable_line(simulated.kind, 20)),
                  results.path(), remedy);
  throw Error(fmt::format("holds no superelement '{}'", shown), results.path(), remedy);
}

/// Nearest stored instants of the requested times, without repetition. `unit`: label of the times, for messages.
std::vector<std::size_t> chosen_rows(const std::vector<double>& time, const RecoverRequest& request,
                                     const std::string& unit, const std::string& where) {
  if (time.empty()) throw Error("holds no stored instants", where, "run the scene to its end, or store more often");
  std::vector<std::size_t> rows;
  if (request.times.empty())
    for (std::size_t row = 0; row < time.size(); ++row) rows.push_back(row);
  const double span = time.back() - time.front(), margin = 1e-9 * (1.0 + std::abs(span));
  for (const double wanted : request.times) {
    if (!(wanted >= time.front() - margin && wanted <= time.back() + margin))
      throw Error(fmt::format("time {:g}{} is outside the stored times {:g} to {:g}{}", wanted, unit, time.front(),
                              time.back(), unit),
                  where, "choose other times with --times");
    const auto after = std::lower_bound(time.begin(), time.end(), wanted);
    std::size_t row = after == time.end() ? time.size() - 1 : static_cast<std::size_t>(after - time.begin());
    if (row > 0 && wanted - time[row - 1] < time[row] - wanted) --row;
    rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < rows.size(); i += static_cast<std::size_t>(request.every)) kept.push_back(rows[i]);
  return kept;
}

const formats::SimulatedBody* simulated_body(const ResultsLayout& layout, const std::string& body) {
  for (const formats::SimulatedBody& simulated : layout.simulated.bodies)
    if (simulated.name == body) return &simulated;
  return nullptr;
}

std::string content_id_of(const ResultsLayout& layout, const BodyRow& found) {
  if (found.is_modal) {
    const formats::SimulatedBody* body = simulated_body(layout, found.name);
    return body ? body->content_id : "";
  }
  return found.row < layout.superelement_content_ids.size() ? layout.superelement_content_ids[found.row] : "";
}

/// Stored coordinates of the body in the units of the scene. Coordinates that the body lacks but the file has are 0.
MatrixXd coordinates(const formats::ResultsReader& results, const std::string& dataset, const BodyRow& found, Index n,
                     const std::vector<std::size_t>& rows) {
  const std::vector<int>& offset = found.is_modal ? results.layout().modal_offset : results.layout().modes_offset;
  const MatrixXd all = results.read_dataset(dataset, rows);
  if (all.cols() == 0)
    throw Error(fmt::format("the coordinates of {} are not stored", found.is_modal ? "modal bodies" : "superelements"),
                results.path(), fmt::format("add {} to output.channels of the scene and run it again", dataset));
  const Index first = offset[found.row], own = offset[found.row + 1] - first;
  if ((found.is_modal ? own > n : own != n) || first < 0 || own < 0 || first + own > all.cols())
    throw Error(fmt::format("body '{}' has {} coordinates, but its recovery file has {}", found.name, own, n),
                results.path(), "the file is damaged; run the scene again");
  MatrixXd y = MatrixXd::Zero(n, all.rows());
  y.topRows(own) = all.middleCols(first, own).transpose();
  if (!y.allFinite())
    throw Error(fmt::format("coordinates of body '{}' are not finite", found.name), results.path(),
                "the run has failed, or the file is damaged");
  return y;
}

/// Adds the motion of the floating frame and its origin, if they are stored.
void add_frame(const formats::ResultsReader& results, const BodyRow& found, const std::vector<std::size_t>& rows,
               BodyMotion& motion) {
  const ResultsLayout& layout = results.layout();
  const auto node = std::ranges::find(layout.nodes, found.name) - layout.nodes.begin();
  const Index row = found.is_modal ? node : static_cast<Index>(found.row);
  const std::string group = found.is_modal ? "nodes/" : "superelements/frame_";
  motion.origin.setConstant(formats::SimulatedBody::unknown);
  if (found.is_modal && row < layout.simulated.node_reference.cols())
    motion.origin = layout.simulated.node_reference.col(row);
  else if (const formats::SimulatedBody* body = simulated_body(layout, found.name); body && !found.is_modal)
    motion.origin = body->origin;
  const MatrixXd position = results.read_dataset(group + "position", rows);
  const MatrixXd rotation = results.read_dataset(group + "rotation", rows);
  if (position.cols() < 3 * (row + 1) || rotation.cols() < 4 * (row + 1)) return;
  motion.position = position.middleCols(3 * row, 3).transpose();
  motion.rotation = rotation.middleCols(4 * row, 4).transpose();
}

/// Whether files of this version contain the strain of superelements with stiffening.
bool knows_strain(const std::string& version) {
  const std::size_t dot = version.find('.');
  return dot == std::string::npos || std::atoi(version.c_str() + dot + 1) >= 10;
}

/// Number of instants to read at once: `batch_doubles` over the width of the widest dataset.
Index batch_of(const ResultsLayout& layout) {
  const auto last = [](const std::vector<int>& offset) { return offset.empty() ? 0 : offset.back(); };
  const double width = std::max({last(layout.modes_offset), last(layout.modal_offset), 7 * count_of(layout.nodes), 1});
  return static_cast<Index>(std::clamp(batch_doubles / width, 1.0, static_cast<double>(largest_batch)));
}

}  // namespace

MotionReader::MotionReader(const formats::Recovery& recovery, const formats::ResultsReader& results,
                           const RecoverRequest& request)
    : recovery_(recovery), results_(results), body_(find_body(results, request.body)) {
  const ResultsLayout& layout = results.layout();
  still_.body = body_.name;
  still_.mirror =
      formats::require_same_superelement(recovery, content_id_of(layout, body_), request.recovery, body_.name);
  still_.to_scene = convert_units(recovery.units, layout.units, request.recovery);
  still_.scene_units = layout.units;
  const std::vector<double> time = results.time();
  rows_ = chosen_rows(time, request, after_time(layout.units), results.path());
  for (const std::size_t r : rows_) time_.push_back(time[r]);
  batch_ = batch_of(layout);
  has_strain_ = !body_.is_modal && layout.strained;
  if (!body_.is_modal && !layout.strained && !knows_strain(results.version()))
    notes_.push_back(
        "the results were written before version 1.10. If the body has a companion file, its stress contains a false "
        "strain from foreshortening. Run the scene again.");
  has_loads_ = may_have_loads(recovery, notes_);
  for (std::string& note : applied_loads_notes(recovery, layout, body_)) notes_.push_back(std::move(note));
  look_at_all(request);
}

/// Motion as the results contain it; modes that the body lacks are zero.
BodyMotion MotionReader::stored(Index first, Index count) const {
  const auto begin = rows_.begin() + first;
  const std::vector<std::size_t> rows(begin, begin + count);
  BodyMotion motion = still_;
  motion.time.assign(time_.begin() + first, time_.begin() + first + count);
  const Index n = recovery_.coordinates();
  motion.y = coordinates(results_, body_.is_modal ? "modal_bodies/w" : "superelements/y", body_, n, rows);
  motion.y_strain = has_strain_ ? coordinates(results_, "superelements/y_strain", body_, n, rows) : motion.y;
  motion.stiffened = formats::stiffened_instants(
      body_.is_modal ? std::nullopt : results_.layout().is_stiffened(body_.row), motion.y, motion.y_strain);
  formats::to_part(recovery_, motion.mirror, motion.to_scene.length, motion.y);
  formats::to_part(recovery_, motion.mirror, motion.to_scene.length, motion.y_strain);
  if (body_.is_modal) motion.y /= std::sqrt(motion.to_scene.mass) * motion.to_scene.length;
  if (body_.is_modal) motion.y_strain = motion.y;
  add_frame(results_, body_, rows, motion);
  if (has_loads_) add_load_factors(recovery_, results_, rows, body_, motion);
  return motion;
}

BodyMotion MotionReader::read(Index first, Index count) const {
  BodyMotion motion = stored(first, count);
  if (has_loads_) add_static_modes(recovery_, zero_, motion);
  if (recovery_.second_order)
    motion.second_order = formats::add_second_order(*recovery_.second_order, motion.stiffened, zero_, motion.y);
  return motion;
}

void MotionReader::look_at_all(const RecoverRequest& request) {
  const Index n = recovery_.coordinates();
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(n), reach = Eigen::VectorXd::Zero(n);
  bool loads_known = has_loads_, place_known = true, stiffened = false;
  for (Index first = 0; first < instants(); first += batch_) {
    const BodyMotion motion = stored(first, std::min(batch_, instants() - first));
    largest = largest.cwiseMax(motion.y.cwiseAbs().rowwise().maxCoeff());
    stiffened = stiffened || motion.stiffened.maxCoeff() > 0.0;
    loads_known = loads_known && motion.load_factor.cols() > 0;
    if (loads_known) reach = reach.cwiseMax(reach_of_loads(recovery_, motion));
    place_known = place_known && motion.position.cols() > 0 && motion.origin.allFinite() &&
                  motion.position.allFinite() && motion.rotation.allFinite();
    still_.origin = motion.origin;
  }
  if (has_loads_ && !loads_known) notes_.push_back(unknown_loads_note());
  has_loads_ = loads_known;
  if (stiffened && largest.maxCoeff() > 0.0 && !recovery_.second_order) notes_.push_back(formats::no_second_order_note);
  if (!body_.is_modal)
    for (Index k = 0; k < n; ++k)
      if (recovery_.dof_node[k] < 0 && largest[k] == 0.0) zero_.push_back(k);
  if (has_loads_) dropped_ = moved_by_loads(reach, zero_);
  if (request.frame == RecoverFrame::world && !place_known)
    throw Error(fmt::format("the position of body '{}' in the world is not stored", body_.name), results_.path(),
                "use --frame part, or run the scene again and store all channels of superelements (for a modal body: "
                "of nodes)");
}

}  // namespace tisserand::reducer
