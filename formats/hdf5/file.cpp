// SPDX-License-Identifier: GPL-3.0-or-later
// Reads untrusted HDF5 files: asks for descriptions and checks them before memory is allocated.
#include "formats/hdf5/file.hpp"

#include <algorithm>
#include <cstring>

#include "common/text.hpp"
#include "formats/hdf5/apart.hpp"

namespace tisserand::formats::hdf5 {
namespace {

std::string kind_in_words(ElementKind kind) {
  switch (kind) {
    case ElementKind::float64:
      return "64-bit floating numbers";
    case ElementKind::float32:
      return "32-bit floating numbers";
    case ElementKind::integer:
      return "integers";
    case ElementKind::text:
      return "strings";
    case ElementKind::other:
      return "other values";
  }
  return "";
}

void throw_problem(const Problem& problem, const std::string& where) {
  if (!problem.message.empty()) throw Error(problem.message, where, problem.remedy);
}

constexpr const char* no_answer = "the data that HDF5 returned are not valid";

Unpacker unpack(const std::string& bytes, const std::string& path) { return {bytes, path, no_answer}; }

/// Whether the complete list of the group lacks this member.
bool denies(const ObjectEntry& group, const std::string& member) {
  return group.state == ObjectState::group && group.problem.message.empty() && group.members.size() < max_members &&
         std::ranges::find(group.members, member) == group.members.end();
}

std::uint64_t product(const Shape& shape, std::size_t first_axis = 0) {
  std::uint64_t count = 1;
  for (std::size_t axis = first_axis; axis < shape.size(); ++axis) count *= shape[axis];
  return count;
}

}  // namespace

std::string shape_text(const Shape& shape) {
  if (shape.empty()) return "scalar";
  std::vector<std::string> parts;
  for (const std::uint64_t extent : shape) parts.push_back(std::to_string(extent));
  return join(parts, " x ");
}

InputFile::InputFile(const std::string& path, Completeness completeness)
    : path_(path), apart_(Together::child_of(path)) {
  if (!apart_) apart_ = std::make_shared<Apart>(std::vector{path});
  number_ = *apart_->number_of(path);
  const std::string opening = apart_->open(number_, completeness);
  Unpacker from = unpack(opening, path_);
  closed_properly_ = from.flag();
  while (!from.is_at_end()) {
    ObjectEntry entry = unpack_entry(from);
    known_.emplace(entry.name, std::move(entry));
  }
}

InputFile::~InputFile() = default;

std::string InputFile::place(const std::string& object) const {
  return object == "/" ? path_ : fmt::format("{}: {}", path_, object);
}

const ObjectEntry& InputFile::entry(const std::string& object) const {
  const auto found = known_.find(object);
  if (found != known_.end()) return found->second;
  const std::size_t slash = object.rfind('/');
  const auto group = known_.find(slash == 0 ? "/" : object.substr(0, slash));
  ObjectEntry entry;
  if (object == "/" || group == known_.end() || !denies(group->second, object.substr(slash + 1))) {
    const std::string bytes = apart_->ask(number_, entry_request(object));
    Unpacker from = unpack(bytes, path_);
    entry = unpack_entry(from);
    from.end();
  }
  entry.name = object;
  return known_.emplace(object, std::move(entry)).first->second;
}

const ObjectEntry* InputFile::find(const std::string& object) const {
  if (object == "/") return &entry(object);
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    const ObjectEntry& found = entry(object.substr(0, end));
    if (found.state == ObjectState::unknown) throw_problem(found.problem, place(found.name));
    const bool is_last = end == std::string::npos;
    if (is_last || found.state == ObjectState::link || found.state == ObjectState::broken)
      return found.state == ObjectState::absent ? nullptr : &found;
    if (found.state != ObjectState::group) return nullptr;
  }
}

const ObjectEntry& InputFile::open(const std::string& object) const {
  const ObjectEntry* found = find(object);
  if (found == nullptr) throw Error("is missing", place(object), "compare the file with its specification");
  if (found->state == ObjectState::link)
    throw Error("is a link to another object or file", place(found->name), "store the object itself in the file");
  if (found->state == ObjectState::broken) throw_problem(found->problem, place(found->name));
  return *found;
}

bool InputFile::has(const std::string& object) const { return find(object) != nullptr; }

bool InputFile::has_attribute(const std::string& object, const std::string& name) const {
  if (!has(object)) return false;
  const ObjectEntry& found = open(object);
  throw_problem(found.attribute_problem, place(object));
  return std::ranges::find(found.attributes, name, &AttributeEntry::name) != found.attributes.end();
}

std::vector<std::string> InputFile::members(const std::string& group) const {
  const ObjectEntry& found = open(group);
  if (found.state != ObjectState::group)
    throw Error("is not a group", place(group), "compare the file with its specification");
  throw_problem(found.problem, place(group));
  return found.members;
}

std::vector<std::string> InputFile::attributes(const std::string& object) const {
  const ObjectEntry& found = open(object);
  throw_problem(found.attribute_problem, place(object));
  std::vector<std::string> names;
  for (const AttributeEntry& attribute : found.attributes) names.push_back(attribute.name);
  return names;
}

