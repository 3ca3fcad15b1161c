// SPDX-License-Identifier: GPL-3.0-or-later
// Spiders and equations of the mesh from RBE1, RBE2, RBE3, RBAR and MPC of a Nastran deck.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "common/stable_sort.hpp"
#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

/// Whether the components are independent of the axes: all or none of the translations, and of the rotations.
bool free_of_axes(Components c) {
  const int t = c & translations_only, r = c & rotations_only;
  return (t == 0 || t == translations_only) && (r == 0 || r == rotations_only);
}

struct Follower {
  int node = 0;
  Components components = all_components;
};

/// Adds rigid spiders from `reference`, one per run of followers with the same components in the same axes (CD).
void add_rigid(NastranModel& model, CardFields& f, int reference, const std::vector<Follower>& followers) {
  if (!f.ok()) return;
  if (followers.empty()) return f.fault("there are no dependent grid points", "name at least one");
  std::vector<Spider> spiders;
  for (const Follower& follower : followers) {
    if (follower.node == reference)
      return f.fault(fmt::format("GRID {} depends on itself", model.grid_id[reference]),
                     "remove it from the dependent grid points");
    const Eigen::Matrix3d axes =
        free_of_axes(follower.components) ? Eigen::Matrix3d::Identity() : model.displacement_axes(follower.node);
    if (spiders.empty() || spiders.back().node_components != follower.components ||
        !spiders.back().axes.isApprox(axes, 1e-12)) {
      Spider spider;
      spider.reference = reference;
      spider.node_components = follower.components;
      spider.axes = axes;
      spider.name = f.label();
      spiders.push_back(spider);
    }
    spiders.back().nodes.push_back(follower.node);
  }
  for (Spider& spider : spiders) model.deck.mesh.spiders.push_back(std::move(spider));
}

/// Reads EID, GN, CM, GM1, GM2, ..., thermal expansion (a real number at the end).
void add_rbe2(NastranModel& model, CardFields& f) {
  model.element_id(f);
  const int reference = model.node(f, 1, "GN");
  const Components components = f.components(2, "CM", 0);
  if (f.ok() && components == 0) f.fault("CM is blank", "give the dependent components");
  std::vector<Follower> followers;
  for (int i = 3; i < f.size() && f.ok(); ++i) {
    if (f.blank(i)) continue;
    if (is_real(f.text(i))) break;
    if (same_word(f.text(i + 1), "THRU")) {
      std::vector<long> ids;
      KnownGrids{model.grid_rows}(f.id(i, "GM"), f.id(i + 2, "GM"), ids);
      for (const long id : ids) followers.push_back({model.node_of(f, id, "GM"), components});
      i += 2;
    } else {
      followers.push_back({model.node(f, i, "GM"), components});
    }
  }
  add_rigid(model, f, reference, followers);
}

/// Reads EID, GA, GB, CNA, CNB, CMA, CMB: one end must be independent with all six components.
void add_rbar(NastranModel& model, CardFields& f) {
  model.element_id(f);
  const int a = model.node(f, 1, "GA"), b = model.node(f, 2, "GB");
  const Components CNA = f.components(3, "CNA", 0), CNB = f.components(4, "CNB", 0);
  const Components CMA = f.components(5, "CMA", 0), CMB = f.components(6, "CMB", 0);
  if (!f.ok()) return;
  const auto all_if_none = [](Components c) { return c == 0 ? all_components : c; };
  if (CNA == all_components && CNB == 0 && CMA == 0) return add_rigid(model, f, a, {{b, all_if_none(CMB)}});
  if (CNB == all_components && CNA == 0 && CMB == 0) return add_rigid(model, f, b, {{a, all_if_none(CMA)}});
  f.fault("independent components on both ends are not understood", "give CNA or CNB as 123456");
}

/// Reads EID, pairs of independent points, "UM", pairs of dependent points; one independent point with all components.
void add_rbe1(NastranModel& model, CardFields& f) {
  model.element_id(f);
  std::vector<Follower> leaders, followers;
  bool dependent = false;
  for (int i = 1; i < f.size() && f.ok(); ++i) {
    if (f.blank(i)) continue;
    if (same_word(f.text(i), "ALPHA") || is_real(f.text(i))) break;
    if (same_word(f.text(i), "UM")) {
      dependent = true;
      continue;
    }
    const int node = model.node(f, i, "G");
    const Components components = f.components(i + 1, "C", 0);
    if (f.ok() && components == 0) f.fault("the components of a grid point are blank", "give its components");
    (dependent ? followers : leaders).push_back({node, components});
    ++i;
  }
  if (!f.ok()) return;
  if (leaders.size() != 1 || leaders.front().components != all_components)
    return f.fault("independent components at several grid points are not understood", "use RBE2");
  add_rigid(model, f, leaders.front().node, followers);
}

struct AveragingGroups {
  std::vector<int> nodes;
  std::vector<double> weight;
  Components components = 0;
};

