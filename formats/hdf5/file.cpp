// Reading of untrusted HDF5 files: open, look, compare with what is expected, and only then allocate and read.
#include "formats/hdf5/file.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "common/text.hpp"

namespace tisserand::formats::hdf5 {

static_assert(sizeof(hid_t) == sizeof(Id), "hid_t of HDF5 1.10 and later");

namespace {

constexpr std::size_t max_text = 1u << 20;
constexpr std::size_t max_report = 1u << 26;
constexpr hsize_t max_members = 10000;
constexpr std::size_t conversion_bytes = 16u << 10;
constexpr const char* damaged_values =
    "the file is damaged (checksums tell) or uses a filter that is not installed; write or copy it again";

/// Properties of every file access: no locks (they fail on network disks and in readers beside a writer).
Handle access_properties() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.id(), false, true);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  return access;
}

/// A copy in memory of a file whose writer was killed after it had left the mode that readers may share.
Handle open_copy_of_killed(const std::string& path) {
  const Handle access = access_properties();
  H5Pset_fapl_core(access.id(), 1u << 20, false);
  const hbool_t clear = true;
  H5Pset(access.id(), "clear_status_flags", &clear);
  return Handle(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()), H5Fclose);
}

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

Shape shape_of(Id space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank <= 0) return {};
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return Shape(dims.begin(), dims.end());
}

std::uint64_t count_of(const Shape& shape) {
  std::uint64_t count = 1;
  for (const std::uint64_t extent : shape) count *= extent;
  return count;
}

/// The text of a fixed-length field without its padding.
std::string strip_padding(const char* text, std::size_t size, H5T_str_t padding) {
  std::size_t length = ::strnlen(text, size);
  if (padding == H5T_STR_SPACEPAD)
    while (length > 0 && text[length - 1] == ' ') --length;
  return std::string(text, length);
}

/// `count` texts of variable length, each at most `most` bytes, which `read` lets HDF5 allocate. It does so in a child
/// process: HDF5 1.10 copies as many bytes as a damaged file says, over what lies behind its buffer.
std::vector<std::string> variable_texts(const std::string& path, std::uint64_t count, std::size_t most,
                                        const std::string& where, const std::function<bool(void*)>& read) {
  const std::string bytes = read_apart(path, [&] {
    std::vector<char*> pointers(count, nullptr);
    std::string joined;
    if (!read(pointers.data())) return joined;
    for (const char* text : pointers) joined.append(text, text == nullptr ? 0 : ::strnlen(text, most)) += '\0';
    return joined;
  });
  std::vector<std::string> texts;
  for (std::size_t begin = 0, end; (end = bytes.find('\0', begin)) != std::string::npos; begin = end + 1)
    texts.push_back(bytes.substr(begin, end - begin));
  if (texts.size() != count) throw Error("cannot be read", where, damaged_values);
  return texts;
}

/// Bytes that the values themselves take in the file: Fletcher's checksum adds four to each chunk.
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

/// Values of a dataset over time: rows [start[0], start[0] + count[0]) and a box of each.
struct Selection {
  std::vector<hsize_t> start, count;
};

bool read_selection(Id dataset, Id space, const Selection& selection, Id transfer, double* values) {
  const hsize_t total = count_of(Shape(selection.count.begin(), selection.count.end()));
  const Handle memory(H5Screate_simple(1, &total, nullptr), H5Sclose);
  return H5Sselect_hyperslab(space, H5S_SELECT_SET, selection.start.data(), nullptr, selection.count.data(), nullptr) >=
             0 &&
         H5Dread(dataset, H5T_NATIVE_DOUBLE, memory.id(), space, transfer, values) >= 0;
}

/// The chunk in which the rows end is written again and again while a run goes on. Where its writer was met, or killed,
/// amid that, the rows are there but their checksum is not yet: this chunk is then read without, the others with it.
bool read_beside_writer(Id dataset, Id space, const Selection& selection, double* values) {
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose), transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  std::vector<hsize_t> chunk(H5S_MAX_RANK);
  if (H5Pget_chunk(creation.id(), H5S_MAX_RANK, chunk.data()) <= 0) return false;
  H5Pset_edc_check(transfer.id(), H5Z_DISABLE_EDC);
  const hsize_t rows = shape_of(space)[0], last = rows > 0 ? (rows - 1) / chunk[0] * chunk[0] : 0;
  const hsize_t begin = selection.start[0], end = begin + selection.count[0];
  const hsize_t middle = std::clamp(last, begin, end);
  Selection before = selection, after = selection;
  before.count[0] = middle - begin;
  after.start[0] = middle;
  after.count[0] = end - middle;
  const std::uint64_t done = count_of(Shape(before.count.begin(), before.count.end()));
  return (middle == begin || read_selection(dataset, space, before, H5P_DEFAULT, values)) &&
         (middle == end || read_selection(dataset, space, after, transfer.id(), values + done));
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
  if (found != nullptr) *static_cast<int*>(number) = std::atoi(found + 8);
  return 0;
}

