// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes with their coordinate systems, and elements by their types.
#include "reducer/decks/abaqus/elements.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "reducer/decks/abaqus/sets.hpp"

namespace tisserand::reducer::abaqus {
namespace {

constexpr std::size_t kMostNodes = 50'000'000;
constexpr std::size_t kMostElements = 50'000'000;

/// Placement of *SYSTEM: x = R x_local + t; without data lines the axes of the part.
Placement read_system(Model& model, const Block& block) {
  Placement system;
  std::array<double, 9> p{};
  const std::span<double> all(p);
  if (block.data.empty()) return system;
  const std::size_t in_first = split(block.data[0].text).size();
  if (!read_numbers(model, block, block.data[0], all.first(6))) return system;
  if (block.data.size() > 1 && !read_numbers(model, block, block.data[1], all.last(3))) return system;
  const Eigen::Vector3d a(p[0], p[1], p[2]), b(p[3], p[4], p[5]), c(p[6], p[7], p[8]);
  system.t = a;
  if (in_first <= 3) return system;
  const Eigen::Vector3d x = (b - a).normalized();
  const Eigen::Vector3d z = x.cross(c - a);
  if (block.data.size() < 2 || !(z.norm() > 1e-9 * (c - a).norm()) || !((b - a).norm() > 0.0)) {
    model.fault("*SYSTEM: its points do not define a plane", block,
                "give the origin a, b on the x axis and, in a second line, c in the x-y plane");
    return system;
  }
  system.R << x, z.normalized().cross(x), z.normalized();
  return system;
}

Eigen::Vector3d from_cylindrical(const Eigen::Vector3d& p) {
  const double angle = p.y() * M_PI / 180.0;
  return {p.x() * std::cos(angle), p.x() * std::sin(angle), p.z()};
}

/// Reads a line of *NODE: id and coordinates; direction cosines after them are ignored.
bool read_node_line(Model& model, const Line& line, long& id, Eigen::Vector3d& position) {
  Fields fields(line.text);
  std::string_view field;
  const std::optional<long> number = fields.next(field) ? to_integer(field) : std::nullopt;
  if (!number || *number <= 0) {
    model.fault(fmt::format("*NODE: '{}' is not a node number", field), line,
                "begin the line with a positive whole number");
    return false;
  }
  id = *number;
  position.setZero();
  for (int k = 0; k < 3 && fields.next(field); ++k) {
    if (field.empty()) continue;
    const std::optional<double> value = to_number(field);
    if (!value) {
      model.fault(fmt::format("node {}: '{}' is not a coordinate", id, field), line, "write a finite number");
      return false;
    }
    position[k] = *value;
  }
  return true;
}

void read_node_block(Model& model, int scope_index, const Block& block, const Placement& system) {
  Scope& scope = model.scopes[scope_index];
  const std::string axes = block.word_of("SYSTEM", "R");
  if (axes != "R" && axes != "C")
    return model.fault(fmt::format("*NODE, SYSTEM={} is not understood", axes), block, "use SYSTEM=R or SYSTEM=C");
  const std::string set = block.name_of("NSET");
  std::vector<int>* members = set.empty() ? nullptr : &scope.node_sets[set];
  const Eigen::Matrix3d R = scope.placement.R * system.R;
  const Eigen::Vector3d t = scope.placement.R * system.t + scope.placement.t;
  if (model.positions.size() + block.data.size() > kMostNodes)
    throw Error(fmt::format("more than {} nodes", kMostNodes), model.where(block),
                "divide the part into several parts");
  scope.nodes.reserve(scope.nodes.size() + block.data.size());
  for (const Line& line : block.data) {
    long id = 0;
    Eigen::Vector3d position;
    if (!read_node_line(model, line, id, position)) continue;
    const int row = count_of(model.positions);
    if (!scope.nodes.try_emplace(id, row).second) {
      model.fault(fmt::format("node {} is defined twice", id), line, "renumber or delete one of them");
      continue;
    }
    model.positions.emplace_back(R * (axes == "C" ? from_cylindrical(position) : position) + t);
    model.node_ids.push_back(id);
    model.node_scopes.push_back(scope_index);
    if (members != nullptr) members->push_back(row);
  }
}

/// Elements from the fields of *ELEMENT lines; an incomplete line continues in the next one.
class ElementBlock {
 public:
  ElementBlock(Model& model, int scope_index, const Block& block, const ElementType& type)
      : model_(model), scope_index_(scope_index), block_(block), type_(type) {}

