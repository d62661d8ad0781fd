#include "io/volume_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <functional>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "io/attribute_texts.hpp"
#include "io/hdf5.hpp"

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
  std::vector<double> size(n);
  if (H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, size.data()) < 0) return {};
  return size;
}

/// Names of axes from attributes that are not JSON.
std::vector<std::string> labels_of(const std::string& path, const h5::Handle& dataset) {
  std::vector<std::string> labels = read_attribute_texts(path, dataset, "DIMENSION_LABELS");
  const bool said = std::ranges::any_of(labels, [](const auto& t) { return !t.empty(); });
  if (said) return labels;
  labels = read_attribute_texts(path, dataset, "axes");
  if (labels.size() != 1) return labels;
  std::vector<std::string> letters;  // "zyx" in one text
  for (const char c : labels[0]) letters.emplace_back(1, c);
  return letters;
}

std::string name_of_filter(H5Z_filter_t id, const char* stored) {
  constexpr std::array<std::pair<H5Z_filter_t, const char*>, 9> kNames{{{H5Z_FILTER_SZIP, "szip"},
                                                                        {307, "bzip2"},
                                                                        {32000, "lzf"},
                                                                        {32001, "blosc"},
                                                                        {32004, "lz4"},
                                                                        {32008, "bitshuffle"},
                                                                        {32013, "zfp"},
                                                                        {32015, "zstd"},
                                                                        {32026, "blosc2"}}};
  for (const auto& [number, name] : kNames)
    if (number == id) return fmt::format("{} (filter {})", name, id);
  return fmt::format("{} (filter {})", stored[0] != 0 ? stored : "an unknown codec", id);
}

/// Reads codecs, bytes and chunks of a dataset, and any contradiction among them.
/// @param file_size  bytes of the file, an upper bound for every number in it
void read_storage(const h5::Handle& dataset, const h5::Handle& space, double file_size,
                  VolumeInfo& v) {
  const h5::Handle list(H5Dget_create_plist(dataset.id()), H5Pclose);
  for (int k = 0; k < H5Pget_nfilters(list.id()); ++k) {
    std::array<char, 64> name{};
    unsigned flags = 0;
    std::size_t n_value = 0;
    const H5Z_filter_t id = H5Pget_filter2(list.id(), static_cast<unsigned>(k), &flags, &n_value,
                                           nullptr, name.size() - 1, name.data(), nullptr);
    if (id >= 0 && H5Zfilter_avail(id) <= 0) v.codec.push_back(name_of_filter(id, name.data()));
  }
  v.stored = static_cast<double>(H5Dget_storage_size(dataset.id()));
  const H5D_layout_t layout = H5Pget_layout(list.id());
  double bytes = v.bytes;
  for (const std::int64_t n : v.shape) bytes *= static_cast<double>(n);
  if (layout == H5D_VIRTUAL || H5Pget_external_count(list.id()) > 0)
    v.fault = "its numbers are in other files; copy them into one";
  if (v.stored > file_size)
    v.fault =
        fmt::format("{:.0f} bytes of numbers are announced in a file of {:.0f}: it is damaged",
                    v.stored, file_size);
  if (layout == H5D_CONTIGUOUS && v.stored > 0 && v.stored != bytes)
    v.fault =
        fmt::format("its shape needs {:.0f} bytes, but {:.0f} are stored: the file is damaged",
                    bytes, v.stored);
  if (layout != H5D_CHUNKED) return;
  const std::size_t rank = v.shape.size();
  std::vector<hsize_t> chunk(rank), now(rank), most(rank);
  H5Pget_chunk(list.id(), static_cast<int>(rank), chunk.data());
  H5Sget_simple_extent_dims(space.id(), now.data(), most.data());
  v.chunk.assign(chunk.begin(), chunk.end());
  double chunks = 1;
  for (std::size_t k = 0; k < rank; ++k) {
    if (chunk[k] == 0) return;
    chunks *= static_cast<double>((now[k] + chunk[k] - 1) / chunk[k]);
    if (chunk[k] > now[k] && most[k] == now[k])
      v.fault = fmt::format("axis {} has {} numbers, fewer than a chunk's {}: the file is damaged",
                            k, now[k], chunk[k]);
  }
  hsize_t written = 0;
  if (H5Dget_num_chunks(dataset.id(), space.id(), &written) < 0) return;
  constexpr double kMost = 1e15;
  v.chunks = static_cast<std::int64_t>(std::min(chunks, kMost));
  v.chunks_written = static_cast<std::int64_t>(written);
  if (v.chunks_written > v.chunks)
    v.fault = fmt::format("its shape has {} chunks, but {} are stored: the file is damaged",
                          v.chunks, v.chunks_written);
}

