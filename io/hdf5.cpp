#include "io/hdf5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "io/hdf5_form.hpp"

namespace acinus::io::h5 {
namespace {

void start_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    H5dont_atexit();  // files are closed explicitly; HDF5's exit handler retries failed writes
                      // instead
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5Lunregister(H5L_TYPE_EXTERNAL);  // no file makes this program open others
  });
}

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, float>) {
    return H5T_NATIVE_FLOAT;
  } else if constexpr (std::is_same_v<T, double>) {
    return H5T_NATIVE_DOUBLE;
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return H5T_NATIVE_INT64;
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return H5T_NATIVE_UINT64;
  } else {
    static_assert(std::is_same_v<T, std::uint8_t>);
    return H5T_NATIVE_UINT8;
  }
}

template <class T>
hid_t stored_type() {
  if constexpr (std::is_same_v<T, float>) {
    return H5T_IEEE_F32LE;
  } else if constexpr (std::is_same_v<T, double>) {
    return H5T_IEEE_F64LE;
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return H5T_STD_I64LE;
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return H5T_STD_U64LE;
  } else {
    static_assert(std::is_same_v<T, std::uint8_t>);
    return H5T_STD_U8LE;
  }
}

Handle access_list() {
  start_library();
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.id(), false, true);  // locks fail on many network file systems
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  return access;
}

int first_error(const StagedState& state) {
  return state.error != 0 ? state.error : state.read_error;
}

std::string trim(const char* begin, std::size_t width) { return {begin, strnlen(begin, width)}; }

}  // namespace

Handle text_type(std::size_t width, H5T_cset_t set) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(width, 1));  // HDF5 has no text of length 0
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), set);
  return type;
}

File::File(std::string path, std::unique_ptr<StagedState> state, Handle handle, bool writing)
    : path_(std::move(path)),
      state_(std::move(state)),
      handle_(std::move(handle)),
      writing_(writing) {}

File File::create(const std::string& path, Format format) {
  const Handle access = access_list();
  auto state = std::make_unique<StagedState>();
  use_staged_driver(access.id(), state.get(), format == Format::kEarliest);
  const auto version = format == Format::kEarliest ? H5F_LIBVER_EARLIEST : H5F_LIBVER_V110;
  const auto newest = format == Format::kEarliest ? H5F_LIBVER_LATEST : H5F_LIBVER_V110;
  H5Pset_libver_bounds(access.id(), version, newest);
  const Handle list(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(list.id(), false);  // the same numbers make the same file
  Handle handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, list.id(), access.id()), H5Fclose);
  if (!handle.valid()) fail(path, "create the file", state->error);
  return {path, std::move(state), std::move(handle), true};
}

File File::open(const std::string& path, Access mode) {
  const Handle access = access_list();
  auto state = std::make_unique<StagedState>();
  const bool writing = mode == Access::kAppend;
  use_staged_driver(access.id(), state.get(), false);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_EARLIEST, H5F_LIBVER_LATEST);
  // A reader takes each row once. Without a cache of chunks it also leaves alone what stands beside
  // the rows, which may be damaged.
  if (!writing) H5Pset_cache(access.id(), 0, 0, 0, 0);
  Handle handle(H5Fopen(path.c_str(), writing ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access.id()),
                H5Fclose);
  if (!handle.valid())
    fail(path, writing ? "open for writing" : "open for reading", first_error(*state));
  return {path, std::move(state), std::move(handle), writing};
}

File::~File() {
  if (!handle_.valid()) return;
  if (writing_) state_->discard = true;
}

void File::fail_here(const std::string& attempted) const {
  fail(path_, attempted, first_error(*state_));
}

void File::refuse(const std::string& found) const {
  throw Error(
      fmt::format("{}: {}. The file is damaged or was not written by acinus.", path_, found),
      Exit::kFileError);
}

