// Options of a use, and the body that has them.
#include "mechanism/build/superelements.hpp"

#include <tuple>

namespace tisserand::mechanism {

namespace {

SuperelementOptions options_of(const formats::SuperelementBodySpec& spec, const UnitConversion& units) {
  SuperelementOptions options;
  options.frame = spec.frame;
  options.frame_node = spec.frame_node;
  options.inertia = spec.inertia.value_or(formats::InertiaOption::B);
  options.modes = spec.modes;
  options.cutoff = spec.cutoff;
  options.position_weights = spec.position_weights;
  options.rotation_weights = spec.rotation_weights;
  options.damping = spec.damping;
  options.units = units;
  options.where = spec.where;
  return options;
}

/// All but units and place: those of the file are the same for all uses.
bool make_the_same(const SuperelementOptions& a, const SuperelementOptions& b) {
  const auto all = [](const SuperelementOptions& o) {
    return std::tie(o.frame, o.frame_node, o.inertia, o.modes, o.cutoff, o.position_weights, o.rotation_weights,
                    o.damping);
  };
  return all(a) == all(b);
}

}  // namespace

int find_or_build(const formats::SuperelementBodySpec& spec, const formats::LoadedSuperelement& file,
                  const UnitConversion& units, BuiltSuperelements& built, std::vector<SuperelementBody>& bodies) {
  SuperelementOptions options = options_of(spec, units);
  std::vector<BuiltSuperelements::Entry>& entries = built.of_file[&file];
  for (const BuiltSuperelements::Entry& entry : entries)
    if (make_the_same(entry.options, options)) return entry.body;
  bodies.push_back(build_superelement_body(file.superelement, file.report.rigid, options));
  const int body = static_cast<int>(bodies.size()) - 1;
  entries.push_back({std::move(options), body});
  return body;
}

}  // namespace tisserand::mechanism