/// Throws Error(kFileError) with advice for files that this program did not write.
[[noreturn]] void fail(const std::string& path, const std::string& attempted) {
  H5Eclear2(H5E_DEFAULT);
  throw Error(fmt::format("{}: cannot {}. The file is cut short or damaged, or another program is "
                          "writing it.",
                          path, attempted),
              Exit::kFileError);
}

h5::File open(const std::string& path) {
  check(std::filesystem::is_regular_file(path),
        fmt::format("{}: no such file. Check the path.", path));
  try {
    return h5::File::open(path, h5::Access::kRead);
  } catch (const Error&) {
    // HDF5's words are about its own structures.
  }
  const bool is_hdf5 = H5Fis_hdf5(path.c_str()) > 0;
  H5Eclear2(H5E_DEFAULT);
  throw Error(is_hdf5
                  ? fmt::format("{}: cannot be opened: it is an HDF5 file that is cut short "
                                "(truncated) or damaged, or another program is writing it.",
                                path)
                  : fmt::format("{}: is no HDF5 file. Check that it is the file you meant.", path),
              Exit::kFileError);
}

void add_volume(const h5::File& file, const std::string& name, std::vector<VolumeInfo>& found) {
  constexpr std::size_t kLeastAxes = 2;
  const h5::Handle dataset(H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) fail(file.path(), "open dataset " + name);
  const h5::Handle space(H5Dget_space(dataset.id()), H5Sclose);
  const h5::Handle type = native_type_of(dataset);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  const H5T_class_t kind = H5Tget_class(type.id());
  if (rank < static_cast<int>(kLeastAxes) || (kind != H5T_INTEGER && kind != H5T_FLOAT)) return;
  std::vector<hsize_t> shape(rank);
  H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
  VolumeInfo v;
  v.name = "/" + name;
  for (const hsize_t n : shape)
    v.shape.push_back(static_cast<std::int64_t>(std::min<hsize_t>(n, INT64_MAX)));
  v.bytes = static_cast<int>(H5Tget_size(type.id()));
  v.is_real = kind == H5T_FLOAT;
  v.has_sign = !v.is_real && H5Tget_sign(type.id()) != H5T_SGN_NONE;
  v.element_size = element_size_of(dataset);
  const std::vector<std::string> tags = read_attribute_texts(file.path(), dataset, "axistags");
  if (tags.size() == 1) v.axis_tags = tags[0];
  v.axis_label = labels_of(file.path(), dataset);
  read_storage(dataset, space, static_cast<double>(std::filesystem::file_size(file.path())), v);
  found.push_back(std::move(v));
}

}  // namespace

std::vector<VolumeInfo> list_volumes(const std::string& path) {
  const h5::File file = open(path);
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
      add_volume(v.file, name, v.found);
    } catch (...) {
      v.failure = std::current_exception();
      return -1;
    }
    return 0;
  };
  const herr_t status =
      H5Ovisit2(file.id(), H5_INDEX_NAME, H5_ITER_INC, each, &visit, H5O_INFO_BASIC);
  if (visit.failure) std::rethrow_exception(visit.failure);
  if (status < 0) fail(path, "list its datasets");
  return std::move(visit.found);
}

void read_volume(const std::string& path, const VolumeInfo& volume,
                 std::span<const VolumeBox> boxes,
                 const std::function<void(std::size_t, std::span<const std::byte>)>& visit) {
  const h5::File file = open(path);
  const h5::Handle dataset(H5Dopen2(file.id(), volume.name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) fail(path, "open dataset " + volume.name);
  const h5::Handle type = native_type_of(dataset);
  const h5::Handle space(H5Dget_space(dataset.id()), H5Sclose);
  std::vector<std::byte> bytes;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const std::vector<hsize_t> first(boxes[k].first.begin(), boxes[k].first.end()),
        count(boxes[k].count.begin(), boxes[k].count.end());
    bytes.resize(std::accumulate(count.begin(), count.end(), std::size_t{1}, std::multiplies()) *
                 volume.bytes);
    const h5::Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                            H5Sclose);
    if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, first.data(), nullptr, count.data(),
                            nullptr) < 0 ||
        H5Dread(dataset.id(), type.id(), memory.id(), space.id(), H5P_DEFAULT, bytes.data()) < 0)
      fail(path, "read dataset " + volume.name);
    visit(k, bytes);
  }
}

}  // namespace acinus::io
