// SPDX-License-Identifier: GPL-3.0-or-later
// Requests and answers between a program and its reading process.
#include "formats/hdf5/entry.hpp"

#include <deque>

#include "formats/hdf5/container.hpp"

namespace tisserand::formats::hdf5 {
namespace {

enum class Question : std::uint8_t { entry, texts, values };

constexpr std::size_t most_first_objects = 256, most_first_bytes = 1u << 20, most_small_values = 8192;

void pack_problem(Packer& to, const Problem& problem) {
  to.text(problem.message);
  to.text(problem.remedy);
}

Problem unpack_problem(Unpacker& from) {
  Problem problem;
  problem.message = from.text();
  problem.remedy = from.text();
  return problem;
}

/// Reads a value of an enumeration whose last member is `last`.
template <class T>
T unpack_choice(Unpacker& from, T last) {
  const auto value = from.value<std::uint8_t>();
  from.require(value <= static_cast<std::uint8_t>(last), "its kind is unknown");
  return static_cast<T>(value);
}

void pack_attribute(Packer& to, const AttributeEntry& attribute) {
  to.text(attribute.name);
  to.value(attribute.kind);
  to.text(attribute.type_text);
  to.value(attribute.count);
  to.text(attribute.text);
  to.value(attribute.number);
  pack_problem(to, attribute.problem);
}

AttributeEntry unpack_attribute(Unpacker& from) {
  AttributeEntry attribute;
  attribute.name = from.raw_text();
  attribute.kind = unpack_choice(from, AttributeEntry::Kind::other);
  attribute.type_text = from.text();
  attribute.count = from.value<std::uint64_t>();
  attribute.text = from.raw_text();
  attribute.number = from.value<double>();
  attribute.problem = unpack_problem(from);
  return attribute;
}

void pack_info(Packer& to, const DatasetInfo& info) {
  to.value(info.kind);
  to.text(info.type_text);
  to.row(info.shape);
  to.value(static_cast<std::uint8_t>(info.written));
  to.value(static_cast<std::uint8_t>(info.filtered));
  to.value(info.stored_bytes);
}

DatasetInfo unpack_info(Unpacker& from) {
  DatasetInfo info;
  info.kind = unpack_choice(from, ElementKind::other);
  info.type_text = from.text();
  info.shape = from.row<std::uint64_t>();
  info.written = from.flag();
  info.filtered = from.flag();
  info.stored_bytes = from.value<std::uint64_t>();
  return info;
}

void put(const Place& place, const std::string& bytes) { std::memcpy(place(bytes.size()), bytes.data(), bytes.size()); }

ValuesRequest unpack_values_request(Unpacker& from) {
  ValuesRequest request;
  request.dataset = from.raw_text();
  request.part = unpack_choice(from, ValuesRequest::Part::column);
  request.type = unpack_choice(from, ValuesRequest::Type::int64);
  for (std::uint64_t* number : {&request.first, &request.count, &request.column, &request.values})
    *number = from.value<std::uint64_t>();
  return request;
}

std::string packed_texts(const std::vector<std::string>& texts) {
  Packer to;
  for (const std::string& text : texts) to.text(text);
  return to.bytes;
}

/// All values of a small dataset that cannot grow, which saves a request; empty for other datasets.
std::string whole_of(const Container& container, const ObjectEntry& entry) {
  const DatasetInfo& info = entry.info;
  std::uint64_t count = 1;
  for (const std::uint64_t extent : info.shape)
    count = std::max(count, extent) > most_small_values ? 0 : count * extent;
  const bool is_wanted =
      info.kind == ElementKind::float64 || info.kind == ElementKind::integer || info.kind == ElementKind::text;
  if (entry.state != ObjectState::dataset || !entry.problem.message.empty() || !info.written || !is_wanted ||
      count == 0 || count > most_small_values || !container.is_fixed_and_below(entry.name, 8 * most_small_values))
    return "";
  std::string whole;
  try {
    if (info.kind == ElementKind::text)
      whole = packed_texts(container.read_texts(entry.name, count));
    else
      container.read(
          {.dataset = entry.name,
           .type = info.kind == ElementKind::integer ? ValuesRequest::Type::int64 : ValuesRequest::Type::float64,
           .values = count},
          [&whole](std::uint64_t bytes) {
            whole.resize(bytes);
            return whole.data();
          });
  } catch (const Error&) {
    return "";  // reported when the values are requested
  }
  return whole.size() <= 16 * most_small_values ? whole : "";
}

}  // namespace

void pack(Packer& to, const ObjectEntry& entry) {
  to.text(entry.name);
  to.value(entry.state);
  pack_problem(to, entry.problem);
  to.value(entry.members.size());
  for (const std::string& member : entry.members) to.text(member);
  to.value(entry.attributes.size());
  for (const AttributeEntry& attribute : entry.attributes) pack_attribute(to, attribute);
  pack_problem(to, entry.attribute_problem);
  pack_info(to, entry.info);
  to.text(entry.whole);
}

ObjectEntry unpack_entry(Unpacker& from) {
  ObjectEntry entry;
  entry.name = from.raw_text();
  entry.state = unpack_choice(from, ObjectState::other);
  entry.problem = unpack_problem(from);
  entry.members.resize(from.size(sizeof(std::size_t)));
  for (std::string& member : entry.members) member = from.raw_text();
  entry.attributes.resize(from.size(sizeof(std::size_t)));
  for (AttributeEntry& attribute : entry.attributes) attribute = unpack_attribute(from);
  entry.attribute_problem = unpack_problem(from);
  entry.info = unpack_info(from);
  entry.whole = from.raw_text();
  return entry;
}

std::string entry_request(const std::string& object) {
  Packer to;
  to.value(Question::entry);
  to.text(object);
  return to.bytes;
}

std::string texts_request(const std::string& dataset, std::uint64_t count) {
  Packer to;
  to.value(Question::texts);
  to.text(dataset);
  to.value(count);
  return to.bytes;
}

std::string values_request(const ValuesRequest& request) {
  Packer to;
  to.value(Question::values);
  to.text(request.dataset);
  to.value(request.part);
  to.value(request.type);
  for (const std::uint64_t number : {request.first, request.count, request.column, request.values}) to.value(number);
  return to.bytes;
}

std::string opening_of(const Container& container) {
  Packer to;
  to.value(static_cast<std::uint8_t>(container.closed_properly()));
  std::deque<std::string> next{"/"};
  for (std::size_t count = 0; !next.empty() && count < most_first_objects && to.bytes.size() < most_first_bytes;
       ++count) {
    ObjectEntry entry = container.describe(next.front());
    next.pop_front();
    entry.whole = whole_of(container, entry);
    pack(to, entry);
    const std::string before = entry.name == "/" ? "/" : entry.name + "/";
    for (const std::string& member : entry.members) next.push_back(before + member);
  }
  return to.bytes;
}

void answer(const Container& container, std::string_view request, const Place& place) {
  Unpacker from(request, container.path(), "the request is not valid");
  switch (unpack_choice(from, Question::values)) {
    case Question::entry: {
      Packer to;
      pack(to, container.describe(from.raw_text()));
      return put(place, to.bytes);
    }
    case Question::texts: {
      const std::string dataset = from.raw_text();
      return put(place, packed_texts(container.read_texts(dataset, from.value<std::uint64_t>())));
    }
    case Question::values:
      return container.read(unpack_values_request(from), place);
  }
}

}  // namespace tisserand::formats::hdf5
