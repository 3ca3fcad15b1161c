// Data: the legal keys of part.yaml.
#include "formats/part/keys.hpp"

#include "formats/sections/reader.hpp"

namespace tisserand::formats {

std::vector<KeySet> part_key_sets() {
  std::vector<KeySet> sets{
      {"part", {"part",         "units",   "mesh",      "materials",  "sections", "points", "groups",
                "plates",       "discs",   "cylinders", "extrusions", "shells",   "solids", "beams",
                "point_masses", "springs", "spiders",   "boundary",   "modes",    "cutoff"}},
      {"units", {"length", "mass", "time"}},
      {"mesh", {"file", "size", "smallest", "curvature", "sizes", "order", "cells", "scale", "unknown", "ignore"}},
      {"material_orthotropic", {"E1", "E2", "nu12", "G12", "G13", "G23", "density"}},
      {"place", {"node", "near", "tolerance", "centroid"}},
      {"group", {"of", "faces", "edges", "volumes", "nodes", "groups", "box", "cylinder", "near", "tolerance"}},
      {"group_cylinder", {"from", "to", "radius"}},
      {"plate",
       {"corners", "elements", "size", "cells", "thickness", "material", "laminate", "offset", "x", "mass_matrix"}},
      {"disc",
       {"center", "normal", "start", "radius", "inner_radius", "elements", "size", "cells", "thickness", "material",
        "laminate", "offset", "x", "mass_matrix"}},
      {"cylinder",
       {"from", "to", "radius", "end_radius", "start", "angle_deg", "elements", "size", "cells", "thickness",
        "material", "laminate", "offset", "x", "mass_matrix"}},
      {"extrusion",
       {"profile", "along", "arc", "elements", "size", "cells", "thickness", "material", "laminate", "offset", "x",
        "mass_matrix"}},
      {"arc", {"through", "axis", "angle_deg"}},
      {"shell", {"on", "thickness", "material", "laminate", "offset", "x", "mass_matrix"}},
      {"ply", {"material", "thickness", "angle_deg"}},
      {"solid", {"on", "material", "mass_matrix"}},
      {"beam",
       {"from", "to", "through", "on", "section", "to_section", "material", "elements", "size", "orientation",
        "angle_deg", "offset", "from_offset", "to_offset", "releases", "theory", "mass_matrix", "rotary_inertia"}},
      {"releases", {"start", "end"}},
      {"point_mass", {"at", "mass", "inertia", "offset"}},
      {"spring", {"from", "to", "stiffness", "axes"}},
      {"orientation", {"axis", "angle_deg", "x", "y", "z"}},
      {"spider", {"kind", "at", "on", "weights"}},
      {"boundary_entry", {"at", "node", "near", "tolerance", "centroid", "keep"}}};
  for (KeySet& set : section_key_sets()) sets.push_back(std::move(set));
  return sets;
}

std::vector<std::string_view> part_collections() {
  return {"materials",  "sections", "points", "groups", "plates",       "discs",   "cylinders",
          "extrusions", "shells",   "solids", "beams",  "point_masses", "springs", "spiders"};
}

}  // namespace tisserand::formats