void File::flush() {
  if (H5Fflush(id(), H5F_SCOPE_GLOBAL) < 0 || state_->error != 0) fail_here("write to disk");
}

void File::close() {
  const herr_t closed = handle_.close();
  if (state_->error != 0) fail_here("write to disk");
  if (closed < 0) fail_here("close the file");
}

bool File::exists(const std::string& name) const {
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    const std::string prefix = name.substr(0, end);
    if (H5Lexists(id(), prefix.c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

void File::create_group(const std::string& name) {
  const Handle list(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(list.id(), false);
  const Handle group(H5Gcreate2(id(), name.c_str(), H5P_DEFAULT, list.id(), H5P_DEFAULT), H5Gclose);
  if (!group.valid()) fail_here("create group " + name);
}

std::vector<std::string> File::members(const std::string& name) const {
  const Handle group(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info{};
  if (!group.valid() || H5Gget_info(group.id(), &info) < 0) fail_here("read group " + name);
  std::vector<std::string> result;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const auto get = [&](char* out, std::size_t size) {
      return H5Lget_name_by_idx(group.id(), ".", H5_INDEX_NAME, H5_ITER_INC, i, out, size,
                                H5P_DEFAULT);
    };
    const auto length = get(nullptr, 0);
    if (length < 0) fail_here("read group " + name);
    std::string member(length, '\0');
    get(member.data(), member.size() + 1);
    result.push_back(std::move(member));
  }
  std::sort(result.begin(), result.end());
  return result;
}

Handle File::open_dataset(const std::string& name) const {
  Handle dataset(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) fail_here("open dataset " + name);
  return dataset;
}

std::vector<hsize_t> File::shape(const std::string& name) const {
  constexpr hsize_t kMostRows = hsize_t{1} << 62, kMostComponents = 4096;
  const Form form = form_of_dataset(open_dataset(name).id());
  const std::vector<hsize_t>& extent = form.extent;
  const bool are_rows = (extent.size() == 1 || extent.size() == 2) && extent[0] <= kMostRows &&
                        (extent.size() == 1 || (extent[1] > 0 && extent[1] <= kMostComponents));
  if (!are_rows) refuse(fmt::format("dataset {} holds {}, no rows", name, describe(form)));
  return extent;
}

std::int64_t File::n_row(const std::string& name) const {
  return static_cast<std::int64_t>(shape(name)[0]);
}

int File::components(const std::string& name) const {
  const auto dims = shape(name);
  return dims.size() == 1 ? 0 : static_cast<int>(dims[1]);
}

Handle File::create_dataset(const std::string& name, hid_t type, const Storage& storage,
                            std::string_view unit) {
  const int rank = storage.components == 0 ? 1 : 2;
  const hsize_t extent[2] = {0, static_cast<hsize_t>(storage.components)};
  const hsize_t limit[2] = {H5S_UNLIMITED, static_cast<hsize_t>(storage.components)};
  const hsize_t chunk[2] = {static_cast<hsize_t>(storage.chunk_rows),
                            static_cast<hsize_t>(storage.components)};
  const Handle space(H5Screate_simple(rank, extent, limit), H5Sclose);
  const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(list.id(), rank, chunk);
  H5Pset_obj_track_times(list.id(), false);  // the same numbers make the same file
  if (storage.filtered) {
    H5Pset_shuffle(list.id());
    H5Pset_deflate(list.id(), 1);
    H5Pset_fletcher32(list.id());
  }
  Handle dataset(
      H5Dcreate2(id(), name.c_str(), type, space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
      H5Dclose);
  if (!dataset.valid()) fail_here("create dataset " + name);
  write_attribute(name, "unit", unit);
  return dataset;
}

template <class T>
void File::create_rows(const std::string& name, const Storage& storage, std::string_view unit) {
  create_dataset(name, stored_type<T>(), storage, unit);
}

void File::create_text_rows(const std::string& name, int width, std::int64_t chunk_rows) {
  const Handle type = text_type(width, H5T_CSET_UTF8);
  create_dataset(name, type.id(), {.chunk_rows = chunk_rows}, "text");
}

void File::write_raw(const std::string& name, hid_t type, std::int64_t first_row,
                     std::int64_t n_value, const void* value) {
  if (n_value == 0) return;
  auto dims = shape(name);
  const hsize_t per_row = dims.size() == 2 ? dims[1] : 1;
  const hsize_t n = static_cast<hsize_t>(n_value) / per_row;
  const hsize_t start[2] = {static_cast<hsize_t>(first_row), 0};
  const hsize_t count[2] = {n, per_row};
  Handle dataset = open_dataset(name);
  if (start[0] + n > dims[0]) {
    dims[0] = start[0] + n;
    if (H5Dset_extent(dataset.id(), dims.data()) < 0) fail_here("grow dataset " + name);
  }
  const Handle file_space(H5Dget_space(dataset.id()), H5Sclose);
  const Handle memory_space(H5Screate_simple(static_cast<int>(dims.size()), count, nullptr),
                            H5Sclose);
  H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start, nullptr, count, nullptr);
  if (H5Dwrite(dataset.id(), type, memory_space.id(), file_space.id(), H5P_DEFAULT, value) < 0) {
    fail_here("write dataset " + name);
  }
  if (dataset.close() < 0 || state_->error != 0)
    fail_here("write dataset " + name);  // compresses here
}

template <class T>
void File::write_rows(const std::string& name, std::int64_t first_row, std::span<const T> value) {
  write_raw(name, native_type<T>(), first_row, static_cast<std::int64_t>(value.size()),
            value.data());
}

void File::write_text_rows(const std::string& name, std::int64_t first_row,
                           std::span<const std::string> value) {
  std::size_t width = 0;
  {
    const Handle dataset = open_dataset(name);
    const Handle type(H5Dget_type(dataset.id()), H5Tclose);
    width = H5Tget_size(type.id());
  }
  std::string packed(width * value.size(), '\0');
  for (std::size_t i = 0; i < value.size(); ++i) {
    value[i].copy(packed.data() + i * width, width);
    if (value[i].size() > width) std::memcpy(packed.data() + (i + 1) * width - 3, "...", 3);
  }
  const Handle type = text_type(width, H5T_CSET_UTF8);
  write_raw(name, type.id(), first_row, static_cast<std::int64_t>(value.size()), packed.data());
}

void File::check_rows(const std::string& name, hsize_t n_row, std::int64_t first,
                      std::int64_t n) const {
  if (n == 0) return;  // an empty frame wrote no padding up to its place
  const auto end = static_cast<hsize_t>(first) + static_cast<hsize_t>(n);
  check(first >= 0 && n >= 0 && end <= n_row,
        fmt::format("{}: dataset {} has {} rows, but rows up to {} should be there. The file is "
                    "damaged or incomplete.",
                    path_, name, n_row, end),
        Exit::kFileError);
}

void File::read_raw(const Handle& dataset, const std::string& name, hid_t type,
                    std::int64_t first_row, std::int64_t n, void* value) const {
  if (n == 0) return;
  const auto dims = shape(name);
  const hsize_t start[2] = {static_cast<hsize_t>(first_row), 0};
  const hsize_t count[2] = {static_cast<hsize_t>(n), dims.size() == 2 ? dims[1] : 1};
  const Handle file_space(H5Dget_space(dataset.id()), H5Sclose);
  const Handle memory_space(H5Screate_simple(static_cast<int>(dims.size()), count, nullptr),
                            H5Sclose);
  if (H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start, nullptr, count, nullptr) < 0 ||
      H5Dread(dataset.id(), type, memory_space.id(), file_space.id(), H5P_DEFAULT, value) < 0)
    fail_here("read dataset " + name);
}

template <class T>
bool File::holds(const std::string& name) const {
  const Handle dataset = open_dataset(name);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  return H5Tequal(type.id(), stored_type<T>()) > 0;
}

void File::check_storage(const Handle& dataset, const std::string& name, double bytes) const {
  hsize_t size = 0;
  if (bytes == 0) return;
  if (H5Fget_filesize(id(), &size) < 0) fail_here("find its size");
  const auto file_size = static_cast<double>(size);
  if (bytes > most_from_file(file_size))
    refuse(fmt::format("dataset {} claims to be larger than the file can hold", name));
  if (writing_) return;  // what this session wrote may not be stored yet
  if (const std::string fault = fault_of_storage(dataset.id(), bytes, file_size); !fault.empty())
    refuse(fmt::format("dataset {}: {}", name, fault));
  handed_out_ += bytes;
  if (handed_out_ > most_from_file(file_size))
    refuse("its datasets claim more than the file can hold");
}

template <class T>
std::vector<T> File::read_rows(const std::string& name, std::int64_t first_row,
                               std::int64_t n) const {
  if (!holds<T>(name)) {
    throw Error(path_ + ": dataset " + name +
                    " has an unexpected type. The file was not written by acinus.",
                Exit::kFileError);
  }
  const auto dims = shape(name);
  check_rows(name, dims[0], first_row, n);
  const hsize_t per_row = dims.size() == 2 ? dims[1] : 1;
  const Handle dataset = open_dataset(name);
  check_storage(dataset, name, static_cast<double>(n) * static_cast<double>(per_row) * sizeof(T));
  std::vector<T> value(n * per_row);
  read_raw(dataset, name, native_type<T>(), first_row, n, value.data());
  return value;
}

std::vector<std::string> File::read_text_rows(const std::string& name, std::int64_t first_row,
                                              std::int64_t n) const {
  const Handle dataset = open_dataset(name);
  const Form form = form_of_dataset(dataset.id());
  if (!form.is_text() || form.extent.size() != 1)
    refuse(fmt::format("dataset {} holds {}, where a column of texts of fixed length is expected",
                       name, describe(form)));
  check_rows(name, shape(name)[0], first_row, n);
  check_storage(dataset, name, static_cast<double>(n) * static_cast<double>(form.width));
  std::string packed(form.width * n, '\0');
  const Handle type = text_type(form.width, H5T_CSET_UTF8);
  read_raw(dataset, name, type.id(), first_row, n, packed.data());
  std::vector<std::string> value;
  for (std::int64_t i = 0; i < n; ++i)
    value.push_back(trim(packed.data() + i * form.width, form.width));
  return value;
}

template <class T>
void File::create_array(const std::string& name, std::size_t n) {
  const hsize_t extent = n;
  const Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links.id(), 1);
  const Handle dataset(H5Dcreate2(id(), name.c_str(), stored_type<T>(), space.id(), links.id(),
                                  H5P_DEFAULT, H5P_DEFAULT),
                       H5Dclose);
  if (!dataset.valid()) fail_here("create dataset " + name);
}

#define ACINUS_H5_INSTANTIATE(T)                                                             \
  template void File::create_rows<T>(const std::string&, const Storage&, std::string_view);  \
  template void File::write_rows<T>(const std::string&, std::int64_t, std::span<const T>);   \
  template std::vector<T> File::read_rows<T>(const std::string&, std::int64_t, std::int64_t) \
      const;                                                                                 \
  template void File::create_array<T>(const std::string&, std::size_t);                      \
  template bool File::holds<T>(const std::string&) const;
ACINUS_H5_INSTANTIATE(float)
ACINUS_H5_INSTANTIATE(double)
ACINUS_H5_INSTANTIATE(std::int64_t)
ACINUS_H5_INSTANTIATE(std::uint64_t)
ACINUS_H5_INSTANTIATE(std::uint8_t)
#undef ACINUS_H5_INSTANTIATE

}  // namespace acinus::io::h5
