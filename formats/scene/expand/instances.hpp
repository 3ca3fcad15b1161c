// SPDX-License-Identifier: GPL-3.0-or-later
// Instances of assemblies: copies of their entries, named by paths and placed by the pose of the instance.
#pragma once

#include <deque>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "formats/scene/expand/include.hpp"
#include "formats/scene/expand/names.hpp"
#include "formats/scene/expand/parameters.hpp"
#include "formats/scene/expand/placement.hpp"
#include "formats/yaml/reader.hpp"

namespace tisserand::formats {

/// Expands the tree of a scene (read and merged) to a flat tree, without assemblies and instances.
class SceneExpander {
 public:
  SceneExpander(YamlDocument& document, TreeLoader& loader, const std::vector<KeySet>& legal_keys);

  /// Runs the expansion. Throws one Error that joins all errors found.
  void run();

 private:
  /// An entry of `instances`.
  struct Instance {
    YamlNode node;          ///< without `parameters` and `first`
    YamlNode given, first;  ///< maps `parameters` and `first` of the entry
    std::string name;       ///< unique within its level
    int count = -1;         ///< number of copies; −1: not repeated
    AssemblyFrame pose, step, mirror;
  };

  template <class Action>
  void collect(Action action);
  Assembly& define(const std::string& name, YamlNode node, const Assembly* outer);
  Assembly& find_assembly(const YamlNode& use, const Assembly& from);
  void expand_top(Assembly& top, ParameterScope& scope);
  void expand(const Level& level);
  YamlNode expanded(const std::string& collection, const YamlNode& entry, const Level& level);
  void expand_instance(const YamlNode& node, const Level& level);
  Instance read_instance(const YamlNode& node, ParameterScope& scope);
  void make_one(const Instance& instance, int index, const AssemblyFrame& frame, Assembly& assembly,
                const Level& level);
  void define_parameters(const Instance& instance, int index, const Assembly& assembly, ParameterScope& around,
                         ParameterScope& own);
  void report_unused(const ParameterScope& scope);
  YamlNode& flat(const std::string& collection, const YamlPlace& place);

  YamlDocument& document_;
  TreeLoader& loader_;
  YamlReader reader_;
  ExpansionBudget budget_;
  Substitution substitution_;
  YamlNode root_;
  std::deque<Assembly> assemblies_;
  std::map<std::pair<const Assembly*, std::string>, Assembly*> by_name_;
  std::vector<Error> errors_;
  std::set<std::string> reported_;
  std::vector<MirroredReference> mirrored_;
  std::set<std::string> reversed_;  ///< joint coordinates that a mirror reverses, as paths from the scene
  long instances_ = 0;
};

}  // namespace tisserand::formats
