#pragma once
/// Parts of read_image.cpp, one per file format. Not for use elsewhere.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "imaging/label_rows.hpp"
#include "imaging/scalar.hpp"

namespace acinus::imaging {

/// Content of an image file, before units are resolved.
struct ImageFile {
  std::array<std::int64_t, 3> size{};
  Vec3 step = Vec3::Zero();  ///< sides of a voxel in units of the file; 0: not stated
  Vec3 unit = Vec3::Zero();  ///< um in such a unit, by axis; 0: not stated
  /// Reason why the sides cannot be used: a contradiction, an unknown unit. Empty: none.
  std::string step_fault;
  Scalar type = Scalar::kU8;
  LabelRows rows;                 ///< see prepare_rows
  Label fill = 0;                 ///< label of voxels that the file does not have
  std::vector<std::string> note;  ///< statements of the file that are ignored

  Voxel voxels() const {  ///< @pre count_voxels
    return {static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])};
  }
};

/// Choice among several channels, from 0; nothing where the file must have one only.
struct ChannelChoice {
  std::int64_t channel = -1;    ///< -1: not given
  bool only_if_needed = false;  ///< counts only where there are several
  /// Channel to read. Throws Error where there are several and none was given, or fewer.
  std::int64_t among(const std::string& path, std::int64_t n) const;
};

/// Size, um, of a unit by one of its names, as files spell it ("um", "micron", "mm"...); 0:
/// unknown.
double unit_by_name(std::string_view name);

// All throw Error, with path and place, at what is wrong or not supported.
ImageFile read_tiff(const std::string& path, const ChannelChoice& channel);
ImageFile read_nifti(const std::string& path, const ChannelChoice& channel);
ImageFile read_metaimage(const std::string& path);
ImageFile read_nrrd(const std::string& path);
ImageFile read_hdf5(const std::string& path, const std::string& dataset,
                    const ChannelChoice& channel);

/// Choice of an image in a folder of OME-Zarr.
struct ZarrChoice {
  std::string dataset;      ///< name of the label image, or a path in the folder; "": the only one
  std::int64_t level = -1;  ///< resolution, from 0, the finest; -1: not given
};
ImageFile read_zarr(const std::string& path, const ZarrChoice& choice,
                    const ChannelChoice& channel);

/// Adds notes to `file` where the axes of an image in space, the columns of `axes`, are not at
/// right angles, or make a mirror image: neither is corrected.
void note_axes(const Eigen::Matrix3d& axes, const std::string& named, ImageFile& file);

/// Throws Error for an image of one slice: cells need a stack. Called before other checks, whose
/// failures would follow from it.
/// @param others  channels and times of the slice
void check_stack(const std::string& path, const std::array<std::int64_t, 3>& size,
                 std::int64_t others = 1);

/// Throws Error unless the announced bytes can come out of those stored: a header may announce
/// anything.
/// @param compressed  LZW makes data at most some thousand times smaller, deflate a thousand
void check_announced(const std::string& path, double announced, double stored, bool compressed);

/// Sets the size of `rows` from that of the image, which may not be allowed: Error.
/// @return number of voxels
std::size_t prepare_rows(const std::string& path, ImageFile& file);

/// Image data that a header announces: raw bytes, or a zlib or gzip stream.
struct ImageBytes {
  std::string path;        ///< file with the data
  std::uint64_t from = 0;  ///< first byte of the data, or of the stream, in the file
  bool compressed = false, swap = false;
  /// Bytes before and behind those of the voxels, after decompression.
  std::uint64_t skip = 0, rest = 0;
};

/// Reads the data into file.rows, some slices or lines at a time. @pre file.type is set and
/// prepare_rows was called
void take_bytes(const ImageBytes& bytes, ImageFile& file);

/// Appends numbers, [z][y][x], as labels. @param first  number of the first line
void append_lines(const std::string& path, std::span<const std::byte> bytes, bool swap,
                  std::size_t first, ImageFile& file);

}  // namespace acinus::imaging
