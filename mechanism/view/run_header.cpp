// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies, nodes, joints, springs, arrows and report of a run, with their numbers in blocks.
#include "mechanism/view/run_header.hpp"

#include <cmath>
#include <filesystem>

#include "common/text.hpp"
#include "formats/page/header_parts.hpp"
#include "mechanism/histories/series.hpp"
#include "mechanism/view/largest_stress.hpp"
#include "mechanism/view/motion_extent.hpp"
#include "mechanism/view/page_channels.hpp"
#include "mechanism/view/recovered_shape.hpp"
#include "mechanism/view/run_modes.hpp"
#include "mechanism/view/run_report.hpp"
#include "mechanism/view/scenery.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::few_modes;
using formats::FewModes;
using formats::Json;
using formats::PageBlocks;
using formats::PageRows;
using formats::Surface;

constexpr double relative_error = 1e-3;                 // of the largest displacement of a body
constexpr std::size_t most_channel_values = 4'000'000;  // of all curves together
constexpr std::size_t most_node_values = 1'000'000;     // instants x nodes outside of rigid bodies

Json list_of(const Eigen::Ref<const Eigen::VectorXd>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(value);
  return list;
}

Json quaternion_of(const Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

/// Places of nodes and markers: fixed in a body that keeps its shape, or over time.
class Places {
 public:
  Places(const ViewedRun& run, PageBlocks& blocks) : run_(run), blocks_(blocks) {}

  Json at(int node, const Vector3d& position, const Quaterniond& orientation) {
    if (node == formats::SimulatedMarker::ground)
      return {{"point", list_of(position)}, {"rotation", quaternion_of(orientation)}};
    const Track track = carried(run_.nodes[node], position, orientation);
    const int owner = run_.body_of_node[node];
    if (owner >= 0 && run_.bodies[owner].is_part_frame) {
      const Track& frame = run_.bodies[owner].frame;
      const Quaterniond back = frame.turn(0).conjugate();
      const Vector3d point = back * Vector3d((track.position.row(0) - frame.position.row(0)).transpose());
      return {{"body", owner}, {"point", list_of(point)}, {"rotation", quaternion_of(back * track.turn(0))}};
    }
    Json place{{"position", blocks_.add_track(track.position)}};
    if (track.has_rotation()) place["rotation"] = blocks_.add_rotations(track.rotation);
    if (owner >= 0) place["body"] = owner;
    if (owner >= 0) place["rest"] = list_of(place_at_rest(run_, run_.bodies[owner], node));
    if (!position.isZero(0.0)) place["arm"] = list_of(orientation.conjugate() * position);
    return place;
  }
  Json at(int node) { return at(node, Vector3d::Zero(), Quaterniond::Identity()); }
  Json at(const formats::SimulatedMarker& marker) { return at(marker.node, marker.position, marker.orientation); }

  /// Whether the file holds the motion of the node.
  bool has(const formats::SimulatedMarker& marker) const {
    return marker.node == formats::SimulatedMarker::ground ||
           (marker.node >= 0 && run_.nodes[marker.node].has_position());
  }
  Json body(const formats::SimulatedMarker& marker) const {
    if (marker.node < 0 || run_.body_of_node[marker.node] < 0) return nullptr;
    return run_.body_of_node[marker.node];
  }

 private:
  const ViewedRun& run_;
  PageBlocks& blocks_;
};

/// Appends the stress to the displacement of the modes, scaled so that the largest of both are equal. Returns the
/// scale; 0: there is no stress.
double stack_stress(BodyShape& shape) {
  formats::Deformation& d = shape.deformation;
  if (shape.stress.size() == 0 || d.modes.cols() == 0) return 0.0;
  const double moved = formats::largest_displacement(d),
               stressed = formats::largest_displacement({shape.stress, d.amplitudes});
  if (!(moved > 0.0 && stressed > 0.0)) return 0.0;
  const double scale = moved / stressed;
  Eigen::MatrixXd both(d.modes.rows() + shape.stress.rows(), d.modes.cols());
  both << d.modes, scale * shape.stress;
  d.modes = std::move(both);
  return scale;
}

/// Adds bodies with their shapes, roads and tyres, and the extent of the motion.
void add_bodies(ViewedRun& run, const ShapeOptions& options, ModesOfBodies& modes, PageBlocks& blocks, Json& json) {
  MotionExtent extent(run);
  json["bodies"] = json["shapes"] = Json::array();
  for (int i = 0; i < std::ssize(run.bodies); ++i) {
    const ViewedBody& body = run.bodies[i];
    BodyShape shape = shape_of_body(run, body, options);
    extent.add(shape.surface, body.frame);
    const Json stressed = largest_stress(run, body, shape);
    modes.take(run, i, shape);
    const double stress_scale = stack_stress(shape);
    const FewModes few = few_modes(shape.deformation, relative_error, formats::size_of(shape.surface));
    modes.reduce(i, few, run.times.size());
    Json one{{"name", body.name},
             {"kind", body.kind},
             {"shape", json["shapes"].size()},
             {"position", blocks.add_track(body.frame.position)},
             {"rotation", blocks.add_rotations(body.frame.rotation)},
             {"amplitudes", nullptr},
             {"mass", std::isfinite(body.file.mass) ? Json(body.file.mass) : Json()}};
    if (few.count() > 0)
      one["amplitudes"] = blocks.add_floats(PageRows(few.amplitudes.topRows(run.times.size()).cast<double>()),
                                            {run.times.size(), few.count()});
    json["shapes"].push_back(formats::shape_json(
        {shape.surface, shape.source, shape.points, shape.all_vertices, stress_scale, shape.elements}, few, blocks));
    if (Json& stress = json["shapes"].back()["stress"]; !stress.is_null()) stress["largest"] = stressed;
    json["bodies"].push_back(std::move(one));
    if (shape.surface.size() > 5000) blocks.next();
  }
  Eigen::AlignedBox3d ground;
  for (const Scenery& one : scenery_of(run)) {
    if (one.kind == "road")
      for (const Vector3d& vertex : one.surface.vertices)
        ground.extend(one.frame.position.row(0).transpose() + one.frame.turn(0) * vertex);
    else
      extent.add(one.surface, one.frame);
    json["bodies"].push_back({{"name", one.name},
                              {"kind", one.kind},
                              {"colour", one.colour},
                              {"shape", json["shapes"].size()},
                              {"position", blocks.add_track(one.frame.position)},
                              {"rotation", blocks.add_rotations(one.frame.rotation)},
                              {"amplitudes", nullptr},
                              {"mass", nullptr}});
    json["shapes"].push_back(formats::shape_json({one.surface, "scene", false, one.surface.size()}, {}, blocks));
  }
  const Eigen::AlignedBox3d &moving = extent.box(), all = moving.merged(ground);
  json["box"] = {list_of(all.min()), list_of(all.max())};
  const int follow = extent.followed();
  json["moving"] = {{"box", {list_of(moving.min()), list_of(moving.max())}},
                    {"size", extent.size()},
                    {"follow", follow < 0 ? Json() : Json(follow)}};
  blocks.next();
}

void add_nodes(const ViewedRun& run, Places& places, PageBlocks& blocks, Json& json) {
  json["nodes"] = Json::array();
  const formats::ResultsLayout& layout = run.layout();
  std::map<int, Json> other_names;
  for (const formats::ResultsLayout::Alias& alias : layout.node_aliases) other_names[alias.node].push_back(alias.name);
  std::size_t values = 0, left_out = 0;
  for (int i = 0; i < std::ssize(run.nodes); ++i) {
    const int owner = run.body_of_node[i], node = i;
    if (owner < 0 || !run.nodes[i].has_position()) continue;
    if (!run.bodies[owner].is_part_frame) values += run.rows.size();
    if (values > most_node_values) {
      ++left_out;
      continue;
    }
    Json one{{"name", layout.nodes[i]}, {"body", owner}, {"place", places.at(node)}};
    if (other_names.contains(node)) one["also"] = other_names[node];
    json["nodes"].push_back(std::move(one));
  }
  if (left_out > 0) json["nodes_left_out"] = left_out;
  blocks.next();
}

/// Indices of the paths ("forces/spring/strut") that the page holds.
Json held(const PageChannels& channels, const std::vector<std::string>& paths) {
  Json list = Json::array();
  for (const std::string& path : paths)
    if (const int index = channels.find(path); index >= 0) list.push_back(index);
  return list;
}

std::vector<std::string> components(const std::string& before, const std::string& ending) {
  return {before + ending + "x", before + ending + "y", before + ending + "z"};
}

void add_arrow(const std::string& name, const char* kind, const Json& place, const std::vector<std::string>& paths,
               const char* axes, const PageChannels& channels, Json& json) {
  const Json indices = held(channels, paths);
  if (indices.size() == 3)
    json["arrows"].push_back({{"name", name}, {"kind", kind}, {"place", place}, {"channels", indices}, {"axes", axes}});
}

void add_joint(const formats::SimulatedLink& link, Places& places, const PageChannels& channels, Json& json) {
  const Json place = places.at(link.ends[0]);
  Json coordinates = Json::array();
  const std::string path = "joints/coordinate/" + link.name;
  if (const int index = channels.find(path); index >= 0) coordinates.push_back(index);
  for (auto at = channels.index.lower_bound(path + "/"); at != channels.index.end(); ++at) {
    if (!at->first.starts_with(path + "/")) break;
    coordinates.push_back(at->second);
  }
  json["joints"].push_back({{"name", link.name},
                            {"kind", link.kind.substr(link.kind.find('/') + 1)},
                            {"bodies", {places.body(link.ends[0]), places.body(link.ends[1])}},
                            {"place", place},
                            {"coordinates", coordinates}});
  add_arrow(link.name, "force", place, components("joints/force/" + link.name, "/"), "place", channels, json);
  add_arrow(link.name, "moment", place, components("joints/moment/" + link.name, "/"), "place", channels, json);
}

void add_spring(const formats::SimulatedLink& link, Places& places, const PageChannels& channels, Json& json) {
  const Json ends = {places.at(link.ends[0]), places.at(link.ends[1])};
  std::vector<std::string> paths{"forces/spring/" + link.name};
  for (const char* of : {"forces/bushing_force/", "forces/bushing_moment/"})
    for (const std::string& path : components(of + link.name, "/")) paths.push_back(path);
  const std::size_t slash = link.kind.find('/');
  json["springs"].push_back({{"name", link.name},
                             {"kind", slash == std::string::npos ? link.kind : link.kind.substr(slash + 1)},
                             {"ends", ends},
                             {"channels", held(channels, paths)}});
}

void add_load(const formats::SimulatedLink& link, Places& places, const PageChannels& channels, Json& json) {
  const bool is_force = link.kind.starts_with("load/force"), follows = link.kind.ends_with("/body");
  add_arrow(link.name, is_force ? "force" : "moment", places.at(link.ends[0]),
            components("forces/load/" + link.name, "/"), follows ? "place" : "world", channels, json);
}

/// Adds the forces of the road on a tyre, at the contact centre.
void add_tyre(const Track& contact, const formats::SimulatedLink& link, const PageChannels& channels,
              PageBlocks& blocks, Json& json) {
  if (!contact.has_position()) return;
  const Json place{{"position", blocks.add_track(contact.position)},
                   {"rotation", blocks.add_rotations(contact.rotation)}};
  add_arrow(link.name, "force", place, components("tyres/force/" + link.name, "/"), "place", channels, json);
  add_arrow(link.name, "moment", place, components("tyres/moment/" + link.name, "/"), "place", channels, json);
}

void add_links(const ViewedRun& run, Places& places, const PageChannels& channels, PageBlocks& blocks, Json& json) {
  json["joints"] = json["springs"] = json["arrows"] = Json::array();
  std::vector<std::string> unseen;
  const TyreContacts contacts = tyre_contacts(run);
  for (const formats::SimulatedLink& link : run.layout().simulated.links) {
    const bool is_load = link.kind.starts_with("load/");
    const bool is_tyre = link.kind == "tyre";
    if (!places.has(link.ends[0]) || (!is_load && !is_tyre && !places.has(link.ends[1]))) {
      unseen.push_back(link.name);
    } else if (link.kind.starts_with("joint/")) {
      add_joint(link, places, channels, json);
    } else if (is_load) {
      add_load(link, places, channels, json);
    } else if (is_tyre) {
      add_tyre(contact_of(run, contacts, link), link, channels, blocks, json);
    } else {
      add_spring(link, places, channels, json);
    }
  }
  if (!unseen.empty())
    json["report"]["notes"].push_back("not shown, because the motion of their bodies is not stored: " + listed(unseen));
  const formats::ResultsLayout& layout = run.layout();
  for (int i = 0; i < std::ssize(layout.nodes); ++i) {
    const std::string path = "superelements/boundary_force/" + layout.nodes[i];
    if (channels.find(path + "/force_x") < 0 || !run.nodes[i].has_position()) continue;
    const Json place = places.at(i);
    add_arrow(layout.nodes[i], "force", place, components(path, "/force_"), "world", channels, json);
    add_arrow(layout.nodes[i], "moment", place, components(path, "/moment_"), "world", channels, json);
  }
  blocks.next();
}

}  // namespace