/// Throws unless `path` is a readable ordinary file that begins like HDF5.
void require_hdf5(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    const int number = errno;
    throw Error(fmt::format("cannot open the file: {}", std::strerror(number)), path,
                number == ENOENT ? "check the name; relative names count from the file that names them"
                                 : "check the name and the permissions of the file");
  }
  struct stat status {};
  const bool known = ::fstat(file, &status) == 0;
  ::close(file);
  if (!known || !S_ISREG(status.st_mode)) throw Error("is not an ordinary file", path, "give the name of an HDF5 file");
  if (status.st_size == 0) throw Error("the file is empty (0 bytes)", path, "write it again");
  if (H5Fis_hdf5(path.c_str()) <= 0)
    throw Error(fmt::format("is not an HDF5 file ({} bytes without the HDF5 signature)", status.st_size), path,
                "give a file written by reducer, mechanism, or another program that follows the specification");
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
  // HDF5's own closing at exit crashes on files whose last write failed; ours are closed by their owners.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

std::string shape_text(const Shape& shape) {
  if (shape.empty()) return "scalar";
  std::vector<std::string> parts;
  for (const std::uint64_t extent : shape) parts.push_back(std::to_string(extent));
  return join(parts, " x ");
}

Error last_error(const std::string& action, const std::string& where, const std::string& remedy) {
  int number = 0;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_errno, &number);
  if (number != 0) return Error(action + ": " + std::strerror(number), where, remedy_of_errno(number));
  return Error(action, where, remedy);
}

InputFile::InputFile(const std::string& path, Completeness completeness) : path_(path) {
  silence();
  require_hdf5(path);
  const Handle access = access_properties();
  file_ = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!file_.valid() && completeness == Completeness::any) {
    closed_properly_ = false;
    file_ = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY | H5F_ACC_SWMR_READ, access.id()), H5Fclose);
    if (!file_.valid()) file_ = open_copy_of_killed(path);
  }
  if (!file_.valid())
    throw last_error("is an HDF5 file, but it is damaged, cut short, or was not closed by the program that wrote it",
                     path, "write or copy it again");
}

std::string InputFile::place(const std::string& object) const {
  return object == "/" ? path_ : fmt::format("{}: {}", path_, object);
}

bool InputFile::has(const std::string& object) const {
  if (object == "/") return true;
  for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
    const std::string name = object.substr(0, end);
    const htri_t found = H5Lexists(file_.id(), name.c_str(), H5P_DEFAULT);
    if (found < 0) throw last_error("cannot be looked up", place(name), "the file is damaged; write or copy it again");
    if (found == 0) return false;
    if (end == std::string::npos) return true;
  }
}

bool InputFile::has_attribute(const std::string& object, const std::string& name) const {
  if (!has(object)) return false;
  const htri_t found = H5Aexists_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT);
  if (found < 0)
    throw last_error("its attributes cannot be looked up", place(object),
                     "the file is damaged; write or copy it again");
  return found > 0;
}

