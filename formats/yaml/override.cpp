// SPDX-License-Identifier: GPL-3.0-or-later
// Applies overrides, whose paths lead through maps and lists of the tree.
#include "formats/yaml/override.hpp"

#include <algorithm>
#include <charconv>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/text.hpp"
#include "formats/yaml/name_check.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {
namespace {

std::string where_of(const Override& change) { return fmt::format("--set {}={}", change.path, change.value); }

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> steps(1);
  for (const char c : path) {
    if (c == '.') {
      steps.emplace_back();
    } else {
      steps.back() += c;
    }
  }
  return steps;
}

/// Walk from the root of the tree to the value of one override.
struct Walk {
  const Override& change;
  int source;
  const std::vector<std::string_view>& collections;
  std::vector<std::string> steps;

  std::string path_to(std::size_t count) const {
    return join({steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(count)}, ".");
  }
  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw Error(what, where_of(change), remedy);
  }
};

YamlNode& enter_map(const Walk& walk, YamlNode& node, std::size_t i) {
  const std::string& step = walk.steps[i];
  for (YamlNode& child : node.children)
    if (child.key == step) return child;
  const bool last = i + 1 == walk.steps.size();
  const bool collection = i > 0 && std::ranges::find(walk.collections, walk.steps[i - 1]) != walk.collections.end();
  if (!last && collection) {
    const std::vector<std::string> known = texts_of(node.children, &YamlNode::key);
    walk.fail(fmt::format("'{}' has no entry '{}'", walk.path_to(i), step),
              did_you_mean(step, known, known.empty() ? "" : fmt::format("use one of {}", listed(known))));
  }
  YamlNode child;
  child.key = step;
  child.place = child.key_place = {1, 1, walk.source};
  child.kind = last ? YamlKind::null : YamlKind::map;
  node.children.push_back(std::move(child));
  return node.children.back();
}

YamlNode& enter_list(const Walk& walk, YamlNode& node, std::size_t i) {
  const std::string& step = walk.steps[i];
  for (YamlNode& child : node.children)
    for (const YamlNode& item : child.children)
      if (child.kind == YamlKind::map && item.key == "name" && item.text == step) return child;
  std::size_t index = 0;
  const auto [end, status] = std::from_chars(step.data(), step.data() + step.size(), index);
  const bool number = status == std::errc{} && end == step.data() + step.size();
  if (!number)
    walk.fail(fmt::format("'{}' is a list; '{}' is neither an index nor the name of an entry", walk.path_to(i), step),
              fmt::format("use an index from 0 to {}", std::max<std::size_t>(node.children.size(), 1) - 1));
  if (index >= node.children.size())
    walk.fail(fmt::format("'{}' has {} entries; there is no index {}", walk.path_to(i), node.children.size(), index),
              node.children.empty() ? "set the whole list"
                                    : fmt::format("use an index from 0 to {}", node.children.size() - 1));
  return node.children[index];
}

YamlNode& enter(const Walk& walk, YamlNode& node, std::size_t i) {
  if (node.kind == YamlKind::null) node.kind = YamlKind::map;
  if (node.kind == YamlKind::map) return enter_map(walk, node, i);
  if (node.kind == YamlKind::sequence) return enter_list(walk, node, i);
  walk.fail(fmt::format("'{}' is {}, not a map", walk.path_to(i), describe(node)),
            fmt::format("set '{}' itself", walk.path_to(i)));
}

void apply(YamlDocument& document, const Override& change, const std::vector<std::string_view>& collections) {
  document.sources.push_back({YamlSourceKind::option, where_of(change), ""});
  const int source = count_of(document.sources) - 1;
  YamlNode value;
  if (!change.value.empty()) {
    try {
      value = parse_yaml(change.value, "value").root;
    } catch (const Error& error) {
      throw Error(error.message(), where_of(change),
                  "put quotes around the whole option for the shell, and around texts inside it for YAML");
    }
  }
  mark_source(value, source);
  const Walk walk{change, source, collections, split(change.path)};
  YamlNode* node = &document.root;
  for (std::size_t i = 0; i < walk.steps.size(); ++i) node = &enter(walk, *node, i);
  value.key = node->key;
  value.key_place = node->key_place;
  value.place.source = source;
  *node = std::move(value);
}

}  // namespace

Override parse_override(const std::string& text) {
  const std::string where = "--set " + text;
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw Error("has no '='", where, "write --set path.to.key=value");
  Override change{text.substr(0, equals), text.substr(equals + 1)};
  for (const std::string& step : split(change.path))
    if (step.empty())
      throw Error(fmt::format("path '{}' has an empty key", change.path), where, "write --set path.to.key=value");
  return change;
}

void apply_overrides(YamlDocument& document, const std::vector<Override>& overrides,
                     const std::vector<std::string_view>& collections) {
  std::vector<Error> errors;
  for (const Override& change : overrides) {
    try {
      apply(document, change, collections);
    } catch (const Error& error) {
      errors.push_back(error);
    }
  }
  if (!errors.empty()) throw merge_errors(errors);
}

}  // namespace tisserand::formats
