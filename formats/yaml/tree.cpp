// SPDX-License-Identifier: GPL-3.0-or-later
// Builds a bounded tree from the events of yaml-cpp, and reports everything wrong with a text file except its keys.
#include "formats/yaml/tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "common/error.hpp"

namespace tisserand::formats {
namespace {

constexpr std::size_t largest_depth = 100;
constexpr std::size_t most_values = 1'000'000;
constexpr std::size_t most_bytes = 16u << 20;

struct Extent {
  std::size_t values = 1;
  std::size_t depth = 1;
};

/// Size of a tree. largest_depth limits the recursion.
Extent measure(const YamlNode& node) {
  Extent extent;
  for (const YamlNode& child : node.children) {
    const Extent inner = measure(child);
    extent.values += inner.values;
    extent.depth = std::max(extent.depth, inner.depth + 1);
  }
  return extent;
}

/// Builds the tree from the events of yaml-cpp's parser. Its recursion is limited there and here.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& text, std::string file) : input_(text), file_(std::move(file)) {}

  YamlNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { finish(make(YamlKind::null, mark), anchor); }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end())
      fail(mark, "the alias refers to a value that contains this alias", "write the value instead of the alias");
    const Extent extent = measure(found->second);
    if (stack_.size() + extent.depth > largest_depth) fail_depth(mark);
    count(extent.values, mark);
    YamlNode copy = found->second;
    place(std::move(copy), mark);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    check_tag(mark, tag);
    YamlNode node = make(YamlKind::scalar, mark);
    node.text = value;
    node.quoted = tag == "!";
    if (node.quoted) check_closing_quote(mark);
    finish(std::move(node), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlKind::sequence, mark, tag, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlKind::map, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Frame {
    YamlNode node;
    YAML::anchor_t anchor;
    std::optional<YamlNode> key;  ///< key of a map entry, read before its value
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what, const std::string& remedy) const {
    throw Error(what, fmt::format("{}:{}:{}", file_, mark.line + 1, mark.column + 1), remedy);
  }
  [[noreturn]] void fail_depth(const YAML::Mark& mark) const {
    fail(mark, fmt::format("values are nested more than {} levels deep", largest_depth),
         "look for brackets that are not closed");
  }

  void check_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!")
      fail(mark, fmt::format("YAML tag '{}' is not supported", tag), "remove it");
  }

  /// Reports a missing closing quote, for which yaml-cpp takes the end of the file.
  void check_closing_quote(const YAML::Mark& mark) const {
    const auto begin = static_cast<std::size_t>(std::max(mark.pos, 0));
    if (begin >= input_.size() || (input_[begin] != '"' && input_[begin] != '\'')) return;
    const char quote = input_[begin];
    for (std::size_t i = begin + 1; i < input_.size(); ++i) {
      const bool doubled = quote == '\'' && input_.compare(i, 2, "''") == 0;
      if (doubled || (quote == '"' && input_[i] == '\\')) {
        ++i;
      } else if (input_[i] == quote) {
        return;
      }
    }
    fail(mark, "not valid YAML: the quote that opens here is not closed", "close it");
  }

  void count(std::size_t values, const YAML::Mark& mark) {
    values_ += values;
    if (values_ > most_values)
      fail(mark, fmt::format("the file has more than {} values, counting the values of its aliases", most_values),
           "use fewer aliases, or put long tables into separate files");
  }

  YamlNode make(YamlKind kind, const YAML::Mark& mark) {
    count(1, mark);
    YamlNode node;
    node.kind = kind;
    node.place = {mark.line + 1, mark.column + 1, 0};
    return node;
  }

  void open(YamlKind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    check_tag(mark, tag);
    if (stack_.size() + 1 >= largest_depth) fail_depth(mark);
    stack_.push_back({make(kind, mark), anchor, std::nullopt});
  }

  void close() {
    TISSERAND_ENSURE(!stack_.empty(), "end of a list or map that was never opened in {}", file_);
    Frame frame = std::move(stack_.back());
    stack_.pop_back();
    finish(std::move(frame.node), frame.anchor);
  }

  void finish(YamlNode node, YAML::anchor_t anchor) {
    YAML::Mark mark;
    mark.line = node.place.line - 1;
    mark.column = node.place.column - 1;
    if (anchor != YAML::NullAnchor) {
      count(measure(node).values, mark);
      anchors_[anchor] = node;
    }
    place(std::move(node), mark);
  }

  void place(YamlNode node, const YAML::Mark& mark) {
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Frame& frame = stack_.back();
    if (frame.node.kind == YamlKind::sequence) {
      frame.node.children.push_back(std::move(node));
    } else if (!frame.key) {
      if (node.kind != YamlKind::scalar) fail(mark, fmt::format("a key must be text, not {}", describe(node)), "");
      if (node.text == "<<" && !node.quoted)
        fail(mark, "YAML merge keys '<<' are not supported", "copy the keys to this place");
      frame.key = std::move(node);
    } else {
      node.key = std::move(frame.key->text);
      node.key_place = frame.key->place;
      if (node.kind == YamlKind::null) node.place = node.key_place;
      frame.key.reset();
      frame.node.children.push_back(std::move(node));
    }
  }

