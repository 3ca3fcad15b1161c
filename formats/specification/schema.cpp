// SPDX-License-Identifier: GPL-3.0-or-later
// Generates JSON Schemas from lists of fields.
#include <cctype>
#include <set>

#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "formats/specification/specification.hpp"

namespace tisserand::formats {
namespace {

using Json = nlohmann::ordered_json;

Json reference(std::string_view name) { return {{"$ref", fmt::format("#/$defs/{}", name)}}; }

/// Parser of the notation of Field::type.
class TypeReader {
 public:
  TypeReader(std::string_view text, const std::set<std::string_view>& names, bool parameters)
      : text_(text), names_(names), parameters_(parameters) {}

  Json whole() {
    Json schema = either();
    TISSERAND_ENSURE(at_ == text_.size(), "type '{}' at {}", text_, at_);
    return schema;
  }

 private:
  Json either() {
    Json alternatives = Json::array(), words = Json::array();
    bool stands_for_value = false;  // numbers, choices, lists; not maps and plain texts
    do {
      skip_blanks();
      const char first = peek();
      if (first == '\'' || std::isdigit(static_cast<unsigned char>(first)) != 0 || starts("true") || starts("false")) {
        words.push_back(word());
      } else {
        stands_for_value = stands_for_value || first == '[' || starts("number") || starts("integer");
        alternatives.push_back(one());
      }
      skip_blanks();
    } while (take("|"));
    if (words.size() == 1) alternatives.push_back({{"const", words[0]}});
    if (words.size() > 1) alternatives.push_back({{"enum", words}});
    if (parameters_ && (stands_for_value || words.size() > 1 || alternatives.size() > 1))
      alternatives.push_back(reference("parameter"));
    return alternatives.size() == 1 ? alternatives[0] : Json{{"anyOf", alternatives}};
  }

  Json word() {
    if (take("'")) return until('\'');
    if (take("true")) return true;
    if (take("false")) return false;
    return std::stoi(digits());
  }

  Json one() {
    if (take("/")) return {{"type", "string"}, {"pattern", until('/')}};
    if (take("[")) return list();
    if (take("{")) return map();
    const std::string name = identifier();
    if (name == "any") return Json::object();
    if (name == "text" && take("+")) return {{"type", "string"}, {"minLength", 1}};
    if (name == "text") return {{"type", "string"}};
    if (name == "number" || name == "integer") return bounded({{"type", name}});
    TISSERAND_ENSURE(names_.contains(name), "type '{}' of '{}'", name, text_);
    return reference(name);
  }

  Json bounded(Json schema) {
    for (const auto& [sign, rule] : {std::pair{">=", "minimum"}, std::pair{">", "exclusiveMinimum"},
                                     std::pair{"<=", "maximum"}, std::pair{"<", "exclusiveMaximum"}})
      if (take(sign)) schema[rule] = Json::parse(digits());
    return schema;
  }

  Json list() {
    Json schema{{"type", "array"}, {"items", either()}};
    expect("]");
    const std::string fewest = digits();
    if (fewest.empty()) return schema;
    const std::string most = take("..") ? digits() : fewest;
    schema["minItems"] = std::stoi(fewest);
    if (!most.empty()) schema["maxItems"] = std::stoi(most);
    return schema;
  }

