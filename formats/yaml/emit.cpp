// SPDX-License-Identifier: GPL-3.0-or-later
// Writes trees by yaml-cpp, which quotes texts as needed.
#include "formats/yaml/emit.hpp"

#include <yaml-cpp/yaml.h>

namespace tisserand::formats {
namespace {

constexpr int block_levels = 2;

void emit(YAML::Emitter& out, const YamlNode& node, int levels) {
  switch (node.kind) {
    case YamlKind::null:
      out << YAML::Null;
      return;
    case YamlKind::scalar:
      if (node.quoted) out << YAML::DoubleQuoted;
      out << node.text;
      return;
    case YamlKind::sequence:
      out << YAML::Flow << YAML::BeginSeq;
      for (const YamlNode& child : node.children) emit(out, child, 0);
      out << YAML::EndSeq;
      return;
    case YamlKind::map:
      if (levels <= 0) out << YAML::Flow;
      out << YAML::BeginMap;
      for (const YamlNode& child : node.children) {
        out << YAML::Key << child.key << YAML::Value;
        emit(out, child, levels - 1);
      }
      out << YAML::EndMap;
      return;
  }
}

std::string text_of(const YamlNode& node, int levels) {
  YAML::Emitter out;
  out.SetNullFormat(YAML::LowerNull);
  emit(out, node, levels);
  std::string text = out.c_str();
  // yaml-cpp breaks long flow maps into lines. A line end outside quotes means a blank.
  if (levels == 0)
    for (char& c : text)
      if (c == '\n') c = ' ';
  return text;
}

}  // namespace

std::string flow_text(const YamlNode& node) { return text_of(node, 0); }

std::string block_text(const YamlNode& root) { return text_of(root, block_levels) + "\n"; }

}  // namespace tisserand::formats
