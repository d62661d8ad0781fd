#pragma once
/// Datasets of numbers on a grid in HDF5 files of other programs.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace acinus::io {

/// One such dataset, as it is stored.
struct VolumeInfo {
  std::string name;                 ///< path in the file
  std::vector<std::int64_t> shape;  ///< slowest axis first
  int bytes = 0;                    ///< of a number
  bool is_real = false, has_sign = false;
  /// um, attribute element_size_um, in the order of the shape; empty where it is not there.
  std::vector<double> element_size;
};

/// All datasets of numbers with three or more axes, by name.
/// Throws Error(kFileError) if the file is not HDF5, or damaged.
std::vector<VolumeInfo> list_volumes(const std::string& path);

/// The numbers of one, in this machine's byte order.
/// Throws Error(kFileError) if they cannot be read.
std::vector<std::byte> read_volume(const std::string& path, const VolumeInfo& volume);

}  // namespace acinus::io
