#include "core/io/volume_file.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <numeric>

#include "core/io/hdf5.hpp"

namespace acinus::io {
namespace {

h5::Handle native_type_of(const h5::Handle& dataset) {
  const h5::Handle stored(H5Dget_type(dataset.id()), H5Tclose);
  return {H5Tget_native_type(stored.id(), H5T_DIR_ASCEND), H5Tclose};
}

std::vector<double> element_size_of(const h5::Handle& dataset) {
  constexpr const char* kName = "element_size_um";
  if (H5Aexists(dataset.id(), kName) <= 0) return {};
  const h5::Handle attribute(H5Aopen(dataset.id(), kName, H5P_DEFAULT), H5Aclose);
  const h5::Handle space(H5Aget_space(attribute.id()), H5Sclose);
  const hssize_t n = H5Sget_simple_extent_npoints(space.id());
  constexpr hssize_t kMostAxes = 8;
  if (n < 1 || n > kMostAxes) return {};
  std::vector<double> size(static_cast<std::size_t>(n));
  if (H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, size.data()) < 0) return {};
  return size;
}

void look_at(const h5::File& file, const std::string& name, std::vector<VolumeInfo>& found) {
  constexpr std::size_t kLeastAxes = 3;
  const h5::Handle dataset(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) h5::fail(file.path(), "open dataset " + name);
  const h5::Handle space(H5Dget_space(dataset.id()), H5Sclose);
  const h5::Handle type = native_type_of(dataset);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  const H5T_class_t kind = H5Tget_class(type.id());
  if (rank < static_cast<int>(kLeastAxes) || (kind != H5T_INTEGER && kind != H5T_FLOAT)) return;
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
  VolumeInfo v;
  v.name = "/" + name;
  for (const hsize_t n : shape)
    v.shape.push_back(static_cast<std::int64_t>(std::min<hsize_t>(n, INT64_MAX)));
  v.bytes = static_cast<int>(H5Tget_size(type.id()));
  v.is_real = kind == H5T_FLOAT;
  v.has_sign = !v.is_real && H5Tget_sign(type.id()) != H5T_SGN_NONE;
  v.element_size = element_size_of(dataset);
  found.push_back(std::move(v));
}

}  // namespace

std::vector<VolumeInfo> list_volumes(const std::string& path) {
  const h5::File file = h5::File::open(path, h5::Access::kRead);
  struct Visit {
    const h5::File& file;
    std::vector<VolumeInfo> found;
    std::exception_ptr failure;
  } visit{file, {}, nullptr};
  // An exception must not cross the library, which is C.
  const auto each = [](hid_t, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    auto& v = *static_cast<Visit*>(data);
    if (info->type != H5O_TYPE_DATASET) return 0;
    try {
      look_at(v.file, name, v.found);
    } catch (...) {
      v.failure = std::current_exception();
      return -1;
    }
    return 0;
  };
  const herr_t status =
      H5Ovisit2(file.id(), H5_INDEX_NAME, H5_ITER_INC, each, &visit, H5O_INFO_BASIC);
  if (visit.failure) std::rethrow_exception(visit.failure);
  if (status < 0) h5::fail(path, "list its datasets");
  return std::move(visit.found);
}

std::vector<std::byte> read_volume(const std::string& path, const VolumeInfo& volume) {
  const h5::File file = h5::File::open(path, h5::Access::kRead);
  const h5::Handle dataset(H5Dopen2(file.id(), volume.name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) h5::fail(path, "open dataset " + volume.name);
  const h5::Handle type = native_type_of(dataset);
  const std::int64_t n =
      std::accumulate(volume.shape.begin(), volume.shape.end(), std::int64_t{1}, std::multiplies());
  std::vector<std::byte> bytes(static_cast<std::size_t>(n) *
                               static_cast<std::size_t>(volume.bytes));
  if (H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    h5::fail(path, "read dataset " + volume.name);
  return bytes;
}

}  // namespace acinus::io
