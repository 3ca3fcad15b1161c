// SPDX-License-Identifier: GPL-3.0-or-later
// Options of a use, and the search of a body that has them.
#include "mechanism/build/superelements.hpp"

#include <tuple>

#include "common/error.hpp"
#include "common/math/count.hpp"

namespace tisserand::mechanism {
namespace {

SuperelementOptions options_of(const formats::SuperelementBodySpec& spec, const CompanionUse& companion,
                               const UnitConversion& units) {
  const SecondOrderChoice choice = choose_second_order(spec, companion.terms);
  SuperelementOptions options;
  options.frame = spec.frame;
  options.frame_node = spec.frame_node;
  options.inertia = choice.inertia;
  options.stiffening = choice.stiffening;
  options.double_curvature = choice.double_curvature;
  options.load_cases = companion.load_cases;
  if (choice.any() || !options.load_cases.empty()) options.companion = companion.file;
  options.modes = spec.modes;
  options.cutoff = spec.cutoff;
  options.position_weights = spec.position_weights;
  options.rotation_weights = spec.rotation_weights;
  if (spec.terms.damping) options.damping = spec.damping;
  options.units = units;
  options.where = spec.where;
  return options;
}

/// Compares all options except units and place, since units are the same for all uses of a file.
bool make_the_same(const SuperelementOptions& a, const SuperelementOptions& b) {
  const auto all = [](const SuperelementOptions& o) {
    return std::tie(o.frame, o.frame_node, o.inertia, o.stiffening, o.double_curvature, o.modes, o.cutoff,
                    o.position_weights, o.rotation_weights, o.damping, o.load_cases);
  };
  return all(a) == all(b);
}

/// Throws Error for wrong combinations. The percentage is of the largest deflection of the rod of a slider-crank.
void refuse_wrong_combinations(const formats::SuperelementBodySpec& spec, const SecondOrderChoice& choice) {
  using formats::InertiaOption, formats::StiffeningOption;
  if (choice.stiffening == StiffeningOption::full && choice.inertia != InertiaOption::F)
    throw Error("stiffening full needs inertia F, because it contains the stress of these inertia forces", spec.where,
                "set inertia: F, or stiffening: stress with inertia: M");
  if (choice.stiffening == StiffeningOption::stress &&
      (choice.inertia == InertiaOption::A || choice.inertia == InertiaOption::B))
    throw Error(
        "stiffening cannot be combined with inertia A or B: errors reach 30 % if bodies rotate and translate fast",
        spec.where, "set inertia: F (or M with stiffening: stress), or second_order: on");
}

[[noreturn]] void throw_without_companion(const formats::SuperelementBodySpec& spec, const SecondOrderChoice& choice,
                                          const formats::Companion* companion) {
  const std::string path = formats::companion_path(spec.file);
  const std::string what = companion == nullptr
                               ? "a companion file, but there is no file " + path
                               : fmt::format("the arrays H, C, E, N and T, but {} has load cases only", path);
  throw Error(fmt::format("{} needs {}", describe(choice), what), spec.where,
              "write a companion file with `second_order: yes` in the part file (only with method craig_bampton or "
              "rubin), or set `second_order: off` at the body");
}

}  // namespace

bool may_use_companion(const formats::SuperelementBodySpec& spec) {
  using formats::InertiaOption, formats::StiffeningOption;
  if (spec.rigid) return false;
  if (spec.second_order) return *spec.second_order;
  if (spec.inertia == InertiaOption::F || spec.stiffening.value_or(StiffeningOption::off) != StiffeningOption::off)
    return true;
  return !spec.inertia && !spec.stiffening;
}

std::string describe(const SecondOrderChoice& choice) {
  constexpr const char* stiffening[] = {"off", "stress", "full"};
  return fmt::format("inertia {}, stiffening {}{}", "ABMF"[static_cast<int>(choice.inertia)],
                     stiffening[static_cast<int>(choice.stiffening)],
                     choice.double_curvature ? ", double curvature" : "");
}

SecondOrderChoice choose_second_order(const formats::SuperelementBodySpec& spec, const formats::Companion* companion) {
  using formats::InertiaOption, formats::StiffeningOption;
  const bool available = companion != nullptr && companion->has_second_order();
  const bool on = spec.second_order.value_or(available && !spec.inertia && !spec.stiffening);
  SecondOrderChoice choice;
  choice.stiffening = spec.stiffening.value_or(on ? StiffeningOption::full : StiffeningOption::off);
  choice.inertia = spec.inertia.value_or(on || choice.stiffening == StiffeningOption::full ? InertiaOption::F
                                         : choice.stiffening == StiffeningOption::stress   ? InertiaOption::M
                                                                                           : InertiaOption::B);
  refuse_wrong_combinations(spec, choice);
  if (choice.any() && !available) throw_without_companion(spec, choice, companion);
  const bool knows = available && !companion->Lambda.empty(), stiffens = choice.stiffening != StiffeningOption::off;
  choice.double_curvature = spec.double_curvature.value_or(knows && stiffens);
  if (choice.double_curvature && !stiffens)
    throw Error("double_curvature: on needs stiffening, because it is a part of it", spec.where,
                "set second_order: on, or remove double_curvature");
  if (choice.double_curvature && !knows)
    throw Error(fmt::format("double_curvature: on, but {} has no array Lambda", formats::companion_path(spec.file)),
                spec.where, "reduce the part with `double_curvature: 20` in the part file, or remove double_curvature");
  return choice;
}

int find_or_build(const formats::SuperelementBodySpec& spec, const formats::LoadedSuperelement& file,
                  const CompanionUse& companion, const UnitConversion& units, BuiltSuperelements& built,
                  std::vector<SuperelementBody>& bodies) {
  SuperelementOptions options = options_of(spec, companion, units);
  std::vector<BuiltSuperelements::Entry>& entries = built.of_file[&file];
  for (const BuiltSuperelements::Entry& entry : entries)
    if (make_the_same(entry.options, options)) return entry.body;
  bodies.push_back(build_superelement_body(file.superelement, file.report.rigid, options));
  const int body = count_of(bodies) - 1;
  entries.push_back({std::move(options), body});
  return body;
}

}  // namespace tisserand::mechanism
