// SPDX-License-Identifier: GPL-3.0-or-later
// Reads keys, scalars and choices, with errors that give place and remedy.
#include "formats/yaml/reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <tuple>

#include "common/stable_sort.hpp"
#include "common/text.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

struct ParsedNumber {
  bool whole_text = false;  ///< the whole text is a number
  double value = 0.0;
};

ParsedNumber parse_number(const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') ++begin;
  if (text == ".inf" || text == "-.inf" || text == ".nan" || text == "+.inf" || text == ".NaN" || text == ".Inf")
    return {true, std::numeric_limits<double>::quiet_NaN()};
  ParsedNumber number;
  const auto [stop, status] = std::from_chars(begin, end, number.value);
  number.whole_text = stop == end && begin != end && status != std::errc::invalid_argument;
  if (status == std::errc::result_out_of_range) number.value = std::numeric_limits<double>::infinity();
  return number;
}

std::string number_remedy(const YamlNode& node) {
  if (node.kind != YamlKind::scalar) return "";
  if (node.quoted && parse_number(node.text).whole_text) return "remove the quotes";
  const bool starts = !node.text.empty() && (std::isdigit(static_cast<unsigned char>(node.text[0])) != 0);
  if (starts && node.text.find(',') != std::string::npos) return "write a decimal point instead of the comma";
  if (starts && node.text.find(' ') != std::string::npos) return "give the number alone, in the units of the file";
  return "";
}

std::vector<std::string> key_words(const KeySet& set) { return texts_of(set.fields, &Field::key); }

bool has_key(const KeySet& set, std::string_view key) {
  return std::ranges::find(set.fields, key, &Field::key) != set.fields.end();
}

/// Key of an earlier version, with the remedy.
struct FormerKey {
  std::string_view noun, key, remedy;
};
constexpr FormerKey former_keys[] = {
    {"integrator", "stabilisation", "remove it: bdf projects onto the constraints"},
    {"integrator", "baumgarte", "remove it: bdf projects onto the constraints"},
    {"error_control", "absolute", "remove it, and give `tolerance` relative to the size of the scene"},
    {"output", "ledger", "remove it, and run `mechanism ledger`"},
    {"study", "whole_budget", "remove it: after an interruption the next call continues"},
    {"part", "verify", "remove it: the program counts the modes where this costs little, and always with `cutoff`"},
};

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  return did_you_mean(word, known, fmt::format("use one of {}", join(known, ", ")));
}

std::string remedy_of_unknown(const std::string& key, const KeySet& set) {
  for (const FormerKey& former : former_keys)
    if (former.noun == set.noun && former.key == key) return std::string(former.remedy);
  return suggestion(key, key_words(set));
}

}  // namespace

YamlReader::YamlReader(const YamlDocument& document, std::vector<KeySet> key_sets)
    : document_(document), key_sets_(std::move(key_sets)) {}

const KeySet& YamlReader::keys(std::string_view noun) const {
  const auto found = std::ranges::find(key_sets_, noun, &KeySet::noun);
  TISSERAND_ENSURE(found != key_sets_.end(), "no key set '{}'", noun);
  return *found;
}

std::filesystem::path YamlReader::folder() const {
  return std::filesystem::path(document_.sources.front().name).parent_path();
}

void YamlReader::fail(const std::string& entry, const YamlPlace& place, const std::string& what,
                      const std::string& remedy) {
  errors_.push_back({place, Error(what, where(place), remedy)});
  broken_.insert(entry);
}

void YamlReader::note(const std::string& entry, const std::string& key, const YamlNode& node) {
  places_.insert_or_assign({entry, key}, Noted{node.place, node.kind == YamlKind::scalar});
}

void YamlReader::note_place(const std::string& entry, const YamlPlace& place) {
  places_.insert_or_assign({entry, ""}, Noted{place, false});
}

