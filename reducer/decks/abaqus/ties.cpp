// SPDX-License-Identifier: GPL-3.0-or-later
// Spiders from couplings, rigid bodies and MPCs.
#include "reducer/decks/abaqus/ties.hpp"

#include <fmt/format.h>

#include "reducer/decks/abaqus/sets.hpp"
#include "reducer/decks/abaqus/surfaces.hpp"

namespace tisserand::reducer::abaqus {
namespace {

/// Directions of the components of a coupling; empty, with a fault, if its orientation cannot be used.
std::optional<Eigen::Matrix3d> coupling_axes(Model& model, int scope, const Block& block) {
  const std::string* name = block.find("ORIENTATION");
  if (name == nullptr) return Eigen::Matrix3d::Identity();
  const std::string where = model.where(block);
  const Orientation* orientation = find_orientation(model, scope, *name, where);
  if (orientation == nullptr) return std::nullopt;
  if (orientation->is_rectangular) return orientation->axes;
  return model.refuse(fmt::format("orientation '{}' is not rectangular with DEFINITION=COORDINATES", *name),
                      orientation->where, "give rectangular axes");
}

/// Components of all data lines together; all six without data lines.
std::optional<Components> components_of(Model& model, const Block& block, std::size_t field) {
  Components result = block.data.empty() ? all_components : 0;
  for (const Line& line : block.data) {
    const std::optional<Components> some = read_components(model, line, field);
    if (!some) return std::nullopt;
    result = static_cast<Components>(result | *some);
  }
  return result;
}

/// Adds a spider with the nodes except the reference; a fault if none remains.
void add_spider(Model& model, const Block& block, Spider spider, const std::vector<int>& nodes) {
  for (const int node : nodes)
    if (node != spider.reference) spider.nodes.push_back(node);
  if (spider.nodes.empty())
    model.fault(fmt::format("{} '{}' connects no nodes", block.title, spider.name), block,
                "check its surface or its set");
  else
    model.deck.mesh.spiders.push_back(std::move(spider));
}

void remove_distant(const Model& model, const Block& block, int reference, std::map<int, double>& weights) {
  const std::string* text = block.find("INFLUENCERADIUS");
  const std::optional<double> radius = text == nullptr ? std::nullopt : to_number(*text);
  if (!radius) return;
  const Eigen::Vector3d& center = model.positions[reference];
  std::erase_if(weights, [&](const auto& entry) { return (model.positions[entry.first] - center).norm() > *radius; });
}

void make_distributing(Model& model, const Block& block, const Block& kind, Spider spider,
                       const std::map<int, double>& weights) {
  const std::string* method = kind.find("WEIGHTINGMETHOD");
  if (method != nullptr && upper_without_blanks(*method) != "UNIFORM")
    return model.fault(fmt::format("*DISTRIBUTING, WEIGHTING METHOD={} is not understood", *method), kind,
                       "use UNIFORM, which takes weights from areas");
  const std::optional<Components> components = components_of(model, kind, 0);
  if (!components) return;
  spider.kind = SpiderKind::averaging;
  spider.node_components = translations_only;
  spider.reference_components = static_cast<Components>(*components | translations_only);
  const std::string* coupling = kind.find("COUPLING");
  if (coupling != nullptr && upper_without_blanks(*coupling) == "STRUCTURAL") spider.node_components = all_components;
  for (const auto& [node, weight] : weights) {
    if (node == spider.reference || !(weight > 0.0)) continue;
    spider.nodes.push_back(node);
    spider.weight.push_back(weight);
  }
  add_spider(model, block, std::move(spider), {});
}

/// Reads the coupling block at `index`; *KINEMATIC or *DISTRIBUTING is the next one.
void read_coupling(Model& model, int scope, std::size_t index) {
  const std::vector<const Block*>& blocks = model.scopes[scope].blocks;
  const Block& block = *blocks[index];
  const std::string where = model.where(block);
  const Block* kind = index + 1 < blocks.size() ? blocks[index + 1] : nullptr;
  if (kind == nullptr || (kind->keyword != "KINEMATIC" && kind->keyword != "DISTRIBUTING"))
    return model.fault("*COUPLING without *KINEMATIC or *DISTRIBUTING", where, "write one of them directly after it");
  const std::optional<int> reference = find_one_node(model, scope, block.name_of("REFNODE"), where);
  const Surface* surface = find_surface(model, scope, block.name_of("SURFACE"), where);
  const std::optional<Eigen::Matrix3d> axes = coupling_axes(model, scope, block);
  if (!reference || surface == nullptr || !axes) return;
  Spider spider;
  spider.reference = *reference;
  spider.axes = *axes;
  spider.name = block.name_of("CONSTRAINTNAME");
  std::map<int, double> weights = surface_weights(model, *surface);
  remove_distant(model, block, *reference, weights);
  if (kind->keyword == "DISTRIBUTING") {
    make_distributing(model, block, *kind, std::move(spider), weights);
    return;
  }
  const std::optional<Components> components = components_of(model, *kind, 0);
  if (!components) return;
  spider.node_components = *components;
  std::vector<int> nodes;
  for (const auto& [node, weight] : weights) nodes.push_back(node);
  add_spider(model, block, std::move(spider), nodes);
}

/// Reads the older form, in which every data line has its own nodes and components.
void read_kinematic_coupling(Model& model, int scope, const Block& block) {
  const std::optional<int> reference = find_one_node(model, scope, block.name_of("REFNODE"), model.where(block));
  const std::optional<Eigen::Matrix3d> axes = coupling_axes(model, scope, block);
  if (!reference || !axes) return;
  for (const Line& line : block.data) {
    const std::vector<std::string_view> fields = split(line.text);
    if (fields.empty()) continue;
    const auto nodes = find_nodes(model, scope, fields[0], model.where(line));
    const std::optional<Components> components = read_components(model, line, 1);
    if (!nodes || !components) continue;
    Spider spider;
    spider.reference = *reference;
    spider.axes = *axes;
    spider.node_components = *components;
    spider.name = lower(fields[0]);
    add_spider(model, block, std::move(spider), *nodes);
  }
}

/// Nodes of the elements of a set; those of solids follow with translations, their only components.
std::vector<int> nodes_of_elements(const Model& model, const std::vector<int>& elements) {
  std::vector<int> nodes;
  add_nodes_of(model, elements, nodes);
  unify(nodes);
  return nodes;
}

void read_rigid_body(Model& model, int scope, const Block& block) {
  const std::string where = model.where(block);
  const std::optional<int> reference = find_one_node(model, scope, block.name_of("REFNODE"), where);
  if (!reference) return;
  if (const std::string* position = block.find("POSITION");
      position != nullptr && upper_without_blanks(*position) != "INPUT")
    return model.fault(fmt::format("*RIGID BODY, POSITION={} is not understood", *position), where,
                       "place the reference node with *NODE");
  if (block.find("ROTNODE") != nullptr)
    model.deck.mesh.warnings.push_back(
        fmt::format("{}: ROT NODE is not used: the reference node carries the rotations", where));
  const std::size_t before = model.deck.mesh.spiders.size();
  const auto add = [&](const std::vector<int>& nodes, Components components, const std::string& name) {
    Spider spider;
    spider.reference = *reference;
    spider.node_components = components;
    spider.name = name;
    add_spider(model, block, std::move(spider), nodes);
  };
  bool has_nodes = false;
  for (const char* parameter : {"NSET", "TIENSET", "PINNSET"}) {
    const std::string name = block.name_of(parameter);
    if (name.empty()) continue;
    has_nodes = true;
    if (const auto nodes = find_nodes(model, scope, name, where))
      add(*nodes, parameter == std::string_view("PINNSET") ? translations_only : all_components, name);
  }
  if (const std::string name = block.name_of("ELSET"); !name.empty()) {
    has_nodes = true;
    if (const auto elements = find_elements(model, scope, name, where))
      add(nodes_of_elements(model, *elements), all_components, name);
  }
  if (!has_nodes && model.deck.mesh.spiders.size() == before)
    model.fault("*RIGID BODY connects no nodes", where, "give ELSET, TIE NSET or PIN NSET");
}

struct MpcKind {
  Components components;
  bool must_coincide;
};
std::optional<MpcKind> mpc_kind(std::string_view word) {
  const std::string name = upper_without_blanks(word);
  if (name == "BEAM") return MpcKind{all_components, false};
  if (name == "TIE") return MpcKind{all_components, true};
  if (name == "PIN") return MpcKind{translations_only, true};
  return std::nullopt;
}

void read_mpc_pair(Model& model, const Block& block, const Line& line, const MpcKind& kind,
                   const std::array<int, 2>& pair) {
  const double distance = (model.positions[pair[0]] - model.positions[pair[1]]).norm();
  const double size = model.positions[pair[1]].norm() + distance;
  if (kind.must_coincide && distance > 1e-6 * size)
    return model.fault(fmt::format("*MPC: {} and {} are {:.6g} apart: equal displacements would prevent rotation of "
                                   "the part",
                                   model.node_text(pair[0]), model.node_text(pair[1]), distance),
                       line, "use BEAM, or place both nodes at the same point");
  Spider spider;
  spider.reference = pair[1];
  spider.node_components = kind.components;
  spider.name = fmt::format("mpc of {}", model.node_text(pair[0]));
  add_spider(model, block, std::move(spider), {pair[0]});
}

/// Reads type, dependent node or set, and reference node or set of equal size.
void read_mpc(Model& model, int scope, const Block& block) {
  for (const Line& line : block.data) {
    const std::vector<std::string_view> fields = split(line.text);
    const std::string where = model.where(line);
    const std::optional<MpcKind> kind = fields.empty() ? std::nullopt : mpc_kind(fields[0]);
    if (!kind || fields.size() != 3) {
      model.fault(fmt::format("*MPC: '{}' is not understood", line.text.substr(0, 60)), where,
                  "write BEAM, TIE or PIN and two nodes or sets");
      continue;
    }
    const auto dependent = find_nodes(model, scope, fields[1], where);
    const auto reference = find_nodes(model, scope, fields[2], where);
    if (!dependent || !reference) continue;
    if (reference->size() != 1 && reference->size() != dependent->size()) {
      model.fault(fmt::format("*MPC: {} dependent nodes, but {} reference nodes", dependent->size(), reference->size()),
                  where, "give one reference node, or as many reference nodes as dependent nodes");
      continue;
    }
    for (std::size_t i = 0; i < dependent->size(); ++i)
      read_mpc_pair(model, block, line, *kind, {(*dependent)[i], (*reference)[reference->size() == 1 ? 0 : i]});
  }
}

}  // namespace

std::optional<Components> read_components(Model& model, const Line& line, std::size_t field) {
  const std::vector<std::string_view> fields = split(line.text);
  const auto blank = [&](std::size_t k) { return k >= fields.size() || fields[k].empty(); };
  if (blank(field) && blank(field + 1)) return all_components;
  const std::optional<long> first = blank(field) ? std::nullopt : to_integer(fields[field]);
  const std::optional<long> last = blank(field + 1) ? first : to_integer(fields[field + 1]);
  if (!first || !last || *first < 1 || *last > 6 || *first > *last)
    return model.refuse(fmt::format("'{}' does not name degrees of freedom", line.text.substr(0, 60)), line,
                        "write the first and the last degree of freedom, from 1 to 6");
  Components result = 0;
  for (long k = *first; k <= *last; ++k) result = static_cast<Components>(result | (1 << (k - 1)));
  return result;
}

std::optional<int> find_one_node(Model& model, int scope, std::string_view text, const std::string& where) {
  const auto nodes = find_nodes(model, scope, text, where);
  if (!nodes) return std::nullopt;
  if (nodes->size() == 1) return nodes->front();
  return model.refuse(fmt::format("set '{}' has {} nodes, expected one", text, nodes->size()), where,
                      "name a single node, or a set of one node");
}

void read_ties(Model& model, int scope) {
  const std::vector<const Block*>& blocks = model.scopes[scope].blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Block& block = *blocks[i];
    if (block.keyword == "COUPLING") read_coupling(model, scope, i);
    if (block.keyword == "KINEMATICCOUPLING") read_kinematic_coupling(model, scope, block);
    if (block.keyword == "RIGIDBODY") read_rigid_body(model, scope, block);
    if (block.keyword == "MPC") read_mpc(model, scope, block);
    if (block.keyword == "EQUATION") read_equation(model, scope, block);
  }
}

}  // namespace tisserand::reducer::abaqus
