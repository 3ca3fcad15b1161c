// SPDX-License-Identifier: GPL-3.0-or-later
// Mutations of an attribute or a dataset, one function for each kind.
#include "tests/formats/hdf5/mutated_container.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "formats/hdf5/file.hpp"

namespace tisserand::test_support {
namespace {

/// Source of bytes: those given in their order, then zeros.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  std::uint8_t byte() { return next_ < size_ ? data_[next_++] : std::uint8_t{0}; }
  std::size_t below(std::size_t limit) { return (byte() + std::size_t{256} * byte()) % limit; }
  double number() {
    constexpr std::array special = {0.0, -0.0, 1.0, -1.0, 1e100, -1e300, 5e-324, 1e-9};
    const std::uint8_t choice = byte();
    if (choice < special.size()) return special[choice];
    if (choice == 8) return std::numeric_limits<double>::infinity();
    if (choice == 9) return std::numeric_limits<double>::quiet_NaN();
    std::array<std::uint8_t, 8> raw{};
    for (std::uint8_t& b : raw) b = byte();
    double value = 0.0;
    std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t next_ = 0;
};

/// Owner of any HDF5 identifier.
class Id {
 public:
  explicit Id(hid_t id) : id_(id) {}
  ~Id() {
    if (id_ >= 0) H5Idec_ref(id_);
  }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): stands for the identifier

 private:
  hid_t id_;
};

hid_t text_type(std::size_t size) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, size);
  return type;
}

hid_t compound_type(hid_t member) {
  const hid_t type = H5Tcreate(H5T_COMPOUND, 2 * H5Tget_size(member));
  H5Tinsert(type, "a", 0, member);
  H5Tinsert(type, "b", H5Tget_size(member), member);
  return type;
}

hid_t wide_float() {
  const hid_t type = H5Tcopy(H5T_IEEE_F64LE);
  H5Tset_size(type, 12);
  return type;
}

/// Any type that a file may hold.
hid_t foreign_type(Bytes& bytes) {
  static const hsize_t three = 3;
  switch (bytes.below(18)) {
    case 0:
      return H5Tcopy(H5T_IEEE_F64LE);
    case 1:
      return H5Tcopy(H5T_IEEE_F64BE);
    case 2:
      return H5Tcopy(H5T_IEEE_F32LE);
    case 3:
      return H5Tcopy(H5T_STD_I32BE);
    case 4:
      return H5Tcopy(H5T_STD_U64LE);
    case 5:
      return H5Tcopy(H5T_STD_I8LE);
    case 6:
      return H5Tcopy(H5T_STD_B16LE);
    case 7:
      return text_type(1 + bytes.below(300));
    case 8:
      return text_type(H5T_VARIABLE);
    case 9:
      return compound_type(H5T_IEEE_F64LE);
    case 10:
      return H5Tarray_create2(H5T_IEEE_F64LE, 1, &three);
    case 11:
      return H5Tenum_create(H5T_STD_I32LE);
    case 12:
      return H5Tvlen_create(H5T_IEEE_F64LE);
    case 13:
      return H5Tcreate(H5T_OPAQUE, 1 + bytes.below(64));
    case 14:
      return H5Tcopy(H5T_STD_REF_OBJ);
    case 15:
      return H5Tcopy(H5T_NATIVE_LDOUBLE);
    case 16:
      return wide_float();
    default:
      return H5Tcopy(H5T_STD_I64LE);
  }
}

struct Space {
  std::vector<hsize_t> shape;
  hid_t id = -1;
};

