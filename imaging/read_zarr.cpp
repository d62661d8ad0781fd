/// Reader of label images of OME-Zarr, versions 0.4 and 0.5, in local folders: chunk by chunk, so
/// that it needs little memory beside the labels.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "geometry/readers/input_file.hpp"
#include "imaging/image_formats.hpp"
#include "imaging/ome_multiscale.hpp"
#include "imaging/zarr_chunks.hpp"

namespace acinus::imaging {
namespace {

/// Position of each axis in the shape; nothing where there is none.
struct ZarrAxes {
  std::array<std::size_t, 3> space{};  ///< x, y, z
  std::optional<std::size_t> channel, time;
};

std::string text_of(const std::vector<OmeAxis>& axis) {
  std::string text;
  for (const OmeAxis& a : axis)
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", a.name,
                        a.type.empty() ? "" : " (" + a.type + ")");
  return text;
}

ZarrAxes find_axes(const OmeMultiscale& m, const ZarrArray& array) {
  const auto rule = [&](const std::string& found) {
    return fmt::format(
        "{}: {}: its axes are {}. Each of x, y, z of type space is needed once, and "
        "c of type channel and t of type time are allowed. Write the image again.",
        m.file, found, text_of(m.axis));
  };
  check(m.axis.size() == array.shape.size(),
        rule(fmt::format("{} axes for an array of {}, {}", m.axis.size(), array.shape.size(),
                         array.folder)));
  std::array<std::optional<std::size_t>, 3> space;
  ZarrAxes axes;
  for (std::size_t k = 0; k < m.axis.size(); ++k) {
    const std::string name = geometry::lower_case(m.axis[k].name), &type = m.axis[k].type;
    std::optional<std::size_t>* axis = nullptr;
    std::string expected = "space";
    if (name == "x" || name == "y" || name == "z") axis = &space[name[0] - 'x'];
    if (name == "c" || type == "channel") {
      axis = &axes.channel;
      expected = "channel";
    }
    if (name == "t" || type == "time") {
      axis = &axes.time;
      expected = "time";
    }
    if (axis == nullptr && array.shape[k] == 1) continue;
    check(axis != nullptr && !*axis && (type.empty() || type == expected),
          rule(fmt::format("axis {} is {} (length {})", k, geometry::in_quotes(m.axis[k].name),
                           array.shape[k])));
    *axis = k;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    check(space[k].has_value(), rule(fmt::format("no axis {}", "xyz"[k])));
    axes.space[k] = *space[k];
  }
  if (!array.axis.empty())
    for (std::size_t k = 0; k < m.axis.size(); ++k)
      check(array.axis.size() == m.axis.size() &&
                (array.axis[k].empty() || array.axis[k] == m.axis[k].name),
            rule(fmt::format("the dimension_names of {} differ", array.folder)));
  return axes;
}

void take_steps(const OmeMultiscale& m, const OmeLevel& level, const ZarrAxes& axes,
                ImageFile& file) {
  file.step_fault = level.fault.empty() ? "" : m.file + ": " + level.fault;
  double most = 0;
  Vec3 moved = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const std::size_t axis = axes.space[static_cast<std::size_t>(k)];
    if (!level.scale.empty()) file.step[k] = level.scale[axis];
    const std::string& unit = m.axis[axis].unit;
    file.unit[k] = unit_by_name(unit);
    if (!unit.empty() && file.unit[k] == 0 && file.step_fault.empty())
      file.step_fault =
          fmt::format("{}: the unit of axis {} is {}, which is no length that is known", m.file,
                      m.axis[axis].name, geometry::in_quotes(unit));
    moved[k] = level.translation[axis];
    most = std::max(most, file.step[k] > 0 ? std::abs(moved[k]) / file.step[k] : 0);
  }
  if (most > 1)  // levels of a pyramid are shifted by parts of a voxel
    file.note.push_back(fmt::format(
        "the translation of {} x {} x {} is not applied: the corner of the first voxel is the "
        "origin",
        moved[0], moved[1], moved[2]));
}

