// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a part that has been read.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "formats/yaml/fault.hpp"

namespace tisserand::formats {

/// Names of a part file to which its entries may refer.
struct PartNames {
  std::vector<std::string> materials;  ///< isotropic materials
  std::vector<std::string> layers;     ///< all materials, which layers of a laminate may use
  std::vector<std::string> sections;
  std::vector<std::string> places;  ///< points, then spiders
  std::vector<std::string> groups;  ///< groups of the part file: defined ones, patches and their edges
};

/// All faults of a part. check(part) throws them as one Error.
Faults find_faults(const Part& part);

/// Names of the edge groups of a patch: "deck/edge1", "tube/start", ...
std::vector<std::string> edge_groups(const ShellPatch& patch);

/// Parts of find_faults(). check_shells(): patches, layouts, shells, solids. check_mesh_and_groups(): mesh file and
/// groups. check_attachments(): springs and spiders. check_loads(): supports and load cases.
void check_shells(const Part& part, const PartNames& names, Faults& faults);
void check_mesh_and_groups(const Part& part, const PartNames& names, Faults& faults);
void check_attachments(const Part& part, const PartNames& names, Faults& faults);
void check_loads(const Part& part, PartNames names, Faults& faults);
void check_place(const Part& part, const PartNames& names, const Place& place, const std::string& key,
                 const Subject& subject);
/// Checks that the groups `on` are known, unless a mesh file may define them.
void check_group_names(const Part& part, const PartNames& names, const std::vector<std::string>& on,
                       const std::string& key, const Subject& subject);

}  // namespace tisserand::formats
