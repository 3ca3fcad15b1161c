// Names in assemblies: which level of instances a path such as `arm/tip` belongs to, and which file a path of a file.
#pragma once

#include <map>
#include <set>
#include <string>

#include "formats/scene_placement.hpp"
#include "formats/yaml_reader.hpp"

namespace tisserand::formats {

/// What a scene or an assembly holds.
struct Assembly {
  std::string name;
  YamlNode node;
  const Assembly* outer = nullptr;  ///< its definition stands in this one
  std::set<std::string> bodies, joints, instances;
  std::set<std::string> reversed;  ///< joint coordinates that a mirror reverses
  std::set<std::string> used_parameters;
  bool made = false;  ///< there is an instance of it
};

/// One instance of an assembly, or the scene itself: names are looked up in it, then in the level around it.
struct Level {
  std::string prefix;  ///< "corner_fl/"
  const Level* outer = nullptr;
  Assembly* assembly = nullptr;
  AssemblyFrame frame;
  int depth = 0;
};

/// Maps of an assembly that are copied with each instance.
bool is_instantiated(const std::string& collection);

/// Fills in the sets of names; names that are no names, and double ones, are errors of the reader.
void read_names(YamlReader& reader, Assembly& assembly);

/// The paths in an entry of a collection as paths from the scene: `ground`, and paths that begin with '/', count from
/// the scene; others from the innermost level that has their first word.
void resolve_references(YamlReader& reader, const std::string& collection, const Level& level, YamlNode& entry);

/// Names of files relative to the folder of the scene.
void rebase_files(const YamlDocument& document, const std::string& collection, YamlNode& entry);

}  // namespace tisserand::formats
