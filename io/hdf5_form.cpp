#include "io/hdf5_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/hdf5_handle.hpp"

namespace acinus::io::h5 {
namespace {

constexpr double kLargestCompression = 1100;  ///< over bytes stored: deflate yields at most 1032
constexpr double kUncheckedBytes = 1 << 20;   ///< bytes, below which chunks are not counted
constexpr int kMostRank = 32;                 ///< limit of HDF5

Form describe_form(hid_t type, hid_t space) {
  Form form;
  const int rank = H5Sget_simple_extent_ndims(space);
  const H5S_class_t shape = H5Sget_simple_extent_type(space);
  if (rank < 0 || rank > kMostRank || shape == H5S_NO_CLASS) return form;
  form.type = H5Tget_class(type);
  form.width = H5Tget_size(type);
  form.variable = form.type == H5T_STRING && H5Tis_variable_str(type) != 0;
  form.nothing = shape == H5S_NULL;
  form.extent.resize(rank);
  if (rank > 0) H5Sget_simple_extent_dims(space, form.extent.data(), nullptr);
  return form;
}

/// True if the filters of a chunked dataset are among those that this program writes.
/// @param packs  set if one of them compresses
bool has_known_filters(hid_t list, bool& packs) {
  const int n = H5Pget_nfilters(list);
  for (int k = 0; k < n; ++k) {
    unsigned flags = 0;
    std::size_t n_value = 0;
    const H5Z_filter_t filter = H5Pget_filter2(list, static_cast<unsigned>(k), &flags, &n_value,
                                               nullptr, 0, nullptr, nullptr);
    packs = packs || filter == H5Z_FILTER_DEFLATE;
    if (filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_SHUFFLE &&
        filter != H5Z_FILTER_FLETCHER32)
      return false;
  }
  return n >= 0;
}

/// Size of one chunk, bytes.
double chunk_size(hid_t list, double width) {
  std::array<hsize_t, kMostRank> chunk{};
  const int rank = H5Pget_chunk(list, kMostRank, chunk.data());
  for (int k = 0; k < rank; ++k) width *= static_cast<double>(chunk[k]);
  return width;
}

}  // namespace

double most_from_file(double file_size) { return kLargestCompression * file_size; }

double Form::n_value() const {
  if (nothing) return 0;
  double n = 1;
  for (const hsize_t length : extent) n *= static_cast<double>(length);
  return n;
}

Form form_of_dataset(hid_t dataset) {
  const Handle type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  return type.valid() && space.valid() ? describe_form(type.id(), space.id()) : Form{};
}

Form form_of_attribute(hid_t attribute) {
  const Handle type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  return type.valid() && space.valid() ? describe_form(type.id(), space.id()) : Form{};
}

std::string describe(const Form& form) {
  if (form.type == H5T_NO_CLASS) return "nothing that can be read";
  const double n = form.n_value();
  if (form.type == H5T_STRING && form.variable)
    return fmt::format("{:.6g} texts of variable length", n);
  const char* what = form.type == H5T_STRING    ? "texts"
                     : form.type == H5T_INTEGER ? "whole numbers"
                     : form.type == H5T_FLOAT   ? "numbers"
                                                : "values of another kind";
  return fmt::format("{:.6g} {} of {} bytes", n, what, form.width);
}

std::string fault_of_storage(hid_t dataset, double wanted, double file_size) {
  const Handle list(H5Dget_create_plist(dataset), H5Pclose);
  if (!list.valid()) return "its storage cannot be told";
  const H5D_layout_t layout = H5Pget_layout(list.id());
  if (layout == H5D_VIRTUAL || H5Pget_external_count(list.id()) > 0)
    return "its numbers stand in other files, which are not read";
  bool packs = false;
  if (layout == H5D_CHUNKED && !has_known_filters(list.id(), packs))
    return "it is packed in a way that is not read here";
  const Handle type(H5Dget_type(dataset), H5Tclose);
  const double one_chunk = layout == H5D_CHUNKED
                               ? chunk_size(list.id(), static_cast<double>(H5Tget_size(type.id())))
                               : 0;
  const double most = packs ? kLargestCompression * file_size : file_size;
  if (wanted > most || (packs && one_chunk > most))
    return "it claims to be larger than the file can hold";
  if (wanted <= std::min(file_size, kUncheckedBytes)) return "";
  const double stored = static_cast<double>(H5Dget_storage_size(dataset));
  if (wanted > (packs ? kLargestCompression : 1) * stored)
    return "it claims to be larger than what is stored of it";
  return "";
}

}  // namespace acinus::io::h5
