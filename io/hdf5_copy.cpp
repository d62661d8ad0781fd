#include <vector>

#include "io/hdf5.hpp"

namespace acinus::io::h5 {

void File::copy_object_from(const File& source, const std::string& name) {
  if (H5Ocopy(source.id(), name.c_str(), id(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0) {
    fail_here("copy " + name + " from " + source.path());
  }
}

void File::copy_rows_from(const File& source, const std::string& name, std::int64_t n) {
  auto dims = source.shape(name);
  const std::string attempted = "copy dataset " + name + " from " + source.path();
  if (n < 0 || static_cast<hsize_t>(n) > dims[0]) fail_here(attempted + " (it has too few rows)");
  const Handle from = source.open_dataset(name);
  const Handle type(H5Dget_type(from.id()), H5Tclose);
  const Handle list(H5Dget_create_plist(from.id()), H5Pclose);
  hsize_t chunk[2] = {0, 0};
  const int rank = static_cast<int>(dims.size());
  if (H5Pget_chunk(list.id(), rank, chunk) != rank || chunk[0] == 0) fail_here(attempted);
  hsize_t file_size = 0;
  if (H5Fget_filesize(source.id(), &file_size) < 0) fail_here(attempted);
  // Rows are written without gaps of whole chunks: there are at most as many as bytes.
  if (static_cast<hsize_t>(n) / chunk[0] > file_size)
    source.refuse("dataset " + name + " claims more rows than the file can hold");
  hsize_t limit[2] = {H5S_UNLIMITED, rank == 2 ? dims[1] : 0};
  dims[0] = static_cast<hsize_t>(n);
  const Handle space(H5Screate_simple(rank, dims.data(), limit), H5Sclose);
  Handle to(
      H5Dcreate2(id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, list.id(), H5P_DEFAULT),
      H5Dclose);
  if (!to.valid()) fail_here(attempted);
  std::vector<char> buffer;
  for (hsize_t row = 0; row < dims[0]; row += chunk[0]) {
    const hsize_t corner[2] = {row, 0};
    hsize_t size = 0;
    std::uint32_t skipped_filters = 0;
    haddr_t address = HADDR_UNDEF;
    if (H5Dget_chunk_info_by_coord(from.id(), corner, &skipped_filters, &address, &size) < 0) {
      source.fail_here("read dataset " + name);
    }
    if (address == HADDR_UNDEF) continue;  // padding that was never written
    if (size > file_size) source.refuse("dataset " + name + " has a chunk larger than the file");
    buffer.resize(size);
    if (H5Dread_chunk(from.id(), H5P_DEFAULT, corner, &skipped_filters, buffer.data()) < 0) {
      source.fail_here("read dataset " + name);
    }
    if (H5Dwrite_chunk(to.id(), H5P_DEFAULT, skipped_filters, corner, size, buffer.data()) < 0)
      fail_here(attempted);
  }
  if (to.close() < 0 || state_->error != 0) fail_here(attempted);
  write_attribute(name, "unit", source.read_text_attribute(name, "unit"));
}

}  // namespace acinus::io::h5
