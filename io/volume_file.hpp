#pragma once
/// Datasets of numbers on a grid in HDF5 files of other programs.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace acinus::io {

/// Volume dataset, as it is stored.
struct VolumeInfo {
  std::string name;                 ///< path in the file
  std::vector<std::int64_t> shape;  ///< slowest axis first
  int bytes = 0;                    ///< size of a number
  bool is_real = false, has_sign = false;
  /// um, attribute element_size_um, in the order of the shape; empty if missing.
  std::vector<double> element_size;
  std::string axis_tags;                ///< attribute axistags, JSON of vigra and ilastik
  std::vector<std::string> axis_label;  ///< attribute DIMENSION_LABELS, or axes; in that order
  std::vector<std::string> codec;       ///< names of filters that the library here cannot undo
  /// Size of the numbers in the file, bytes; 0: none were ever written.
  double stored = 0;
  std::vector<std::int64_t> chunk;  ///< numbers of a chunk along each axis; empty: not in chunks
  std::int64_t chunks = 0, chunks_written = 0;  ///< chunks that are not written read as 0
  std::string fault;  ///< contradiction between shape and storage; empty: none
};

/// Lists all datasets of numbers with two or more axes, by name. Throws Error(kFileError) if the
/// file is not HDF5, truncated or damaged.
std::vector<VolumeInfo> list_volumes(const std::string& path);

/// Box of a volume, in the order of the shape.
struct VolumeBox {
  std::vector<std::int64_t> first, count;
};

/// Reads the numbers in boxes of one volume, in this machine's byte order, one after the other, and
/// calls visit(number of the box, its numbers). Throws Error(kFileError) if they cannot be read.
void read_volume(const std::string& path, const VolumeInfo& volume,
                 std::span<const VolumeBox> boxes,
                 const std::function<void(std::size_t, std::span<const std::byte>)>& visit);

}  // namespace acinus::io