/// Place of the key of the finding, or of the innermost enclosing map that is in the file.
const YamlReader::Noted* YamlReader::noted(const Fault& fault) const {
  std::string key = fault.key;
  while (true) {
    const auto found = places_.find({fault.entry, key});
    if (found != places_.end()) return &found->second;
    if (key.empty()) return nullptr;
    const std::size_t dot = key.rfind('.');
    key = dot == std::string::npos ? "" : key.substr(0, dot);
  }
}

bool YamlReader::follows_from_error(const Fault& fault) const {
  if (!broken_.contains(fault.entry)) return false;
  const auto found = places_.find({fault.entry, fault.key});
  if (found == places_.end() || !found->second.scalar) return true;
  const auto same_place = [&found](const Placed& placed) { return placed.place == found->second.place; };
  return std::ranges::any_of(errors_, same_place);
}

void YamlReader::raise(const Faults& faults) const {
  std::vector<Placed> all = errors_;
  for (const Fault& fault : faults.list) {
    if (follows_from_error(fault)) continue;
    const Noted* found = noted(fault);
    const std::string text_where = found == nullptr ? fault.entry : where(found->place);
    all.push_back({found == nullptr ? YamlPlace{} : found->place, Error(fault.what, text_where, fault.remedy)});
  }
  sort_stably(all, {}, [](const Placed& placed) {
    return std::tuple(placed.place.source, placed.place.line, placed.place.column);
  });
  std::vector<Error> errors;
  std::set<std::string> reported;  // two bodies may share one faulty section
  for (const Placed& placed : all)
    if (reported.insert(placed.error.what()).second) errors.push_back(placed.error);
  if (!errors.empty()) throw merge_errors(errors);
}

void Context::fail(const YamlPlace& place, const std::string& what, const std::string& remedy) const {
  reader.fail(entry, place, subject.empty() ? what : fmt::format("{}: {}", subject, what), remedy);
}

bool Context::require_list(const YamlNode& node, const std::string& what, const std::string& remedy,
                           std::optional<std::size_t> count) const {
  if (node.kind == YamlKind::sequence && node.children.size() == count.value_or(node.children.size())) return true;
  fail(node.place, fmt::format("{}, not {}", what, describe(node)), remedy);
  return false;
}

Context Context::inside(const std::string& what) const {
  return {reader, subject.empty() ? what : fmt::format("{}: {}", subject, what), entry};
}

std::span<const YamlNode> items_of(const YamlNode& node) {
  return node.kind == YamlKind::sequence ? std::span(node.children) : std::span(&node, 1);
}

bool has_rows(const YamlNode& node) {
  return node.kind == YamlKind::sequence && !node.children.empty() && node.children.front().kind == YamlKind::sequence;
}

bool looks_like_number(const YamlNode& node) {
  return node.kind == YamlKind::scalar && !node.quoted && parse_number(node.text).whole_text;
}

double read_number(const Context& context, const YamlNode& node, const std::string& what) {
  const double unreadable = std::numeric_limits<double>::quiet_NaN();
  if (!looks_like_number(node)) {
    context.fail(node.place, fmt::format("{} must be a number, not {}", what, describe(node)), number_remedy(node));
    return unreadable;
  }
  const double value = parse_number(node.text).value;
  if (std::isfinite(value)) return value;
  context.fail(node.place, fmt::format("{} must be finite, not {}", what, describe(node)), "");
  return unreadable;
}

std::optional<int> read_integer(const Context& context, const YamlNode& node, const std::string& what) {
  if (node.kind == YamlKind::scalar && !node.quoted) {
    int value = 0;
    const char* end = node.text.data() + node.text.size();
    const auto [stop, status] = std::from_chars(node.text.data(), end, value);
    if (stop == end && status == std::errc{}) return value;
    if (stop == end && status == std::errc::result_out_of_range) {
      context.fail(node.place, fmt::format("{} {} is too large", what, describe(node)), "");
      return std::nullopt;
    }
  }
  context.fail(node.place, fmt::format("{} must be a whole number, not {}", what, describe(node)), number_remedy(node));
  return std::nullopt;
}

