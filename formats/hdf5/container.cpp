// SPDX-License-Identifier: GPL-3.0-or-later
// Reads untrusted HDF5 files: inspects and checks each object before memory is allocated for its data.
#include "formats/hdf5/container.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "common/memory/short_memory.hpp"
#include "common/text.hpp"
#include "formats/hdf5/descriptor_driver.hpp"

namespace tisserand::formats::hdf5 {

static_assert(sizeof(hid_t) == sizeof(Id), "hid_t of HDF5 1.10 and later");

namespace {

constexpr std::size_t max_text = 1u << 20;
constexpr std::size_t max_report = 1u << 26;
constexpr std::size_t conversion_bytes = 16u << 10;
constexpr const char* damaged_values =
    "the file is damaged, or uses a filter that is not installed; write or copy the file again";
constexpr const char* write_again = "the file is damaged; write or copy the file again";

std::string type_in_words(Id type) {
  const std::size_t bits = 8 * H5Tget_size(type);
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return fmt::format("{}-bit floating numbers", bits);
    case H5T_INTEGER:
      return fmt::format("{}-bit integers", bits);
    case H5T_STRING:
      return "strings";
    case H5T_COMPOUND:
      return "compound values";
    case H5T_ENUM:
      return "enumeration values (or booleans)";
    case H5T_VLEN:
      return "sequences of variable length";
    case H5T_ARRAY:
      return "arrays";
    default:
      return "values of another kind";
  }
}

ElementKind kind_of(Id type) {
  switch (H5Tget_class(type)) {
    case H5T_FLOAT:
      return H5Tget_size(type) == 8   ? ElementKind::float64
             : H5Tget_size(type) == 4 ? ElementKind::float32
                                      : ElementKind::other;
    case H5T_INTEGER:
      return H5Tget_size(type) <= 8 ? ElementKind::integer : ElementKind::other;
    case H5T_STRING:
      return ElementKind::text;
    default:
      return ElementKind::other;
  }
}

Shape shape_of(Id space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank <= 0) return {};
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return Shape(dims.begin(), dims.end());
}

std::uint64_t value_count(const Shape& shape) {
  std::uint64_t count = 1;
  for (const std::uint64_t extent : shape) count *= extent;
  return count;
}

/// Text of a fixed-length field without its padding.
std::string strip_padding(const char* text, std::size_t size, H5T_str_t padding) {
  std::size_t length = ::strnlen(text, size);
  if (padding == H5T_STR_SPACEPAD)
    while (length > 0 && text[length - 1] == ' ') --length;
  return std::string(text, length);
}

/// Stored bytes of the values alone. Fletcher's checksum adds four bytes to each chunk.
std::uint64_t without_checksums(Id creation, std::uint64_t stored, std::size_t element) {
  std::vector<hsize_t> chunk(H5S_MAX_RANK);
  const int rank = H5Pget_chunk(creation, H5S_MAX_RANK, chunk.data());
  std::uint64_t bytes = element;
  for (int axis = 0; axis < rank; ++axis) bytes *= chunk[axis];
  return stored / (bytes + 4) * bytes;
}

bool has_only_checksums(Id creation) {
  unsigned flags = 0;
  std::size_t values = 0;
  return H5Pget_nfilters(creation) == 1 &&
         H5Pget_filter2(creation, 0, &flags, &values, nullptr, 0, nullptr, nullptr) == H5Z_FILTER_FLETCHER32;
}

/// Block of a dataset over time: rows [start[0], start[0] + count[0]) and a box within each row.
struct Selection {
  std::vector<hsize_t> start, count;
  hsize_t values() const { return value_count(Shape(count.begin(), count.end())); }
};

/// An open dataset, its space, and the type of its values in memory.
struct Source {
  Id dataset = -1, space = -1, type = -1;
};

bool read_selection(const Source& source, const Selection& selection, Id transfer, char* values) {
  const hsize_t total = selection.values();
  const Handle memory(H5Screate_simple(1, &total, nullptr), H5Sclose);
  return H5Sselect_hyperslab(source.space, H5S_SELECT_SET, selection.start.data(), nullptr, selection.count.data(),
                             nullptr) >= 0 &&
         H5Dread(source.dataset, source.type, memory.id(), source.space, transfer, values) >= 0;
}

