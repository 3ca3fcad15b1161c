// Writing of HDF5 objects, and files that are composed in memory so that the disk sees them whole or not at all.
#include <hdf5.h>

#include <algorithm>
#include <cstring>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

namespace {

constexpr const char* remedy = "choose another place for the file";

/// Zero-padded UTF-8 of `size` bytes.
Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(size, 1));
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

void write_attribute(Id file, const std::string& object, const std::string& name, Id file_type, Id memory_type,
                     const void* value, const std::string& where) {
  if (H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) > 0)
    H5Adelete_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate_by_name(file, object.c_str(), name.c_str(), file_type, space.id(), H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!attribute.valid() || H5Awrite(attribute.id(), memory_type, value) < 0)
    throw last_error(fmt::format("cannot write attribute '{}' of {}", name, object), where, remedy);
}

/// Creates and writes; no times are stored, so that equal contents give equal bytes.
void write_values(Id file, const std::string& dataset, Id space, Id file_type, Id memory_type, const void* values,
                  const std::string& where) {
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.id(), 1);
  H5Pset_obj_track_times(creation.id(), false);
  const Handle handle(H5Dcreate2(file, dataset.c_str(), file_type, space, links.id(), creation.id(), H5P_DEFAULT),
                      H5Dclose);
  if (!handle.valid() || H5Dwrite(handle.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    throw last_error(fmt::format("cannot write dataset {}", dataset), where, remedy);
}

Handle simple_space(const Shape& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return Handle(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose);
}

}  // namespace

void write_text_attribute(Id file, const std::string& object, const std::string& name, const std::string& value,
                          const std::string& where) {
  std::string padded = value;
  if (padded.empty()) padded.push_back('\0');
  const Handle type = text_type(padded.size());
  write_attribute(file, object, name, type.id(), type.id(), padded.data(), where);
}

void write_number_attribute(Id file, const std::string& object, const std::string& name, double value,
                            const std::string& where) {
  write_attribute(file, object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value, where);
}

void write_integer_attribute(Id file, const std::string& object, const std::string& name, std::int32_t value,
                             const std::string& where) {
  write_attribute(file, object, name, H5T_STD_I32LE, H5T_NATIVE_INT32, &value, where);
}

void write_dataset(Id file, const std::string& dataset, const Shape& shape, const double* values,
                   const std::string& where) {
  write_values(file, dataset, simple_space(shape).id(), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values, where);
}

void write_dataset(Id file, const std::string& dataset, const Shape& shape, const std::int32_t* values,
                   const std::string& where) {
  write_values(file, dataset, simple_space(shape).id(), H5T_STD_I32LE, H5T_NATIVE_INT32, values, where);
}

void write_texts(Id file, const std::string& dataset, const std::vector<std::string>& values,
                 const std::string& where) {
  std::size_t size = 1;
  for (const std::string& value : values) size = std::max(size, value.size());
  std::vector<char> buffer(size * values.size() + 1, '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    std::memcpy(buffer.data() + i * size, values[i].data(), values[i].size());
  const Handle type = text_type(size);
  write_values(file, dataset, simple_space({values.size()}).id(), type.id(), type.id(), buffer.data(), where);
}

void write_text(Id file, const std::string& dataset, const std::string& value, const std::string& where) {
  if (H5Lexists(file, dataset.c_str(), H5P_DEFAULT) > 0) H5Ldelete(file, dataset.c_str(), H5P_DEFAULT);
  std::string padded = value;
  if (padded.empty()) padded.push_back('\0');
  const Handle type = text_type(padded.size()), space(H5Screate(H5S_SCALAR), H5Sclose);
  write_values(file, dataset, space.id(), type.id(), type.id(), padded.data(), where);
}

Handle create_in_memory(const std::string& where) {
  silence();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id(), 1u << 20, false);
  Handle file(H5Fcreate("memory", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose);
  if (!file.valid()) throw last_error("cannot compose the file in memory", where, "check the installation of HDF5");
  return file;
}

std::string file_image(Id file, const std::string& where) {
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  std::string image(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  if (size <= 0 || H5Fget_file_image(file, image.data(), image.size()) != size)
    throw last_error("cannot compose the file in memory", where, "check the installation of HDF5");
  return image;
}

}  // namespace tisserand::formats::hdf5
