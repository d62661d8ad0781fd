#pragma once
/// Fields of substances at the frames of a run: fields/frame_000000.vtkhdf, ... beside the run
/// file, each a VTKHDF ImageData whose points are the centres of voxels, and fields.vtkhdf.series,
/// which lists them with their times for ParaView.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace acinus::io {

struct VoxelField {
  std::string name, unit;
  std::vector<float> value;  ///< [z][y][x]
};

struct FieldFrame {
  double time_s = 0;
  Vec3 origin = Vec3::Zero();   ///< um, corner with the smallest coordinates
  Vec3 spacing = Vec3::Ones();  ///< um
  std::array<int, 3> n{};       ///< voxels along x, y, z
  std::vector<VoxelField> field;
};

/// Writes the frames of one run. A frame appears whole or not at all. Errors: Error(kFileError).
class FieldFiles {
 public:
  /// @param folder  of the run
  /// @param times   s, of the frames that are kept; later ones are removed
  FieldFiles(std::string folder, std::vector<double> times, bool compress);

  void append(const FieldFrame& frame);
  const std::vector<double>& times() const { return times_; }

  static constexpr const char* kFolder = "fields";
  static constexpr const char* kSeries = "fields.vtkhdf.series";
  static std::string frame_name(std::size_t number);

 private:
  void write_series() const;

  std::string folder_;
  std::vector<double> times_;
  bool compress_;
};

/// Reads the fields of a frame.
/// @param folder  of the run; links in it are not followed
/// @return nothing if the frame has no file
/// @throws Error(kFileError) for a file that is damaged
std::optional<FieldFrame> read_fields(const std::string& folder, std::size_t number);

}  // namespace acinus::io
