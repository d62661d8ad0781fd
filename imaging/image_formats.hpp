#pragma once
/// The parts of read_image.cpp, one per file format. Not for use elsewhere.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "imaging/label_image.hpp"
#include "imaging/scalar.hpp"

namespace acinus::imaging {

/// What a file says, before units are looked at.
struct ImageFile {
  std::array<std::int64_t, 3> size{};
  Vec3 step = Vec3::Zero();  ///< sides of a voxel in units of the file; 0 where it does not say
  Vec3 unit = Vec3::Zero();  ///< um in such a unit, by axis; 0: the file does not say
  /// Reason why the sides cannot be used: a contradiction, an unknown unit. Empty: none.
  std::string step_fault;
  Scalar type = Scalar::kU8;
  std::vector<Label> label;       ///< [z][y][x]
  std::vector<std::string> note;  ///< statements of the file that are not followed

  Voxel voxels() const {  ///< @pre count_voxels
    return {static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])};
  }
};

/// Which of several channels, from 0; nothing where the file must have one only.
struct ChannelChoice {
  std::int64_t channel = -1;    ///< -1: not said
  bool only_if_needed = false;  ///< counts only where there are several
  /// The channel to read. Throws Error where there are several and none was said, or fewer.
  std::int64_t among(const std::string& path, std::int64_t n) const;
};

/// um in a unit by one of its names, as files spell it ("um", "micron", "mm"...); 0: unknown.
double unit_by_name(std::string_view name);

// All throw Error, with path and place, at what is wrong or not supported.
ImageFile read_tiff(const std::string& path, const ChannelChoice& channel);
ImageFile read_nifti(const std::string& path, const ChannelChoice& channel);
ImageFile read_metaimage(const std::string& path);
ImageFile read_nrrd(const std::string& path);
ImageFile read_hdf5(const std::string& path, const std::string& dataset,
                    const ChannelChoice& channel);

/// The axes of an image in space: columns of `axes`. Notes in `file` where they are not at right
/// angles, or make a mirror image: neither is followed.
void note_axes(const Eigen::Matrix3d& axes, const std::string& named, ImageFile& file);

/// Throws Error for an image of one slice: cells need a stack. Called before other checks, whose
/// failures would follow from it.
/// @param others  channels and times of the slice
void check_stack(const std::string& path, const std::array<std::int64_t, 3>& size,
                 std::int64_t others = 1);

/// A header may announce anything: throws Error unless so many bytes can come out of those stored.
/// @param compressed  LZW makes data at most some thousand times smaller, deflate a thousand
void check_announced(const std::string& path, double announced, double stored, bool compressed);

/// The data that the header of a file announces: raw bytes, or a zlib or gzip stream.
struct ImageBytes {
  std::string path;  ///< of the file that has them, for messages
  std::string_view stored;
  bool compressed = false, swap = false;
  std::size_t skip = 0;  ///< bytes before those of the voxels, once inflated
};

/// Fills file.label. @pre file.size and file.type are set
void take_bytes(const ImageBytes& bytes, ImageFile& file);

}  // namespace acinus::imaging