/// Reads rows while their writer may still run, or was killed. The writer rewrites the chunk of the last rows
/// repeatedly, so its checksum may be outdated: this chunk is read without it, the others with it.
bool read_beside_writer(const Source& source, const Selection& selection, char* values) {
  const Handle creation(H5Dget_create_plist(source.dataset), H5Pclose), transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  std::vector<hsize_t> chunk(H5S_MAX_RANK);
  if (H5Pget_chunk(creation.id(), H5S_MAX_RANK, chunk.data()) <= 0) return false;
  H5Pset_edc_check(transfer.id(), H5Z_DISABLE_EDC);
  const hsize_t rows = shape_of(source.space)[0], last = rows > 0 ? (rows - 1) / chunk[0] * chunk[0] : 0;
  const hsize_t begin = selection.start[0], end = begin + selection.count[0];
  const hsize_t middle = std::clamp(last, begin, end);
  Selection before = selection, after = selection;
  before.count[0] = middle - begin;
  after.start[0] = middle;
  after.count[0] = end - middle;
  const std::uint64_t done = H5Tget_size(source.type) * before.values();
  return (middle == begin || read_selection(source, before, H5P_DEFAULT, values)) &&
         (middle == end || read_selection(source, after, transfer.id(), values + done));
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  auto& list = *static_cast<std::vector<std::string>*>(names);
  list.emplace_back(name);
  return list.size() < max_members ? 0 : 1;
}

herr_t collect_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  auto& list = *static_cast<std::vector<std::string>*>(names);
  list.emplace_back(name);
  return list.size() < max_members ? 0 : 1;
}

herr_t find_errno(unsigned, const H5E_error2_t* entry, void* number) {
  const char* found = entry->desc != nullptr ? std::strstr(entry->desc, "errno = ") : nullptr;
  int& result = *static_cast<int*>(number);
  if (found != nullptr) result = std::atoi(found + 8);
  const bool memory =
      entry->maj_num == H5E_RESOURCE && (entry->min_num == H5E_NOSPACE || entry->min_num == H5E_CANTALLOC);
  if (memory && result == 0) result = ENOMEM;
  return 0;
}

/// System error number of the HDF5 call that just failed, or 0. ENOMEM also if HDF5 lacks memory for its own report.
int number_of_last_error() {
  const int last = errno;
  int number = 0;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_errno, &number);
  return number == 0 && last == ENOMEM ? last : number;
}

/// Problem of the HDF5 call that just failed. Damaged sizes can request any amount of memory.
Problem last_problem(const std::string& action, const std::string& remedy) {
  if (number_of_last_error() == ENOMEM)
    return {action + ": not enough memory", remedy + "; if memory is short, raise the limit (`ulimit -v`)"};
  const Error error = last_error(action, "", remedy);
  return {error.message(), error.remedy()};
}

/// Reason why the data of a dataset are unavailable; empty if they are available.
Problem storage_problem(Id creation, Id type, Id space) {
  if (H5Pget_external_count(creation) > 0 || H5Pget_layout(creation) == H5D_VIRTUAL)
    return {"its data are stored in another file", "store the data in the file itself"};
  if (type < 0 || space < 0 || H5Sget_simple_extent_type(space) == H5S_NULL)
    return {"has no values", "compare the file with its specification"};
  return {};
}

DatasetInfo dataset_info(Id dataset, Id creation, Id type, Id space) {
  DatasetInfo result;
  result.kind = kind_of(type);
  result.type_text = type_in_words(type);
  result.shape = shape_of(space);
  const auto count = static_cast<std::uint64_t>(H5Sget_simple_extent_npoints(space));
  result.stored_bytes = H5Dget_storage_size(dataset);
  const bool checked = has_only_checksums(creation);
  if (checked) result.stored_bytes = without_checksums(creation, result.stored_bytes, H5Tget_size(type));
  result.filtered = !checked && H5Pget_nfilters(creation) > 0;
  const bool whole = result.filtered || result.stored_bytes / H5Tget_size(type) >= count;
  result.written = count == 0 || (result.stored_bytes > 0 && whole);
  return result;
}

