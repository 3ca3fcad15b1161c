// SPDX-License-Identifier: GPL-3.0-or-later
// Reads references by a registered type conversion, and the global heap by its specification (HDF5 File Format, III.E).
#include "formats/hdf5/variable_texts.hpp"

#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::formats::hdf5 {
namespace {

constexpr std::uint64_t most_collection = 1u << 27;
constexpr std::uint64_t other_reference_bytes = 8;  // length before the address, index after it

[[noreturn]] void refuse_texts(const std::string& what, const std::string& where) {
  throw Error(what, where, "the file is damaged or malicious: do not use it");
}

std::uint64_t rounded_up(std::uint64_t size) { return (size + 7) / 8 * 8; }

/// Conversion that keeps the bytes of references. HDF5 calls it for conversions to an opaque type.
herr_t keep_references(hid_t from, hid_t to, H5T_cdata_t* data, std::size_t, std::size_t, std::size_t, void*, void*,
                       hid_t) {
  data->need_bkg = H5T_BKG_NO;
  return data->command != H5T_CONV_INIT || H5Tget_size(from) == H5Tget_size(to) ? 0 : -1;
}

Handle reference_type(std::uint64_t size) {
  return Handle(H5Tcreate(H5T_OPAQUE, static_cast<std::size_t>(size)), H5Tclose);
}

void register_references() {
  const Handle text(H5Tcopy(H5T_C_S1), H5Tclose), bytes = reference_type(1);
  H5Tset_size(text.id(), H5T_VARIABLE);
  H5Tregister(H5T_PERS_SOFT, "references", text.id(), bytes.id(), keep_references);
}

}  // namespace

VariableTexts::VariableTexts(int descriptor, Id file) : descriptor_(descriptor) {
  [[maybe_unused]] static const bool once = (register_references(), true);
  const Handle creation(H5Fget_create_plist(file), H5Pclose);
  std::size_t address = 8, length = 8;
  hsize_t begin = 0;
  H5Pget_sizes(creation.id(), &address, &length);
  H5Pget_userblock(creation.id(), &begin);
  address_bytes_ = address;
  length_bytes_ = length;
  begin_ = begin;
}

std::uint64_t VariableTexts::number(const char* bytes, std::uint64_t size) const {
  std::uint64_t value = 0;
  for (std::uint64_t k = std::min<std::uint64_t>(size, 8); k-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

void VariableTexts::load(std::uint64_t address, const std::string& where) {
  const std::uint64_t head = rounded_up(8 + length_bytes_), item_head = rounded_up(8 + length_bytes_);
  const auto read = [&](std::uint64_t size) {
    collection_.resize(size);
    const ssize_t count = ::pread(descriptor_, collection_.data(), size, static_cast<off_t>(begin_ + address));
    if (count != static_cast<ssize_t>(size)) refuse_texts("refers to strings beyond the end of the file", where);
  };
  loaded_ = 0;
  items_.clear();
  read(head);
  const std::uint64_t size = number(&collection_[8], length_bytes_);
  if (!collection_.starts_with("GCOL") || size < head || size > most_collection)
    refuse_texts("refers to a place in the file that holds no strings", where);
  read(size);
  for (std::uint64_t at = head; size - at >= item_head;) {
    const Item item{number(&collection_[at], 2), at + item_head, number(&collection_[at + 8], length_bytes_)};
    if (item.index == 0) break;  // the rest is free
    if (item.size > size - item.begin)
      refuse_texts("refers to a string that is longer than its space in the file", where);
    items_.push_back(item);
    at = std::min(size, item.begin + rounded_up(item.size));
  }
  std::ranges::sort(items_, {}, [](const Item& item) { return std::pair(item.index, item.begin); });
  loaded_ = address;
}

std::string VariableTexts::text_at(std::uint64_t address, std::uint64_t index, std::uint64_t length,
                                   const std::string& where) {
  if (loaded_ != address) load(address, where);
  const auto found = std::ranges::lower_bound(items_, index, {}, &Item::index);
  if (found == items_.end() || found->index != index) refuse_texts("refers to a string that does not exist", where);
  if (found->size != length)
    refuse_texts(fmt::format("has a string of {} bytes, but its reference says {} bytes", found->size, length), where);
  const char* text = &collection_[found->begin];
  return std::string(text, ::strnlen(text, length));
}

std::vector<std::string> VariableTexts::read(std::uint64_t count, std::uint64_t most, const std::string& where,
                                             const std::function<bool(Id type, void* references)>& read) {
  const std::uint64_t size = address_bytes_ + other_reference_bytes;
  const Handle type = reference_type(size);
  std::string references(size * count, '\0');
  if (!read(type.id(), references.data()))
    throw last_error("cannot be read", where, "the file is damaged; write or copy the file again");
  std::vector<std::string> texts;
  std::uint64_t bytes = 0;
  for (const char* at = references.data(); texts.size() < count; at += size) {
    const std::uint64_t address = number(at + 4, address_bytes_);
    texts.push_back(address == 0 ? "" : text_at(address, number(at + 4 + address_bytes_, 4), number(at, 4), where));
    bytes += texts.back().size();
    if (bytes > most)
      throw Error(fmt::format("holds strings of more than {} bytes", most), where, "shorten the strings");
  }
  return texts;
}

}  // namespace tisserand::formats::hdf5
