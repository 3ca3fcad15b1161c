// From the rows of a results file to the coordinates of one superelement.
#include "reducer/recover/motion.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::ResultsLayout;

/// Row of /superelements that the request means.
int find_body(const ResultsLayout& layout, const formats::ResultsReader& results, const std::string& body) {
  const auto& names = layout.superelements;
  if (body.empty() && names.size() == 1) return 0;
  const std::string remedy = names.empty() ? "give results of a scene with a flexible superelement, and store its "
                                             "coordinates (channel superelements/y)"
                                           : "give --body " + listed(names, " or --body ");
  if (body.empty())
    throw Error(fmt::format("holds {} superelements, and none is chosen", names.size()), results.path(), remedy);
  const auto found = std::find(names.begin(), names.end(), body);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  const std::string shown = printable_line(body, 60);
  if (std::find(layout.modal_bodies.begin(), layout.modal_bodies.end(), body) != layout.modal_bodies.end())
    throw Error(fmt::format("body '{}' is modal: its coordinates w are not those of a superelement", shown),
                results.path(), "simulate the superelement itself (type: superelement)");
  for (const formats::SimulatedBody& simulated : layout.simulated.bodies)
    if (simulated.name == body)
      throw Error(fmt::format("body '{}' was simulated as {}: it does not deform as a superelement does", shown,
                              printable_line(simulated.kind, 20)),
                  results.path(), remedy);
  throw Error(fmt::format("holds no superelement '{}'", shown), results.path(), remedy);
}

/// Nearest stored instants of the times asked for, without repetition.
std::vector<std::size_t> chosen_rows(const std::vector<double>& time, const RecoverRequest& request,
                                     const std::string& where) {
  if (time.empty()) throw Error("holds no instants", where, "run the scene to its end, or store more often");
  std::vector<std::size_t> rows;
  if (request.times.empty())
    for (std::size_t row = 0; row < time.size(); ++row) rows.push_back(row);
  const double span = time.back() - time.front(), margin = 1e-9 * (1.0 + std::abs(span));
  for (const double wanted : request.times) {
    if (!(wanted >= time.front() - margin && wanted <= time.back() + margin))
      throw Error(fmt::format("time {:g} is not within its instants {:g} to {:g}", wanted, time.front(), time.back()),
                  where, "choose others with --times");
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

/// y of results -> y of the part in its file's units: signs of the image, lengths of translations.
void to_file(const formats::Recovery& recovery, const BodyMotion& motion, MatrixXd& y) {
  for (Index k = 0; k < y.rows(); ++k) {
    const int component = recovery.dof_component[static_cast<std::size_t>(k)];
    if (recovery.dof_node[static_cast<std::size_t>(k)] < 0) continue;
    const double sign = motion.mirror[component % 3] * (component < 3 ? 1.0 : motion.mirror.prod());
    y.row(k) *= component < 3 ? sign / motion.to_scene.length : sign;
  }
}

Vector3d frame_origin(const ResultsLayout& layout, const std::string& body) {
  for (const formats::SimulatedBody& simulated : layout.simulated.bodies)
    if (simulated.name == body) return simulated.origin;
  return Vector3d::Constant(formats::SimulatedBody::unknown);
}

}  // namespace

BodyMotion body_motion(const formats::Recovery& recovery, const formats::ResultsReader& results,
                       const RecoverRequest& request) {
  const ResultsLayout& layout = results.layout();
  const int row = find_body(layout, results, request.body);
  const auto index = static_cast<std::size_t>(row);
  BodyMotion motion;
  motion.body = layout.superelements[index];
  const std::string id = index < layout.superelement_content_ids.size() ? layout.superelement_content_ids[index] : "";
  motion.mirror = formats::require_same_superelement(recovery, id, request.recovery, motion.body);
  motion.to_scene = convert_units(recovery.units, layout.units, request.recovery);
  motion.scene_units = layout.units;
  const std::vector<double> time = results.time();
  const std::vector<std::size_t> rows = chosen_rows(time, request, results.path());
  for (const std::size_t r : rows) motion.time.push_back(time[r]);

  const MatrixXd all = results.read_dataset("superelements/y", rows);
  if (all.cols() == 0)
    throw Error("the coordinates of superelements are not stored", results.path(),
                "add superelements/y to output.channels of the scene and run it again");
  const Index first = layout.modes_offset[index], n = layout.modes_offset[index + 1] - first;
  if (n != recovery.coordinates() || first < 0 || first + n > all.cols())
    throw Error(
        fmt::format("body '{}' has {} coordinates, its recovery file {}", motion.body, n, recovery.coordinates()),
        results.path(), "the file is damaged; run the scene again");
  motion.y = all.middleCols(first, n).transpose();
  if (!motion.y.allFinite())
    throw Error(fmt::format("coordinates of body '{}' are not finite", motion.body), results.path(),
                "the run has failed, or the file is damaged");
  to_file(recovery, motion, motion.y);

  const MatrixXd position = results.read_dataset("superelements/frame_position", rows);
  const MatrixXd rotation = results.read_dataset("superelements/frame_rotation", rows);
  motion.origin = frame_origin(layout, motion.body);
  if (position.cols() >= 3 * (row + 1) && rotation.cols() >= 4 * (row + 1)) {
    motion.position = position.middleCols(3 * row, 3).transpose();
    motion.rotation = rotation.middleCols(4 * row, 4).transpose();
  }
  if (request.frame == RecoverFrame::world && (motion.position.cols() == 0 || !motion.origin.allFinite() ||
                                               !motion.position.allFinite() || !motion.rotation.allFinite()))
    throw Error(fmt::format("where body '{}' is in the world is not stored", motion.body), results.path(),
                "give --frame part, or run the scene again with all channels of superelements");
  return motion;
}

}  // namespace tisserand::reducer