Selection selection_of(const ValuesRequest& request, const Shape& shape) {
  Selection selection;
  selection.start.assign(shape.size(), 0);
  selection.count.assign(shape.begin(), shape.end());
  selection.start[0] = request.first;
  selection.count[0] = request.count;
  if (request.part == ValuesRequest::Part::rows) return selection;
  std::uint64_t column = request.column;
  for (std::size_t axis = shape.size() - 1; axis > 0; --axis) {
    selection.start[axis] = column % shape[axis];
    selection.count[axis] = 1;
    column /= shape[axis];
  }
  return selection;
}

Id memory_type(ValuesRequest::Type type) {
  return type == ValuesRequest::Type::float64   ? H5T_NATIVE_DOUBLE
         : type == ValuesRequest::Type::float32 ? H5T_NATIVE_FLOAT
                                                : H5T_NATIVE_INT64;
}

/// Whether the HDF5 signature is at a permitted position: 0 or a power of two from 512 on.
bool has_signature(const OpenFile& file) {
  char bytes[8] = {};
  for (off_t at = 0; ::pread(file.descriptor(), bytes, sizeof bytes, at) == sizeof bytes; at = at == 0 ? 512 : 2 * at)
    if (std::memcmp(bytes, "\x89HDF\r\n\x1a\n", sizeof bytes) == 0) return true;
  return false;
}

}  // namespace

Handle::Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = other.id_;
    close_ = other.close_;
    other.id_ = -1;
  }
  return *this;
}

int Handle::reset() {
  const int status = id_ >= 0 && close_ != nullptr ? close_(id_) : 0;
  id_ = -1;
  return status;
}

void silence() {
  require_addresses(std::size_t{4} << 20U);  // HDF5 crashes or exits if it cannot initialise
  // HDF5's own closing at exit crashes on files whose last write failed. Our files are closed by their owners.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Error last_error(const std::string& action, const std::string& where, const std::string& remedy) {
  const int number = number_of_last_error();
  if (number != 0) return Error(action + ": " + std::strerror(number), where, remedy_of_errno(number));
  return Error(action, where, remedy);
}

OpenFile::OpenFile(const std::string& path)
    : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0) {
    const int number = errno;
    throw Error(fmt::format("cannot open the file: {}", std::strerror(number)), path,
                number == ENOENT ? "check the name; a relative name starts at the folder of the file that contains it"
                                 : "check the name and the permissions of the file");
  }
  struct stat status {};
  const bool known = ::fstat(descriptor_, &status) == 0;
  const bool is_ordinary = known && S_ISREG(status.st_mode);
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (is_ordinary && size_ > 0) return;
  ::close(descriptor_);
  if (!is_ordinary) throw Error("is not an ordinary file", path, "give the name of an HDF5 file");
  throw Error("the file is empty (0 bytes)", path, "write it again");
}

OpenFile::~OpenFile() { ::close(descriptor_); }

