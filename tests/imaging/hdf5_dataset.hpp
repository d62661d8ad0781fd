#pragma once
/// HDF5 files with one dataset, as other programs write them.

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <vector>

namespace acinus::imaging {

struct Hdf5Dataset {
  std::vector<hsize_t> shape{};
  std::vector<std::uint32_t> value{};
  std::string tags{};                 ///< attribute axistags
  std::vector<std::string> labels{};  ///< attribute DIMENSION_LABELS
  std::vector<double> step{};         ///< attribute element_size_um
  std::vector<hsize_t> chunk{};
  H5Z_filter_t filter = 0;
  bool written = true;
};

inline void put_text(hid_t set, const char* name, const std::vector<std::string>& text) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  const hsize_t n = text.size();
  const hid_t space = n == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr);
  const hid_t attribute = H5Acreate2(set, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  std::vector<const char*> raw;
  for (const std::string& t : text) raw.push_back(t.c_str());
  H5Awrite(attribute, type, raw.data());
  H5Aclose(attribute);
  H5Sclose(space);
  H5Tclose(type);
}

/// Filter that is known where the file is written, and taken out of the library afterwards.
inline constexpr H5Z_filter_t kForeign = 32000;
inline std::size_t keep_bytes(unsigned, std::size_t, const unsigned*, std::size_t n, std::size_t*,
                              void**) {
  return n;
}

inline void write_dataset(const std::string& path, const Hdf5Dataset& d) {
  const H5Z_class2_t foreign{H5Z_CLASS_T_VERS, kForeign, 1, 1, "lzf", nullptr, nullptr, keep_bytes};
  if (d.filter == kForeign) H5Zregister(&foreign);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const int rank = static_cast<int>(d.shape.size());
  const hid_t space = H5Screate_simple(rank, d.shape.data(), nullptr);
  const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
  if (!d.chunk.empty()) H5Pset_chunk(list, rank, d.chunk.data());
  if (d.filter != 0) H5Pset_filter(list, d.filter, 0, 0, nullptr);
  const hid_t set =
      H5Dcreate2(file, "labels", H5T_STD_U32LE, space, H5P_DEFAULT, list, H5P_DEFAULT);
  if (d.written) H5Dwrite(set, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, d.value.data());
  if (!d.tags.empty()) put_text(set, "axistags", {d.tags});
  if (!d.labels.empty()) put_text(set, "DIMENSION_LABELS", d.labels);
  if (!d.step.empty()) {
    const hsize_t n = d.step.size();
    const hid_t line = H5Screate_simple(1, &n, nullptr);
    const hid_t a =
        H5Acreate2(set, "element_size_um", H5T_NATIVE_DOUBLE, line, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(a, H5T_NATIVE_DOUBLE, d.step.data());
    H5Aclose(a);
    H5Sclose(line);
  }
  H5Dclose(set);
  H5Pclose(list);
  H5Sclose(space);
  H5Fclose(file);
  if (d.filter == kForeign) H5Zunregister(kForeign);
}

}  // namespace acinus::imaging