Handle InputFile::open_object(const std::string& object) const {
  if (!has(object)) throw Error("is missing", place(object), "compare the file with its specification");
  for (std::size_t end = object.find('/', 1); object != "/"; end = object.find('/', end + 1)) {
    H5L_info_t link;
    const std::string name = object.substr(0, end);
    if (H5Lget_info(file_.id(), name.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      throw Error("is a link to somewhere else", place(name), "store the object itself in the file");
    if (end == std::string::npos) break;
  }
  Handle handle(H5Oopen(file_.id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  if (!handle.valid()) throw last_error("cannot be opened", place(object), "the file is damaged; write it again");
  return handle;
}

std::vector<std::string> InputFile::members(const std::string& group) const {
  const Handle object = open_object(group);
  if (H5Iget_type(object.id()) != H5I_GROUP)
    throw Error("is not a group", place(group), "compare with the specification");
  std::vector<std::string> names;
  if (H5Literate(object.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names) < 0)
    throw last_error("its members cannot be listed", place(group), "the file is damaged; write it again");
  return names;
}

std::vector<std::string> InputFile::attributes(const std::string& object) const {
  const Handle handle = open_object(object);
  std::vector<std::string> names;
  if (H5Aiterate2(handle.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_attribute, &names) < 0)
    throw last_error("its attributes cannot be listed", place(object), "the file is damaged; write it again");
  return names;
}

std::string InputFile::text_attribute(const std::string& object, const std::string& name) const {
  const std::string where = fmt::format("{}: attribute '{}'", place(object), name);
  if (!has_attribute(object, name)) throw Error("is missing", where, "add it; it is a string");
  const Handle attribute(H5Aopen_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose), space(H5Aget_space(attribute.id()), H5Sclose);
  if (!type.valid() || !space.valid()) throw last_error("cannot be read", where, "the file is damaged; write it again");
  if (kind_of(type.id()) != ElementKind::text)
    throw Error(fmt::format("holds {}, expected a string", type_in_words(type.id())), where, "write it as one string");
  if (H5Sget_simple_extent_npoints(space.id()) != 1)
    throw Error(fmt::format("has {} values, expected one string", H5Sget_simple_extent_npoints(space.id())), where,
                "write it as one string");
  const std::size_t size = H5Tget_size(type.id());
  const auto read = [&](void* texts) { return H5Aread(attribute.id(), type.id(), texts) >= 0; };
  if (H5Tis_variable_str(type.id()) > 0) return variable_texts(path_, 1, max_text, where, read).front();
  if (size > max_text)
    throw Error(fmt::format("has {} bytes, at most {} are allowed", size, max_text), where, "shorten it");
  std::vector<char> buffer(size + 1, '\0');
  if (!read(buffer.data())) throw last_error("cannot be read", where, "the file is damaged; write it again");
  return strip_padding(buffer.data(), size, H5Tget_strpad(type.id()));
}

double InputFile::number_attribute(const std::string& object, const std::string& name) const {
  const std::string where = fmt::format("{}: attribute '{}'", place(object), name);
  if (!has_attribute(object, name)) throw Error("is missing", where, "add it; it is a number");
  const Handle attribute(H5Aopen_by_name(file_.id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose), space(H5Aget_space(attribute.id()), H5Sclose);
  if (!type.valid() || !space.valid()) throw last_error("cannot be read", where, "the file is damaged; write it again");
  const H5T_class_t kind = H5Tget_class(type.id());
  if (kind != H5T_FLOAT && kind != H5T_INTEGER)
    throw Error(fmt::format("holds {}, expected a number", type_in_words(type.id())), where, "write it as one number");
  if (H5Sget_simple_extent_npoints(space.id()) != 1)
    throw Error(fmt::format("has {} values, expected one number", H5Sget_simple_extent_npoints(space.id())), where,
                "write it as one number");
  double value = 0.0;
  if (H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0)
    throw last_error("cannot be read", where, "the file is damaged; write it again");
  return value;
}

Handle InputFile::open_dataset(const std::string& dataset) const {
  Handle handle = open_object(dataset);
  if (H5Iget_type(handle.id()) != H5I_DATASET)
    throw Error("is not a dataset", place(dataset), "compare the file with its specification");
  const Handle creation(H5Dget_create_plist(handle.id()), H5Pclose);
  if (H5Pget_external_count(creation.id()) > 0 || H5Pget_layout(creation.id()) == H5D_VIRTUAL)
    throw Error("its data are stored in another file", place(dataset), "store the data in the file itself");
  return handle;
}

DatasetInfo InputFile::info(const std::string& dataset) const {
  const Handle handle = open_dataset(dataset);
  const Handle type(H5Dget_type(handle.id()), H5Tclose), space(H5Dget_space(handle.id()), H5Sclose);
  const Handle creation(H5Dget_create_plist(handle.id()), H5Pclose);
  if (!type.valid() || !space.valid() || H5Sget_simple_extent_type(space.id()) == H5S_NULL)
    throw Error("has no values", place(dataset), "compare the file with its specification");
  DatasetInfo result;
  result.kind = kind_of(type.id());
  result.type_text = type_in_words(type.id());
  result.shape = shape_of(space.id());
  const auto count = static_cast<std::uint64_t>(H5Sget_simple_extent_npoints(space.id()));
  result.stored_bytes = H5Dget_storage_size(handle.id());
  const bool checked = has_only_checksums(creation.id());
  if (checked) result.stored_bytes = without_checksums(creation.id(), result.stored_bytes, H5Tget_size(type.id()));
  result.filtered = !checked && H5Pget_nfilters(creation.id()) > 0;
  const bool whole = result.filtered || result.stored_bytes / H5Tget_size(type.id()) >= count;
  result.written = count == 0 || (result.stored_bytes > 0 && whole);
  return result;
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

void InputFile::read(const std::string& dataset, const Shape& shape, const std::string& meaning, double* values) const {
  require(dataset, ElementKind::float64, shape, meaning);
  if (H5Dread(open_dataset(dataset).id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    throw last_error("cannot be read", place(dataset), damaged_values);
}

void InputFile::read(const std::string& dataset, const Shape& shape, const std::string& meaning,
                     std::int64_t* values) const {
  require(dataset, ElementKind::integer, shape, meaning);
  // HDF5 would zero a megabyte before each conversion, however few the numbers are.
  const Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_buffer(transfer.id(), conversion_bytes, nullptr, nullptr);
  if (H5Dread(open_dataset(dataset).id(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, transfer.id(), values) < 0)
    throw last_error("cannot be read", place(dataset), damaged_values);
}

std::vector<std::string> InputFile::read_all_texts(Id dataset, std::uint64_t count, const std::string& where) const {
  const Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  if (count == 0) return {};
  const auto read = [&](void* to) { return H5Dread(dataset, type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0; };
  if (H5Tis_variable_str(type.id()) > 0) return variable_texts(path_, count, max_report, where, read);
  const std::size_t size = H5Tget_size(type.id());
  if (size > max_report / count)
    throw Error(
        fmt::format("{} strings of {} bytes are too long, at most {} bytes are allowed", count, size, max_report),
        where, "shorten them");
  std::vector<char> buffer(size * count + 1, '\0');
  if (!read(buffer.data())) throw last_error("cannot be read", where, damaged_values);
  std::vector<std::string> texts;
  for (std::uint64_t i = 0; i < count; ++i)
    texts.push_back(strip_padding(buffer.data() + i * size, size, H5Tget_strpad(type.id())));
  return texts;
}

std::vector<std::string> InputFile::read_texts(const std::string& dataset, std::uint64_t count,
                                               const std::string& meaning) const {
  require(dataset, ElementKind::text, {count}, meaning);
  return read_all_texts(open_dataset(dataset).id(), count, place(dataset));
}

std::string InputFile::read_text(const std::string& dataset) const {
  require(dataset, ElementKind::text, {}, "one string");
  return read_all_texts(open_dataset(dataset).id(), 1, place(dataset)).front();
}

void InputFile::read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t count, double* values) const {
  const Handle handle = open_dataset(dataset), space(H5Dget_space(handle.id()), H5Sclose);
  std::vector<hsize_t> start(8, 0), extent;
  for (const std::uint64_t e : shape_of(space.id())) extent.push_back(e);
  TISSERAND_ENSURE(!extent.empty() && extent.size() <= 8 && first + count <= extent[0], "rows {} + {} of {}", first,
                   count, dataset);
  start[0] = first;
  extent[0] = count;
  start.resize(extent.size());
  const Selection selection{start, extent};
  if (read_selection(handle.id(), space.id(), selection, H5P_DEFAULT, values)) return;
  if (!closed_properly_ && read_beside_writer(handle.id(), space.id(), selection, values)) return;
  throw last_error("cannot be read", place(dataset), damaged_values);
}

void InputFile::read_column(const std::string& dataset, std::uint64_t column, std::uint64_t count,
                            double* values) const {
  const Handle handle = open_dataset(dataset), space(H5Dget_space(handle.id()), H5Sclose);
  const Shape shape = shape_of(space.id());
  TISSERAND_ENSURE(!shape.empty() && count <= shape[0], "column of {} rows of {}", count, dataset);
  std::vector<hsize_t> start(shape.size(), 0), extent(shape.size(), 1);
  for (std::size_t axis = shape.size() - 1; axis > 0; --axis) {
    start[axis] = column % shape[axis];
    column /= shape[axis];
  }
  extent[0] = count;
  const Selection selection{start, extent};
  if (read_selection(handle.id(), space.id(), selection, H5P_DEFAULT, values)) return;
  if (!closed_properly_ && read_beside_writer(handle.id(), space.id(), selection, values)) return;
  throw last_error("cannot be read", place(dataset), damaged_values);
}

}  // namespace tisserand::formats::hdf5