Container::Container(const OpenFile& file, Completeness completeness) : path_(file.path()) {
  silence();
  if (!has_signature(file))
    throw Error(fmt::format("is not an HDF5 file ({} bytes without the HDF5 signature)", file.size()), path_,
                "give a file written by reducer, mechanism, or another program that writes this file format");
  const Handle access = access_through(file.descriptor(), file.size());
  constexpr const char* name = "/file";  // absolute, so that HDF5 does not ask for the current folder
  file_ = Handle(H5Fopen(name, H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!file_.valid() && completeness == Completeness::any) {
    closed_properly_ = false;
    file_ = Handle(H5Fopen(name, H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.id()), H5Fclose);
    // The writer was killed after it had left the mode for concurrent readers.
    const hbool_t clear = true;
    if (!file_.valid()) H5Pset(access.id(), "clear_status_flags", &clear);
    if (!file_.valid()) file_ = Handle(H5Fopen(name, H5F_ACC_RDWR, access.id()), H5Fclose);
  }
  if (!file_.valid())
    throw last_error("is an HDF5 file, but it is damaged or truncated, or the program that wrote it did not close it",
                     path_, "write or copy the file again");
  texts_ = std::make_unique<VariableTexts>(file.descriptor(), file_.id());
}

std::string Container::place(const std::string& object) const {
  return object == "/" ? path_ : fmt::format("{}: {}", path_, object);
}

ObjectEntry Container::describe(const std::string& object) const {
  ObjectEntry entry;
  entry.name = object;
  if (object != "/") {
    H5L_info_t link;
    const htri_t found = H5Lexists(file_.id(), object.c_str(), H5P_DEFAULT);
    if (found <= 0) {
      entry.state = found < 0 ? ObjectState::unknown : ObjectState::absent;
      if (found < 0)
        entry.problem = last_problem("cannot be looked up", "the file is damaged; write or copy the file again");
      return entry;
    }
    entry.state = ObjectState::link;
    if (H5Lget_info(file_.id(), object.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD) return entry;
  }
  entry.state = ObjectState::broken;
  const Handle handle(H5Oopen(file_.id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  if (!handle.valid()) {
    entry.problem = last_problem("cannot be opened", write_again);
    return entry;
  }
  const H5I_type_t kind = H5Iget_type(handle.id());
  entry.state = kind == H5I_GROUP     ? ObjectState::group
                : kind == H5I_DATASET ? ObjectState::dataset
                                      : ObjectState::other;
  if (kind == H5I_GROUP &&
      H5Literate(handle.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &entry.members) < 0)
    entry.problem = last_problem("its members cannot be listed", write_again);
  if (kind == H5I_DATASET) {
    const Handle type(H5Dget_type(handle.id()), H5Tclose), space(H5Dget_space(handle.id()), H5Sclose);
    const Handle creation(H5Dget_create_plist(handle.id()), H5Pclose);
    entry.problem = storage_problem(creation.id(), type.id(), space.id());
    if (entry.problem.message.empty()) entry.info = dataset_info(handle.id(), creation.id(), type.id(), space.id());
  }
  describe_attributes(handle.id(), entry);
  return entry;
}

void Container::describe_attributes(Id object, ObjectEntry& entry) const {
  std::vector<std::string> names;
  if (H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &names) < 0)
    entry.attribute_problem = last_problem("its attributes cannot be listed", write_again);
  for (const std::string& name : names) entry.attributes.push_back(describe_attribute(object, name));
}

AttributeEntry Container::describe_attribute(Id object, const std::string& name) const {
  AttributeEntry entry;
  entry.name = name;
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose), space(H5Aget_space(attribute.id()), H5Sclose);
  if (!type.valid() || !space.valid()) {
    entry.problem = last_problem("cannot be read", write_again);
    return entry;
  }
  const H5T_class_t kind = H5Tget_class(type.id());
  entry.kind = kind == H5T_STRING                         ? AttributeEntry::Kind::text
               : kind == H5T_FLOAT || kind == H5T_INTEGER ? AttributeEntry::Kind::number
                                                          : AttributeEntry::Kind::other;
  entry.type_text = type_in_words(type.id());
  entry.count = static_cast<std::uint64_t>(H5Sget_simple_extent_npoints(space.id()));
  if (entry.count != 1) return entry;
  if (entry.kind == AttributeEntry::Kind::text) read_text(attribute.id(), type.id(), entry);
  if (entry.kind == AttributeEntry::Kind::number && H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &entry.number) < 0)
    entry.problem = last_problem("cannot be read", write_again);
  return entry;
}

void Container::read_text(Id attribute, Id type, AttributeEntry& entry) const {
  const auto read = [&](Id as, void* text) { return H5Aread(attribute, as, text) >= 0; };
  if (H5Tis_variable_str(type) > 0) {
    try {
      entry.text = texts_->read(1, max_text, "", read).front();
    } catch (const Error& error) {
      entry.problem = {error.message(), error.remedy()};
    }
    return;
  }
  const std::size_t size = H5Tget_size(type);
  if (size > max_text) {
    entry.problem = {fmt::format("has {} bytes, at most {} are allowed", size, max_text), "shorten it"};
    return;
  }
  std::vector<char> buffer(size + 1, '\0');
  if (read(type, buffer.data()))
    entry.text = strip_padding(buffer.data(), size, H5Tget_strpad(type));
  else
    entry.problem = last_problem("cannot be read", write_again);
}

Id Container::dataset(const std::string& name) const {
  if (last_.valid() && last_name_ == name) return last_.id();
  last_ = Handle(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  last_name_ = name;
  if (!last_.valid()) throw last_error("cannot be opened", place(name), write_again);
  const Handle creation(H5Dget_create_plist(last_.id()), H5Pclose), type(H5Dget_type(last_.id()), H5Tclose);
  const Handle space(H5Dget_space(last_.id()), H5Sclose);
  const Problem problem = storage_problem(creation.id(), type.id(), space.id());
  if (!problem.message.empty()) last_.reset();
  if (!problem.message.empty()) throw Error(problem.message, place(name), problem.remedy);
  return last_.id();
}

bool Container::is_fixed_and_below(const std::string& name, std::uint64_t bytes) const {
  const Handle handle(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type(H5Dget_type(handle.id()), H5Tclose), space(H5Dget_space(handle.id()), H5Sclose);
  std::vector<hsize_t> now(H5S_MAX_RANK), most(H5S_MAX_RANK);
  H5Sget_simple_extent_dims(space.id(), now.data(), most.data());
  return now == most && H5Tget_size(type.id()) * value_count(shape_of(space.id())) <= bytes;
}

std::vector<std::string> Container::read_texts(const std::string& name, std::uint64_t count) const {
  const Id dataset = this->dataset(name);
  const Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  if (kind_of(type.id()) != ElementKind::text ||
      H5Sget_simple_extent_npoints(space.id()) != static_cast<hssize_t>(count))
    throw Error("does not hold the expected strings", place(name), damaged_values);
  if (count == 0) return {};
  const auto read = [&](Id as, void* to) { return H5Dread(dataset, as, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0; };
  if (H5Tis_variable_str(type.id()) > 0) return texts_->read(count, max_report, place(name), read);
  const std::size_t size = H5Tget_size(type.id());
  if (size > max_report / count)
    throw Error(
        fmt::format("{} strings of {} bytes are too long, at most {} bytes are allowed", count, size, max_report),
        place(name), "shorten them");
  std::vector<char> buffer(size * count + 1, '\0');
  if (!read(type.id(), buffer.data())) throw last_error("cannot be read", place(name), damaged_values);
  std::vector<std::string> texts;
  for (std::uint64_t i = 0; i < count; ++i)
    texts.push_back(strip_padding(buffer.data() + i * size, size, H5Tget_strpad(type.id())));
  return texts;
}

void Container::read(const ValuesRequest& request, const Place& room) const {
  const Id dataset = this->dataset(request.dataset);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const Shape shape = shape_of(space.id());
  const Id type = memory_type(request.type);
  const auto unexpected = [&] {
    return Error("does not hold as many values as expected", place(request.dataset), damaged_values);
  };
  if (request.part == ValuesRequest::Part::all) {
    if (H5Sget_simple_extent_npoints(space.id()) != static_cast<hssize_t>(request.values)) throw unexpected();
    const Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    // HDF5 would clear a megabyte before each conversion, even for few integers.
    if (request.type == ValuesRequest::Type::int64) H5Pset_buffer(transfer.id(), conversion_bytes, nullptr, nullptr);
    if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, transfer.id(), room(request.values * H5Tget_size(type))) < 0)
      throw last_error("cannot be read", place(request.dataset), damaged_values);
    return;
  }
  if (shape.empty() || request.first > shape[0] || request.count > shape[0] - request.first) throw unexpected();
  const Selection selection = selection_of(request, shape);
  if (selection.values() != request.values) throw unexpected();
  char* values = room(request.values * H5Tget_size(type));
  const Source source{dataset, space.id(), type};
  if (read_selection(source, selection, H5P_DEFAULT, values)) return;
  if (!closed_properly_ && read_beside_writer(source, selection, values)) return;
  throw last_error("cannot be read", place(request.dataset), damaged_values);
}

}  // namespace tisserand::formats::hdf5
