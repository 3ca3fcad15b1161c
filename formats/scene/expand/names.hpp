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

/// Contents of a scene or of an assembly: its tree, and the sets of names that it defines.
struct Assembly {
  std::string name;
  YamlNode node;
  const Assembly* outer = nullptr;  ///< assembly that contains its definition
  std::set<std::string> bodies, joints, tyres, instances;
  std::set<std::string> functions;  ///< inputs and channels, which expressions use
  std::set<std::string> used_parameters;
  bool made = false;  ///< whether an instance exists
};

/// Instance of an assembly, or the scene itself, as a level of names. A name is searched in its own level first, then
/// in the outer levels.
struct Level {
  std::string prefix;  ///< path before the names of the level, for example "corner_fl/"
  const Level* outer = nullptr;
  Assembly* assembly = nullptr;
  AssemblyFrame frame;
  ParameterScope* scope = nullptr;
  int depth = 0;
};

/// Reference from an entry of a mirrored assembly to a joint coordinate.
struct MirroredReference {
  std::string path;   ///< path of the coordinate from the scene
  std::string given;  ///< as written in the file
  std::string entry;  ///< entry that refers to it
  YamlPlace entry_place, place;
};

/// Whether each instance of an assembly copies the map of this key.
bool is_instantiated(const std::string& key);

/// Fills in the sets of names of an assembly from its tree. Invalid and duplicate names become errors of the reader.
void read_names(YamlReader& reader, Assembly& assembly);

/// Replaces the paths in an entry of a collection by paths from the scene. `ground` and paths that begin with '/' are
/// relative to the scene, others to the innermost level that has their first word. Expressions write paths with points:
/// `speed` of a motor becomes `left.motor.speed`. `mirrored`: receives the references to check with check_mirrored().
void resolve_references(const std::string& collection, const Level& level, YamlNode& entry,
                        std::vector<MirroredReference>& mirrored);

/// Records an error of the reader for each of the `references` to a joint coordinate that a mirror reverses: one number
/// cannot fit both sides. `reversed`: reversed coordinates of all joints, as paths from the scene.
void check_mirrored(YamlReader& reader, const std::vector<MirroredReference>& references,
                    const std::set<std::string>& reversed);

/// Replaces the names of a beam's material and section by their definitions in the beam's assembly or an outer one.
void insert_definitions(const Level& level, Substitution& substitution, YamlNode& body);

/// Makes file names below the node relative to the folder of the scene. They are the values of keys `file`, and of keys
/// `from` of rigid bodies.
void rebase_files(const YamlDocument& document, YamlNode& node);

}  // namespace tisserand::formats