Space foreign_space(Bytes& bytes) {
  const std::size_t rank = bytes.below(6);
  Space space;
  if (rank == 0) {
    space.id = H5Screate(bytes.below(2) == 0 ? H5S_SCALAR : H5S_NULL);
    return space;
  }
  constexpr std::array<hsize_t, 8> sizes = {0, 1, 2, 3, 13, 14, 100'000, hsize_t{1} << 40};
  for (std::size_t k = 0; k < rank; ++k) space.shape.push_back(sizes[bytes.below(sizes.size())]);
  space.id = H5Screate_simple(static_cast<int>(rank), space.shape.data(), nullptr);
  return space;
}

/// Layout: contiguous, compact, or in chunks with filters. Allocation as late as HDF5 allows. The n-bit filter is used
/// for numbers only, because HDF5 itself crashes with other types.
hid_t foreign_layout(Bytes& bytes, hid_t type, const std::vector<hsize_t>& shape) {
  const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
  const std::size_t choice = bytes.below(8);
  if (choice == 1) H5Pset_layout(list, H5D_COMPACT);
  if (choice >= 2 && !shape.empty()) {
    std::vector<hsize_t> chunk;
    for (const hsize_t length : shape) chunk.push_back(std::clamp<hsize_t>(length, 1, 1 + bytes.below(20)));
    H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data());
    if (choice == 3) H5Pset_deflate(list, 6);
    if (choice == 4) H5Pset_shuffle(list);
    if (choice == 5) H5Pset_fletcher32(list);
    if (choice == 6) H5Pset_scaleoffset(list, H5Z_SO_FLOAT_DSCALE, 2);
    const bool is_number = H5Tget_class(type) == H5T_INTEGER || H5Tget_class(type) == H5T_FLOAT;
    if (choice == 7 && is_number) H5Pset_nbit(list);
  }
  return list;
}

/// Bytes for all points of a dataset, at most 64 KiB; empty: the dataset gets no data.
std::vector<char> foreign_values(Bytes& bytes, hid_t type, hid_t space) {
  const hssize_t points = H5Sget_simple_extent_npoints(space);
  const std::size_t size = H5Tget_size(type);
  const bool holds_addresses = H5Tdetect_class(type, H5T_VLEN) > 0 || H5Tis_variable_str(type) > 0;
  if (points <= 0 || holds_addresses || bytes.below(4) == 0) return {};
  if (static_cast<std::size_t>(points) > 65'536 / std::max<std::size_t>(size, 1)) return {};
  std::vector<char> values(static_cast<std::size_t>(points) * size);
  for (char& value : values) value = static_cast<char>(bytes.byte());
  return values;
}

/// Writes texts of variable length for all points, if there are at most 1000.
void write_variable_texts(Bytes& bytes, hid_t dataset, hid_t type, hid_t space) {
  const hssize_t points = H5Sget_simple_extent_npoints(space);
  if (H5Tis_variable_str(type) <= 0 || points <= 0 || points > 1000) return;
  std::vector<std::string> texts;
  for (hssize_t i = 0; i < points; ++i) texts.push_back(std::string(bytes.below(600), static_cast<char>(bytes.byte())));
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data());
}

void foreign_dataset(Bytes& bytes, hid_t file, const std::string& name) {
  const Id type(foreign_type(bytes));
  const Space shape = foreign_space(bytes);
  const Id space(shape.id), layout(foreign_layout(bytes, type, shape.shape));
  const Id dataset(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT));
  if (dataset < 0) return;
  const std::vector<char> values = foreign_values(bytes, type, space);
  if (!values.empty()) H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  write_variable_texts(bytes, dataset, type, space);
}

/// Writes an attribute of at most 1 MiB. HDF5 writes all of an attribute at once, even if it was given no values.
void foreign_attribute(Bytes& bytes, hid_t file, const std::string& name) {
  const Id type(foreign_type(bytes)), space(foreign_space(bytes).id);
  if (H5Sget_simple_extent_npoints(space) > (1 << 20) / static_cast<hssize_t>(H5Tget_size(type))) return;
  const Id attribute(H5Acreate2(file, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT));
  if (attribute < 0) return;
  const std::vector<char> values = foreign_values(bytes, type, space);
  if (!values.empty()) H5Awrite(attribute, type, values.data());
}