const AttributeEntry& InputFile::attribute(const std::string& object, const std::string& name,
                                           AttributeEntry::Kind kind, const char* meaning) const {
  const std::string where = fmt::format("{}: attribute '{}'", place(object), name);
  if (!has_attribute(object, name)) throw Error("is missing", where, fmt::format("add it; it is a {}", meaning));
  const AttributeEntry& found = *std::ranges::find(open(object).attributes, name, &AttributeEntry::name);
  const std::string remedy = fmt::format("write it as one {}", meaning);
  if (found.type_text.empty()) throw_problem(found.problem, where);
  if (found.kind != kind) throw Error(fmt::format("holds {}, expected a {}", found.type_text, meaning), where, remedy);
  if (found.count != 1) throw Error(fmt::format("has {} values, expected one {}", found.count, meaning), where, remedy);
  throw_problem(found.problem, where);
  return found;
}

std::string InputFile::text_attribute(const std::string& object, const std::string& name) const {
  return attribute(object, name, AttributeEntry::Kind::text, "string").text;
}

double InputFile::number_attribute(const std::string& object, const std::string& name) const {
  return attribute(object, name, AttributeEntry::Kind::number, "number").number;
}

DatasetInfo InputFile::info(const std::string& dataset) const {
  const ObjectEntry& found = open(dataset);
  if (found.state != ObjectState::dataset)
    throw Error("is not a dataset", place(dataset), "compare the file with its specification");
  throw_problem(found.problem, place(dataset));
  return found.info;
}

void InputFile::require(const std::string& dataset, ElementKind kind, const Shape& shape,
                        const std::string& meaning) const {
  const DatasetInfo found = info(dataset);
  if (found.kind != kind)
    throw Error(fmt::format("holds {}, expected {}", found.type_text, kind_in_words(kind)), place(dataset),
                fmt::format("write {} as {}", meaning, kind_in_words(kind)));
  if (found.shape != shape)
    throw Error(fmt::format("has shape {}, expected {} ({})", shape_text(found.shape), shape_text(shape), meaning),
                place(dataset), "compare the file with its specification");
  if (!found.written)
    throw Error("was created, but not all of its values were written", place(dataset), "write the file again");
}

void InputFile::values(const ValuesRequest& request, void* values) const {
  if (request.values == 0) return;
  const std::uint64_t bytes = request.values * (request.type == ValuesRequest::Type::float32 ? 4 : 8);
  const std::string& whole = entry(request.dataset).whole;
  if (request.part == ValuesRequest::Part::all && whole.size() == bytes) {
    std::memcpy(values, whole.data(), bytes);
    return;
  }
  apart_->ask(number_, values_request(request), [&](std::uint64_t size) {
    if (size != bytes)
      throw Error(fmt::format("{}: {} bytes instead of {}", no_answer, size, bytes), place(request.dataset),
                  "the file is damaged or malicious: do not use it");
    return static_cast<char*>(values);
  });
}

void InputFile::read(const std::string& dataset, const Shape& shape, const std::string& meaning, double* to) const {
  require(dataset, ElementKind::float64, shape, meaning);
  values({.dataset = dataset, .values = product(shape)}, to);
}

void InputFile::read(const std::string& dataset, const Shape& shape, const std::string& meaning,
                     std::int64_t* to) const {
  require(dataset, ElementKind::integer, shape, meaning);
  values({.dataset = dataset, .type = ValuesRequest::Type::int64, .values = product(shape)}, to);
}

std::vector<std::string> InputFile::texts(const std::string& dataset, std::uint64_t count) const {
  const std::string& whole = entry(dataset).whole;
  const std::string bytes = whole.empty() ? apart_->ask(number_, texts_request(dataset, count)) : whole;
  Unpacker from = unpack(bytes, path_);
  std::vector<std::string> texts(from.is_at_end() ? 0 : count);
  for (std::string& text : texts) text = from.raw_text();
  from.require(texts.size() == count, "it is too short");
  from.end();
  return texts;
}

std::vector<std::string> InputFile::read_texts(const std::string& dataset, std::uint64_t count,
                                               const std::string& meaning) const {
  require(dataset, ElementKind::text, {count}, meaning);
  return texts(dataset, count);
}

std::string InputFile::read_text(const std::string& dataset) const {
  require(dataset, ElementKind::text, {}, "one string");
  return texts(dataset, 1).front();
}

void InputFile::read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t count, double* to) const {
  values({.dataset = dataset,
          .part = ValuesRequest::Part::rows,
          .first = first,
          .count = count,
          .values = count * product(info(dataset).shape, 1)},
         to);
}

void InputFile::read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t count, float* to) const {
  values({.dataset = dataset,
          .part = ValuesRequest::Part::rows,
          .type = ValuesRequest::Type::float32,
          .first = first,
          .count = count,
          .values = count * product(info(dataset).shape, 1)},
         to);
}

void InputFile::read_column(const std::string& dataset, std::uint64_t column, std::uint64_t count, double* to) const {
  values({.dataset = dataset, .part = ValuesRequest::Part::column, .count = count, .column = column, .values = count},
         to);
}

}  // namespace tisserand::formats::hdf5