Json run_header(ViewedRun& run, const RunOptions& options, PageBlocks& blocks) {
  const formats::ResultsReader& reader = *run.reader;
  const formats::SimulatedScene& scene = run.layout().simulated;
  const Vector3d gravity = scene.empty() ? Vector3d::Zero() : scene.gravity;
  Json json{{"name", reader.scene()},
            {"file", std::filesystem::path(reader.path()).filename().string()},
            {"kind", scene.analysis.empty() ? (reader.modes() > 0 ? "modes" : "dynamics") : scene.analysis},
            {"completed", reader.completed()},
            {"reason", reader.reason()},
            {"units", formats::units_json(run.layout().units)},
            {"up", list_of(gravity.norm() > 0.0 ? Vector3d(-gravity.normalized()) : Vector3d::UnitZ())},
            {"gravity", list_of(gravity)},
            {"times", blocks.add_times(run.times)},
            {"thinned", nullptr}};
  if (const Json pascal = formats::pascal_json(run.layout().units); !pascal.is_null()) json["pascal"] = pascal;
  if (run.rows.size() < reader.rows()) json["thinned"] = {{"rows", reader.rows()}, {"kept", run.rows.size()}};
  require_used_recovery(run, options.shapes);
  ModesOfBodies modes(reader);
  add_bodies(run, options.shapes, modes, blocks, json);
  json["report"] = report_of_run(reader);
  for (const std::string& note : run.notes) json["report"]["notes"].push_back(note);
  Places places(run, blocks);
  add_nodes(run, places, blocks, json);
  const PageChannels channels = add_channels(run, options.channels, most_channel_values, blocks);
  add_links(run, places, channels, blocks, json);
  json["channels"] = channels.list;
  json["channels_left_out"] = channels.left_out;
  json["references"] = Json::array();
  json["modes"] = modes.json();
  for (const char* energy : {"kinetic", "strain", "potential", "work", "dissipated", "total", "balance"})
    if (const int index = channels.find(std::string("energy/") + energy); index >= 0)
      json["report"]["energy"][energy] = index;
  if (const int index = channels.find("solver/step"); index >= 0) json["report"]["steps"] = index;
  json["scene"] = scene.text.empty() ? Json() : Json(scene.text);
  return json;
}

}  // namespace tisserand::mechanism