/// Puts another object in place of a dataset: a group, a named type, or a link that leads elsewhere or nowhere.
void other_object(Bytes& bytes, hid_t file, const std::string& name) {
  switch (bytes.below(4)) {
    case 0:
      Id(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      break;
    case 1:
      H5Lcreate_soft(bytes.below(2) == 0 ? "/mass" : name.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    case 2:
      H5Lcreate_external("other.h5", "/mass", file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    default: {
      const Id type(foreign_type(bytes));
      H5Tcommit2(file, name.c_str(), type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    }
  }
}

/// Name, shape and numbers of a valid dataset.
struct Table {
  std::string name;
  std::vector<hsize_t> shape;
  std::vector<double> values;
  bool is_integer = false;
};

void write_table(hid_t file, const Table& table, hid_t stored, hid_t layout) {
  const Id space(H5Screate_simple(static_cast<int>(table.shape.size()), table.shape.data(), nullptr));
  const Id dataset(H5Dcreate2(file, table.name.c_str(), stored, space, H5P_DEFAULT, layout, H5P_DEFAULT));
  if (dataset >= 0) H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, table.values.data());
}

/// Writes the table as the next byte chooses: unchanged, absent, foreign, with some or all values changed, as another
/// object, with another type or layout, or with another length.
void put_table(Bytes& bytes, hid_t file, Table table) {
  const hid_t usual = table.is_integer ? H5T_STD_I32LE : H5T_IEEE_F64LE;
  switch (bytes.byte() % 8) {
    case 1:
      return;
    case 2:
      foreign_dataset(bytes, file, table.name);
      return;
    case 3:
      for (std::size_t k = bytes.below(6) + 1; k > 0; --k)
        table.values[bytes.below(table.values.size())] = table.is_integer ? std::round(bytes.number()) : bytes.number();
      break;
    case 4:
      other_object(bytes, file, table.name);
      return;
    case 5: {
      const Id type(foreign_type(bytes)), layout(foreign_layout(bytes, type, table.shape));
      write_table(file, table, type, layout);
      return;
    }
    case 6: {
      const std::size_t axis = bytes.below(table.shape.size());
      table.shape[axis] += bytes.below(2) == 0 ? 1 : hsize_t(-1);
      std::size_t points = 1;
      for (const hsize_t length : table.shape) points *= length;
      table.values.resize(points);
      break;
    }
    case 7:
      for (double& value : table.values) value *= bytes.number();
      break;
    default:
      break;
  }
  write_table(file, table, usual, H5P_DEFAULT);
}

void put_text(Bytes& bytes, hid_t object, const std::string& name, std::string value) {
  switch (bytes.byte() % 4) {
    case 1:
      return;
    case 2:
      foreign_attribute(bytes, object, name);
      return;
    case 3:
      for (std::size_t k = bytes.below(400); k > 0; --k) value += static_cast<char>(bytes.byte());
      break;
    default:
      break;
  }
  formats::hdf5::write_attribute({object, ""}, ".", name, value);
}

void put_number(Bytes& bytes, hid_t object, const std::string& name, double value, bool is_integer) {
  switch (bytes.byte() % 4) {
    case 1:
      return;
    case 2:
      foreign_attribute(bytes, object, name);
      return;
    case 3:
      value = bytes.number();
      is_integer = false;
      break;
    default:
      break;
  }
  if (is_integer)
    formats::hdf5::write_attribute({object, ""}, ".", name, static_cast<std::int32_t>(value));
  else
    formats::hdf5::write_attribute({object, ""}, ".", name, value);
}

void put_names(Bytes& bytes, hid_t file, const std::string& dataset, std::vector<std::string> names) {
  switch (bytes.byte() % 8) {
    case 1:
      return;
    case 2:
      foreign_dataset(bytes, file, dataset);
      return;
    case 3:
      for (std::string& name : names)
        for (std::size_t k = bytes.below(300); k > 0; --k) name += static_cast<char>(bytes.byte());
      break;
    case 4:
      other_object(bytes, file, dataset);
      return;
    case 5:
      names.assign(1 + bytes.below(3000), "node");
      break;
    case 6:
      names.assign(names.size(), "same");
      break;
    default:
      break;
  }
  formats::hdf5::write_texts({file, ""}, dataset, names);
}

/// Texts of fixed or variable length in an attribute or a dataset of `points` points.
std::vector<std::string> texts_of(hid_t type, std::size_t points, const std::function<bool(hid_t, void*)>& read) {
  std::vector<std::string> texts(points);
  if (H5Tis_variable_str(type) > 0) {
    const Id memory(text_type(H5T_VARIABLE));
    std::vector<char*> pointers(points, nullptr);
    if (!read(memory, pointers.data())) return {};
    for (std::size_t i = 0; i < points; ++i) texts[i] = pointers[i] == nullptr ? "" : pointers[i];
    for (char* pointer : pointers) H5free_memory(pointer);
    return texts;
  }
  const std::size_t length = H5Tget_size(type);
  std::vector<char> values(points * length);
  if (!read(type, values.data())) return {};
  for (std::size_t i = 0; i < points; ++i) texts[i].assign(&values[i * length], strnlen(&values[i * length], length));
  return texts;
}

void put_attribute(Bytes& bytes, hid_t from, hid_t to, const std::string& name) {
  const Id attribute(H5Aopen(from, name.c_str(), H5P_DEFAULT)), type(H5Aget_type(attribute));
  if (H5Tget_class(type) == H5T_STRING) {
    const auto texts = texts_of(type, 1, [&](hid_t as, void* values) { return H5Aread(attribute, as, values) >= 0; });
    put_text(bytes, to, name, texts.empty() ? "" : texts[0]);
  } else {
    double value = 0.0;
    H5Aread(attribute, H5T_NATIVE_DOUBLE, &value);
    put_number(bytes, to, name, value, H5Tget_class(type) == H5T_INTEGER);
  }
}

void put_dataset(Bytes& bytes, hid_t from, hid_t to, const std::string& name) {
  const Id dataset(H5Dopen2(from, name.c_str(), H5P_DEFAULT)), type(H5Dget_type(dataset)), space(H5Dget_space(dataset));
  const auto points = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  const auto read = [&](hid_t as, void* values) {
    return H5Dread(dataset, as, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0;
  };
  Table table{name, std::vector<hsize_t>(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space))), {}, false};
  H5Sget_simple_extent_dims(space, table.shape.data(), nullptr);
  if (H5Tget_class(type) == H5T_STRING) {
    const std::vector<std::string> texts = texts_of(type, points, read);
    if (table.shape.empty())
      formats::hdf5::write_text({to, ""}, name, texts.empty() ? "" : texts[0]);
    else
      put_names(bytes, to, name, texts);
    return;
  }
  table.is_integer = H5Tget_class(type) == H5T_INTEGER;
  table.values.resize(points);
  read(H5T_NATIVE_DOUBLE, table.values.data());
  if (points > 0 && !table.shape.empty())
    put_table(bytes, to, table);
  else
    write_table(to, table, table.is_integer ? H5T_STD_I32LE : H5T_IEEE_F64LE, H5P_DEFAULT);
}

herr_t note_name(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

void put_attributes(Bytes& bytes, hid_t from, hid_t to, const std::string& object) {
  const Id source(H5Oopen(from, object.c_str(), H5P_DEFAULT)), copy(H5Oopen(to, object.c_str(), H5P_DEFAULT));
  if (copy < 0) return;
  std::vector<std::string> names;
  hsize_t start = 0;
  H5Aiterate2(source, H5_INDEX_NAME, H5_ITER_INC, &start, note_name, &names);
  for (const std::string& name : names)
    if (name != "content_id") put_attribute(bytes, source, copy, name);
}

struct Object {
  std::string name;
  H5O_type_t type;
};

herr_t note_object(hid_t, const char* name, const H5O_info_t* info, void* objects) {
  static_cast<std::vector<Object>*>(objects)->push_back({name, info->type});
  return 0;
}

}  // namespace

std::string mutated_container(const std::string& sound, const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  formats::hdf5::Handle owner = formats::hdf5::create_in_memory("");
  const hid_t file = owner.id();
  const Id from(H5Fopen(sound.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (from < 0) throw Error("cannot be opened", sound, "give a sound file");
  put_attributes(bytes, from, file, "/");
  std::vector<Object> objects;
  H5Ovisit(from, H5_INDEX_NAME, H5_ITER_INC, note_object, &objects);
  for (const Object& object : objects) {
    if (object.name == ".") continue;
    if (object.type == H5O_TYPE_GROUP)
      Id(H5Gcreate2(file, object.name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    else
      put_dataset(bytes, from, file, object.name);
    put_attributes(bytes, from, file, object.name);
  }
  for (std::size_t k = bytes.below(4); k > 0; --k) foreign_dataset(bytes, file, "/more" + std::to_string(k));
  for (std::size_t k = bytes.below(4); k > 0; --k) foreign_attribute(bytes, file, "more" + std::to_string(k));
  if (bytes.byte() % 4 == 1) put_text(bytes, file, "content_id", std::string(64, 'a'));
  return formats::hdf5::file_image(std::move(owner), "");
}

}  // namespace tisserand::test_support