std::string read_text(const Context& context, const YamlNode& node, const std::string& what) {
  if (node.kind == YamlKind::scalar) return node.text;
  context.fail(node.place, fmt::format("{} must be text, not {}", what, describe(node)), "");
  return "";
}

std::vector<std::string> read_texts(const Context& context, const YamlNode& node, const std::string& what) {
  std::vector<std::string> texts;
  for (const YamlNode& item : items_of(node)) texts.push_back(read_text(context, item, what));
  return texts;
}

std::vector<double> read_numbers(const Context& context, const YamlNode& node, const std::string& what) {
  std::vector<double> values;
  if (!context.require_list(node, what + " must be a list of numbers", "write it as [1, 2, 3]")) return values;
  for (std::size_t i = 0; i < node.children.size(); ++i)
    values.push_back(read_number(context, node.children[i], fmt::format("{}[{}]", what, i)));
  return values;
}

std::optional<std::size_t> read_word(const Context& context, const YamlNode& node, const std::string& what,
                                     const std::vector<std::string>& words) {
  if (node.kind == YamlKind::scalar) {
    const auto found = std::ranges::find(words, node.text);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    context.fail(node.place, fmt::format("unknown {} '{}'", what, node.text), suggestion(node.text, words));
  } else {
    context.fail(node.place, fmt::format("{} must be one word, not {}", what, describe(node)),
                 fmt::format("use one of {}", join(words, ", ")));
  }
  return std::nullopt;
}

MapReader::MapReader(Context context, const YamlNode& node, std::string_view noun, std::string prefix)
    : context_(std::move(context)), node_(node), keys_(context_.reader.keys(noun)), prefix_(std::move(prefix)) {
  if (node.kind != YamlKind::map) {
    const bool is_file = &node == &context_.reader.root();  // may be another kind of file: not quoted
    const std::string found = is_file && node.kind == YamlKind::scalar ? "a text" : describe(node);
    context_.fail(node.place, fmt::format("must be a map of keys and values, not {}", found),
                  fmt::format("keys are {}", join(key_words(keys_), ", ")));
    return;
  }
  const auto is_quotable = [&](const YamlNode& unknown) {
    const bool is_file = noun == "scene" || noun == "assembly" || noun == "part" || noun == "study";
    const bool is_option = context_.reader.where(unknown.key_place).starts_with("--set");
    return !is_file || is_option || std::ranges::any_of(node.children, [&](const YamlNode& child) {
      return child.key_place.source == unknown.key_place.source && has_key(keys_, child.key);
    });
  };
  std::map<std::string_view, YamlPlace> seen;
  for (const YamlNode& child : node.children) {
    const auto [first, is_new] = seen.try_emplace(child.key, child.key_place);
    if (!has_key(keys_, child.key) && !is_quotable(child)) {
      context_.fail(
          child.key_place, "this key is unknown, and the file has no known key",
          fmt::format("keys are {}; check that this is the right kind of file", join(key_words(keys_), ", ")));
      return;
    }
    if (!has_key(keys_, child.key))
      context_.fail(child.key_place, fmt::format("unknown key '{}'", child.key), remedy_of_unknown(child.key, keys_));
    else if (!is_new)
      context_.fail(child.key_place,
                    fmt::format("key '{}' is given twice (first in line {})", child.key, first->second.line),
                    "remove one");
    context_.reader.note(context_.entry, prefix_ + child.key, child);
  }
}

YamlPlace MapReader::place() const { return node_.key.empty() ? node_.place : node_.key_place; }

void require_kind(const YamlReader& reader, std::string_view own, std::string_view other, const std::string& remedy) {
  const std::vector<YamlNode>& children = reader.root().children;
  const auto stray = std::ranges::find(children, other, &YamlNode::key);
  if (stray == children.end() || std::ranges::find(children, own, &YamlNode::key) != children.end()) return;
  throw Error(fmt::format("this file describes a {}, not a {}", other, own), reader.where(stray->place), remedy);
}

