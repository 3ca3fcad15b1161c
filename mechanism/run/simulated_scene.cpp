// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies with their masses, and markers of joints, springs and loads on stored nodes.
#include "mechanism/run/simulated_scene.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "common/sha256.hpp"
#include "formats/scene/expand/values.hpp"
#include "mechanism/build/mirrored_files.hpp"

namespace tisserand::mechanism {
namespace {

using formats::SimulatedBody;
using formats::SimulatedLink;
using formats::SimulatedMarker;

std::string absolute(const std::string& path) {
  return path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string();
}

double gyration_radius(const Eigen::Matrix3d& inertia, double mass) { return std::sqrt(inertia.trace() / 3.0 / mass); }

struct Files {
  MirroredFiles<formats::LoadedSuperelement> superelements;
  MirroredFiles<formats::LoadedModalBody> modal_bodies;
};

SimulatedBody described(const formats::SuperelementBodySpec& spec, Files& files) {
  SimulatedBody body;
  body.kind = spec.rigid ? "rigid" : "superelement";
  body.file = absolute(spec.file);
  body.content_id = files.superelements.at(spec.file, spec.mirror).superelement.content_id;
  return body;
}

SimulatedBody described(const formats::ModalBodySpec& spec, Files& files) {
  SimulatedBody body;
  body.kind = "modal";
  body.file = absolute(spec.file);
  body.content_id = formats::content_id(files.modal_bodies.at(spec.file, spec.mirror).body);
  return body;
}

SimulatedBody described(const formats::RigidBodySpec& spec, Files&) {
  SimulatedBody body;
  body.kind = "rigid";
  body.center_of_mass = spec.center_of_mass;
  return body;
}

SimulatedBody described(const formats::BeamBodySpec&, Files&) {
  SimulatedBody body;
  body.kind = "beam";
  return body;
}

SimulatedBody described(const formats::VirtualBodySpec&, Files&) {
  SimulatedBody body;
  body.kind = "virtual";
  body.mass = body.gyration = 0.0;
  body.center_of_mass.setZero();
  return body;
}

/// Sets masses in the units of the scene, and origins of floating frames, from the model.
void set_masses(const Model& model, const std::map<std::string, SimulatedBody*>& bodies) {
  for (const RigidBody& rigid : model.rigid_bodies) {
    SimulatedBody& body = *bodies.at(rigid.name);
    body.mass = rigid.mass;
    body.gyration = gyration_radius(rigid.inertia, rigid.mass);
    for (const Place& place : model.places)
      if (place.name == rigid.name) body.center_of_mass = -place.marker.p;
  }
  for (const SuperelementUse& use : model.superelements) {
    const SuperelementBody& element = model.superelement_bodies[use.body];
    SimulatedBody& body = *bodies.at(use.name);
    body.mass = element.mass;
    body.origin = element.reference_origin;
    body.center_of_mass = element.reference_origin + element.center_of_mass;
  }
  for (const ModalBody& modal : model.modal_bodies) bodies.at(modal.name)->mass = modal.mass;
}

/// Positions of the nodes in the part frames of their bodies before any motion (3 x places).
Eigen::Matrix3Xd node_references(const formats::Scene& scene, const Model& model, const State& start,
                                 const std::vector<int>& body_of_node) {
  Eigen::Matrix3Xd references(3, static_cast<Eigen::Index>(model.places.size()));
  for (std::size_t i = 0; i < model.places.size(); ++i) {
    const Marker& marker = model.places[i].marker;
    NodeMotion node;
    if (marker.node >= 0) {
      node.x = start.x().col(marker.node);
      node.R = quaternion(start.Q().col(marker.node)).toRotationMatrix();
    }
    formats::Pose part;
    if (body_of_node[i] >= 0)
      part = std::visit([](const auto& one) { return one.start.pose; }, scene.bodies[body_of_node[i]]);
    references.col(static_cast<Eigen::Index>(i)) =
        part.orientation.normalized().conjugate() *
        (to_world(model, marker_position(marker, node)) + model.origin - part.position);
  }
  return references;
}

/// Stored nodes by name, for markers of links.
class StoredNodes {
 public:
  explicit StoredNodes(const Model& model) : model_(model) {
    for (int i = 0; i < std::ssize(model.places); ++i) {
      by_name_[model.places[i].name] = i;
      on_node_.emplace(model.places[i].marker.node, i);
    }
    for (const PlaceAlias& alias : model.place_aliases) by_name_[alias.name] = alias.place;
  }

