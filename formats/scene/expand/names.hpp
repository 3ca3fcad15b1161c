// Names in assemblies: which level of instances a path such as `arm/tip` belongs to, and which file a path of a file.
#pragma once

#include <set>
#include <string>

#include <vector>

#include "formats/scene/expand/parameters.hpp"
#include "formats/scene/expand/placement.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// What a scene or an assembly holds.
struct Assembly {
  std::string name;
  YamlNode node;
  const Assembly* outer = nullptr;  ///< its definition stands in this one
  std::set<std::string> bodies, joints, tyres, instances;
  std::set<std::string> functions;  ///< inputs and channels, which expressions name
  std::set<std::string> used_parameters;
  bool made = false;  ///< there is an instance of it
};

/// One instance of an assembly, or the scene itself: names are looked up in it, then in the level around it.
struct Level {
  std::string prefix;  ///< "corner_fl/"
  const Level* outer = nullptr;
  Assembly* assembly = nullptr;
  AssemblyFrame frame;
  ParameterScope* scope = nullptr;
  int depth = 0;
};

/// A joint coordinate that an entry of a mirrored assembly names, with its path from the scene.
struct MirroredReference {
  std::string path;
  std::string given;  ///< as it stands in the file
  std::string entry;  ///< whose it is
  YamlPlace entry_place, place;
};

/// Maps of an assembly that are copied with each instance.
bool is_instantiated(const std::string& key);

/// Fills in the sets of names; names that are no names, and double ones, are errors of the reader.
void read_names(YamlReader& reader, Assembly& assembly);

/// The paths in an entry of a collection as paths from the scene: `ground`, and paths that begin with '/', count from
/// the scene; others from the innermost level that has their first word. So do names in expressions, whose paths are
/// written with points: `speed` of a motor is `left.motor.speed` in the flat scene. Adds to `mirrored` what is to be
/// checked when all joints are known.
void resolve_references(const std::string& collection, const Level& level, YamlNode& entry,
                        std::vector<MirroredReference>& mirrored);

/// Coordinates that a mirror reverses cannot be measured by others with one number for both sides: errors of the
/// reader. `reversed`: of all joints, paths from the scene.
void check_mirrored(YamlReader& reader, const std::vector<MirroredReference>& references,
                    const std::set<std::string>& reversed);

/// The material and section of a beam that its assembly, or one around it, defines, in the place of their names.
void insert_definitions(const Level& level, Substitution& substitution, YamlNode& body);

/// Names of files below the node relative to the folder of the scene: of keys `file`, and of rigid bodies `from`.
void rebase_files(const YamlDocument& document, YamlNode& node);

}  // namespace tisserand::formats
