// SPDX-License-Identifier: GPL-3.0-or-later
// Writes and reads the simulated scene in a results file.
#include "formats/results/simulated_scene_file.hpp"

#include <cstdint>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::formats {
namespace {

constexpr std::uint64_t most_items = 10'000'000;
constexpr std::uint64_t body_numbers = 8, marker_numbers = 7;

std::uint64_t entries_of(const hdf5::InputFile& file, const std::string& dataset) {
  const hdf5::DatasetInfo info = file.info(dataset);
  if (info.shape.empty() || info.shape[0] > most_items)
    throw Error(fmt::format("has shape {}, expected at most {} entries", hdf5::shape_text(info.shape), most_items),
                fmt::format("{}: {}", file.path(), dataset), "compare the file with formats/RESULTS.md");
  return info.shape[0];
}

/// Reads indices from `least` to below `end`.
std::vector<std::int64_t> read_indices(const hdf5::InputFile& file, const std::string& dataset,
                                       const hdf5::Shape& shape, std::int64_t least, std::size_t end) {
  std::vector<std::int64_t> values(shape.size() == 1 ? shape[0] : shape[0] * shape[1]);
  file.read(dataset, shape, "indices", values.data());
  for (const std::int64_t value : values)
    if (value < least || value >= static_cast<std::int64_t>(end))
      throw Error(
          fmt::format("holds the index {}, expected {} to {}", value, least, static_cast<std::int64_t>(end) - 1),
          fmt::format("{}: {}", file.path(), dataset), "compare the file with formats/RESULTS.md");
  return values;
}

void read_bodies(const hdf5::InputFile& file, SimulatedScene& scene) {
  const std::uint64_t count = entries_of(file, "/scene/body_name");
  const auto texts = [&](const char* name) {
    return file.read_texts(std::string("/scene/body_") + name, count, "bodies");
  };
  const std::vector<std::string> name = texts("name"), kind = texts("kind"), id = texts("content_id"),
                                 path = texts("file");
  std::vector<double> numbers(count * body_numbers);
  file.read("/scene/body_numbers", {count, body_numbers}, "bodies x 8", numbers.data());
  for (std::uint64_t i = 0; i < count; ++i) {
    const double* n = numbers.data() + i * body_numbers;
    scene.bodies.push_back({name[i], kind[i], id[i], path[i], n[0], n[1], {n[2], n[3], n[4]}, {n[5], n[6], n[7]}});
  }
}

void read_links(const hdf5::InputFile& file, std::size_t nodes, SimulatedScene& scene) {
  if (!file.has("/scene/link_name")) return;
  const std::uint64_t count = entries_of(file, "/scene/link_name");
  const std::vector<std::string> name = file.read_texts("/scene/link_name", count, "joints, springs and loads"),
                                 kind = file.read_texts("/scene/link_kind", count, "joints, springs and loads");
  // A file without motion of nodes does not store their names either.
  const std::size_t known =
      nodes > 0 || !file.has("/scene/body_of_node") ? nodes : entries_of(file, "/scene/body_of_node");
  const std::vector<std::int64_t> node =
      read_indices(file, "/scene/link_node", {count, 2}, SimulatedMarker::not_stored, known);
  std::vector<double> marker(count * 2 * marker_numbers);
  file.read("/scene/link_marker", {count, 2, marker_numbers}, "links x 2 x 7", marker.data());
  for (std::uint64_t i = 0; i < count; ++i) {
    SimulatedLink link{name[i], kind[i], {}};
    for (std::uint64_t k = 0; k < 2; ++k) {
      const double* m = marker.data() + (2 * i + k) * marker_numbers;
      const Eigen::Quaterniond q(m[3], m[4], m[5], m[6]);
      const bool is_pose = Eigen::Vector3d(m[0], m[1], m[2]).allFinite() && std::abs(q.norm() - 1.0) < 1e-6;
      if (!is_pose)
        throw Error(fmt::format("marker {} of '{}' is not a position with a unit quaternion", k == 0 ? "a" : "b",
                                printable(name[i])),
                    file.path() + ": /scene/link_marker", "compare the file with formats/RESULTS.md");
      const bool is_stored = nodes > 0 || node[2 * i + k] < 0;
      link.ends[k] = {is_stored ? static_cast<int>(node[2 * i + k]) : SimulatedMarker::not_stored,
                      {m[0], m[1], m[2]},
                      q.normalized()};
    }
    scene.links.push_back(std::move(link));
  }
}

void write_bodies(const hdf5::Output& out, const std::vector<SimulatedBody>& bodies) {
  std::vector<std::string> name, kind, id, path;
  std::vector<double> numbers;
  for (const SimulatedBody& body : bodies) {
    name.push_back(body.name);
    kind.push_back(body.kind);
    id.push_back(body.content_id);
    path.push_back(body.file);
    numbers.insert(numbers.end(), {body.mass, body.gyration});
    numbers.insert(numbers.end(), body.center_of_mass.begin(), body.center_of_mass.end());
    numbers.insert(numbers.end(), body.origin.begin(), body.origin.end());
  }
  hdf5::write_texts(out, "/scene/body_name", name);
  hdf5::write_texts(out, "/scene/body_kind", kind);
  hdf5::write_texts(out, "/scene/body_content_id", id);
  hdf5::write_texts(out, "/scene/body_file", path);
  hdf5::write_dataset(out, "/scene/body_numbers", {bodies.size(), body_numbers}, numbers.data());
}

void write_links(const hdf5::Output& out, const std::vector<SimulatedLink>& links) {
  if (links.empty()) return;
  std::vector<std::string> name, kind;
  std::vector<std::int32_t> node;
  std::vector<double> marker;
  for (const SimulatedLink& link : links) {
    name.push_back(link.name);
    kind.push_back(link.kind);
    for (const SimulatedMarker& end : link.ends) {
      node.push_back(end.node);
      const Eigen::Quaterniond& q = end.orientation;
      marker.insert(marker.end(), {end.position.x(), end.position.y(), end.position.z(), q.w(), q.x(), q.y(), q.z()});
    }
  }
  hdf5::write_texts(out, "/scene/link_name", name);
  hdf5::write_texts(out, "/scene/link_kind", kind);
  hdf5::write_dataset(out, "/scene/link_node", {links.size(), 2}, node.data());
  hdf5::write_dataset(out, "/scene/link_marker", {links.size(), 2, marker_numbers}, marker.data());
}

}  // namespace

