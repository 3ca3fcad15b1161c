// SPDX-License-Identifier: GPL-3.0-or-later
// *PART, *INSTANCE, *ASSEMBLY and *STEP.
#include "reducer/decks/abaqus/scopes.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "reducer/decks/abaqus/keywords.hpp"

namespace tisserand::reducer::abaqus {
namespace {

struct Part {
  std::vector<const Block*> blocks;
  bool is_used = false;
};

/// Placement: translation first, then rotation about the line from a to b: x = a + Q (x_part + t − a).
Placement read_placement(Model& model, const Block& block) {
  Placement placement;
  if (!block.data.empty()) {
    std::array<double, 3> t{};
    if (read_numbers(model, block, block.data[0], t)) placement.t = {t[0], t[1], t[2]};
  }
  if (block.data.size() > 1) {
    std::array<double, 7> turn{};
    if (!read_numbers(model, block, block.data[1], turn)) return placement;
    const Eigen::Vector3d a(turn[0], turn[1], turn[2]), b(turn[3], turn[4], turn[5]);
    if (!((b - a).norm() > 0.0)) {
      model.fault("*INSTANCE: the two points of the axis of rotation coincide", block.data[1],
                  "give two different points and the angle in degrees");
      return placement;
    }
    placement.R = Eigen::AngleAxisd(turn[6] * M_PI / 180.0, (b - a).normalized()).toRotationMatrix();
    placement.t = a + placement.R * (placement.t - a);
  }
  return placement;
}

void count_keyword(Model& model, const Block& block) {
  const std::optional<KeywordRole> role = keyword_role(block.keyword);
  if (!role) ++model.unknown[block.title];
  if (role == KeywordRole::skipped) ++model.skipped[block.title];
}

/// Sorts the blocks in one pass; `inside_` is the list that receives the present ones.
class Sorter {
 public:
  explicit Sorter(Model& model) : model_(model) { model_.scopes.emplace_back(); }

  void run() {
    for (const Block& block : model_.input.blocks) take(block);
    if (part_ != nullptr || instance_ >= 0 || in_step_)
      model_.fault(fmt::format("the deck ends inside {}", in_step_           ? "*STEP"
                                                          : part_ != nullptr ? "*PART"
                                                                             : "*INSTANCE"),
                   model_.input.paths[0], "is the file truncated? add the missing *END ... keyword");
    for (const auto& [name, part] : parts_)
      if (!part.is_used) model_.deck.mesh.warnings.push_back(fmt::format("part '{}' has no instance", name));
  }

 private:
  void take(const Block& block) {
    if (block.keyword == "STEP") {
      in_step_ = true;
    } else if (block.keyword == "ENDSTEP") {
      in_step_ = false;
    } else if (in_step_) {
      model_.steps.push_back(&block);
    } else if (block.keyword == "PART") {
      begin_part(block);
    } else if (block.keyword == "ENDPART") {
      part_ = nullptr;
    } else if (block.keyword == "INSTANCE") {
      begin_instance(block);
    } else if (block.keyword == "ENDINSTANCE") {
      instance_ = -1;
    } else {
      count_keyword(model_, block);
      if (part_ != nullptr)
        part_->blocks.push_back(&block);
      else
        model_.scopes[std::max(instance_, 0)].blocks.push_back(&block);
    }
  }

  void begin_part(const Block& block) {
    const std::string name = block.name_of("NAME");
    const auto [entry, is_new] = parts_.try_emplace(name);
    if (name.empty() || !is_new)
      model_.fault(fmt::format("*PART '{}' {}", name, name.empty() ? "has no name" : "exists twice"), block,
                   "give every part a name of its own: *PART, NAME=...");
    part_ = &entry->second;
  }

  void begin_instance(const Block& block) {
    Scope scope;
    scope.name = block.name_of("NAME");
    const std::string part = block.name_of("PART");
    for (const Scope& other : model_.scopes)
      if (scope.name == other.name)
        model_.fault(fmt::format("*INSTANCE '{}' {}", scope.name, scope.name.empty() ? "has no name" : "exists twice"),
                     block, "give every instance a name of its own: *INSTANCE, NAME=...");
    const auto found = parts_.find(part);
    if (found == parts_.end()) {
      model_.fault(fmt::format("*INSTANCE '{}': there is no part '{}'", scope.name, part), block,
                   "define the part before its instance, with *PART, NAME=...");
    } else {
      scope.blocks = found->second.blocks;
      found->second.is_used = true;
    }
    scope.placement = read_placement(model_, block);
    instance_ = add_row(model_.scopes, std::move(scope));
  }

  Model& model_;
  std::map<std::string, Part> parts_;
  Part* part_ = nullptr;
  int instance_ = -1;
  bool in_step_ = false;
};

}  // namespace

void sort_into_scopes(Model& model) { Sorter(model).run(); }

}  // namespace tisserand::reducer::abaqus