  void read() {
    if (model_.elements.size() + block_.data.size() > kMostElements)
      throw Error(fmt::format("more than {} elements", kMostElements), model_.where(block_),
                  "divide the part into several parts");
    scope().elements.reserve(scope().elements.size() + block_.data.size());
    for (const Line& line : block_.data) read_line(line);
    if (is_open_) too_few(*last_line_);
  }

 private:
  Scope& scope() { return model_.scopes[scope_index_]; }

  void read_line(const Line& line) {
    last_line_ = &line;
    Fields fields(line.text);
    for (std::string_view field; fields.next(field);) {
      if (!is_open_)
        begin(line, field);
      else
        add_node(line, field);
    }
    if (is_open_ && found_ >= type_.nodes) finish(line);
  }

  void begin(const Line& line, std::string_view field) {
    const std::optional<long> id = to_integer(field);
    is_open_ = true;
    is_sound_ = id && *id > 0;
    found_ = 0;
    if (!is_sound_)
      model_.fault(fmt::format("*ELEMENT: '{}' is not an element number", field), line,
                   "begin the line with a positive whole number");
    element_ = {};
    element_.id = id.value_or(0);
    element_.type = &type_;
    element_.first = model_.connectivity.size();
    element_.scope = scope_index_;
    element_.file = line.file;
    element_.line = line.number;
  }

  void add_node(const Line& line, std::string_view field) {
    ++found_;
    const std::optional<int> node = find_node(model_, scope_index_, field);
    if (node)
      model_.connectivity.push_back(*node);
    else if (is_sound_)
      model_.fault(fmt::format("element {}: node '{}' does not exist", element_.id, field), line,
                   "define it with *NODE or correct the number");
    is_sound_ = is_sound_ && node;
  }

  void finish(const Line& line) {
    is_open_ = false;
    const int most = type_.nodes + (type_.kind == ElementKind::beam ? 1 : 0);
    if (is_sound_ && found_ > most) {
      model_.fault(
          fmt::format("element {} names {} nodes, but type {} has {}", element_.id, found_, type_.name, type_.nodes),
          line, "correct the type or the nodes");
      is_sound_ = false;
    }
    if (is_sound_) is_sound_ = is_new(line);
    if (!is_sound_) {
      model_.connectivity.resize(element_.first);
      return;
    }
    element_.count = found_;
    const int row = add_row(model_.elements, element_);
    scope().elements.emplace(element_.id, row);
    if (const std::string set = block_.name_of("ELSET"); !set.empty()) scope().element_sets[set].push_back(row);
  }

  bool is_new(const Line& line) {
    const auto other = scope().elements.find(element_.id);
    if (other == scope().elements.end()) return true;
    model_.fault(fmt::format("element {} is defined twice, first at {}", element_.id,
                             model_.where(model_.elements[other->second])),
                 line, "renumber or delete one of them");
    return false;
  }

  void too_few(const Line& line) {
    model_.fault(fmt::format("element {} names only {} of the {} nodes of type {}", element_.id, found_, type_.nodes,
                             type_.name),
                 line, "give all nodes; is the file truncated?");
    model_.connectivity.resize(element_.first);
  }

  Model& model_;
  int scope_index_;
  const Block& block_;
  const ElementType& type_;
  RawElement element_;
  const Line* last_line_ = nullptr;
  int found_ = 0;
  bool is_open_ = false;
  bool is_sound_ = false;
};

void read_element_block(Model& model, int scope, const Block& block) {
  const std::string* name = block.find("TYPE");
  if (name == nullptr) return model.fault("*ELEMENT without TYPE", block, "write *ELEMENT, TYPE=...");
  const std::string type_name = upper_without_blanks(*name);
  const RefusedType refused = refused_type(type_name);
  if (!refused.why.empty()) {
    model.fault(fmt::format("*ELEMENT, TYPE={}: {}", type_name, refused.why), block, refused.remedy);
    model.has_unknown_elements = true;
    return;
  }
  const ElementType* type = find_element_type(type_name);
  if (type == nullptr) {
    model.unknown[fmt::format("*ELEMENT, TYPE={}", type_name.substr(0, 20))] += static_cast<long>(block.data.size());
    model.has_unknown_elements = true;
    return;
  }
  ElementBlock(model, scope, block, *type).read();
}

}  // namespace

void read_nodes(Model& model, int scope) {
  Placement system;
  for (const Block* block : model.scopes[scope].blocks) {
    if (block->keyword == "SYSTEM") system = read_system(model, *block);
    if (block->keyword == "NODE") read_node_block(model, scope, *block, system);
  }
}

void read_elements(Model& model, int scope) {
  for (const Block* block : model.scopes[scope].blocks)
    if (block->keyword == "ELEMENT") read_element_block(model, scope, *block);
}

}  // namespace tisserand::reducer::abaqus
