#include <fmt/format.h>

#include <algorithm>

#include "io/hdf5.hpp"
#include "io/hdf5_form.hpp"

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

Handle File::open_attribute(const std::string& object, const std::string& name) const {
  Handle attribute(H5Aopen_by_name(id(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                   H5Aclose);
  if (!attribute.valid()) fail_here("read attribute " + name + " of " + object);
  return attribute;
}

std::vector<std::int64_t> File::read_attribute(const std::string& object,
                                               const std::string& name) const {
  constexpr double kMost = 64;
  const Handle attribute = open_attribute(object, name);
  const Form form = form_of_attribute(attribute.id());
  if (form.type != H5T_INTEGER || form.width > sizeof(std::int64_t) || form.n_value() > kMost)
    refuse(fmt::format("attribute {} of {} holds {}, where a few whole numbers are expected", name,
                       object, describe(form)));
  std::vector<std::int64_t> value(static_cast<std::size_t>(form.n_value()));
  if (!value.empty() && H5Aread(attribute.id(), H5T_NATIVE_INT64, value.data()) < 0)
    fail_here("read attribute " + name + " of " + object);
  return value;
}

std::int64_t File::read_count(const std::string& object, const std::string& name) const {
  const std::vector<std::int64_t> value = read_attribute(object, name);
  if (value.size() != 1 || value[0] < 0)
    refuse(fmt::format("attribute {} of {} is no count", name, object));
  return value[0];
}

std::uint64_t File::read_hash(const std::string& object, const std::string& name) const {
  const Handle attribute = open_attribute(object, name);
  const Form form = form_of_attribute(attribute.id());
  if (form.type != H5T_INTEGER || form.width != sizeof(std::uint64_t) || form.n_value() != 1)
    refuse(fmt::format("attribute {} of {} holds {}, where one whole number is expected", name,
                       object, describe(form)));
  std::uint64_t value = 0;
  if (H5Aread(attribute.id(), H5T_NATIVE_UINT64, &value) < 0)
    fail_here("read attribute " + name + " of " + object);
  return value;
}

std::string File::read_text_attribute(const std::string& object, const std::string& name) const {
  constexpr std::size_t kMostBytes = 1 << 20;
  const Handle attribute = open_attribute(object, name);
  const Form form = form_of_attribute(attribute.id());
  if (!form.is_text() || form.n_value() != 1 || form.width > kMostBytes)
    refuse(fmt::format("attribute {} of {} holds {}, where one text of fixed length is expected",
                       name, object, describe(form)));
  std::string text(form.width, '\0');
  const Handle type(H5Aget_type(attribute.id()), H5Tclose);
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
  const Form form = form_of_dataset(dataset.id());
  if (!form.is_text() || form.n_value() != 1)
    refuse(fmt::format("dataset {} holds {}, where one text of fixed length is expected", name,
                       describe(form)));
  check_storage(dataset, name, static_cast<double>(form.width));
  std::string text(form.width, '\0');
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  if (H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
    fail_here("read dataset " + name);
  text.resize(strnlen(text.data(), text.size()));
  return text;
}

}  // namespace acinus::io::h5
