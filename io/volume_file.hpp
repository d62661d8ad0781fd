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
  std::string axis_tags;                ///< attribute axistags, JSON of vigra and ilastik
  std::vector<std::string> axis_label;  ///< attribute DIMENSION_LABELS, or axes; in that order
  std::vector<std::string> codec;       ///< filters that the library here cannot undo
  /// Bytes that the numbers take in the file; 0: none were ever written.
  double stored = 0;
  std::int64_t chunks = 0, chunks_written = 0;  ///< what is not written reads as 0
  std::string fault;                            ///< a contradiction between shape and storage
};

/// All datasets of numbers with two or more axes, by name.
/// Throws Error(kFileError) if the file is not HDF5, cut short or damaged.
std::vector<VolumeInfo> list_volumes(const std::string& path);

/// The numbers of one, in this machine's byte order.
/// Throws Error(kFileError) if they cannot be read.
std::vector<std::byte> read_volume(const std::string& path, const VolumeInfo& volume);

}  // namespace acinus::io
