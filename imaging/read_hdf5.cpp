/// Reader of HDF5 images as ilastik, Fiji's plugin and others write them: a dataset with the axes
/// z, y, x, or with axes that the file names.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "geometry/readers/input_file.hpp"
#include "imaging/image_formats.hpp"
#include "imaging/json_statements.hpp"
#include "io/volume_file.hpp"

namespace acinus::imaging {
namespace {

std::string list_of(const std::vector<io::VolumeInfo>& volumes) {
  std::string text;
  for (const io::VolumeInfo& v : volumes) text += (text.empty() ? "" : ", ") + v.name;
  return text;
}

bool named(const io::VolumeInfo& v, const std::string& dataset) {
  return dataset.empty() || v.name == (dataset.starts_with("/") ? dataset : "/" + dataset);
}

/// Chooses the dataset. @param lenient  the name counts only where there are several
io::VolumeInfo choose(const std::string& path, const std::string& said, bool lenient) {
  std::vector<io::VolumeInfo> volumes = io::list_volumes(path);
  const std::string dataset = lenient && volumes.size() == 1 ? "" : said;
  // Tables have two axes as well: datasets with three come first.
  if (dataset.empty() &&
      std::ranges::any_of(volumes, [](const auto& v) { return v.shape.size() > 2; }))
    std::erase_if(volumes, [](const auto& v) { return v.shape.size() < 3; });
  check(!volumes.empty(),
        fmt::format("{}: no dataset of numbers with three axes (z, y, x).", path));
  for (const io::VolumeInfo& v : volumes)
    check(v.shape.size() > 2 || (volumes.size() > 1 && dataset.empty()) || !named(v, dataset),
          fmt::format("{}: {} has two axes, {} x {}: one slice. Cells are made from a stack of "
                      "slices; give the whole stack in one dataset.",
                      path, v.name, v.shape[1], v.shape[0]));
  if (dataset.empty()) {
    check(volumes.size() == 1, fmt::format("{}: has {} images. Say which: --dataset one of {}.",
                                           path, volumes.size(), list_of(volumes)));
    return volumes.front();
  }
  const auto found =
      std::ranges::find_if(volumes, [&](const auto& v) { return named(v, dataset); });
  check(found != volumes.end(), fmt::format("{}: --dataset {}: there is none; there are {}.", path,
                                            dataset, list_of(volumes)));
  return *found;
}

Scalar type_of(const std::string& path, const io::VolumeInfo& v) {
  switch (v.bytes) {
    case 1:
      return v.has_sign ? Scalar::kI8 : Scalar::kU8;
    case 2:
      if (!v.is_real) return v.has_sign ? Scalar::kI16 : Scalar::kU16;
      break;
    case 4:
      return v.is_real ? Scalar::kF32 : v.has_sign ? Scalar::kI32 : Scalar::kU32;
    case 8:
      return v.is_real ? Scalar::kF64 : v.has_sign ? Scalar::kI64 : Scalar::kU64;
    default:
      break;
  }
  throw Error(
      fmt::format("{}: {} has numbers of {} bytes, which are not read.", path, v.name, v.bytes));
}

/// Position of each axis in the shape; nothing where there is none.
struct Axes {
  std::array<std::optional<std::size_t>, 3> space;  ///< x, y, z
  std::optional<std::size_t> channel, time;
};

std::string text_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& n : names) text += (text.empty() ? "" : ", ") + n;
  return text;
}

/// Axis names that the file states, slowest first; empty: none.
std::vector<std::string> named_axes(const std::string& path, const io::VolumeInfo& v) {
  std::vector<std::string> label = v.axis_label;
  for (std::string& l : label) l = geometry::lower_case(l);
  std::vector<std::string> tags;
  if (!v.axis_tags.empty()) {
    const std::optional<std::vector<std::string>> read = read_axis_tags(v.axis_tags);
    check(read.has_value(), fmt::format("{}: {}: its axistags cannot be read: {}. Write it again.",
                                        path, v.name, geometry::in_quotes(v.axis_tags)));
    tags = *read;
  }
  check(tags.empty() || label.empty() || tags == label,
        fmt::format("{}: {}: axistags says the axes {}, its labels {}. Write one of them.", path,
                    v.name, text_of(tags), text_of(label)));
  const std::vector<std::string> said = tags.empty() ? label : tags;
  check(said.empty() || said.size() == v.shape.size(),
        fmt::format("{}: {}: has {} axes, but names {} ({}). Write the image again.", path, v.name,
                    v.shape.size(), said.size(), text_of(said)));
  return said;
}

