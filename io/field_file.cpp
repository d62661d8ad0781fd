#include "io/field_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/hdf5.hpp"
#include "io/inside.hpp"

namespace acinus::io {
namespace {
namespace fs = std::filesystem;

void write_frame(const std::string& path, const FieldFrame& frame, bool compress) {
  h5::File file = h5::File::create(path, h5::Format::kChecked);
  file.write_attribute("/", "schema", "acinus/fields");
  file.write_attribute("/", "schema_version", std::array<std::int64_t, 2>{1, 0});
  file.write_numbers("/", "time_s", std::array<double, 1>{frame.time_s});
  file.create_group("/VTKHDF");
  file.write_attribute("/VTKHDF", "Version", std::array<std::int64_t, 2>{1, 0});
  file.write_attribute("/VTKHDF", "Type", "ImageData");
  file.write_attribute(
      "/VTKHDF", "WholeExtent",
      std::array<std::int64_t, 6>{0, frame.n[0] - 1, 0, frame.n[1] - 1, 0, frame.n[2] - 1});
  const auto three = [](const Vec3& v) { return std::array<double, 3>{v.x(), v.y(), v.z()}; };
  file.write_numbers("/VTKHDF", "Origin", three(frame.origin + 0.5 * frame.spacing));
  file.write_numbers("/VTKHDF", "Spacing", three(frame.spacing));
  file.write_numbers("/VTKHDF", "Direction", std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  // Values at points, the centres of voxels: VTK 9.1 cannot read those of cells.
  file.create_group("/VTKHDF/PointData");
  for (const VoxelField& f : frame.field) {
    const std::string name = "/VTKHDF/PointData/" + f.name;
    file.write_volume(name, {frame.n[2], frame.n[1], frame.n[0]}, f.value, compress);
    file.write_attribute(name, "unit", f.unit);
  }
  file.close();
}

}  // namespace

FieldFiles::FieldFiles(std::string folder, std::vector<double> times, bool compress)
    : folder_(std::move(folder)), times_(std::move(times)), compress_(compress) {
  const fs::path frames = fs::path(folder_) / kFolder;
  std::error_code failed;
  fs::create_directories(frames, failed);
  check(!failed,
        fmt::format("{}: the folder cannot be made ({})", frames.string(), failed.message()),
        Exit::kFileError);
  for (std::size_t k = times_.size(); fs::remove(frames / frame_name(k), failed); ++k) continue;
}

std::string FieldFiles::frame_name(std::size_t number) {
  return fmt::format("frame_{:06d}.vtkhdf", number);
}

void FieldFiles::append(const FieldFrame& frame) {
  const std::string path = (fs::path(folder_) / kFolder / frame_name(times_.size())).string();
  const std::string partial = path + ".tmp";
  {
    const RemoveUnlessMoved cleanup{partial};
    write_frame(partial, frame, compress_);
    replace_file(partial, path);
  }
  times_.push_back(frame.time_s);
  write_series();
}

void FieldFiles::write_series() const {
  std::string text = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [";
  for (std::size_t k = 0; k < times_.size(); ++k)
    text += fmt::format("{}\n    {{ \"name\": \"{}/{}\", \"time\": {} }}", k > 0 ? "," : "",
                        kFolder, frame_name(k), times_[k]);
  write_text_file((fs::path(folder_) / kSeries).string(), text + "\n  ]\n}\n");
}

std::optional<FieldFrame> read_fields(const std::string& folder, std::size_t number) {
  const std::string name =
      fmt::format("{}/{}", FieldFiles::kFolder, FieldFiles::frame_name(number));
  if (!is_file_inside(folder, name)) return std::nullopt;
  const std::string path = (fs::path(folder) / name).string();
  const h5::File file = h5::File::open(path, h5::Access::kRead);
  const auto sound = [&](bool is_sound) {
    check(is_sound, path + ": is damaged or was not written by acinus.", Exit::kFileError);
  };
  const auto numbers = [&](const char* object, const char* attribute, std::size_t n) {
    std::vector<double> value = file.read_numbers(object, attribute);
    sound(value.size() == n &&
          std::ranges::all_of(value, [](double x) { return std::isfinite(x); }));
    return value;
  };
  FieldFrame frame;
  frame.time_s = numbers("/", "time_s", 1)[0];
  const std::vector<double> origin = numbers("/VTKHDF", "Origin", 3);
  const std::vector<double> spacing = numbers("/VTKHDF", "Spacing", 3);
  const std::vector<std::int64_t> extent = file.read_attribute("/VTKHDF", "WholeExtent");
  sound(extent.size() == 6);
  for (int axis = 0; axis < 3; ++axis) {
    constexpr std::int64_t kMost = 1'000'000;
    const std::int64_t last = extent[2 * axis + 1];
    sound(extent[2 * axis] == 0 && last >= 0 && last < kMost && spacing[axis] > 0);
    frame.n[axis] = static_cast<int>(last) + 1;
    frame.spacing[axis] = spacing[axis];
    frame.origin[axis] = origin[axis] - 0.5 * spacing[axis];
  }
  for (const std::string& field : file.members("/VTKHDF/PointData")) {
    const std::string at = "/VTKHDF/PointData/" + field;
    frame.field.push_back({field, file.read_text_attribute(at, "unit"),
                           file.read_volume(at, {frame.n[2], frame.n[1], frame.n[0]})});
  }
  return frame;
}

}  // namespace acinus::io