const YamlNode* MapReader::find(std::string_view key) const {
  TISSERAND_ENSURE(has_key(keys_, key), "key '{}' of '{}'", key, keys_.noun);
  if (node_.kind != YamlKind::map) return nullptr;
  const auto found = std::ranges::find(node_.children, key, &YamlNode::key);
  return found == node_.children.end() ? nullptr : &*found;
}

const YamlNode* MapReader::require(std::string_view key) const {
  const YamlNode* node = find(key);
  if (node == nullptr && node_.kind == YamlKind::map) fail(fmt::format("missing key '{}'", key), "");
  return node;
}

void MapReader::refuse(std::initializer_list<std::string_view> keys, const std::string& why,
                       const std::string& remedy) const {
  for (const std::string_view key : keys)
    if (const YamlNode* node = find(key)) context_.fail(node->key_place, fmt::format("'{}' {}", key, why), remedy);
}

void MapReader::refuse_both(std::string_view first, std::string_view second, const std::string& remedy) const {
  if (const YamlNode* node = find(second); node != nullptr && has(first))
    context_.fail(node->key_place, fmt::format("both '{}' and '{}' are given", first, second), remedy);
}

void MapReader::require_one(std::string_view first, std::string_view second, const std::string& remedy) const {
  if (has(first) == has(second))
    fail(has(first) ? fmt::format("both '{}' and '{}' are given", first, second)
                    : fmt::format("neither '{}' nor '{}' is given", first, second),
         remedy);
}

MapReader MapReader::inside(const YamlNode& value, std::string_view noun) const {
  return {context_.inside(value.key), value, noun, fmt::format("{}{}.", prefix_, value.key)};
}

std::vector<const YamlNode*> MapReader::entries(std::string_view key, const std::string& noun) const {
  std::vector<const YamlNode*> list;
  const YamlNode* node = find(key);
  if (node == nullptr || node->kind == YamlKind::null) return list;
  if (node->kind != YamlKind::map) {
    context_.fail(node->place, fmt::format("{} must be a map from names to entries, not {}", key, describe(*node)),
                  fmt::format("write the name of each {}, a colon, and its keys", noun));
    return list;
  }
  std::map<std::string_view, YamlPlace> seen;
  for (const YamlNode& child : node->children) {
    const auto [first, is_new] = seen.try_emplace(child.key, child.key_place);
    if (is_new) {
      list.push_back(&child);
    } else {
      context_.fail(child.key_place,
                    fmt::format("{} '{}' is given twice (first in line {})", noun, child.key, first->second.line),
                    "rename or remove one");
    }
  }
  return list;
}

double MapReader::number(std::string_view key) const {
  const YamlNode* node = require(key);
  return node == nullptr ? std::numeric_limits<double>::quiet_NaN() : read_number(context_, *node, std::string(key));
}

double MapReader::number(std::string_view key, double fallback) const {
  const YamlNode* node = find(key);
  return node == nullptr ? fallback : read_number(context_, *node, std::string(key));
}

int MapReader::integer(std::string_view key, int fallback) const {
  const YamlNode* node = find(key);
  return node == nullptr ? fallback : read_integer(context_, *node, std::string(key)).value_or(fallback);
}

std::string MapReader::text(std::string_view key) const {
  const YamlNode* node = require(key);
  return node == nullptr ? "" : read_text(context_, *node, std::string(key));
}

Context key_context(YamlReader& reader, const YamlNode& node) {
  Context context{reader, node.key, reader.where(node.key_place)};
  reader.note_place(context.entry, node.key_place);
  return context;
}

Context entry_context(YamlReader& reader, const std::string& noun, const YamlNode& node) {
  Context context = key_context(reader, node);
  context.subject = fmt::format("{} '{}'", noun, node.key);
  return context;
}

}  // namespace tisserand::formats
