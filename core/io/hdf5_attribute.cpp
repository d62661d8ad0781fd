#include <algorithm>
#include <cstring>

#include "core/io/hdf5.hpp"

namespace acinus::io::h5 {
namespace {

/// Opens an attribute, or creates it.
Handle obtain(hid_t object, const std::string& name, hid_t type, hid_t space) {
  if (H5Aexists(object, name.c_str()) > 0)
    return {H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose};
  return {H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
}

}  // namespace

void File::write_attribute(const std::string& object, const std::string& name,
                           std::span<const std::int64_t> value) {
  const Handle owner(H5Oopen(id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  const hsize_t n = value.size();
  const Handle space(n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr), H5Sclose);
  const Handle attribute = obtain(owner.id(), name, H5T_STD_I64LE, space.id());
  if (!attribute.valid() || H5Awrite(attribute.id(), H5T_NATIVE_INT64, value.data()) < 0) {
    fail_here("write attribute " + name + " of " + object);
  }
}

void File::write_attribute(const std::string& object, const std::string& name,
                           std::string_view text) {
  const Handle owner(H5Oopen(id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  // ASCII, fixed length: VTK's readers compare the type of these attributes.
  const Handle type = text_type(text.size(), H5T_CSET_ASCII);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  std::string padded(text);
  padded.resize(std::max<std::size_t>(text.size(), 1), '\0');
  if (H5Aexists(owner.id(), name.c_str()) > 0) H5Adelete(owner.id(), name.c_str());
  const Handle attribute = obtain(owner.id(), name, type.id(), space.id());
  if (!attribute.valid() || H5Awrite(attribute.id(), type.id(), padded.data()) < 0) {
    fail_here("write attribute " + name + " of " + object);
  }
}

void File::write_hash(const std::string& object, const std::string& name, std::uint64_t value) {
  const Handle owner(H5Oopen(id(), object.c_str(), H5P_DEFAULT), H5Oclose);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute = obtain(owner.id(), name, H5T_STD_U64LE, space.id());
  if (!attribute.valid() || H5Awrite(attribute.id(), H5T_NATIVE_UINT64, &value) < 0) {
    fail_here("write attribute " + name + " of " + object);
  }
}

std::vector<std::int64_t> File::read_attribute(const std::string& object,
                                               const std::string& name) const {
  const Handle attribute(
      H5Aopen_by_name(id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) fail_here("read attribute " + name + " of " + object);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  const hssize_t n = H5Sget_simple_extent_npoints(space.id());
  if (n < 0 || n > 64) fail_here("read attribute " + name + " of " + object);
  std::vector<std::int64_t> value(n);
  if (H5Aread(attribute.id(), H5T_NATIVE_INT64, value.data()) < 0) {
    fail_here("read attribute " + name + " of " + object);
  }
  return value;
}

std::uint64_t File::read_hash(const std::string& object, const std::string& name) const {
  const Handle attribute(
      H5Aopen_by_name(id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  std::uint64_t value = 0;
  const Handle space(attribute.valid() ? H5Aget_space(attribute.id()) : -1, H5Sclose);
  if (!space.valid() || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Aread(attribute.id(), H5T_NATIVE_UINT64, &value) < 0) {
    fail_here("read attribute " + name + " of " + object);
  }
  return value;
}

std::string File::read_text_attribute(const std::string& object, const std::string& name) const {
  const Handle attribute(
      H5Aopen_by_name(id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!attribute.valid()) fail_here("read attribute " + name + " of " + object);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0) {
    fail_here("read attribute " + name + " of " + object + " as fixed-length text");
  }
  std::string text(H5Tget_size(type.id()), '\0');
  if (H5Aread(attribute.id(), type.id(), text.data()) < 0)
    fail_here("read attribute " + name + " of " + object);
  text.resize(strnlen(text.data(), text.size()));
  return text;
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(id(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

void File::write_text(const std::string& name, std::string_view text) {
  if (exists(name) && H5Ldelete(id(), name.c_str(), H5P_DEFAULT) < 0)
    fail_here("replace dataset " + name);
  const Handle type = text_type(text.size(), H5T_CSET_UTF8);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  std::string padded(text);
  padded.resize(std::max<std::size_t>(text.size(), 1), '\0');
  const Handle dataset(
      H5Dcreate2(id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose);
  if (!dataset.valid() ||
      H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()) < 0) {
    fail_here("write dataset " + name);
  }
  write_attribute(name, "unit", "text");
}

std::string File::read_text(const std::string& name) const {
  const Handle dataset = open_dataset(name);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0) {
    fail_here("read dataset " + name + " as fixed-length text");
  }
  std::string text(H5Tget_size(type.id()), '\0');
  if (H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) {
    fail_here("read dataset " + name);
  }
  text.resize(strnlen(text.data(), text.size()));
  return text;
}

}  // namespace acinus::io::h5