const OmeLevel& choose_level(const OmeMultiscale& m, std::int64_t level) {
  const auto n = static_cast<std::int64_t>(m.level.size());
  check(level < n, fmt::format("{}: --level {}: the image has {} level{}, numbered from 0, the "
                               "finest.",
                               m.file, level, n, n == 1 ? "" : "s"));
  return m.level[static_cast<std::size_t>(std::max<std::int64_t>(level, 0))];
}

/// Appends chunks to the lines of an image.
class ChunkPlacing {
 public:
  ChunkPlacing(const ZarrArray& array, const ZarrAxes& axes,
               std::span<const std::optional<std::int64_t>> fixed, ImageFile& file)
      : array_(array), axes_(axes), fixed_(fixed), stride_(chunk_strides(array)), file_(file) {}

  void place(const ZarrChunk& chunk) const {
    LabelBlock block;
    block.bytes = std::as_bytes(std::span(chunk.bytes));
    for (std::size_t k = 0; k < fixed_.size(); ++k)
      if (fixed_[k]) block.start += (*fixed_[k] - chunk.first[k]) * stride_[k];
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t k = axes_.space[d];
      block.first[d] = static_cast<int>(chunk.first[k]);
      block.size[d] = static_cast<int>(std::min(array_.chunk[k], array_.shape[k] - chunk.first[k]));
      block.stride[d] = stride_[k];
    }
    append_labels(chunk.place, block, file_.type, array_.encoding.swap, file_.fill, file_.rows);
  }

 private:
  const ZarrArray& array_;
  const ZarrAxes& axes_;
  std::span<const std::optional<std::int64_t>> fixed_;
  std::vector<std::size_t> stride_;
  ImageFile& file_;
};

}  // namespace

ImageFile read_zarr(const std::string& path, const ZarrChoice& choice,
                    const ChannelChoice& channel) {
  const std::string folder = choose_ome_image(path, choice.dataset, channel.only_if_needed);
  const OmeMultiscale m = read_multiscale(folder);
  const OmeLevel& level = choose_level(m, choice.level);
  const ZarrArray array = read_zarr_array(folder + "/" + level.path);
  const ZarrAxes axes = find_axes(m, array);
  ImageFile file;
  file.type = array.type;
  for (std::size_t k = 0; k < 3; ++k) file.size[k] = array.shape[axes.space[k]];
  take_steps(m, level, axes, file);
  if (!m.is_label && folder == path)
    file.note.push_back("the metadata do not say that this is a label image; it is taken as one");
  const auto length = [&](const std::optional<std::size_t>& a) { return a ? array.shape[*a] : 1; };
  const std::int64_t channels = length(axes.channel), n_channel = channels * length(axes.time);
  check_stack(path, file.size, n_channel);
  const std::int64_t chosen = channel.among(path, n_channel);
  std::vector<std::optional<std::int64_t>> fixed(array.shape.size(), 0);
  for (const std::size_t k : axes.space) fixed[k].reset();
  if (axes.channel) fixed[*axes.channel] = chosen % channels;
  if (axes.time) fixed[*axes.time] = chosen / channels;
  prepare_rows(path, file);
  file.fill = array.fill.value_or(0);
  const ChunkPlacing placing(array, axes, fixed, file);
  const std::int64_t found = visit_chunks(array, fixed, axes.space[0],
                                          [&](const ZarrChunk& chunk) { placing.place(chunk); });
  std::int64_t all = 1;
  for (const std::size_t k : axes.space)
    all *= (array.shape[k] + array.chunk[k] - 1) / array.chunk[k];
  check(array.fill || found == all,
        fmt::format("{}: {} of its {} chunks are not stored, and its fill value is no label, a "
                    "whole number from 0 on. Write the image again.",
                    array.folder, all - found, all));
  check(found > 0, fmt::format("{}: none of its chunks is there, so all voxels would be the fill "
                               "value. The image is incomplete; copy or write it again.",
                               array.folder));
  return file;
}

}  // namespace acinus::imaging