  const std::string& input_;
  std::string file_;
  std::vector<Frame> stack_;
  std::map<YAML::anchor_t, YamlNode> anchors_;
  std::size_t values_ = 0;
  YamlNode root_;
};

/// Length of the UTF-8 sequence that starts at text[i], or 0 if there is none (also for control characters).
std::size_t character_length(const std::string& text, std::size_t i) {
  const auto byte = [&text](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(i);
  if (first < 0x20) return first == '\t' || first == '\n' || first == '\r' ? 1 : 0;
  if (first < 0x7f) return 1;
  const std::size_t length = first >= 0xf0 && first < 0xf5   ? 4
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xc2 && first < 0xe0 ? 2
                                                             : 0;
  if (length == 0 || i + length > text.size()) return 0;
  for (std::size_t k = i + 1; k < i + length; ++k)
    if ((byte(k) & 0xc0) != 0x80) return 0;
  return length;
}

void check_characters(const std::string& text, const std::string& file) {
  int line = 1, column = 1;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0)
      throw Error(fmt::format("byte 0x{:02x} is not text in UTF-8", static_cast<unsigned char>(text[i])),
                  fmt::format("{}:{}:{}", file, line, column), "check that this is a text file, and save it as UTF-8");
    column = text[i] == '\n' ? 1 : column + 1;
    line += text[i] == '\n' ? 1 : 0;
    i += length;
  }
}

void check_only_one(YAML::Parser& parser, const std::string& text, const std::string& file) {
  TreeBuilder other(text, file);
  if (!parser.HandleNextDocument(other)) return;
  const YamlPlace place = other.take_root().place;
  throw Error("a second YAML document begins after '---'", fmt::format("{}:{}:{}", file, place.line, place.column),
              "keep one document per file");
}

}  // namespace

std::string YamlDocument::where(const YamlPlace& place) const {
  const YamlSource& source = sources.at(static_cast<std::size_t>(place.source));
  return source.kind == YamlSourceKind::file ? fmt::format("{}:{}:{}", source.name, place.line, place.column)
                                             : source.name;
}

YamlDocument parse_yaml(const std::string& text, const std::string& file) {
  if (text.size() > most_bytes)
    throw Error(fmt::format("the file has more than {} bytes", most_bytes), file,
                "put long tables into separate csv files");
  check_characters(text, file);
  const std::string body = text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;  // without byte order mark
  TreeBuilder builder(body, file);
  try {
    std::istringstream stream(body);
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) throw Error("the file is empty", file, "");
    check_only_one(parser, body, file);
  } catch (const YAML::Exception& fault) {
    const bool placed = fault.mark.line >= 0;
    throw Error(fmt::format("not valid YAML: {}", fault.msg),
                placed ? fmt::format("{}:{}:{}", file, fault.mark.line + 1, fault.mark.column + 1) : file,
                "check indentation, brackets, quotes and colons at and before this place");
  }
  return {builder.take_root(), {{YamlSourceKind::file, file, ""}}};
}

YamlDocument load_yaml(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw Error("is a folder, not a file", path, "give a file");
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw Error("is not a regular file", path, "give a text file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw Error(fmt::format("cannot open the file: {}", std::strerror(errno)), path, "check path and permission");
  std::string text, piece(1u << 16, '\0');
  while (text.size() <= most_bytes &&
         stream.read(piece.data(), static_cast<std::streamsize>(piece.size())).gcount() > 0)
    text.append(piece, 0, static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) throw Error(fmt::format("cannot read the file: {}", std::strerror(errno)), path, "");
  return parse_yaml(text, path);
}

void mark_source(YamlNode& node, int source) {
  node.place.source = source;
  node.key_place.source = source;
  for (YamlNode& child : node.children) mark_source(child, source);
}

std::size_t count_nodes(const YamlNode& node) { return measure(node).values; }

const YamlNode* find_child(const YamlNode& node, std::string_view key) {
  for (const YamlNode& child : node.children)
    if (node.kind == YamlKind::map && child.key == key) return &child;
  return nullptr;
}

YamlNode* find_child(YamlNode& node, std::string_view key) {
  return const_cast<YamlNode*>(find_child(static_cast<const YamlNode&>(node), key));
}

std::string describe(const YamlNode& node) {
  switch (node.kind) {
    case YamlKind::null:
      return "nothing";
    case YamlKind::sequence:
      return fmt::format("a list of {}", node.children.size());
    case YamlKind::map:
      return "a map";
    case YamlKind::scalar:
      break;
  }
  constexpr std::size_t longest = 40;
  const std::string text = node.text.size() > longest ? node.text.substr(0, longest) + "..." : node.text;
  return node.quoted ? fmt::format("the text \"{}\"", text) : fmt::format("'{}'", text);
}

}  // namespace tisserand::formats