  /// Marker on a stored node. `name`: the node that the scene names, preferred if it is stored and the marker is on it.
  SimulatedMarker at(const Marker& marker, const std::string& name) const {
    SimulatedMarker found;
    found.position = marker.p;
    found.orientation = Eigen::Quaterniond(marker.R).normalized();
    if (marker.node < 0) {
      found.node = SimulatedMarker::ground;
      found.position = model_.origin + to_world(model_, marker.p);
      found.orientation = Eigen::Quaterniond(to_world(model_, marker.R)).normalized();
      return found;
    }
    const auto named = by_name_.find(name);
    const auto any = on_node_.find(marker.node);
    if (named != by_name_.end() && model_.places[named->second].marker.node == marker.node)
      found.node = named->second;
    else if (any != on_node_.end())
      found.node = any->second;
    else
      return {};
    const Marker& place = model_.places[found.node].marker;
    found.position = place.R.transpose() * (marker.p - place.p);
    found.orientation = Eigen::Quaterniond(place.R.transpose() * marker.R).normalized();
    return found;
  }

 private:
  const Model& model_;
  std::map<std::string, int> by_name_;
  std::map<int, int> on_node_;
};

void add_joints(const formats::Scene& scene, const Model& model, const StoredNodes& nodes,
                std::vector<SimulatedLink>& links) {
  std::map<std::string_view, const formats::JointSpec*> specs;
  for (const formats::JointSpec& spec : scene.joints) specs[spec.name] = &spec;
  const auto add = [&](const std::string& name, JointKind kind, const Marker& a, const Marker& b) {
    const formats::JointSpec& spec = *specs.at(name);
    links.push_back({name, "joint/" + formats::joint_word(kind), {nodes.at(a, spec.a.node), nodes.at(b, spec.b.node)}});
  };
  for (const Joint& joint : model.joints) add(joint.name, joint.kind, joint.a, joint.b);
  for (const Tie& tie : model.ties) add(tie.name, JointKind::fixed, tie.a, tie.b);
}

void add_forces(const formats::Scene& scene, const Model& model, const StoredNodes& nodes,
                std::vector<SimulatedLink>& links) {
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const Coordinate& coordinate = model.coordinates[model.springs[i].coordinate];
    const formats::SpringSpec& spec = scene.springs[i];
    const bool is_line = spec.coordinate ? is_length(coordinate.relation) : spec.kind == formats::SpringKind::line;
    links.push_back({spec.name,
                     is_line ? "spring/line" : "spring/torsion",
                     {nodes.at(coordinate.a, spec.a.node), nodes.at(coordinate.b, spec.b.node)}});
  }
  for (std::size_t i = 0; i < model.bushings.size(); ++i) {
    const formats::BushingSpec& spec = scene.bushings[i];
    links.push_back({spec.name,
                     "bushing",
                     {nodes.at(model.bushings[i].a, spec.a.node), nodes.at(model.bushings[i].b, spec.b.node)}});
  }
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const formats::LoadSpec& spec = scene.loads[i];
    links.push_back({spec.name,
                     fmt::format("load/{}/{}", spec.kind == formats::LoadKind::force ? "force" : "moment",
                                 spec.axes == formats::LoadAxes::body ? "body" : "world"),
                     {nodes.at(model.loads[i].at, spec.at.node), {}}});
  }
  for (std::size_t i = 0; i < model.tyres.size(); ++i)
    links.push_back({model.tyres[i].name, "tyre", {nodes.at(model.tyres[i].wheel, scene.tyres[i].wheel.node), {}}});
}