void write_simulated(const hdf5::Output& out, const SimulatedScene& scene) {
  if (scene.empty()) return;
  hdf5::write_text(out, "/scene/text", scene.text);
  hdf5::write_text(out, "/scene/file", scene.file);
  hdf5::write_text(out, "/scene/analysis", scene.analysis);
  hdf5::write_dataset(out, "/scene/gravity", scene.gravity);
  write_bodies(out, scene.bodies);
  if (!scene.body_of_node.empty()) hdf5::write_dataset(out, "/scene/body_of_node", scene.body_of_node);
  if (scene.node_reference.cols() > 0)
    hdf5::write_dataset(out, "/scene/node_reference", {static_cast<std::uint64_t>(scene.node_reference.cols()), 3},
                        scene.node_reference.data());
  write_links(out, scene.links);
}

SimulatedScene read_simulated(const hdf5::InputFile& file, std::size_t nodes) {
  SimulatedScene scene;
  if (!file.has("/scene") || !file.has("/scene/body_name")) return scene;
  scene.text = file.read_text("/scene/text");
  scene.file = file.read_text("/scene/file");
  scene.analysis = file.read_text("/scene/analysis");
  file.read("/scene/gravity", {3}, "acceleration", scene.gravity.data());
  read_bodies(file, scene);
  if (nodes > 0 && file.has("/scene/body_of_node")) {
    const auto wide = read_indices(file, "/scene/body_of_node", {nodes}, -1, scene.bodies.size());
    scene.body_of_node.assign(wide.begin(), wide.end());
    scene.node_reference.resize(3, static_cast<Eigen::Index>(nodes));
    file.read("/scene/node_reference", {nodes, 3}, "positions of nodes", scene.node_reference.data());
  }
  read_links(file, nodes, scene);
  return scene;
}

}  // namespace tisserand::formats