/// Reads from field 4 on: weight (real), components, grid points, the next weight; up to UM or ALPHA.
AveragingGroups read_groups(NastranModel& model, CardFields& f) {
  AveragingGroups groups;
  std::unordered_map<int, std::size_t> place;
  double weight = 0.0;
  bool expects_weight = true;
  for (int i = 4; i < f.size() && f.ok(); ++i) {
    if (f.blank(i)) continue;
    if (same_word(f.text(i), "UM") || same_word(f.text(i), "ALPHA")) break;
    if (expects_weight || is_real(f.text(i))) {
      expects_weight = false;
      weight = f.real(i, "WT");
      while (++i < f.size() && f.blank(i)) continue;
      const Components components = f.components(i, "C", 0);
      if (f.ok() && !(weight >= 0.0)) f.fault(fmt::format("weight {:g} is negative", weight), "give a weight >= 0");
      if (f.ok() && (components == 0 || (groups.components != 0 && groups.components != components)))
        f.fault("components are blank or differ between the groups", "give all groups the same components");
      groups.components = components;
      continue;
    }
    const int node = model.node(f, i, "G");
    if (node < 0 || weight == 0.0) continue;
    const auto [at, fresh] = place.try_emplace(node, groups.nodes.size());
    if (fresh) {
      groups.nodes.push_back(node);
      groups.weight.push_back(weight);
    } else {
      groups.weight[at->second] += weight;
    }
  }
  return groups;
}

/// Common axes of all nodes; empty if they differ.
std::optional<Eigen::Matrix3d> common_axes(const NastranModel& model, int reference, const std::vector<int>& nodes) {
  const Eigen::Matrix3d axes = model.displacement_axes(reference);
  const bool same = std::all_of(nodes.begin(), nodes.end(),
                                [&](int node) { return model.displacement_axes(node).isApprox(axes, 1e-12); });
  return same ? std::optional(axes) : std::nullopt;
}

/// Reads EID, blank, REFGRID, REFC, groups. UM chooses which components are dependent; the equations are the same.
void add_rbe3(NastranModel& model, CardFields& f) {
  model.element_id(f);
  Spider spider;
  spider.kind = SpiderKind::averaging;
  spider.reference = model.node(f, 2, "REFGRID");
  spider.reference_components = f.components(3, "REFC", 0);
  if (f.ok() && spider.reference_components == 0)
    f.fault("REFC is blank", "give the components of the reference point");
  AveragingGroups groups = read_groups(model, f);
  if (!f.ok()) return;
  if (groups.nodes.empty())
    return f.fault("there are no grid points to average", "give a weight, components and grid points");
  if (std::find(groups.nodes.begin(), groups.nodes.end(), spider.reference) != groups.nodes.end())
    return f.fault("the reference point is also one of the averaged points", "remove it from the groups");
  spider.node_components = groups.components;
  if (!free_of_axes(spider.node_components) || !free_of_axes(spider.reference_components)) {
    const std::optional<Eigen::Matrix3d> axes = common_axes(model, spider.reference, groups.nodes);
    if (!axes)
      return f.fault("components 123 or 456 are incomplete, and CD differs between the grid points",
                     "give the points the same CD, or use components 123 or 123456");
    spider.axes = *axes;
  }
  spider.nodes = std::move(groups.nodes);
  spider.weight = std::move(groups.weight);
  spider.name = f.label();
  model.deck.mesh.spiders.push_back(std::move(spider));
}

/// Appends a term in axes of CD as terms in part axes, the largest first.
void append_term(const NastranModel& model, int node, int component, double coefficient, TieEquation& equation) {
  const Eigen::Vector3d direction = coefficient * model.displacement_axes(node).col(component % 3);
  std::array<int, 3> order{0, 1, 2};
  sort_stably(order, [&](int i, int j) { return std::abs(direction(i)) > std::abs(direction(j)); });
  for (const int i : order)
    if (std::abs(direction(i)) > 1e-14 * std::abs(coefficient))
      equation.terms.push_back({node, component / 3 * 3 + i, direction(i)});
}

/// Reads SID, then G, C, A twice per line; later lines have a blank first field. The first term is dependent.
void add_mpc(NastranModel& model, CardFields& f) {
  f.id(0, "SID");
  if (!model.holds(f, "MPC")) return;
  TieEquation equation;
  for (int line = 0; line < f.size(); line += 8)
    for (const int i : {line + 1, line + 4}) {
      if (f.blank(i) && f.blank(i + 2)) continue;
      const int node = model.node(f, i, "G");
      const Components components = f.components(i + 1, "C", 0);
      const double coefficient = f.real(i + 2, "A", 0.0);
      if (!f.ok()) return;
      if (components == 0 || (components & (components - 1)) != 0)
        return f.fault(fmt::format("C '{}' must be one component", f.text(i + 1)), "give a digit from 1 to 6");
      if (coefficient != 0.0) append_term(model, node, std::countr_zero(components), coefficient, equation);
    }
  if (equation.terms.empty()) return f.fault("the equation has no terms", "give G, C and A of each term");
  equation.name = f.label();
  model.deck.mesh.equations.push_back(equation);
}

/// Adds a fault for several sets of MPC without case control, which would select one.
void judge_sets(NastranModel& model) {
  std::string first;
  bool reported = false;
  if (model.cards.has_case_control) return;
  model.for_each("MPC", [&](CardFields& f) {
    if (first.empty()) first = std::string(f.text(0));
    if (f.text(0) != first && !reported) {
      f.fault(fmt::format("the deck has sets {} and {} of MPC, but no case control to select one", first, f.text(0)),
              "keep one set");
      reported = true;
    }
  });
}

}  // namespace

void add_ties(NastranModel& model) {
  model.for_each("RBE2", [&](CardFields& f) { add_rbe2(model, f); });
  model.for_each("RBAR", [&](CardFields& f) { add_rbar(model, f); });
  model.for_each("RBE1", [&](CardFields& f) { add_rbe1(model, f); });
  model.for_each("RBE3", [&](CardFields& f) { add_rbe3(model, f); });
  model.for_each("MPC", [&](CardFields& f) { add_mpc(model, f); });
  judge_sets(model);
}

}  // namespace tisserand::reducer