/// Content identifiers of the files of bodies, by the keys that name them.
std::map<std::string, std::string> body_contents(const formats::Scene& scene, const BodyFiles& files) {
  std::map<std::string, std::string> contents;
  for (const formats::BodySpec& spec : scene.bodies) {
    std::string id;
    if (const auto* element = std::get_if<formats::SuperelementBodySpec>(&spec)) {
      const auto found = files.superelements.find(element->file);
      if (found != files.superelements.end()) id = found->second.superelement.content_id;
      const auto companion = files.companions.find(element->file);
      if (companion != files.companions.end()) id += " " + companion->second.companion_id;
    } else if (const auto* modal = std::get_if<formats::ModalBodySpec>(&spec)) {
      const auto found = files.modal_bodies.find(modal->file);
      if (found != files.modal_bodies.end()) id = formats::content_id(found->second.body);
    }
    const std::string name = std::visit([](const auto& one) { return one.name; }, spec);
    for (const char* key : {"file", "from"}) contents[fmt::format("bodies.{}.{}", name, key)] = id;
  }
  return contents;
}

formats::ContentsOf contents_of(const formats::Scene& scene, const BodyFiles& files) {
  const std::filesystem::path folder = std::filesystem::path(scene.file).parent_path();
  return [bodies = body_contents(scene, files), folder](const std::string& key, const std::string& name) {
    if (const auto body = bodies.find(key); body != bodies.end()) return body->second;
    return key.ends_with(".file") ? sha256_of_file((folder / name).string()) : std::string();
  };
}

}  // namespace

std::string scene_values(const formats::Scene& scene, const BodyFiles& files) {
  if (!scene.tree) return {};
  std::string values = formats::scene_values(*scene.tree, contents_of(scene, files));
  constexpr std::size_t most_bytes = std::size_t{16} << 20U;
  return values.size() <= most_bytes ? values : std::string();
}

std::string scene_text(const formats::Scene& scene, const BodyFiles& files) {
  return scene.tree ? formats::text_with_contents(*scene.tree, contents_of(scene, files)) : std::string();
}

formats::SimulatedScene simulated_scene(const formats::Scene& scene, const BodyFiles& files, const BuiltModel& built,
                                        const State& start) {
  const Model& model = built.model;
  formats::SimulatedScene simulated;
  simulated.analysis = formats::analysis_word(scene.analysis);
  simulated.text = scene_text(scene, files);
  simulated.file = absolute(scene.file);
  simulated.gravity = scene.gravity;
  std::map<std::string, int> index;
  Files read{MirroredFiles(files.superelements), MirroredFiles(files.modal_bodies)};
  for (const formats::BodySpec& spec : scene.bodies) {
    SimulatedBody body = std::visit([&](const auto& one) { return described(one, read); }, spec);
    body.name = std::visit([](const auto& one) { return one.name; }, spec);
    index[body.name] = count_of(simulated.bodies);
    simulated.bodies.push_back(std::move(body));
  }
  std::map<std::string, SimulatedBody*> by_name;
  for (SimulatedBody& body : simulated.bodies) by_name[body.name] = &body;
  set_masses(model, by_name);
  for (const Place& place : model.places) {  // body names in assemblies contain slashes, node names do not
    auto found = index.find(place.name);
    if (found == index.end()) found = index.find(place.name.substr(0, place.name.rfind('/')));
    simulated.body_of_node.push_back(found == index.end() ? -1 : found->second);
  }
  simulated.node_reference = node_references(scene, model, start, simulated.body_of_node);
  const StoredNodes nodes(model);
  add_joints(scene, model, nodes, simulated.links);
  add_forces(scene, model, nodes, simulated.links);
  return simulated;
}

}  // namespace tisserand::mechanism
