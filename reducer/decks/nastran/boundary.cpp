// SPDX-License-Identifier: GPL-3.0-or-later
// Attachments, boundary and supports of the nodes of a Nastran deck.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/text.hpp"
#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

constexpr double drilling_cosine = 0.985;  // 10 degrees: the decks' program holds this rotation in flat shells

void attach(std::vector<Components>& attached, int node, Components components) {
  Components& of_node = attached[node];
  of_node = static_cast<Components>(of_node | components);
}

/// Components with entries in a block: translations, and rotations, each all or none.
Components of_block(const Eigen::Matrix<double, 6, 6>& block) {
  Components result = 0;
  if (block.diagonal().head<3>().cwiseAbs().maxCoeff() > 0.0) result |= translations_only;
  if (block.diagonal().tail<3>().cwiseAbs().maxCoeff() > 0.0) result |= rotations_only;
  return result;
}

void attach_spider(std::vector<Components>& attached, const Spider& spider) {
  attach(attached, spider.reference, spider.kind == SpiderKind::rigid ? all_components : spider.reference_components);
  for (const int node : spider.nodes) attach(attached, node, spider.node_components);
}

/// Boundary components of all nodes that cards name, in the order of the deck.
class Boundary {
 public:
  explicit Boundary(NastranModel& model) : model_(model) {}

  void add(CardFields& f, int node, Components components) {
    if (node < 0 || !f.ok()) return;
    if (components == 0) return f.fault("components are blank", "give 123, 456 or 123456");
    const auto [at, fresh] = place_.try_emplace(node, nodes_.size());
    if (fresh) nodes_.push_back({node, components, model_.row(f)});
    if (!fresh) nodes_[at->second].components = static_cast<Components>(nodes_[at->second].components | components);
  }

  const std::vector<HeldNode>& nodes() const { return nodes_; }

 private:
  NastranModel& model_;
  std::vector<HeldNode> nodes_;
  std::map<int, std::size_t> place_;
};

/// Reads ID1, C1, ID2, C2, ...
void read_pairs(NastranModel& model, CardFields& f, Boundary& boundary) {
  for (int i = 0; i < f.size() && f.ok(); i += 2) {
    if (f.blank(i)) continue;
    const int node = model.node(f, i, "ID");
    boundary.add(f, node, f.components(i + 1, "C", 0));
  }
}

/// Reads C, ID1, ID2, ... or C, ID1, THRU, ID2.
void read_list(NastranModel& model, CardFields& f, Boundary& boundary) {
  const Components components = f.components(0, "C", 0);
  for (const long id : f.id_list(1, "ID", KnownGrids{model.grid_rows}))
    boundary.add(f, model.node_of(f, id, "ID"), components);
}

/// Directions (part axes) of the rotations among `components`, given in axes of CD.
std::vector<Eigen::Vector3d> rotation_axes(const NastranModel& model, int node, Components components) {
  std::vector<Eigen::Vector3d> axes;
  const Eigen::Matrix3d frame = model.displacement_axes(node);
  for (int i = 0; i < 3; ++i)
    if ((components & (1u << (3 + i))) != 0) axes.emplace_back(frame.col(i));
  return axes;
}

/// Normals of the shells at the nodes of `wanted`; nodes with rotations of other elements are omitted.
std::map<int, std::vector<Eigen::Vector3d>> shell_normals(const NastranModel& model, const std::set<int>& wanted) {
  const Mesh& mesh = model.deck.mesh;
  Mesh others;  // all except the shells
  others.position = mesh.position;
  others.beams = mesh.beams;
  others.beam_properties = mesh.beam_properties;
  others.springs = mesh.springs;
  others.masses = mesh.masses;
  others.spiders = mesh.spiders;
  others.equations = mesh.equations;
  const std::vector<Components> turned = attachments(others);
  std::map<int, std::vector<Eigen::Vector3d>> normals;
  for (const ShellElement& shell : mesh.shells)
    for (const int node : nodes_of(shell)) {
      if (!wanted.contains(node) || (turned[node] & rotations_only) != 0) continue;
      normals[node].push_back(normal_of(mesh, shell).normalized());
    }
  return normals;
}

/// Removes from held.components those without attachments; the remaining ones hold the part.
void drop_idle(const NastranModel& model, const std::vector<Components>& attached,
               const std::map<int, std::vector<Eigen::Vector3d>>& normals, HeldNode& held) {
  const Components present = attached[held.node];
  Components left = held.components;
  if ((present & translations_only) == 0) left &= rotations_only;
  if ((present & rotations_only) == 0) left &= translations_only;
  const auto shells = normals.find(held.node);
  if (shells != normals.end())
    for (int i = 3; i < 6; ++i) {
      const auto bit = static_cast<Components>(1u << i);
      if ((left & bit) == 0) continue;
      const Eigen::Vector3d axis = rotation_axes(model, held.node, bit).front();
      const bool drilling = std::all_of(shells->second.begin(), shells->second.end(), [&](const Eigen::Vector3d& n) {
        return std::abs(n.dot(axis)) > drilling_cosine;
      });
      if (drilling) left = static_cast<Components>(left & ~bit);
    }
  held.components = left;
}