Axes find_named(const std::string& path, const io::VolumeInfo& v,
                const std::vector<std::string>& name) {
  Axes axes;
  for (std::size_t k = 0; k < name.size(); ++k) {
    std::optional<std::size_t>* axis = nullptr;
    if (name[k].size() == 1 && name[k][0] >= 'x' && name[k][0] <= 'z')
      axis = &axes.space[name[k][0] - 'x'];
    if (name[k] == "c" || name[k] == "channel") axis = &axes.channel;
    if (name[k] == "t" || name[k] == "time") axis = &axes.time;
    if (axis == nullptr && v.shape[k] == 1) continue;
    check(axis != nullptr && !*axis,
          fmt::format("{}: {}: its axes are {}; each of x, y, z, and c and t if there are any, is "
                      "needed once. Write the image again.",
                      path, v.name, text_of(name)));
    *axis = k;
  }
  return axes;
}

/// Axes z, y, x of a dataset without names; axes of length 1 (a channel, a time) may be anywhere
/// among the three.
Axes find_unnamed(const std::string& path, const io::VolumeInfo& v) {
  constexpr std::size_t kAxes = 3;
  std::vector<std::size_t> axis;
  for (std::size_t k = 0; k < v.shape.size(); ++k)
    if (v.shape[k] != 1 || v.shape.size() - k <= kAxes - axis.size()) axis.push_back(k);
  check(axis.size() == kAxes,
        fmt::format("{}: {} has {} axes longer than 1 and no names for them (axistags); three are "
                    "read (z, y, x). Save one channel of one time.",
                    path, v.name, axis.size()));
  Axes axes;
  for (std::size_t k = 0; k < kAxes; ++k) axes.space[k] = axis[kAxes - 1 - k];
  return axes;
}

void check_storage(const std::string& path, const io::VolumeInfo& v) {
  check(v.codec.empty(),
        fmt::format("{}: {} is compressed with {}, which is not read. Save it with gzip or without "
                    "compression.",
                    path, v.name, text_of(v.codec)));
  check(v.fault.empty(), fmt::format("{}: {}: {}.", path, v.name, v.fault));
  check(v.stored > 0,
        fmt::format("{}: {} has a shape but no numbers: none were ever written.", path, v.name));
}

/// Reads the sides of voxels, um, by axis of the shape or, if there are three, of space in that
/// order.
void take_steps(const std::string& path, const io::VolumeInfo& v, const Axes& axes,
                ImageFile& file) {
  if (v.element_size.empty()) return;
  std::vector<std::size_t> spatial;
  for (const auto& a : axes.space)
    if (a) spatial.push_back(*a);
  std::ranges::sort(spatial);
  const bool by_axis = v.element_size.size() == v.shape.size();
  check(by_axis || v.element_size.size() == spatial.size(),
        fmt::format("{}: {}: element_size_um has {} numbers for {} axes. Write the image again.",
                    path, v.name, v.element_size.size(), v.shape.size()));
  file.unit = Vec3::Ones();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!axes.space[k]) continue;
    const std::size_t at = *axes.space[k];
    const std::size_t rank = std::ranges::find(spatial, at) - spatial.begin();
    file.step[static_cast<int>(k)] = v.element_size[by_axis ? at : rank];
  }
}

/// Layout of one channel of one time in a volume.
struct ChannelLayout {
  io::VolumeBox all;                  ///< its numbers
  std::array<std::size_t, 3> axis{};  ///< of x, y, z
};

ChannelLayout lay_out(const io::VolumeInfo& v, const Axes& axes, std::int64_t chosen) {
  ChannelLayout c{{std::vector<std::int64_t>(v.shape.size(), 0), v.shape}, {}};
  for (std::size_t k = 0; k < 3; ++k) c.axis[k] = *axes.space[k];
  const std::int64_t channels = axes.channel ? v.shape[*axes.channel] : 1;
  const auto choose = [&](const std::optional<std::size_t>& axis, std::int64_t n) {
    if (!axis) return;
    c.all.first[*axis] = n;
    c.all.count[*axis] = 1;
  };
  choose(axes.channel, chosen % channels);
  choose(axes.time, chosen / channels);
  return c;
}