  Json map() {
    const Json names = one();
    expect(":");
    const Json values = either();
    expect("}");
    Json schema;
    schema["type"] = take("+") ? Json("object") : Json{"object", "null"};
    if (names != Json{{"type", "string"}}) schema["propertyNames"] = names;
    if (!values.empty()) schema["additionalProperties"] = values;
    return schema;
  }

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool starts(std::string_view word) const { return text_.substr(at_).starts_with(word); }
  bool take(std::string_view word) {
    if (!starts(word)) return false;
    at_ += word.size();
    return true;
  }
  void expect(std::string_view word) { TISSERAND_ENSURE(take(word), "'{}' in type '{}' at {}", word, text_, at_); }
  void skip_blanks() {
    while (take(" ")) continue;
  }
  std::string until(char end) {
    const std::size_t stop = text_.find(end, at_);
    TISSERAND_ENSURE(stop != std::string_view::npos, "no {} in type '{}'", end, text_);
    const std::string inside(text_.substr(at_, stop - at_));
    at_ = stop + 1;
    return inside;
  }
  template <class Belongs>
  std::string span(Belongs belongs) {
    const std::size_t begin = at_;
    while (at_ < text_.size() && belongs(static_cast<unsigned char>(text_[at_]))) ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }
  std::string identifier() {
    return span([](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  }
  /// Reads a number. The two points of a range do not belong to it.
  std::string digits() {
    return span([this](unsigned char c) { return std::isdigit(c) != 0 || c == '-' || (c == '.' && !starts("..")); });
  }

  std::string_view text_;
  const std::set<std::string_view>& names_;
  bool parameters_;
  std::size_t at_ = 0;
};

std::string description(const Field& field) {
  const std::string without = field.default_text();
  const bool says_default = !without.empty() && !field.required() && without != "-";
  return std::string(field.meaning) + (says_default ? fmt::format(" (default: {})", without) : "");
}

/// Type of a field in the notation of types; for a choice, its words.
std::string type_of_field(const Field& field) {
  std::string text(field.type);
  if (!text.empty()) return text;
  for (const std::string_view word : field.words) text += fmt::format("{}'{}'", text.empty() ? "" : " | ", word);
  return text;
}

/// Writes one line per key and per definition, so that differences between versions are easy to read.
void write(const Json& json, const std::string& indent, bool open, std::string& text) {
  if (!json.is_structured()) {
    text += json.dump();
    return;
  }
  const bool list = json.is_array();
  text += list ? "[" : "{";
  bool first = true;
  for (const auto& [key, value] : json.items()) {
    text += first ? "" : (open ? "," : ", ");
    if (open) text += "\n" + indent + "  ";
    if (!list) text += fmt::format("\"{}\": ", key);
    write(value, open ? indent + "  " : indent, key == "$defs" || key == "properties", text);
    first = false;
  }
  if (open) text += "\n" + indent;
  text += list ? "]" : "}";
}

}  // namespace

std::string schema_text(const FileKind& kind) {
  std::set<std::string_view> names;
  for (const NamedType& type : kind.types) names.insert(type.name);
  for (const KeySet& set : kind.sets) names.insert(set.noun);

  Json definitions;
  if (kind.parameters)
    definitions["parameter"] = {{"type", "string"}, {"pattern", "\\$"}, {"description", "$name or ${formula}"}};
  for (const NamedType& type : kind.types) {
    Json& definition = definitions[std::string(type.name)];
    definition = TypeReader(type.type, names, kind.parameters).whole();
    if (!type.meaning.empty()) definition["description"] = type.meaning;
  }
  for (const KeySet& set : kind.sets) {
    Json properties = Json::object(), required = Json::array();
    for (const Field& field : set.fields) {
      Json property = TypeReader(type_of_field(field), names, kind.parameters).whole();
      if (!field.meaning.empty()) property["description"] = description(field);
      properties[std::string(field.key)] = property;
      if (field.required()) required.push_back(field.key);
    }
    Json& definition = definitions[std::string(set.noun)];
    definition["type"] = "object";
    if (!required.empty()) definition["required"] = required;
    if (set.count.fewest > 0) definition["minProperties"] = set.count.fewest;
    if (set.count.most > 0) definition["maxProperties"] = set.count.most;
    definition["additionalProperties"] = false;
    definition["properties"] = properties;
  }
  Json schema;
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = kind.name + ".yaml of Tisserand";
  schema["$ref"] = "#/$defs/" + kind.name;
  schema["$defs"] = definitions;
  std::string text;
  write(schema, "", true, text);
  return text + "\n";
}

}  // namespace tisserand::formats