void read_held(NastranModel& model) {
  model.for_each("SPC", [&](CardFields& f) {
    if (!model.holds(f, "SPC")) return;
    for (int i = 1; i < 7 && f.ok(); i += 3) {
      if (f.blank(i)) continue;
      const int node = model.node(f, i, "G");
      const Components components = f.components(i + 1, "C", 0);
      if (f.ok()) model.held.push_back({node, components, model.row(f)});
    }
  });
  model.for_each("SPC1", [&](CardFields& f) {
    if (!model.holds(f, "SPC")) return;
    const Components components = f.components(1, "C", 0);
    for (const long id : f.id_list(2, "G", KnownGrids{model.grid_rows})) {
      const int node = model.node_of(f, id, "G");
      if (node >= 0) model.held.push_back({node, components, model.row(f)});
    }
  });
  for (int i = 0; i < std::ssize(model.fixed); ++i)
    if (model.fixed[i] != 0) model.held.push_back({i, model.fixed[i], model.grid_card[i]});
}

std::string digits(Components components) {
  std::string text;
  for (int i = 0; i < 6; ++i)
    if ((components & (1u << i)) != 0) text += static_cast<char>('1' + i);
  return text;
}

}  // namespace

std::vector<Components> attachments(const Mesh& mesh) {
  std::vector<Components> attached(static_cast<std::size_t>(mesh.nodes()), 0);
  for (const BeamElement& beam : mesh.beams) {
    const formats::Section& s = mesh.beam_properties[beam.property].data.section;
    const bool turns = s.second_moment_y > 0.0 || s.second_moment_z > 0.0 || s.torsion_constant > 0.0;
    for (const int node : {beam.first, beam.second}) attach(attached, node, turns ? all_components : translations_only);
  }
  for (const ShellElement& shell : mesh.shells)
    for (const int node : nodes_of(shell)) attach(attached, node, all_components);
  for (const SolidElement& solid : mesh.solids)
    for (const int node : nodes_of(solid)) attach(attached, node, translations_only);
  for (const Spring& spring : mesh.springs) {
    attach(attached, spring.first, of_block(spring.stiffness.topLeftCorner<6, 6>()));
    attach(attached, spring.second, of_block(spring.stiffness.bottomRightCorner<6, 6>()));
  }
  for (const NodalMass& mass : mesh.masses) {
    const bool turns = !mass.inertia.isZero(0.0) || !mass.offset.isZero(0.0);
    attach(attached, mass.node, turns ? all_components : translations_only);
  }
  for (const Spider& spider : mesh.spiders) attach_spider(attached, spider);
  for (const TieEquation& equation : mesh.equations)
    for (const TieTerm& term : equation.terms)
      attach(attached, term.node, term.component < 3 ? translations_only : rotations_only);
  return attached;
}

void add_boundary(NastranModel& model) {
  Boundary boundary(model);
  for (const char* name : {"ASET", "BSET", "BNDFIX"})
    model.for_each(name, [&](CardFields& f) { read_pairs(model, f, boundary); });
  for (const char* name : {"ASET1", "BSET1", "BNDFIX1"})
    model.for_each(name, [&](CardFields& f) { read_list(model, f, boundary); });
  const std::vector<Components> attached = attachments(model.deck.mesh);
  for (const HeldNode& entry : boundary.nodes()) {
    const long id = model.grid_id[entry.node];
    Components c = entry.components;
    CardFields f = model.card(entry.card);
    if (c != translations_only && c != rotations_only && c != all_components) {
      f.fault(fmt::format("GRID {}: components {} alone cannot be boundary coordinates", id, digits(c)),
              "give 123, 456 or 123456");
      continue;
    }
    if ((c & rotations_only) != 0 && (attached[entry.node] & rotations_only) == 0) {
      model.remarks.add("boundary rotations without stiffness and mass are ignored at GRID", std::to_string(id));
      c &= translations_only;
    }
    if (model.displacement_frame[entry.node] != 0)
      model.remarks.add("boundary coordinates have the axes of the part, not those of CD, at GRID", std::to_string(id));
    if (c != 0)
      model.deck.mesh.boundary.push_back(
          {fmt::format("node_{}", id), entry.node, (c & translations_only) != 0, (c & rotations_only) != 0});
  }
}

void judge_supports(NastranModel& model) {
  read_held(model);
  if (model.held.empty()) return;
  std::set<int> wanted;
  for (const HeldNode& held : model.held)
    if ((held.components & rotations_only) != 0) wanted.insert(held.node);
  const auto normals = shell_normals(model, wanted);
  const std::vector<Components> attached = attachments(model.deck.mesh);
  struct Support {
    std::vector<std::string> nodes;
    std::size_t number = 0;
  };
  std::map<std::size_t, Support> supports;  // key: card
  for (const HeldNode& entry : model.held) {
    HeldNode held = entry;
    drop_idle(model, attached, normals, held);
    const long id = model.grid_id[held.node];
    if (held.components == 0) {
      model.remarks.add("supports of components without stiffness and mass are ignored at GRID",
                        fmt::format("{} ({})", id, digits(entry.components)));
      continue;
    }
    Support& support = supports[entry.card];
    if (++support.number <= 10) support.nodes.push_back(fmt::format("{} ({})", id, digits(held.components)));
  }
  for (const auto& [card, support] : supports) {
    CardFields f = model.card(card);
    f.fault(fmt::format("fixes GRID {} to the ground", listed(support.nodes, ", ", support.number)),
            "a superelement has no supports: define the support in the scene");
  }
}

}  // namespace tisserand::reducer
