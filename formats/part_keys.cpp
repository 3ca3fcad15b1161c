// Data: the legal keys of part.yaml.
#include "formats/part_keys.hpp"

#include "formats/section_reader.hpp"

namespace tisserand::formats {

std::vector<KeySet> part_key_sets() {
  std::vector<KeySet> sets{
      {"part",
       {"part", "units", "materials", "sections", "points", "beams", "point_masses", "boundary", "modes", "cutoff"}},
      {"units", {"length", "mass", "time"}},
      {"beam",
       {"from", "to", "through", "section", "material", "elements", "size", "orientation", "theory", "mass_matrix",
        "rotary_inertia"}},
      {"point_mass", {"at", "mass", "inertia"}}};
  for (KeySet& set : section_key_sets()) sets.push_back(std::move(set));
  return sets;
}

}  // namespace tisserand::formats
