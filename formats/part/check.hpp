// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a part that has been read.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Names that references may use.
struct PartNames {
  std::vector<std::string> materials;  ///< isotropic materials
  std::vector<std::string> layers;     ///< all materials
  std::vector<std::string> sections;
  std::vector<std::string> places;  ///< points, then spiders
  std::vector<std::string> groups;  ///< groups of the part file: defined ones, patches and their edges
};

/// All faults of a part. check(part) throws them.
Faults find_faults(const Part& part);

/// Edge groups of a patch: "deck/edge1", "tube/start", ...
std::vector<std::string> edge_groups(const ShellPatch& patch);

/// Pieces of find_faults(): patches, layouts, shells, solids; mesh file and groups; springs and spiders; supports,
/// load cases.
void check_shells(const Part& part, const PartNames& names, Faults& faults);
void check_mesh_and_groups(const Part& part, const PartNames& names, Faults& faults);
void check_attachments(const Part& part, const PartNames& names, Faults& faults);
void check_loads(const Part& part, PartNames names, Faults& faults);
void check_place(const Part& part, const PartNames& names, const Place& place, const std::string& key,
                 const Subject& subject);
/// Checks names of groups. They must be known, unless a mesh file may define them.
void check_group_names(const Part& part, const PartNames& names, const std::vector<std::string>& on,
                       const std::string& key, const Subject& subject);

}  // namespace tisserand::formats