/// Cuts a channel along z and y, at the borders of chunks, into boxes of some MB or one chunk.
std::vector<io::VolumeBox> cut(const io::VolumeInfo& v, const ChannelLayout& c) {
  constexpr std::int64_t kMostBytes = 1 << 25;
  std::array<std::int64_t, 2> length{};  // along y, z
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t axis = c.axis[k + 1];
    length[k] = v.chunk.empty() ? 1 : std::min(v.chunk[axis], v.shape[axis]);
  }
  const std::int64_t ny = v.shape[c.axis[1]], nz = v.shape[c.axis[2]];
  const std::int64_t line = v.shape[c.axis[0]] * v.bytes, layer = line * ny * length[1];
  if (layer <= kMostBytes) {
    length[0] = ny;
    length[1] *= std::max<std::int64_t>(1, kMostBytes / layer);
  } else {
    length[0] *= std::max<std::int64_t>(1, kMostBytes / (line * length[0] * length[1]));
  }
  std::vector<io::VolumeBox> boxes;
  for (std::int64_t z = 0; z < nz; z += length[1])
    for (std::int64_t y = 0; y < ny; y += length[0]) {
      io::VolumeBox& box = boxes.emplace_back(c.all);
      box.first[c.axis[1]] = y;
      box.first[c.axis[2]] = z;
      box.count[c.axis[1]] = std::min(length[0], ny - y);
      box.count[c.axis[2]] = std::min(length[1], nz - z);
    }
  return boxes;
}

/// Appends the numbers of a box to the lines of the image.
void append_box(const std::string& path, const io::VolumeInfo& v, const ChannelLayout& c,
                const io::VolumeBox& box, std::span<const std::byte> bytes, ImageFile& file) {
  LabelBlock block;
  block.bytes = bytes;
  std::vector<std::size_t> stride(box.count.size(), v.bytes);
  for (std::size_t k = stride.size() - 1; k-- > 0;) stride[k] = stride[k + 1] * box.count[k + 1];
  for (std::size_t k = 0; k < 3; ++k) {
    block.stride[k] = stride[c.axis[k]];
    block.first[k] = static_cast<int>(box.first[c.axis[k]]);
    block.size[k] = static_cast<int>(box.count[c.axis[k]]);
  }
  append_labels(path, block, file.type, false, file.fill, file.rows);
}

}  // namespace

ImageFile read_hdf5(const std::string& path, const std::string& dataset,
                    const ChannelChoice& channel) {
  const io::VolumeInfo v = choose(path, dataset, channel.only_if_needed);
  check_storage(path, v);
  const std::vector<std::string> name = named_axes(path, v);
  const Axes axes = name.empty() ? find_unnamed(path, v) : find_named(path, v, name);
  const auto length = [&](const std::optional<std::size_t>& a) { return a ? v.shape[*a] : 1; };
  ImageFile file;
  file.type = type_of(path, v);
  for (std::size_t k = 0; k < 3; ++k) file.size[k] = length(axes.space[k]);
  take_steps(path, v, axes, file);
  const std::int64_t n_channel = length(axes.channel) * length(axes.time);
  check_stack(path, file.size, n_channel);
  const std::int64_t chosen = channel.among(path, n_channel);
  const std::size_t voxels = prepare_rows(path, file);
  check_announced(path, static_cast<double>(voxels) * static_cast<double>(n_channel) * v.bytes,
                  v.stored, true);
  if (v.chunks_written < v.chunks)
    file.note.push_back(
        fmt::format("{} has {} of its {} chunks only; the others are taken as "
                    "background",
                    v.name, v.chunks_written, v.chunks));
  const ChannelLayout layout = lay_out(v, axes, chosen);
  const std::vector<io::VolumeBox> boxes = cut(v, layout);
  io::read_volume(path, v, boxes, [&](std::size_t k, std::span<const std::byte> bytes) {
    append_box(path, v, layout, boxes[k], bytes, file);
  });
  return file;
}

}  // namespace acinus::imaging
