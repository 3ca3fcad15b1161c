// SPDX-License-Identifier: GPL-3.0-or-later
// Names in assemblies: the level of instances of a path such as `arm/tip`, and the files that paths name.
#pragma once

#include <set>
#include <string>

#include <vector>

#include "formats/scene/expand/parameters.hpp"
#include "formats/scene/expand/placement.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Contents of a scene or an assembly.
struct Assembly {
  std::string name;
  YamlNode node;
  const Assembly* outer = nullptr;  ///< assembly that contains its definition
  std::set<std::string> bodies, joints, tyres, instances;
  std::set<std::string> functions;  ///< inputs and channels, which expressions use
  std::set<std::string> used_parameters;
  bool made = false;  ///< whether an instance exists
};

/// Instance of an assembly, or the scene itself. Names are searched here first, then in the outer levels.
struct Level {
  std::string prefix;  ///< "corner_fl/"
  const Level* outer = nullptr;
  Assembly* assembly = nullptr;
  AssemblyFrame frame;
  ParameterScope* scope = nullptr;
  int depth = 0;
};

/// Joint coordinate that an entry of a mirrored assembly refers to, with its path from the scene.
struct MirroredReference {
  std::string path;
  std::string given;  ///< as written in the file
  std::string entry;  ///< entry that refers to it
  YamlPlace entry_place, place;
};

/// Whether each instance of an assembly copies the map of this key.
bool is_instantiated(const std::string& key);

/// Fills in the sets of names. Invalid and duplicate names are reported as errors of the reader.
void read_names(YamlReader& reader, Assembly& assembly);

/// Replaces the paths in an entry of a collection by paths from the scene. `ground` and paths that begin with '/' are
/// relative to the scene, others to the innermost level with their first word. Expressions write paths with points:
/// `speed` of a motor becomes `left.motor.speed`. Adds to `mirrored` what must be checked when all joints are known.
void resolve_references(const std::string& collection, const Level& level, YamlNode& entry,
                        std::vector<MirroredReference>& mirrored);

/// Reports references to coordinates that a mirror reverses, since one number cannot fit both sides, as errors of the
/// reader. `reversed`: such coordinates of all joints, as paths from the scene.
void check_mirrored(YamlReader& reader, const std::vector<MirroredReference>& references,
                    const std::set<std::string>& reversed);

/// Replaces the names of a beam's material and section by definitions of its assembly or an outer one.
void insert_definitions(const Level& level, Substitution& substitution, YamlNode& body);

/// Makes file names below the node relative to the folder of the scene: keys `file`, and `from` of rigid bodies.
void rebase_files(const YamlDocument& document, YamlNode& node);

}  // namespace tisserand::formats
